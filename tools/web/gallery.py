"""Scenes of tests/web in one pack, drawn by Compatibility on this machine and in a browser."""

import base64
import io
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

import numpy as np
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
ADDON = "addons/lobelight"
PANORAMAS = ("tests/data/forest.exr", "demo/environments/hall.exr")
# The light that was baked, and the width that its panorama is brought to.
LIGHT = "tests/web/light.res"
LIGHT_WIDTH = 512
# Each picture's pixels of which this part at least is to be this near, in 1/255.
LEAST_SHARE = 0.999
NEAR = 2
# As the engine would say it; the rest it says wherever the driver draws in memory.
COMPLAINT = re.compile(r"(^|\s)(SCRIPT |USER |SHADER )?(ERROR|WARNING)(:|\s)|handle_crash|leaked at exit", re.MULTILINE)
ALWAYS_SAID = re.compile(r"^(WARNING: Could not set V-Sync mode|ERROR: Texture with GL ID of \d+: leaked).*$", re.MULTILINE)
PROJECT = """config_version=5

[application]

config/name="Gallery"
run/main_scene="res://tests/web/gallery.tscn"
config/features=PackedStringArray("4.6", "GL Compatibility")

[display]

window/size/viewport_width=64
window/size/viewport_height=64

[editor_plugins]

enabled=PackedStringArray("res://addons/lobelight/plugin.cfg")

[rendering]

renderer/rendering_method="gl_compatibility"
"""
PRESET = """[preset.0]

name="Web"
platform="Web"
runnable=true
export_filter="all_resources"
include_filter=""
exclude_filter="bake_light.gd"
export_path=""
script_export_mode=2

[preset.0.options]

variant/thread_support=false
vram_texture_compression/for_desktop=true
vram_texture_compression/for_mobile=false
"""
PAGE = """<!DOCTYPE html>
<title>Gallery</title>
<link rel="icon" href="data:,">
<canvas id="canvas" width="64" height="64"></canvas>
<script src="index.js"></script>
<script>
  const canvas = document.getElementById("canvas");
  new Engine({ executable: "index", canvas: canvas, canvasResizePolicy: 0, args: ["--", ...ARGUMENTS] }).startGame();
</script>
"""


class GalleryError(Exception):
    """Says in one sentence what went wrong."""


def run_engine(*arguments, drawing=False):
    """The engine's output; an error or a warning in it is an error."""
    command = ["bash", str(ROOT / "tools/lib/with_display.sh")] if drawing else []
    command += [os.environ["GODOT"], *map(str, arguments)]
    # What a pack lacks, the engine looks for in the folder that it was called in.
    with tempfile.TemporaryDirectory() as nowhere:
        done = subprocess.run(
            command, cwd=nowhere, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
    text = ALWAYS_SAID.sub("", done.stdout.decode(errors="replace"))
    found = COMPLAINT.search(text)
    if done.returncode or found:
        line = text[found.start() :].strip().splitlines()[0] if found else f"status {done.returncode}"
        raise GalleryError(f"the engine with {' '.join(map(str, arguments[:6]))}: {line}")
    return text


def make_project(project):
    """A project with the addon and the scenes, as a game has them."""
    shutil.rmtree(project, ignore_errors=True)
    shutil.copytree(ROOT / ADDON, project / ADDON)
    shutil.copytree(ROOT / "tests/web", project / "tests/web")
    for name in PANORAMAS:
        (project / name).parent.mkdir(parents=True, exist_ok=True)
        for ending in ("", ".import"):
            shutil.copy(ROOT / f"{name}{ending}", project / f"{name}{ending}")
    shutil.copy(ROOT / "tools/diet/bake_light.gd", project)
    (project / "project.godot").write_text(PROJECT, encoding="utf-8")
    (project / "export_presets.cfg").write_text(PRESET, encoding="utf-8")
    # Otherwise Godot 4.6 ends after the first import of a project with a library.
    (project / ".godot").mkdir()
    (project / ".godot/extension_list.cfg").write_text(f"res://{ADDON}/lobelight.gdextension\n", encoding="utf-8")


def make_site(project, site, template):
    """Exports the project made here into a folder with the engine's Web template and a page."""
    make_project(project)
    # The import looks at scenes before there is a light.
    scenes = project / "tests/web/scenes"
    scenes.rename(project / "later")
    (project / "later/.gdignore").touch()
    run_engine("--headless", "--path", project, "--import")
    light = [f"res://{PANORAMAS[0]}", f"res://{LIGHT}", LIGHT_WIDTH]
    run_engine("--headless", "--path", project, "--script", "res://bake_light.gd", "--", *light)
    (project / "later/.gdignore").unlink()
    (project / "later").rename(scenes)
    shutil.rmtree(site, ignore_errors=True)
    site.mkdir(parents=True)
    run_engine("--headless", "--path", project, "--export-pack", "Web", site / "index.pck")
    for file in template.iterdir():
        shutil.copy(file, site)


def read_lines(lines):
    """Pictures (height, width, 3) and milliseconds by name, of what gallery.gd prints."""
    pictures, times = {}, {}
    for line in lines:
        kind, _, rest = line.partition(" ")
        name, _, value = rest.partition(" ")
        if kind == "PICTURE":
            pictures[name] = np.asarray(Image.open(io.BytesIO(base64.b64decode(value))).convert("RGB"), dtype=int)
        elif kind == "TOOK":
            times[name] = int(value)
    return pictures, times


def draw_on_desktop(site, *arguments):
    """As read_lines; what the pack in `site` draws in Compatibility."""
    renderer = ["--rendering-method", "gl_compatibility", "--rendering-driver", "opengl3"]
    pack = ["--main-pack", site / "index.pck", "--audio-driver", "Dummy"]
    return read_lines(run_engine(*pack, *renderer, "--", *arguments, drawing=True).splitlines())


def draw_in_browser(page, address, site, limit, *arguments):
    """The same in a browser.Page; `limit` in seconds."""
    text = PAGE.replace("ARGUMENTS", repr(list(arguments)))
    (site / "index.html").write_text(text, encoding="utf-8")
    page.open(f"{address}index.html")
    page.wait_for("GALLERY DONE", limit)
    return read_lines([text for _kind, text, _when in page.lines])


def compare(one, other):
    """The share of pixels that are NEAR, and the largest difference."""
    apart = np.abs(one - other).max(axis=-1)
    return float(np.mean(apart <= NEAR)), int(apart.max())
