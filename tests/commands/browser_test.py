#!/usr/bin/env python3
"""A headless Chromium that draws in software: scenes beside Compatibility on this machine, and the demo's page.

browser_test.py --scenes DIR [--every-scene] | --page DIR [--controls]: the scenes' project is made in DIR, where GODOT names the engine and
WEB_TEMPLATE the folder of its Web template; the page is of ./dev web. --controls, which takes minutes, also drags the divider and a
slider.
"""

import argparse
import os
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/web"))
import browser  # noqa: E402
import demo_page  # noqa: E402
import gallery  # noqa: E402

# Seconds; far more than anything takes.
LIMIT = 600
# A picture of nothing would agree with itself.
LEAST_CONTRAST = 20.0
MOST_APART = 1
# A coat and a sheen in a baked light, and a room with a probe that is captured. Each takes half a minute, most of it for shaders, so only
# --every-scene also draws a procedural sky by lobes of a table and by an own shader, and long lobes and sources of a panorama.
SCENES = ("dielectric", "room")
MORE_SCENES = ("sky", "own", "long")


class Checks:
    def __init__(self):
        self.passed = self.failed = 0

    def expect(self, name, holds):
        print(f"  {name}: {'passed' if holds else 'FAILED'}", flush=True)
        self.passed += bool(holds)
        self.failed += not holds

    def expect_silence(self, name, page):
        complaints = page.complaints()
        self.expect(f"{name}: no error and no warning on the console", not complaints)
        for text in complaints[:10]:
            print(f"    {text[:300]}")


def check_gallery(checks, program, work, scenes):
    """Scenes of tests/web are drawn in the browser as on the desktop."""
    site = work / "gallery"
    gallery.make_site(work / "project", site, pathlib.Path(os.environ["WEB_TEMPLATE"]))
    expected, _times = gallery.draw_on_desktop(site, *scenes)
    page = browser.Page(program, size=(80, 80))
    with browser.serve(site) as address:
        pictures, _times = gallery.draw_in_browser(page, address, site, LIMIT, *scenes)
    checks.expect_silence("gallery", page)
    page.close()
    is_whole = expected.keys() == pictures.keys() == set(scenes)
    checks.expect(f"gallery: {len(pictures)} scenes", is_whole)
    if not is_whole:
        return
    for name, picture in expected.items():
        checks.expect(f"{name} shows something", float(picture.std()) > LEAST_CONTRAST)
        share, largest = gallery.compare(picture, pictures[name])
        said = f"{name}: {share:.3%} of the pixels within {gallery.NEAR}/255, {gallery.LEAST_SHARE:.1%} wanted"
        checks.expect(f"{said}, at most {largest}/255", share >= gallery.LEAST_SHARE)
    if "own" not in scenes:
        return
    # The same metal by a shader of one's own and by LobeMaterial3D.
    apart = int(np.abs(pictures["own"] - pictures["sky"]).max())
    checks.expect(f"own: {apart}/255 from LobeMaterial3D's picture at most, {MOST_APART} wanted", apart <= MOST_APART)


def check_page(checks, program, folder, with_controls):
    """The demo loads and shows something; its controls follow the mouse and a finger."""
    with browser.serve(folder) as address:
        page = browser.Page(program, size=demo_page.SIZE, has_touch=True)
        demo = demo_page.DemoPage(page)
        demo.open(address, LIMIT)
        picture = demo.picture()
        checks.expect("page: the first picture shows something", float(picture.std()) > LEAST_CONTRAST)
        if with_controls:
            check_controls(checks, page, demo)
        for pixels, wanted in ((1, (60, 40)), (1.5, (90, 60)), (3, (120, 80))):
            size = demo.canvas_of_screen((60, 40), pixels)
            checks.expect(f"page: a screen of {pixels} pixels for one of CSS is drawn with {size}", size == wanted)
    checks.expect_silence("page", page)
    page.close()


def check_controls(checks, page, demo):
    """The divider and a slider, dragged, and a window of another size."""
    # Fewer lobes, of which frames take less time.
    checks.expect("page: one method has no divider", demo_page.find_divider(demo.press("l", "l", "h")) < 0)
    picture = demo.press("b")
    for title, drag, to in (("mouse", page.drag_by_mouse, 0.3), ("finger", page.drag_by_finger, 0.7)):
        holds, picture = demo.try_divider(picture, drag, to)
        checks.expect(f"page: the divider follows the {title}", holds)
    picture = demo.press("h")
    for title, drag, to in (("mouse", page.drag_by_mouse, 180), ("finger", page.drag_by_finger, 230)):
        holds, picture = demo.try_slider(picture, drag, to)
        checks.expect(f"page: a slider follows the {title} and turns the environment", holds)
    picture, size = demo.resize(demo_page.PORTRAIT)
    checks.expect(f"page: the canvas is as large as the window, {size}", size == demo_page.PORTRAIT)
    checks.expect("page: it shows something there", float(picture.std()) > LEAST_CONTRAST)


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--scenes", type=pathlib.Path)
    what.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--controls", action="store_true")
    parser.add_argument("--every-scene", action="store_true")
    options = parser.parse_args()
    checks = Checks()
    try:
        with browser.start_browser() as program:
            if options.page:
                check_page(checks, program, options.page, options.controls)
            else:
                check_gallery(checks, program, options.scenes, SCENES + (MORE_SCENES if options.every_scene else ()))
    except (browser.PageError, gallery.GalleryError) as error:
        checks.expect(str(error), False)
    print(f"browser: {checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed else 0


if __name__ == "__main__":
    sys.exit(main())
