#!/usr/bin/env python3
"""The Web in a headless Chromium that draws in software: scenes beside Compatibility on a desktop.

web_test.py --work DIR: GODOT names the engine, WEB_TEMPLATE the folder of its Web template.
"""

import argparse
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/web"))
import browser  # noqa: E402
import gallery  # noqa: E402

# Seconds; far more than anything takes.
LIMIT = 600
# A picture of nothing would agree with itself.
LEAST_CONTRAST = 20.0


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


def check_gallery(checks, program, work):
    """Every scene of tests/web is drawn in the browser as on the desktop."""
    site = work / "gallery"
    gallery.make_site(work / "project", site, pathlib.Path(os.environ["WEB_TEMPLATE"]))
    expected, _times = gallery.draw_on_desktop(site)
    page = browser.Page(program, size=(80, 80))
    with browser.serve(site) as address:
        pictures, _times = gallery.draw_in_browser(page, address, site, LIMIT)
    checks.expect_silence("gallery", page)
    page.close()
    checks.expect(f"gallery: {len(expected)} scenes", len(expected) >= 5 and expected.keys() == pictures.keys())
    for name, picture in expected.items():
        checks.expect(f"{name} shows something", float(picture.std()) > LEAST_CONTRAST)
        share, largest = gallery.compare(picture, pictures[name])
        said = f"{name}: {share:.3%} of the pixels within {gallery.NEAR}/255, {gallery.LEAST_SHARE:.1%} wanted"
        checks.expect(f"{said}, at most {largest}/255", share >= gallery.LEAST_SHARE)


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    options = parser.parse_args()
    checks = Checks()
    try:
        with browser.start_browser() as program:
            check_gallery(checks, program, options.work)
    except (browser.PageError, gallery.GalleryError) as error:
        checks.expect(str(error), False)
    print(f"web: {checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed else 0


if __name__ == "__main__":
    sys.exit(main())
