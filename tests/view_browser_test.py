#!/usr/bin/env python3
"""Opens pages of `marrow view` in a headless Chromium, turns, clicks and looks at the pixels.

  tests/view_browser_test.py MARROW

Ends with 77, which CTest calls skipped, where there is no Chromium.
"""
import pathlib
import subprocess
import sys
import tempfile
import time

import chromium

SIZE = (1000, 700)
MIDDLE = (200, 60, 760, 600)  # left, top, right, bottom: the canvas between the panels
HOSTILE = "</title></script><script>alert(1)</script>&\"'@DATA@"
MESHES = pathlib.Path(__file__).parents[2] / "shared/meshes/real"  # where they are at hand
failures = 0


def check(is_right, words):
    global failures
    if not is_right:
        failures += 1
        print("FAIL", words)


def run(marrow, *arguments):
    subprocess.run([marrow, *map(str, arguments)], check=True)


def make_page(marrow, folder, name, *options):
    """A page of a shape that `marrow make` knows."""
    shape, lines, page = (folder / f"{name}{end}" for end in (".obj", ".skel", ".html"))
    run(marrow, "make", name, "-o", shape, "--resolution", "0.5")
    run(marrow, "extract", shape, "-o", lines, "--quiet", "--trace", folder / name)
    run(marrow, "view", shape, lines, "-o", page, *options)
    check(page.stat().st_size < 2e6, f"{page.name} has {page.stat().st_size} bytes")
    return page


def open_page(browser, page):
    """Returns when it is drawn, and says after how long."""
    browser.events.clear()
    browser.ask("Emulation.setDeviceMetricsOverride", width=SIZE[0], height=SIZE[1],
                deviceScaleFactor=1, mobile=False)
    start = time.monotonic()
    browser.ask("Page.navigate", url=page.as_uri())
    # The page before has been drawn too.
    browser.wait(f"location.href === '{page.as_uri()}' && document.readyState === 'complete' && "
                 "document.documentElement.dataset.drawn > 0")
    print(f"{page.name}: {page.stat().st_size} bytes, drawn after {time.monotonic() - start:.2f} s")


def open_plain_page(browser, folder):
    """What the browser needs on this machine, now, for nothing but a context of WebGL."""
    page = folder / "plain.html"
    page.write_text("""<!doctype html><canvas></canvas><script>
      const gl = document.querySelector("canvas").getContext("webgl2");
      requestAnimationFrame(() => {
        gl.clear(gl.COLOR_BUFFER_BIT);
        gl.finish();
        document.documentElement.dataset.drawn = 1;
      });
    </script>""")
    open_page(browser, page)


def open_real_shapes(browser, marrow, folder):
    for shape in filter(pathlib.Path.exists, (MESHES / "horse.obj", MESHES / "rings3.obj")):
        lines, page = (folder / f"{shape.stem}{end}" for end in (".skel", ".html"))
        run(marrow, "extract", shape, "-o", lines, "--quiet")
        run(marrow, "view", shape, lines, "-o", page)
        open_page(browser, page)
        check_is_quiet(browser, page)


def differing(a, b):
    """The share of pixels in the middle that differ clearly."""
    pairs = list(zip(a.area(*MIDDLE), b.area(*MIDDLE)))
    return sum(max(abs(p - q) for p, q in zip(x[1], y[1])) > 24 for x, y in pairs) / len(pairs)


def colourful(picture, least):
    return [place for place, (r, g, b) in picture.area(*MIDDLE)
            if max(r, g, b) - min(r, g, b) >= least]


def check_is_quiet(browser, page):
    check(browser.complaints() == [], f"{page.name}: {browser.complaints()}")
    other = [url for url in browser.requests() if url != page.as_uri() and url != "data:,"]
    check(other == [], f"{page.name} asks for {other}")


def check_moves(browser, first):
    browser.drag((450, 300), (560, 340))
    turned = browser.picture()
    check(differing(first, turned) > 0.03, "a drag does not turn the shape")
    for key, shift in (("ArrowLeft", False), ("ArrowUp", True), ("+", False)):
        browser.key(key, shift)
        now = browser.picture()
        check(differing(turned, now) > 0.01, f"{key} does nothing")
        turned = now
    browser.mouse("mouseWheel", 450, 300, deltaX=0, deltaY=300)
    check(differing(turned, browser.picture()) > 0.01, "the wheel does nothing")
    browser.key("r")
    check(differing(first, browser.picture()) < 0.001, "R does not lead back")


def check_controls(browser, first):
    browser.key("f")
    bare = browser.picture()
    check(len(colourful(bare, 30)) < len(colourful(first, 30)) / 2, "F leaves the surface")
    browser.key("f")
    for key in ("s", "s", "c", "l"):
        browser.key(key)
        now = browser.picture()
        check(differing(first, now) > 0.0005, f"{key} does nothing")
    check(browser.value("!document.getElementById('scale').hidden"), "no scale of radii")
    check(browser.value("document.getElementById('scale').textContent.includes('units of the file')"),
          "no unit")
    for key in ("s", "c"):
        browser.key(key)
    # The stages, one after the other, and the skeleton again.
    layers = browser.value("document.querySelectorAll('.layer').length")
    check(layers == 7, f"{layers} layers instead of 7")
    for _ in range(layers - 1):
        browser.key("l")
    check(differing(first, browser.picture()) < 0.001, "the controls do not lead back")


def check_click(browser, first):
    bright = colourful(first, 110)
    check(len(bright) > 100, "no lines to be seen")
    said = ""
    for x, y in bright[len(bright) // 2:][:5]:
        browser.click(x, y)
        said = browser.value("document.getElementById('status').textContent")
        if said:
            break
    check(said.startswith("skeleton: node ") and ", radius " in said, f"a click says '{said}'")
    browser.click(230, 590)
    check(browser.value("document.getElementById('status').textContent") == "", "words stay")


def check_colours(browser):
    for scheme, is_right in (("dark", lambda c: max(c) < 60), ("light", lambda c: min(c) > 200)):
        browser.ask("Emulation.setEmulatedMedia",
                    features=[{"name": "prefers-color-scheme", "value": scheme}])
        picture = browser.picture()
        check(is_right(picture.at(400, 20)), f"{scheme}: the ground is {picture.at(400, 20)}")
        check(len(colourful(picture, 110)) > 100, f"{scheme}: no lines to be seen")


def check_without_webgl(program, page):
    browser = chromium.Browser(program, "--disable-3d-apis")
    try:
        browser.ask("Page.navigate", url=page.as_uri())
        browser.wait("document.readyState === 'complete' && "
                     "!!document.getElementById('sorry') && !document.getElementById('sorry').hidden")
        check(browser.value("document.getElementById('facts').children.length") > 6, "no figures")
        check_is_quiet(browser, page)
    finally:
        browser.close()


def main():
    marrow, program = sys.argv[1], chromium.find()
    if program is None:
        print("skipped: no Chromium here; apt-get install chromium")
        return 77
    with tempfile.TemporaryDirectory(prefix="marrow-view.") as name:
        folder = pathlib.Path(name)
        animal = make_page(marrow, folder, "quadruped", "--trace", folder / "quadruped")
        rings = make_page(marrow, folder, "rings", "--title", HOSTILE)
        browser = chromium.Browser(program)
        try:
            open_plain_page(browser, folder)
            open_page(browser, animal)
            first = browser.picture()
            check(len(colourful(first, 30)) > 2000, "no shape to be seen")
            check_click(browser, first)
            check_moves(browser, first)
            check_controls(browser, first)
            check_colours(browser)
            check_is_quiet(browser, animal)
            open_page(browser, rings)
            check(browser.value("document.title") == HOSTILE, "the title is not what was asked for")
            check(len(colourful(browser.picture(), 110)) > 100, "no rings to be seen")
            check_is_quiet(browser, rings)
            open_real_shapes(browser, marrow, folder)
        finally:
            browser.close()
        check_without_webgl(program, animal)
    if failures == 0:
        print("pages in a browser: all good")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
