#!/usr/bin/env python3
"""What the demo's page shows and takes in a browser that draws in software: for ./dev web-check.

check.py --work DIR --out DIR: DIR/page and DIR/page.json are of ./dev web.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np
from PIL import Image, ImageDraw

import browser
import demo_page
import gallery

# Seconds.
LIMIT = 1200
# Of a picture in the sheet.
SIZE = (320, 200)
ENVIRONMENTS = ("Hall", "Sunset", "Studio, live", "Interior")
METHODS = ("Lobelight", "Thesis 2015", "Importance sampling", "Godot")
# The methods before ours know of no rooms.
OF_ROOMS = ("Lobelight", "Godot")
# Until another light is there; the engine's own sky and reflection probes take a few dozen.
FRAMES = {"Lobelight": 10, "Thesis 2015": 10, "Importance sampling": 10, "Godot": 40}
# Pixels that the desktop's picture is moved by: SwiftShader places vertices on a grid of sixteenths, llvmpipe on one of 256ths.
MOVED = 1 / 32
FPS_SECONDS = 40
# That no animation frame is given to the page.
HIDDEN_SECONDS = 5
SAID = {True: "yes", False: "no"}
# Reads of the page's pixels, and the milliseconds that the page waited for them.
READ_BACKS = """
  window.readBacks = [];
  for (const name of ["readPixels", "getBufferSubData"]) {
    const original = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...values) {
      const started = performance.now();
      const result = original.apply(this, values);
      window.readBacks.push(performance.now() - started);
      return result;
    };
  }
"""
# A tab that is hidden gets no animation frames. (Headless browsers hide none.)
HIDING = """
  window.hiddenTab = false;
  const askForFrame = window.requestAnimationFrame.bind(window);
  const held = [];
  window.requestAnimationFrame = draw => window.hiddenTab ? held.push(draw) : askForFrame(draw);
  window.showTab = () => {
    window.hiddenTab = false;
    held.splice(0).forEach(draw => askForFrame(draw));
  };
"""
ENGINE_PAGE = """<!DOCTYPE html>
<link rel="icon" href="data:,">
<style>body { margin: 0 }</style>
<canvas id="canvas" width="WIDTH" height="HEIGHT"></canvas>
<script src="index.js"></script>
<script>
  const canvas = document.getElementById("canvas");
  new Engine({ executable: "index", canvas, canvasResizePolicy: 0, args: ["--print-fps"] }).startGame();
</script>
"""


def draw_sheet(demo):
    """Pictures by (environment, method), drawn by the page one after the other."""
    keyboard = demo.page.page.keyboard
    keyboard.press("h")
    pictures = {}
    for environment in ENVIRONMENTS:
        for method in OF_ROOMS if environment == "Interior" else METHODS:
            pictures[environment, method] = demo.settle(FRAMES[method])
            print(f"  {environment}, {method}", flush=True)
            keyboard.press("m")
        keyboard.press("e")
    return pictures


def join(pictures):
    """One picture: environments below each other, methods beside each other."""
    width, height = SIZE
    sheet = Image.new("RGB", (width * len(METHODS), height * len(ENVIRONMENTS)), "white")
    pen = ImageDraw.Draw(sheet)
    for (environment, method), picture in pictures.items():
        place = (width * METHODS.index(method), height * ENVIRONMENTS.index(environment))
        sheet.paste(Image.fromarray(picture.astype("uint8")), place)
        pen.text((place[0] + 8, place[1] + height - 18), f"{environment}: {method}", fill="white", stroke_width=2, stroke_fill="black")
    return sheet


def measure_read_backs(demo):
    """Milliseconds of each read of pixels while the studio is captured."""
    page = demo.page.page
    page.evaluate("window.readBacks.length = 0")
    demo.wait_for_frames(12)
    return page.evaluate("window.readBacks")


def read_fps(lines):
    """Frames a second, of (line, seconds) that --print-fps has written: each tells of the frames since the one before."""
    said = [(int(found[1]), when) for text, when in lines for found in [re.search(r"FPS: (\d+)", text)] if found]
    if len(said) < 2:
        return 0.0
    return sum(frames for frames, _when in said[1:]) / (said[-1][1] - said[0][1])


def fps_in_browser(program, folder):
    """Frames a second of the demo's pack in a page of SIZE."""
    text = ENGINE_PAGE.replace("WIDTH", str(SIZE[0])).replace("HEIGHT", str(SIZE[1]))
    (folder / "fps.html").write_text(text, encoding="utf-8")
    page = browser.Page(program, size=SIZE)
    with browser.serve(folder) as address:
        page.open(f"{address}fps.html")
        page.wait_for("Project FPS", LIMIT)
        page.page.wait_for_timeout(1000 * FPS_SECONDS)
        page.close()
    (folder / "fps.html").unlink()
    return read_fps([(text, when) for _kind, text, when in page.lines])


def fps_on_desktop(folder):
    """The same in Compatibility on this machine."""
    command = ["bash", gallery.ROOT / "tools/lib/with_display.sh", os.environ["GODOT"], "--main-pack", folder / "index.pck"]
    command += ["--audio-driver", "Dummy", "--rendering-method", "gl_compatibility", "--rendering-driver", "opengl3"]
    command += ["--resolution", f"{SIZE[0]}x{SIZE[1]}", "--print-fps", "--disable-vsync"]
    with tempfile.TemporaryDirectory() as nowhere:
        engine = subprocess.Popen(
            [*map(str, command)], cwd=nowhere, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, bufsize=1
        )
        stop = threading.Timer(FPS_SECONDS + 10, engine.terminate)
        stop.start()
        lines = [(line, time.monotonic()) for line in engine.stdout]
        stop.cancel()
        engine.wait()
    return read_fps(lines)


def compare_scenes(program, work):
    """By scene: the share of near pixels in the browser, the largest difference, and the share that the desktop's own picture has
    if it is moved."""
    site = work / "gallery"
    gallery.make_site(work / "project", site, pathlib.Path(os.environ["WEB_TEMPLATE"]))
    expected, desktop_times = gallery.draw_on_desktop(site)
    moved, _times = gallery.draw_on_desktop(site, "--moved", MOVED)
    page = browser.Page(program, size=(80, 80))
    with browser.serve(site) as address:
        pictures, times = gallery.draw_in_browser(page, address, site, LIMIT)
    page.close()
    found = {}
    for name, picture in expected.items():
        share, largest = gallery.compare(picture, pictures[name])
        found[name] = {
            "near": share,
            "largest": largest,
            "near_if_moved": gallery.compare(picture, moved[name])[0],
            "milliseconds": times[name],
            "desktop_milliseconds": desktop_times[name],
        }
    return found, page.complaints()


def check_page(program, folder):
    """The page: times, pictures, read-backs, and what the console says."""
    page = browser.Page(program, size=SIZE)
    page.page.add_init_script(READ_BACKS)
    page.page.add_init_script(HIDING)
    demo = demo_page.DemoPage(page)
    with browser.serve(folder) as address:
        started = time.monotonic()
        demo.open(address, LIMIT)
        first = time.monotonic() - started
        pictures = draw_sheet(demo)
        for _step in range(2):
            page.page.keyboard.press("e")
        demo.settle()
        read_backs = measure_read_backs(demo)
        hidden = hide_and_show(page, demo)
    found = {"first_picture_seconds": first, "read_backs": len(read_backs), "hidden": hidden}
    found["read_back_milliseconds"] = float(np.median(read_backs)) if read_backs else 0.0
    found["complaints"] = page.complaints()
    page.close()
    return found, pictures


def hide_and_show(page, demo):
    """Whether the page, after a time without frames, draws what is asked of it."""
    demo.settle()
    page.page.evaluate("window.hiddenTab = true")
    page.page.wait_for_timeout(1000 * HIDDEN_SECONDS)
    # By now the last frame that was asked for has been drawn.
    before = demo.picture()
    page.page.keyboard.press("m")
    page.page.wait_for_timeout(1000)
    still = demo.picture()
    page.page.evaluate("window.showTab()")
    after = demo.settle(FRAMES["Godot"])
    return {
        "drew_meanwhile": bool(np.abs(still - before).mean() > demo_page.CHANGED),
        "draws_again": bool(np.abs(after - before).mean() > demo_page.CHANGED),
    }


def write_report(out, results, sheet):
    page, sizes, scenes = results["page"], results["bytes"], results["scenes"]
    sheet.quantize(256, dither=Image.Dither.NONE).save(out / "sheet.png", optimize=True)
    (out / "results.json").write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    lines = [
        "# In a browser",
        "",
        "![Each environment of the demo by each method, drawn in the browser](sheet.png)",
        "",
        "Written by `./dev web-check`: the page of `./dev web` in a headless Chromium, which draws WebGL 2 in software (SwiftShader),",
        "beside the Compatibility renderer on the same machine, also in software (llvmpipe). Times are of this machine and of what else",
        "it did; only their ratios say something.",
        "",
        "| | |",
        "|---|---|",
        f"| the pack | {sizes['pack']:,} bytes, {sizes['pack_gzip']:,} compressed |",
        f"| the engine, which is that of all games | {sizes['engine']:,} bytes, {sizes['engine_gzip']:,} compressed |",
        f"| the page | {sizes['page']:,} bytes |",
        f"| from opening the page to the first picture | {page['first_picture_seconds']:.1f} s |",
        f"| frames a second, {SIZE[0]} × {SIZE[1]}: browser, desktop | {results['fps']:.2f}, {results['desktop_fps']:.2f} |",
        f"| a read-back while the studio is captured, median of {page['read_backs']} | {page['read_back_milliseconds']:.0f} ms |",
        f"| without animation frames for {HIDDEN_SECONDS} s, as in a hidden tab: draws, draws again afterwards | "
        f"{SAID[page['hidden']['drew_meanwhile']]}, {SAID[page['hidden']['draws_again']]} |",
        f"| errors and warnings on the console | {len(page['complaints']) + len(results['scene_complaints'])} |",
        "",
        "A read-back waits for all that the driver still has to draw: here, in software, for a whole frame. Headless browsers hide no",
        "tab; the page's animation frames are held back instead. Not counted are two lines that are not the project's: that the",
        "engine's sound uses a ScriptProcessorNode, and Chromium's note that pixels are read back. The thesis' method and importance",
        "sampling know of no rooms.",
        "",
        "## Beside the desktop",
        "",
        f"The scenes of `tests/web`, 256 × 192: the share of pixels within {gallery.NEAR}/255 of the desktop's Compatibility, and the share",
        "that the desktop's own picture has of itself if it is moved by 1/32 of a pixel. The browser's driver places vertices on a grid of",
        "sixteenths of a pixel, the desktop's on one of 256ths: what differs is at silhouettes and at rims, by less than such a movement.",
        "",
        "| scene | within 2/255 | largest difference | moved |",
        "|---|---|---|---|",
    ]
    for name, scene in scenes.items():
        lines.append(f"| {name} | {scene['near']:.3%} | {scene['largest']}/255 | {scene['near_if_moved']:.3%} |")
    (out / "README.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    options = parser.parse_args()
    folder = options.work / "page"
    sizes = json.loads((options.work / "page.json").read_text(encoding="utf-8"))
    results = {"bytes": {name: sizes[name] for name in sizes if isinstance(sizes[name], int)}}
    try:
        with browser.start_browser() as program:
            results["scenes"], results["scene_complaints"] = compare_scenes(program, options.work)
            results["page"], pictures = check_page(program, folder)
            results["fps"] = fps_in_browser(program, folder)
        results["desktop_fps"] = fps_on_desktop(folder)
    except (browser.PageError, gallery.GalleryError) as error:
        sys.exit(f"web-check: {error}")
    write_report(options.out, results, join(pictures))
    complaints = results["page"]["complaints"] + results["scene_complaints"]
    for text in complaints:
        print(f"on the console: {text[:300]}")
    print(options.out / "README.md")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
