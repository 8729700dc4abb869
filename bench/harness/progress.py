"""How far a long run is."""

import os
import sys
import time


class Progress:
    """A bar on a terminal, a line for every step elsewhere; on standard error."""

    def __init__(self, steps):
        self.steps, self.done, self.start = steps, 0, time.monotonic()
        self.bar = sys.stderr.isatty() and os.environ.get("TERM") != "dumb"

    def step(self, words):
        """The next step begins."""
        if not self.bar:
            sys.stderr.write(f"== {words} ({self.done + 1} of {self.steps}, {self._seconds():.0f} s)\n")
            sys.stderr.flush()
        self.note(words)
        self.done += 1

    def note(self, words):
        """What the step is at; only shown on a terminal."""
        if not self.bar:
            return
        filled = "#" * round(24 * self.done / max(self.steps, 1))
        text = f"[{filled:24}] {self.done}/{self.steps} {self._seconds():4.0f} s  {words}"
        sys.stderr.write("\r\x1b[K" + text[:os.get_terminal_size(2).columns - 1])
        sys.stderr.flush()

    def _seconds(self):
        return time.monotonic() - self.start

    def finish(self):
        if self.bar:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()
