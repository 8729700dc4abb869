"""Programs that are measured from outside."""

import os
import subprocess
import tempfile
import threading
from dataclasses import dataclass

# One thread each, whatever libraries they use.
ONE_THREAD = {name: "1" for name in
              ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


@dataclass
class Child:
    """How a program ended."""
    status: int  # exit status; negative: the signal
    output: str
    errors: str
    user: float  # seconds
    peak_mb: float  # greatest resident memory, 10^6 bytes
    timed_out: bool


def run(command, seconds=600):
    """Runs `command` on one thread and kills it after `seconds`."""
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=errors,
                                   env={**os.environ, **ONE_THREAD})
        late = threading.Event()
        timer = threading.Timer(seconds, lambda: (late.set(), process.kill()))
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        finally:
            timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        return Child(process.returncode, output.read(), errors.read(), usage.ru_utime,
                     usage.ru_maxrss * 1024 / 1e6, late.is_set())
