"""Runs functions of the shipped shaders in the engine and judges what they give against 50 digits.

A Probe is a file below bake/stability/probes with rows of 32-bit floats for it, in named cases. The engine draws all of
them in each renderer and hands the results back bit by bit (bake/stability/stability.gd).

Bounds are worked out beside each expectation from what Vulkan asks of single precision ("Precision of core SPIR-V
instructions"; OpenGL ES asks for no more): sums and products to U, the unit roundoff, and the functions below.
"""

import json
import math
import re
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from verdict import Verdict

ROOT = Path(__file__).resolve().parents[2]
RENDERERS = ("mobile", "gl_compatibility", "forward_plus")

U = 2.0**-24
# Relative errors: 2.5, 2 and 3 units in the last place; a square root is 1 / inversesqrt.
DIVISION = 5 * U
INVERSE_SQRT = 4 * U
SQRT = INVERSE_SQRT + DIVISION
# atan and asin: 4096 units in the last place.
ATAN = 8192 * U
# Sampling: weights of a filter have at least 8 bits on all hardware that Godot 4 runs on (Vulkan asks for 4).
FILTER = 2.0**-8
# Rounding to a half float: Vulkan lets conversions round either way.
HALF = 2.0**-10


def log2_error(x):
    """Absolute: three units in the last place, 2^-21 between a half and two."""
    return max(6 * U * abs(math.log2(x)), 2.0**-21)


def exp2_error(x):
    """Relative."""
    return (6 + 4 * abs(x)) * U


def pow_error(x, y):
    """Relative: that of exp2(y log2 x)."""
    exponent = y * math.log2(x)
    return math.log(2) * (abs(y) * log2_error(x) + abs(exponent) * U) + exp2_error(exponent)


def single(values):
    """The nearest 32-bit floats, as doubles."""
    return np.asarray(values, dtype=np.float32).astype(float)


@dataclass
class Near:
    """The results at `at` lie within `bound` of `exact`. `medium` is what half precision adds to the bound; `scale` takes
    the error to standard deviations of a lobe."""

    at: tuple
    exact: tuple
    bound: float
    unit: str
    medium: float = 0.0
    scale: float = 0.0

    def __post_init__(self):
        self.exact = tuple(float(x) for x in self.exact)
        # Where nothing may be off, quotients are still to be had.
        self.bound, self.medium = max(float(self.bound), 1e-300), float(self.medium)

    def judge(self, verdict, results, medium):
        off = math.dist([results[n] for n in self.at], self.exact)
        verdict.error(off, self.bound + self.medium * medium, self.unit)
        if self.scale:
            worst = verdict.result.get("standard_deviations", 0.0)
            verdict.result["standard_deviations"] = max(worst, off * self.scale)


@dataclass
class Energy:
    """The result at `at` is `exact` but for a relative `bound`."""

    at: int
    exact: float
    bound: float
    medium: float = 0.0

    def judge(self, verdict, results, medium):
        verdict.energy(abs(results[self.at] / float(self.exact) - 1.0), self.bound + self.medium * medium)


@dataclass
class Holds:
    """test(results) gives (error, bound, unit)."""

    test: Callable

    def judge(self, verdict, results, _medium):
        verdict.error(*self.test(results))


@dataclass
class Probe:
    """`expect(row)`, or `expect(row, renderer)`, gives what is to be judged of a row."""

    name: str
    group: str
    probe: str
    results: int
    expect: Callable
    rows: list = field(default_factory=list)
    cases: list = field(default_factory=list)
    defines: tuple = ()
    textures: dict = field(default_factory=dict)
    uniforms: dict = field(default_factory=dict)
    light: dict | None = None
    by_renderer: bool = False
    # Results need not be finite.
    any_bits: bool = False
    # Whether something in it is mediump.
    has_medium: bool = False
    # The rows as bits, where these are what is to come back.
    patterns: np.ndarray | None = None

    def add(self, title, rows, **about):
        """A case; what is said about it goes into its verdicts."""
        first = len(self.rows)
        self.rows += [tuple(single(row).tolist()) for row in rows]
        self.cases.append((title, first, len(self.rows), about))

    @property
    def texels(self):
        return len(self.rows[0]) // 4


class Expectations:
    """What is expected of a probe's rows, worked out once for all renderers."""

    def __init__(self):
        self.known = {}

    def of(self, probe, row, renderer):
        # Forward+ and Mobile are told the same.
        key = probe.name, row, probe.by_renderer and renderer == "gl_compatibility"
        if key not in self.known:
            values = probe.rows[row]
            self.known[key] = probe.expect(values, renderer) if probe.by_renderer else probe.expect(values)
        return self.known[key]


def moved(probe, values, before):
    """What rounding changes of a case: means in radians and in standard deviations of lobes that weigh something, light as a
    share of the row's brightest channel."""
    if probe.group == "shader look-up":
        counts = before[:, 5] > 1e-3
        off = np.linalg.norm(values[counts, :3] - before[counts, :3], axis=1)
        if not off.size:
            return {}
        deviations = off / np.sqrt(before[counts, 3])
        return {"moved_radians": float(off.max()), "moved_deviations": float(deviations.max())}
    light = np.abs(values[:, :3] - before[:, :3]).max(axis=1) / np.maximum(before[:, :3].max(axis=1), 1e-6)
    return {"moved_light": float(light.max())}


def judge(probe, values, renderer, expectations, precision, before=None):
    """The verdicts of a probe's cases; `before` are the values in single precision."""
    verdicts = []
    for title, first, last, about in probe.cases:
        medium = precision == "half"
        ending = f"in {renderer}" + (", mediump as halves" if medium else "")
        verdict = Verdict({"name": f"shader {title} {ending}"}, probe.group)
        verdict.result |= {"renderer": renderer, "precision": precision, **about}
        if before is not None:
            verdict.result |= moved(probe, values[first:last].astype(float), before[first:last].astype(float))
        if probe.patterns is not None:
            wrong = np.count_nonzero(values.view(np.uint32) != probe.patterns)
            verdict.error(float(wrong), 0.5, "wrong numbers")
        for row in range(first, last):
            results = values[row].tolist()
            if not probe.any_bits:
                verdict.finite(results, "a result")
                if not verdict.result["finite"]:
                    break
            for check in expectations.of(probe, row, renderer):
                check.judge(verdict, results, medium)
        verdicts.append(verdict.done())
    return verdicts


# The engine


@dataclass
class Texture:
    """Texels of half or single floats, (layers, rows, columns, 4); a cube's levels of a face are concatenated."""

    data: bytes
    width: int
    height: int
    layers: int = 1
    is_float: bool = False
    kind: str = "2d"
    mipmaps: bool = False

    def describe(self, file):
        return {
            "file": file,
            "width": self.width,
            "height": self.height,
            "layers": self.layers,
            "float": self.is_float,
            "kind": self.kind,
            "mipmaps": self.mipmaps,
        }


def rows_of_pixels(probe):
    """The input as the probe reads it: 64 rows a line, two lines at least."""
    values = np.array(probe.rows, dtype=np.float32) if probe.patterns is None else probe.patterns
    return np.pad(values, ((0, max(-len(values) % 64, 128 - len(values))), (0, 0)))


def write_jobs(folder, textures, probes, passes, pyramids):
    """jobs.json and its files. `probes`, `passes` and `pyramids` are (probe, number, root): root is the folder, res://, whose
    shaders are run, the number goes into the results' names."""
    used = {}
    for name, texture in textures.items():
        (folder / f"{name}.texture").write_bytes(texture.data)
        used[name] = texture.describe(f"{name}.texture")
    jobs = []
    for probe, number, root in probes:
        rows_of_pixels(probe).tofile(folder / f"{probe.name}.rows")
        job = {
            "name": f"{probe.name}.{number}",
            "root": root,
            "probe": probe.probe,
            "rows": len(probe.rows),
            "texels": probe.texels,
            "results": probe.results,
            "input": f"{probe.name}.rows",
            "defines": list(probe.defines),
            "textures": probe.textures,
            "uniforms": {name: list(map(float, value)) for name, value in probe.uniforms.items()},
        }
        jobs.append(job | ({"light": probe.light} if probe.light else {}))
    drawn = [
        [one.job() | {"name": f"{one.name}.{number}", "root": root} for one, number, root in several]
        for several in (passes, pyramids)
    ]
    text = json.dumps({"textures": used, "probes": jobs, "passes": drawn[0], "pyramids": drawn[1]})
    (folder / "jobs.json").write_text(text, encoding="utf-8")


class EngineError(Exception):
    """What the engine has to say where it did not do what was asked."""


PROBLEM = re.compile(r"^(?:SCRIPT |SHADER |USER )?ERROR: (.*)|^(stability: .*)|^handle_crash", re.MULTILINE)


def run_engine(renderer, folder, out, project, seconds=600):
    """Draws the jobs in `folder` with a renderer; raises EngineError."""
    out.mkdir(exist_ok=True)
    command = ["bash", str(ROOT / "tools/stability/engine.sh"), renderer, str(project)]
    command += ["--jobs", str(folder / "jobs.json"), "--out", str(out)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        raise EngineError(f"{renderer} did not end within {seconds} s") from None
    problem = PROBLEM.search(run.stdout + run.stderr)
    if problem or run.returncode != 0:
        said = problem.group(0) if problem else (run.stdout + run.stderr).strip()[-300:]
        raise EngineError(f"{renderer} ended with status {run.returncode}: {said}")


def read_results(out, probe, number=0):
    values = np.fromfile(out / f"{probe.name}.{number}.bin", dtype=np.float32)
    if values.size != len(probe.rows) * probe.results:
        raise EngineError(f"{probe.name} has {values.size} results")
    return values.reshape(len(probe.rows), probe.results)


def temporary_folder():
    build = ROOT / "build"
    build.mkdir(exist_ok=True)
    return tempfile.TemporaryDirectory(prefix="stability-", dir=build)
