#!/usr/bin/env python3
"""`./dev accuracy`: how close lobes come to the reference, over materials and maps.

One engine draws every case that results.json lacks; each is judged as soon as it is drawn, as ./dev compare judges.
"""

import contextlib
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/compare"))

import batch  # noqa: E402
import cases  # noqa: E402
import metrics  # noqa: E402
import report  # noqa: E402
import results  # noqa: E402
import runs  # noqa: E402

WORK = ROOT / "build/accuracy"
REPORT = ROOT / "docs/report/accuracy"
MAPS = runs.own_maps(WORK)
RENDERERS = ("mobile", "gl_compatibility", "forward_plus")
SIZE, QUICK_SIZE = 96, 64
SAMPLES = 640
TIMING_ROUNDS = 5


def read_options(arguments):
    parser = runs.Parser("accuracy")
    parser.add_common()
    parser.add_argument("--only", choices=cases.PARTS)
    parser.add_argument("--minutes", type=runs.whole_number(1, 10000))
    parser.add_argument("--renderer", choices=RENDERERS, default="mobile")
    options = parser.parse_args(arguments)
    runs.check_files(options, MAPS)
    if options.out is None:
        # The repository's report is of the repository's maps.
        usual = not (options.quick or options.maps or options.only or options.size) and options.renderer == "mobile"
        options.out = REPORT if usual else WORK / f"report-{options.renderer}{'-quick' if options.quick else ''}"
    options.size = options.size or (QUICK_SIZE if options.quick else SIZE)
    options.samples = options.samples or SAMPLES
    options.timing_rounds = options.timing_rounds or TIMING_ROUNDS
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


def folder_of(case):
    return WORK / "cases" / f"{case.map}_{case.brdf}_{case.alpha[0]:g}_{case.alpha[1]:g}"


def judge(case, options, keys, kept):
    plan, rows = metrics.judge(str(folder_of(case)))
    kept.driver = plan["driver"]
    found = results.figures_of(rows, plan, metrics.median_ratio)
    kept.add(conditions_of(case, options, keys), found, plan.get("unavailable", {}))
    kept.save(options.renderer)
    return "  ".join(f"{row['method']} {row['psnr']:.1f}" for row in rows)


def measure(missing, options, paths, keys, kept):
    """Draws and judges the cases until options.minutes are over; results.json has each as soon as it is measured."""
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
            "tolerant": True,
        }
        for case in missing
    ]
    progress = runs.Progress([1.0] * len(missing))
    with contextlib.closing(batch.draw(entries, options.renderer, WORK)) as drawn:
        for index in drawn:
            found = judge(missing[index], options, keys, kept)
            progress.step(1.0, missing[index].title(), f"{found} dB")
            if options.minutes is not None and progress.seconds() > 60.0 * options.minutes:
                return
    if progress.done < len(missing):
        raise runs.Problem(batch.failure(WORK))


def run(options):
    paths, keys = runs.prepare_maps(options, MAPS, WORK)
    given_maps = [path.stem for path in options.maps]
    plan = cases.quick if options.quick else cases.full
    whole = plan(cases.PARTS, given_maps)
    # Cases that several parts have are measured with what all of them need.
    wanted = {case.title() for case in plan((options.only,) if options.only else cases.PARTS, given_maps)}
    planned = [case for case in whole if case.title() in wanted]
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
    print(report.write(options.out, results.with_times(entries), kept.driver, options))
    to_come = sum(not kept.entry(conditions_of(case, options, keys), case.methods) for case in planned)
    if to_come:
        print(f"accuracy: {to_come} cases are not measured yet; the same command goes on from here", file=sys.stderr)


if __name__ == "__main__":
    runs.main("accuracy", read_options, run)
