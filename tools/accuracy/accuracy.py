#!/usr/bin/env python3
"""`./dev accuracy`: how close lobes come to the reference, over materials and maps.

One engine draws every case that results.json lacks; each is judged as soon as it is drawn, as ./dev compare judges.
"""

import argparse
import contextlib
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/compare"))

import batch  # noqa: E402
import bright_map  # noqa: E402
import cases  # noqa: E402
import metrics  # noqa: E402
import report  # noqa: E402
import results  # noqa: E402

WORK = ROOT / "build/accuracy"
REPORT = ROOT / "docs/report/accuracy"
MAPS = {
    "hall": ROOT / "demo/environments/hall.exr",
    "sunset": ROOT / "demo/environments/sunset.exr",
    "forest": ROOT / "tests/data/forest.exr",
    cases.SYNTHETIC: WORK / f"synthetic-{bright_map.version()}.exr",
}
RENDERERS = ("mobile", "gl_compatibility", "forward_plus")
SIZE, QUICK_SIZE = 96, 64
SAMPLES = 640
TIMING_ROUNDS = 5


class Problem(Exception):
    """One sentence for the user."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Problem(f"{message}; ./dev accuracy --help lists the options")


def whole_number(low, high):
    def convert(text):
        if not text.isdecimal() or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"must be a whole number from {low} to {high}, not {text}")
        return int(text)

    return convert


def read_options(arguments):
    parser = Parser(prog="./dev accuracy", add_help=False, allow_abbrev=False)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--maps", type=lambda text: [pathlib.Path(name) for name in text.split(",") if name], default=[])
    parser.add_argument("--only", choices=cases.PARTS)
    parser.add_argument("--renderer", choices=RENDERERS, default="mobile")
    parser.add_argument("--size", type=whole_number(8, 2048))
    parser.add_argument("--samples", type=whole_number(2, 1 << 20), default=SAMPLES)
    parser.add_argument("--timing-rounds", type=whole_number(1, 10000), default=TIMING_ROUNDS)
    parser.add_argument("--json", type=pathlib.Path)
    # Only looks at the options.
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args(arguments)
    for path in options.maps:
        if not path.is_file():
            raise Problem(f"{path}: there is no such map")
        if path.stem in MAPS or sum(other.stem == path.stem for other in options.maps) > 1:
            raise Problem(f"{path}: another map has the name {path.stem}")
    if options.json and not options.json.absolute().parent.is_dir():
        raise Problem(f"{options.json}: its folder does not exist")
    if options.out is None:
        # The repository's report is of the repository's maps.
        usual = not (options.quick or options.maps or options.only or options.size) and options.renderer == "mobile"
        options.out = REPORT if usual else WORK / f"report-{options.renderer}{'-quick' if options.quick else ''}"
    options.size = options.size or (QUICK_SIZE if options.quick else SIZE)
    return options


def conditions_of(case, options, keys):
    """What a figure depends on besides the method, as results.json has it."""
    return {
        "map": case.map,
        "brdf": case.brdf,
        "alpha": list(case.alpha),
        "size": options.size,
        "samples": options.samples,
        "renderer": options.renderer,
        "timing_rounds": options.timing_rounds if case.timed else 0,
        "key": keys[case.map],
    }


def left(seconds):
    return f"{seconds / 60:.0f} min left" if seconds >= 90 else f"{seconds:.0f} s left"


def folder_of(case):
    return WORK / "cases" / f"{case.map}_{case.brdf}_{case.alpha[0]:g}_{case.alpha[1]:g}"


def judge(case, options, keys, kept):
    plan, rows = metrics.judge(str(folder_of(case)))
    kept.driver = plan["driver"]
    kept.add(conditions_of(case, options, keys), results.figures_of(rows, plan, metrics.median_ratio))
    kept.save(options.renderer)
    return "  ".join(f"{row['method']} {row['psnr']:.1f}" for row in rows)


def measure(missing, options, paths, keys, kept):
    """Draws and judges the cases; results.json has each as soon as it is measured."""
    entries = [
        {
            "env": str(paths[case.map]),
            "brdf": case.brdf,
            "alpha": case.alpha,
            "methods": case.methods,
            "size": options.size,
            "samples": options.samples,
            "timing_rounds": options.timing_rounds if case.timed else 0,
            "out": str(folder_of(case)),
        }
        for case in missing
    ]
    started, done = time.monotonic(), 0
    with contextlib.closing(batch.draw(entries, options.renderer, WORK)) as drawn:
        for index in drawn:
            found = judge(missing[index], options, keys, kept)
            done += 1
            seconds = (time.monotonic() - started) / done * (len(missing) - done)
            title = missing[index].title()
            print(f"[{done}/{len(missing)}] {title}: {found} dB; {left(seconds)}", file=sys.stderr, flush=True)
    if done < len(missing):
        raise Problem(batch.failure(WORK))


def run(options):
    WORK.mkdir(parents=True, exist_ok=True)
    if not MAPS[cases.SYNTHETIC].exists():
        bright_map.write(MAPS[cases.SYNTHETIC])
    paths = {**MAPS, **{path.stem: path.absolute() for path in options.maps}}
    given_maps = [path.stem for path in options.maps]
    plan = cases.quick if options.quick else cases.full
    whole = plan(cases.PARTS, given_maps)
    # Cases that several parts have are measured with what all of them need.
    wanted = {case.title() for case in plan((options.only,) if options.only else cases.PARTS, given_maps)}
    planned = [case for case in whole if case.title() in wanted]
    sources = batch.source_key()
    keys = {name: batch.case_key(sources, path) for name, path in paths.items()}
    options.out.mkdir(parents=True, exist_ok=True)
    kept = results.Results(options.out / "results.json")
    missing = [case for case in planned if not kept.entry(conditions_of(case, options, keys), case.methods)]
    if len(missing) < len(planned):
        print(f"{len(planned) - len(missing)} of {len(planned)} cases are measured already", file=sys.stderr)
    if missing:
        measure(missing, options, paths, keys, kept)
    # Of the other parts, what an earlier run has measured.
    entries = [kept.entry(conditions_of(case, options, keys), case.methods) for case in whole]
    entries = [entry for entry in entries if entry]
    kept.save(options.renderer, entries)
    results.write_csv(options.out / "results.csv", entries)
    if options.json:
        metrics.write_json(str(options.json), {"renderer": options.renderer, "driver": kept.driver, "cases": entries})
    print(report.write(options.out, entries, kept.driver, options))


def main():
    try:
        options = read_options(sys.argv[1:])
        if not options.check:
            run(options)
    except (Problem, ValueError, OSError, metrics.MetricError) as problem:
        sys.exit(f"accuracy: {str(problem).rstrip('.')}.")
    except KeyboardInterrupt:
        sys.exit("accuracy: stopped; the same command goes on from here.")


if __name__ == "__main__":
    main()
