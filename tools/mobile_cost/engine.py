"""Runs the engine on drivers without a GPU and takes what they compile, one variant at a time.

Mobile runs on Mesa's Vulkan driver for Adreno GPUs over a no-op kernel (mesa-drm-shim): the driver compiles every pipeline
as on a phone and prints it. Compatibility runs on Mesa's software driver, which stores every program's GLSL;
gl_compile.py compiles that for other GPUs.
"""

import os
import pathlib
import re
import shutil
import subprocess
import threading
import time

import ir3

ROOT = pathlib.Path(__file__).resolve().parents[2]
DISPLAY = ROOT / "tools/lib/with_display.sh"
# Seconds without a new line after which nothing more is expected.
QUIET = 0.5
MOST_SECONDS = 90
_DRAWING = "mobile-cost: drawing "
_WARM_UP = "warm_up"
# Compatibility's #defines of the pass that draws the sphere, specialised for a scene without lights.
_DRAWN = {"BASE_PASS", "DISABLE_LIGHT_DIRECTIONAL", "DISABLE_LIGHTMAP", "DISABLE_FOG"}


class EngineError(Exception):
    """Says in one sentence what went wrong; `log` has the rest."""


def base_environment(engine, work):
    """For the engine unpacked in the cache: its own drivers, nothing cached between runs, nothing of the user's."""
    home = work / "home"
    home.mkdir(parents=True, exist_ok=True)
    root = engine / "root"
    libraries = next(path for path in (root / "usr/lib").glob("*-linux-gnu*"))
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("MESA_", "IR3_", "FD_"))}
    return {
        **kept,
        "HOME": str(home),
        "XDG_RUNTIME_DIR": str(home),
        "XDG_CACHE_HOME": str(home),
        "XDG_DATA_HOME": str(home),
        "MESA_SHADER_CACHE_DISABLE": "true",
        "__EGL_VENDOR_LIBRARY_DIRS": str(root / "usr/share/glvnd/egl_vendor.d"),
        "LIBGL_DRIVERS_PATH": str(libraries / "dri"),
        "FONTCONFIG_FILE": str(root / "etc/fonts/fonts.conf"),
    }


def _on_one_processor():
    # The engine then has one thread that compiles, and listings seldom get into each other.
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


class Engine:
    """The engine drawing variants; to be used in a `with` statement."""

    def __init__(self, engine, work, method, driver, variables, preload=None):
        self._handshake = work / "drawn"
        shutil.rmtree(self._handshake, ignore_errors=True)
        self._handshake.mkdir(parents=True)
        # Pipelines that the engine itself has stored would not be compiled.
        shutil.rmtree(work / "home", ignore_errors=True)
        self._environment = {**base_environment(engine, work), **variables}
        self._program = ["env", f"LD_PRELOAD={preload}"] if preload else []
        self._program += [str(engine / "root/usr/bin/godot"), "--path", str(ROOT), "--audio-driver", "Dummy"]
        self._program += ["--rendering-method", method, "--rendering-driver", driver]
        self._program += ["--script", "res://tools/mobile_cost/draw_variants.gd", "--", str(self._handshake)]
        self.log = work / f"{method}.log"
        self._lines, self._changed = [], time.monotonic()
        self._process = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._process and self._process.poll() is None:
            self._process.terminate()
            self._process.wait()

    def _read(self):
        with self.log.open("w", encoding="utf-8") as log:
            for line in self._process.stderr:
                log.write(line)
                self._lines.append(line)
                self._changed = time.monotonic()

    def collect(self, names, done, warmed_up=lambda: None):
        """Gives (name, lines): the lines that came on stderr while a variant was drawn, when `done(lines)` holds and no
        more come. Something else is drawn first, until warmed_up() is called: what the engine compiles for itself."""
        self._process = subprocess.Popen(
            ["bash", str(DISPLAY), *self._program, ",".join(names)],
            env=self._environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            preexec_fn=_on_one_processor,
        )
        reader = threading.Thread(target=self._read, daemon=True)
        reader.start()
        self._wait_for(_WARM_UP, done)
        warmed_up()
        (self._handshake / _WARM_UP).touch()
        for name in names:
            yield name, self._wait_for(name, done)
            (self._handshake / name).touch()
        self._process.wait()
        reader.join()

    def _wait_for(self, name, done):
        started, begin = time.monotonic(), None
        while True:
            time.sleep(0.1)
            now = time.monotonic()
            if begin is None:
                begin = next((i for i, line in enumerate(self._lines) if line == f"{_DRAWING}{name}\n"), None)
            if begin is not None and now - max(self._changed, started) > QUIET:
                lines = self._lines[begin + 1 :]
                if done(lines):
                    return lines
            if self._process.poll() is not None:
                raise EngineError(f"the engine ended while {name} was to be drawn; its output: {self.log}")
            if now - started > MOST_SECONDS:
                raise EngineError(f"{name} was not compiled in {MOST_SECONDS} s; the engine's output: {self.log}")


def pipelines_of(lines):
    """The listings by shader, [Shader]; those that are not whole raise ListingError."""
    shaders = [ir3.parse_listing(listing) for listing in ir3.shaders_of(lines)]
    for shader in shaders:
        shader.check()
    return shaders


def is_compiled(lines):
    """Whether a variant's two pipelines are there: the one for all cases and the one specialised for this scene."""
    ends = (re.search(r"; FRAG prog (\d+)/\d+: \d+ max_waves", line) for line in lines)
    return len({found[1] for found in ends if found}) >= 2


def specialised(shaders):
    """(fragment, vertex) of the pipeline specialised for the scene: of the two, the one of fewer instructions."""
    fragments = {}
    for shader in shaders:
        if shader.stage == "FRAG":
            fragments.setdefault(shader.program, shader)
    if len(fragments) != 2:
        raise EngineError(f"{len(fragments)} pipelines were compiled where there should be 2")
    fragment = min(fragments.values(), key=lambda s: s.statistics["instructions"])
    # A pipeline's shaders have numbers in a row.
    vertices = [s for s in shaders if s.stage == "VERT" and s.program < fragment.program]
    if not vertices:
        raise EngineError("a pipeline without a vertex shader was compiled")
    return fragment, max(vertices, key=lambda s: s.program)


def drawn_program(folder, known):
    """(vertex GLSL, fragment GLSL) of the program that Compatibility draws the sphere with, among those stored in `folder`
    whose names are not in `known`: the base pass, and of the scene's specialisation."""
    found = []
    for path in folder.glob("*.shader_test"):
        if path.name in known:
            continue
        parts = re.split(r"(?m)^\[(require|vertex shader|fragment shader)\]\n", path.read_text(errors="replace"))
        stages = dict(zip(parts[1::2], parts[2::2]))
        defines = set(re.findall(r"(?m)^#define (\w+)", stages.get("fragment shader", "")[:3000]))
        if _DRAWN <= defines and "MODE_RENDER_DEPTH" not in defines:
            found.append((path.stat().st_mtime_ns, stages))
    if not found:
        return None
    stages = max(found, key=lambda entry: entry[0])[1]
    return stages["vertex shader"], stages["fragment shader"]
