#!/usr/bin/env python3
"""`./dev report`: error against run time of every method, for materials, maps and renderers.

Draws what results.json lacks, each renderer's cases in one run of the engine, judges them as ./dev compare does, and
writes tables, figures and the page.
"""

import argparse
import contextlib
import datetime
import itertools
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(1, str(ROOT / "tools/compare"))

import analysis  # noqa: E402
import batch  # noqa: E402
import cases  # noqa: E402
import measurements  # noqa: E402
import metrics  # noqa: E402
import pages  # noqa: E402
import runs  # noqa: E402
import sheets  # noqa: E402

WORK = ROOT / "build/report"
REPORT = ROOT / "docs/report"
MAPS = runs.own_maps(WORK)
SIZE, QUICK_SIZE, GPU_SIZE = 128, 64, 512
# Where times are taken: what a renderer spends on any frame weighs less on large ones.
TIMING_SIZE, QUICK_TIMING_SIZE, GPU_TIMING_SIZE = 256, 128, 1024
SAMPLES, GPU_SAMPLES = 640, 256
TIMING_ROUNDS, QUICK_TIMING_ROUNDS = 7, 5
# Of the engine, on one case; after that the case is left out.
MOST_TRIES = 2
MOST_CASES_LEFT_OUT = 5
# What RenderingServer.get_video_adapter_type() calls a processor.
DEVICE_TYPE_CPU = 4
SOFTWARE_DRIVERS = ("llvmpipe", "softpipe", "lavapipe", "swiftshader", "software")


def listed(known, what):
    """Converts "A,B" to a tuple of names that are all among the known ones."""
    def convert(text):
        names = tuple(dict.fromkeys(name for name in text.split(",") if name))
        unknown = [name for name in names if name not in known]
        if unknown or not names:
            raise argparse.ArgumentTypeError(f"there is no {what} '{','.join(unknown)}'; take some of {', '.join(known)}")
        return names

    return convert


def read_options(arguments):
    parser = runs.Parser("report")
    parser.add_common()
    parser.add_argument("--device", action="store_true")
    parser.add_argument("--renderers", type=listed(cases.RENDERERS, "renderer"))
    parser.add_argument("--methods", type=listed(cases.METHODS, "method"))
    parser.add_argument("--cases", type=runs.whole_number(1, 10000))
    parser.add_argument("--minutes", type=runs.whole_number(1, 10000))
    options = parser.parse_args(arguments)
    runs.check_files(options, MAPS)
    if options.out and options.out.exists() and not options.out.is_dir():
        raise runs.Problem(f"{options.out}: is not a folder")
    given = any((options.maps, options.renderers, options.methods, options.size, options.samples))
    given = given or any((options.timing_rounds, options.cases))
    if options.out is None:
        # The repository's report is of the repository's maps, whole; a GPU adds to it.
        options.out = WORK / ("quick" if options.quick else "own") if options.quick or given else REPORT
    options.out = options.out.absolute()
    if options.renderers is None:
        options.renderers = cases.RENDERERS[:1] if options.quick else cases.RENDERERS
    options.size = options.size or (GPU_SIZE if options.device else QUICK_SIZE if options.quick else SIZE)
    options.samples = options.samples or (GPU_SAMPLES if options.device else SAMPLES)
    options.timing_size = GPU_TIMING_SIZE if options.device else QUICK_TIMING_SIZE if options.quick else TIMING_SIZE
    options.timing_rounds = options.timing_rounds or (QUICK_TIMING_ROUNDS if options.quick else TIMING_ROUNDS)
    return options


def folder_of(case):
    return WORK / "cases" / case.name()


def list_entry(case, options, paths):
    return {
        "env": str(paths[case.map]),
        "brdf": case.brdf,
        "alpha": case.alpha,
        "methods": case.methods,
        "size": options.size,
        "samples": options.samples,
        "timing_rounds": options.timing_rounds if case.timed else 0,
        "timing_size": options.timing_size,
        "out": str(folder_of(case)),
        "tolerant": True,
        "stage": case.stage,
    }


def require_gpu(plan):
    name = plan["driver"]
    if plan["driver_type"] == DEVICE_TYPE_CPU or any(word in name.lower() for word in SOFTWARE_DRIVERS):
        raise runs.Problem(f"--device found no GPU: the display's driver is {name}, which draws in software")


def judge(case, options, keys, kept):
    """Adds a drawn case to what is kept; returns what to say of it."""
    folder = folder_of(case)
    plan, rows = batch.judge(folder)
    if case.device == cases.GPU:
        require_gpu(plan)
    methods = measurements.methods_of(rows, plan)
    sheet = ""
    if case.pictured:
        sheet = f"{case.map}_{case.brdf}_{case.alpha[0]:g}_{case.alpha[1]:g}.png"
        sheets.draw(folder, methods, kept.folder / sheet)
    where = {
        "machine": measurements.machine(),
        "driver": plan["driver"],
        "driver_version": plan["driver_version"],
        "engine": plan["engine"],
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d"),
    }
    entry = {"study": case.study, **measurements.conditions_of(case, options, keys), "sheet": sheet, "where": where}
    entry["fixed_ms_rounds"] = plan["fixed_ms_rounds"]
    kept.add({**entry, "methods": methods, "unavailable": plan.get("unavailable", {})})
    kept.save()
    best = max((m for m in methods if m != cases.REFERENCE), key=lambda m: methods[m]["psnr"] or 0.0, default=None)
    return f"{len(methods) - 1} methods, best {best} {methods[best]['psnr'] or 0.0:.1f} dB" if best else "no method"


def measure(missing, options, paths, keys, kept):
    """Draws and judges the cases in their order, one run of the engine for each renderer in a row, until options.minutes
    are over. Returns those that the engine could not draw, with the reason.

    A case at which the engine stops is tried again, then left out.
    """
    progress, left_out, tries = runs.Progress([case.weight() for case in missing]), {}, {}

    def is_over():
        return options.minutes is not None and progress.seconds() > 60.0 * options.minutes

    for renderer, cases_of_run in itertools.groupby(missing, key=lambda case: case.renderer):
        waiting = list(cases_of_run)
        while waiting and not is_over():
            done = 0
            environment = {"LOBELIGHT_DISPLAY": "real"} if options.device else None
            entries = [list_entry(case, options, paths) for case in waiting]
            with contextlib.closing(batch.draw(entries, renderer, WORK, environment)) as drawn:
                for index in drawn:
                    case = waiting[index]
                    try:
                        said = judge(case, options, keys, kept)
                    except metrics.MetricError as problem:
                        left_out[case.title()] = str(problem)
                        said = f"left out, {problem}"
                    done += 1
                    progress.step(case.weight(), case.title(), said)
                    if is_over():
                        break
            waiting = waiting[done:]
            if waiting and not is_over():
                title, reason = waiting[0].title(), batch.failure(WORK)
                tries[title] = tries.get(title, 0) + 1
                if tries[title] == MOST_TRIES:
                    left_out[title] = reason
                    progress.step(waiting.pop(0).weight(), title, f"left out, {reason}")
            if len(left_out) > MOST_CASES_LEFT_OUT:
                raise runs.Problem(f"too many cases cannot be drawn, the last reason: {list(left_out.values())[-1]}")
    return left_out


def ordered(plan):
    """The cases that say the most first: those that are timed, in every renderer, then the others.

    Of each renderer, map by map and setting by setting, so that each pyramid is made once; of the timed ones those of
    the goals before the others.
    """
    def shared(case):
        return (case.renderer, not case.timed, case.map, str(case.stage))

    first = {}
    for index, case in enumerate(plan):
        first.setdefault(shared(case), index)
    goals = analysis.goal_materials()
    renderers = list(dict.fromkeys(case.renderer for case in plan))

    def rank(case):
        of_goal = (case.brdf, tuple(case.alpha)) in goals
        return (not case.timed, renderers.index(case.renderer), first[shared(case)], case.timed and not of_goal)

    return sorted(plan, key=rank)


def run(options):
    paths, keys = runs.prepare_maps(options, MAPS, WORK)
    given_maps = tuple(path.stem for path in options.maps)
    if options.device:
        plan = cases.on_gpu(options.renderers)
    else:
        plan = (cases.quick if options.quick else cases.full)(options.renderers, given_maps)
    if options.methods:
        plan = cases.only_methods(plan, options.methods)
    plan = ordered(plan)[: options.cases]
    folder = options.out / "compare"
    folder.mkdir(parents=True, exist_ok=True)
    kept = measurements.Measurements(folder)

    def entry_of(case):
        return kept.entry(measurements.conditions_of(case, options, keys), case.methods, case.pictured)

    missing = [case for case in plan if not entry_of(case)]
    if len(missing) < len(plan):
        print(f"{len(plan) - len(missing)} of {len(plan)} cases are measured already", file=sys.stderr)
    left_out = measure(missing, options, paths, keys, kept)
    entries = [entry for entry in map(entry_of, plan) if entry]
    to_come = len(plan) - len(entries) - len(left_out)
    # What the other kind of device has measured of the same sources and maps stays.
    device = cases.GPU if options.device else cases.SOFTWARE
    entries += [e for e in kept.of_other_devices(device) if e["key"] == keys.get(e["map"])]
    if not entries:
        raise runs.Problem(f"nothing could be drawn: {next(iter(left_out.values()), 'the time was over')}")
    kept.save(entries)
    measurements.write_csv(folder / "results.csv", entries)
    summary = pages.write(options.out, entries, REPORT, left_out, to_come)
    if options.json:
        metrics.write_json(str(options.json), {**summary, "cases": entries})
    print(f"report: {len(entries)} cases; {options.out / 'README.md'}, {options.out / 'index.html'}")
    if to_come:
        print(f"report: {to_come} cases are not measured yet; the same command goes on from here", file=sys.stderr)
    if left_out:
        title, reason = next(iter(left_out.items()))
        raise runs.Problem(f"{len(left_out)} cases could not be measured, the first of them {title}: {reason}")


if __name__ == "__main__":
    runs.main("report", read_options, run)
