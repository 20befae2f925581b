"""The demo's page in a browser: its divider and its first slider, found by their places and judged by pictures."""

import numpy as np
from browser import PageError
from playwright.sync_api import TimeoutError

# Small, as it is drawn in software: the panel of controls leaves little of the picture.
SIZE = (360, 200)
PORTRAIT = (200, 300)
# The first slider, which sets the environment's direction (demo/interface/interface.gd): its row, a row of its grabber where the
# track is not, where the grabber is at the start, and the columns in which it moves.
SLIDER_ROW = 145
GRABBER_ROW = 138
SLIDER_START = 141
SLIDER_TRACK = slice(131, 290)
# Rows of the divider's line below its handle, the handle's, and rows that the panel leaves free.
LINE = slice(125, 198)
HANDLE_ROW = 100
FREE = slice(190, 200)
# Pixels that things may be off, and what of 255 the line and the grabber have at least.
NEAR = 8
BRIGHT = 200
# Of 255: what a picture that has changed differs by, on average.
CHANGED = 0.5
# Until what has been done is in the picture.
FRAMES = 3


class DemoPage:
    """The demo in a browser.Page of SIZE."""

    def __init__(self, page):
        self.page = page
        self.screen = None

    def open(self, address, limit):
        """Loads it and waits for the first picture, `limit` seconds at most."""
        self.page.open(f"{address}index.html")
        script = "document.querySelector('#cover.gone, #state.problem') || !document.getElementById('cover')"
        try:
            self.page.page.wait_for_function(script, timeout=1000 * limit)
        except TimeoutError as error:
            raise PageError(f"the page showed nothing in {limit} s") from error
        if problem := self.page.page.evaluate("document.querySelector('#state.problem')?.textContent"):
            raise PageError(f"the page says: {problem}")
        self.wait_for_frames(2)

    def wait_for_frames(self, count):
        """Until the browser has drawn so many."""
        script = "n => new Promise(done => { const next = () => n-- > 0 ? requestAnimationFrame(next) : done(); next(); })"
        self.page.page.evaluate(script, count)

    def picture(self):
        return self.page.picture()

    def settle(self, frames=FRAMES):
        """The picture once it shows what has been done."""
        self.wait_for_frames(frames)
        return self.picture()

    def press(self, *keys):
        """The picture after keys of the demo: H folds the panel, L takes other lobes, B another second method."""
        for key in keys:
            self.page.page.keyboard.press(key)
        return self.settle()

    def try_divider(self, picture, drag, to):
        """Drags the divider of a picture to a part of the width: whether it was there and is there now, and the picture."""
        before, there = find_divider(picture), round(to * picture.shape[1])
        drag((before, HANDLE_ROW), (there, HANDLE_ROW))
        picture = self.settle()
        return before >= 0 and abs(find_divider(picture) - there) <= NEAR, picture

    def try_slider(self, picture, drag, to):
        """Drags the slider to a column: whether its grabber is there and the environment has turned, and the picture."""
        drag((find_grabber(picture), SLIDER_ROW), (to, SLIDER_ROW))
        turned = self.settle()
        changed = float(np.abs(turned[FREE] - picture[FREE]).mean())
        return abs(find_grabber(turned) - to) <= NEAR and changed > CHANGED, turned

    def resize(self, size):
        """The picture in a window of another size, and the canvas's size on the page."""
        self.page.page.set_viewport_size({"width": size[0], "height": size[1]})
        picture = self.settle()
        box = self.page.page.locator("canvas").bounding_box()
        return picture, (round(box["width"]), round(box["height"]))

    def canvas_of_screen(self, size, pixels):
        """The canvas's width and height in pixels where the window is of this size and the screen has so many pixels for each
        of CSS. The page stays so."""
        if self.screen is None:
            # What it says holds for as long as it lives.
            self.screen = self.page.context.new_cdp_session(self.page.page)
        of_screen = {"width": size[0], "height": size[1], "deviceScaleFactor": pixels, "mobile": False}
        self.screen.send("Emulation.setDeviceMetricsOverride", of_screen)
        self.wait_for_frames(FRAMES)
        return tuple(self.page.page.evaluate("(c => [c.width, c.height])(document.getElementById('canvas'))"))


def find_divider(picture):
    """The column of the line between the two methods, bright all the way down; -1 if there is none."""
    columns = np.flatnonzero(np.all(picture[LINE].min(axis=-1) > BRIGHT, axis=0))
    return int(columns.mean()) if columns.size else -1


def find_grabber(picture):
    """The column of the slider's grabber."""
    columns = np.flatnonzero(picture[GRABBER_ROW, SLIDER_TRACK].max(axis=-1) > BRIGHT)
    return int(columns.mean()) + SLIDER_TRACK.start if columns.size else SLIDER_START
