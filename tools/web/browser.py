"""Opens folders of files in a headless Chromium that draws WebGL 2 in software, and keeps what pages say."""

import contextlib
import functools
import http.server
import io
import os
import re
import threading
import time

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

from serve import Handler

PROGRAM = "/usr/bin/chromium"
ARGUMENTS = [
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-dev-shm-usage",
    "--autoplay-policy=no-user-gesture-required",
]
# What the browser says of the engine's sound, whatever the page shows.
ENGINE_SAYS = ["The ScriptProcessorNode is deprecated. Use AudioWorkletNode instead. (https://bit.ly/audio-worklet)"]
# What Chromium says once where a WebGL page reads pixels, as live capture in Compatibility does, and this file's tests.
READ_BACK = re.compile(
    r"\[\.WebGL-0x[0-9a-f]+\]GL Driver Message \(OpenGL, Performance, GL_CLOSE_PATH_NV, High\): GPU stall due to ReadPixels"
    r"( \(this message will no longer repeat\))?"
)
DRAG_STEPS = 4


class PageError(Exception):
    """Says in one sentence what went wrong."""


@contextlib.contextmanager
def serve(folder, isolated=False):
    """Serves a folder to this machine; gives its address."""
    handler = type("FolderHandler", (Handler,), {"isolated": isolated})
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(handler, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()


@contextlib.contextmanager
def start_browser(*more):
    """The browser, until the context ends."""
    arguments = [*ARGUMENTS, *more]
    # Chromium refuses to run as root inside its sandbox.
    if os.geteuid() == 0:
        arguments.append("--no-sandbox")
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=PROGRAM, headless=True, args=arguments)
        try:
            yield browser
        finally:
            browser.close()


class Page:
    """A page and all that it says: `lines`, of (kind, text, seconds since it was opened)."""

    def __init__(self, browser, size=(640, 480), **options):
        self.context = browser.new_context(viewport={"width": size[0], "height": size[1]}, **options)
        self.page = self.context.new_page()
        self.lines = []
        self.opened = time.monotonic()
        self.page.on("console", lambda message: self._say(message.type, message.text))
        self.page.on("pageerror", lambda error: self._say("error", str(error)))
        self.page.on("crash", lambda _page: self._say("error", "the page crashed"))

    def _say(self, kind, text):
        self.lines.append((kind, text, time.monotonic() - self.opened))

    def open(self, address):
        self.opened = time.monotonic()
        self.page.goto(address)

    def wait_for(self, start, limit, since=0):
        """The first line from `since` on that begins with `start`; PageError after `limit` seconds."""
        ends = time.monotonic() + limit
        while True:
            for kind, text, _when in self.lines[since:]:
                if text.startswith(start):
                    return text
                if kind == "error" and text == "the page crashed":
                    raise PageError(text)
            if time.monotonic() > ends:
                said = "; ".join(text[:200] for _kind, text, _when in self.lines[-5:])
                raise PageError(f"the page did not say {start!r} in {limit} s; it said last: {said}")
            self.page.wait_for_timeout(100)

    def complaints(self):
        """Errors and warnings on the console but for ENGINE_SAYS and what the driver says of pictures that are read back."""
        said = [text for kind, text, _when in self.lines if kind in ("error", "warning")]
        return [text for text in said if text not in ENGINE_SAYS and not READ_BACK.fullmatch(text)]

    def picture(self):
        """What the page shows: (height, width, 3), from 0 to 255."""
        return np.asarray(Image.open(io.BytesIO(self.page.screenshot(timeout=300_000))).convert("RGB"), dtype=int)

    def drag_by_mouse(self, start, end):
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        for step in range(1, DRAG_STEPS + 1):
            mouse.move(*(a + (b - a) * step / DRAG_STEPS for a, b in zip(start, end)))
        mouse.up()

    def drag_by_finger(self, start, end):
        session = self.context.new_cdp_session(self.page)

        def send(kind, *points):
            touches = [{"x": x, "y": y} for x, y in points]
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})

        send("touchStart", start)
        for step in range(1, DRAG_STEPS + 1):
            send("touchMove", tuple(a + (b - a) * step / DRAG_STEPS for a, b in zip(start, end)))
        send("touchEnd")
        session.detach()

    def close(self):
        self.context.close()
