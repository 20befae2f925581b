#!/usr/bin/env python3
"""`./dev mobile-cost`: what phones' GPUs execute a pixel, counted from what their compilers make of the engine's shaders."""

import argparse
import hashlib
import json
import os
import pathlib
import signal
import sys
import time

import engine
import ir3
import mali
import measure
from gpus import GPUS, Paths

ROOT = engine.ROOT
WORK = ROOT / "build/mobile-cost"
REPORT = ROOT / "docs/report/mobile-cost"
VARIANTS = json.loads((ROOT / "tools/mobile_cost/variants.json").read_text(encoding="utf-8"))
# What the engine adds around any material.
BASE = "empty_lit"
SOURCES = ("addons/lobelight/lobelight.gdshaderinc", "addons/lobelight/runtime", "bake/comparators", "tools/mobile_cost")
ENDINGS = {".gd", ".gdshaderinc", ".json", ".py"}


class Problem(Exception):
    """One sentence for the user."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Problem(f"{message}; ./dev mobile-cost --help lists the options")


def listed(known, what):
    def convert(text):
        names = [name for name in text.split(",") if name]
        for name in names:
            if name not in known:
                raise argparse.ArgumentTypeError(f"there is no {what} '{name}'; there are {', '.join(known)}")
        if not names:
            raise argparse.ArgumentTypeError(f"names no {what}")
        return list(dict.fromkeys(names))

    return convert


def read_options(arguments):
    parser = Parser(prog="./dev mobile-cost", add_help=False, allow_abbrev=False)
    parser.add_argument("--gpus", type=listed(GPUS, "GPU"))
    parser.add_argument("--variants", type=listed(VARIANTS, "variant"))
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    # Only looks at the options and prints which compilers they need.
    parser.add_argument("--families", action="store_true")
    options = parser.parse_args(arguments)
    caller = pathlib.Path(os.environ.get("LOBELIGHT_CWD", "."))
    if options.json:
        options.json = caller / options.json
        if not options.json.parent.is_dir():
            raise Problem(f"{options.json}: its folder does not exist")
    if options.out:
        options.out = caller / options.out
    else:
        options.out = WORK / "report" if options.gpus or options.variants else REPORT
    options.gpus = [GPUS[name] for name in options.gpus or GPUS]
    options.variants = options.variants or list(VARIANTS)
    # The others' own share is told by it.
    if BASE not in options.variants:
        options.variants.insert(0, BASE)
    return options


def source_key(versions):
    """Hash of everything that a row depends on."""
    digest = hashlib.sha256(versions.encode())
    for source in SOURCES:
        for path in sorted([ROOT / source, *(ROOT / source).rglob("*")]):
            if path.is_file() and path.suffix in ENDINGS and path.name not in ("report.py", "figures.py"):
                digest.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


class Rows:
    """The rows, saved after each; those of an earlier run with the same key are kept."""

    def __init__(self, path, key):
        self._path, self._key, self._rows = path, key, {}
        if path.is_file():
            kept = json.loads(path.read_text(encoding="utf-8"))
            if kept["key"] == key:
                self._rows = {(row["gpu"], row["variant"]): row for row in kept["rows"]}

    def get(self, gpu, variant):
        return self._rows.get((gpu.name, variant))

    def add(self, row):
        self._rows[row["gpu"], row["variant"]] = row
        write(self._path, json.dumps({"key": self._key, "rows": list(self._rows.values())}, indent=1) + "\n")


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name("." + path.name)
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


class Progress:
    def __init__(self, todo):
        self._todo, self._done, self._started = todo, 0, time.monotonic()

    def say(self, text):
        self._done += 1
        left = (time.monotonic() - self._started) / self._done * (self._todo - self._done)
        print(f"[{self._done}/{self._todo}] {text}  {left:.0f} s left", file=sys.stderr, flush=True)


def measure_all(options, rows, paths):
    missing = {gpu: [name for name in options.variants if options.again or not rows.get(gpu, name)] for gpu in options.gpus}
    captured = [n for n in options.variants if any(n in missing[g] for g in options.gpus if g.renderer != "mobile")]
    progress = Progress(sum(map(len, missing.values())) + len(captured))
    if captured:
        for name in measure.capture(captured, paths):
            progress.say(f"GLSL of {name}")
    for gpu in options.gpus:
        if not missing[gpu]:
            continue
        mesa = paths.mesa(gpu.family)
        method = measure.mobile if gpu.renderer == "mobile" else measure.compatibility
        for name, counted in method(gpu, missing[gpu], paths):
            rows.add({"gpu": gpu.name, "renderer": gpu.renderer, "variant": name, **counted, "mesa": mesa})
            progress.say(f"{gpu.label} {name}: {counted['instructions']} instructions, {counted['registers']} registers")


def run(options):
    paths = Paths(os.environ["MOBILE_ENGINE"], os.environ.get("MOBILE_COMPILERS"), WORK, os.environ.get("MOBILE_COMPILERS_MALI"))
    WORK.mkdir(parents=True, exist_ok=True)
    rows = Rows(WORK / "rows.json", source_key((paths.engine / "key").read_text(encoding="utf-8") + paths.mesa("adreno")))
    measure_all(options, rows, paths)
    found = []
    for gpu in options.gpus:
        base = rows.get(gpu, BASE)["instructions"]
        found += [{**rows.get(gpu, name), "own": rows.get(gpu, name)["instructions"] - base} for name in options.variants]
    # Brings the plots, which what only looks at the options does without.
    import report

    report.write_all(options.out, found, VARIANTS, write)
    if options.json:
        write(options.json, json.dumps(found, indent=1) + "\n")
    print(report.summary(found, VARIANTS))
    print(f"Mesa {report.versions(found)}; the report is {options.out / 'README.md'}")


def main(arguments):
    # Ending by an exception stops the engine, too.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        options = read_options(arguments)
        if options.families:
            print("\n".join(sorted({gpu.family for gpu in options.gpus} | {"adreno"})))
            return 0
        run(options)
    except (Problem, engine.EngineError, ir3.ListingError, mali.StatisticsError, OSError) as error:
        print(f"mobile-cost: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
