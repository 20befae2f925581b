"""./dev bench: speed, memory and error of the fit, and its rivals beside it. Writes figures and their data."""

import argparse
import csv
import io
import json
import os
import platform
import statistics
import subprocess
import sys
from pathlib import Path

# Before NumPy is loaded: one thread for everybody.
for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402
import scipy  # noqa: E402
import threadpoolctl  # noqa: E402

import checks  # noqa: E402
import plots  # noqa: E402
import rivals  # noqa: E402
from fitter import Fitter, FitterError  # noqa: E402

PARTS = ("rivals", "curve", "speed")


class BenchError(Exception):
    """Says in one sentence what went wrong."""


def run(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [f"it ended with {done.returncode}"]
        raise BenchError(f"{Path(command[0]).name}: {lines[-1]}")
    return done.stdout


def write(path, text):
    """Under a temporary name first, so that a run that is stopped leaves no half of a file."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


def machine():
    pools = threadpoolctl.threadpool_info()
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        names = [line.split(":", 1)[1].strip() for line in cpuinfo.read_text().splitlines() if "model name" in line]
        model = names[0] if names else model
    return {
        "processor": model,
        "cores": os.cpu_count(),
        "load_at_start": os.getloadavg()[0],
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "blas": [f"{pool['internal_api']} {pool['version']}, threads: {pool['num_threads']}" for pool in pools],
    }


def geometric_mean(values):
    return float(np.exp(np.mean(np.log(values)))) if values else None


def no_worse(sign, ours, theirs):
    """Whether an error of ours is at most theirs, by more than what is in the fourth digit; a log-likelihood, by more
    than 1e-5 nat."""
    return ours <= theirs * 1.0005 if sign > 0 else ours >= theirs - 1e-5


def summarise(rows):
    """For each rival its time over ours, and how its errors compare, over all slices."""
    summary = {}
    for name in rows[0]["runs"]:
        ratios = [row["runs"][name]["seconds"] / row["runs"]["ours"]["seconds"] for row in rows]
        entry = {
            "time_over_ours_geometric_mean": geometric_mean(ratios),
            "time_over_ours_least": min(ratios),
            "milliseconds_median": 1e3 * statistics.median(row["runs"][name]["seconds"] for row in rows),
        }
        for metric in ("l1_percent", "l2_percent"):
            entry[f"{metric}_mean"] = statistics.mean(row["runs"][name][metric] for row in rows)
        entry["log_likelihood_mean"] = statistics.mean(row["runs"][name]["log_likelihood"] for row in rows)
        if name == "ours":
            summary[name] = entry
            continue
        for metric, sign in rivals.METRICS.items():
            key = metric if metric == "log_likelihood" else f"{metric}_percent"
            beaten = [
                row["runs"][name]["seconds"] / row["runs"]["ours"]["seconds"]
                for row in rows
                if no_worse(sign, row["runs"]["ours"][key], row["runs"][name][key])
            ]
            entry[f"no_better_in_{metric}"] = {
                "slices": len(beaten),
                "of": len(rows),
                "time_over_ours_geometric_mean": geometric_mean(beaten),
            }
            if name not in rows[0]["as_good_as_ours"]:
                continue
            reached = [
                (row["as_good_as_ours"][name][metric]["seconds"], row["runs"]["ours"]["seconds"])
                for row in rows
                if row["as_good_as_ours"][name][metric]
            ]
            entry[f"as_good_in_{metric}"] = {
                "slices": len(reached),
                "of": len(rows),
                "time_over_ours_geometric_mean": geometric_mean([theirs / ours for theirs, ours in reached]),
            }
        summary[name] = entry
    return summary


def print_row(row):
    ours = row["runs"]["ours"]
    print(row["slice"])
    for name, one in row["runs"].items():
        print(
            f"  {name:21} {1e3 * one['seconds']:9.2f} ms {one['iterations']:5d} iterations   "
            f"L1 {one['l1_percent']:6.2f} %  L2 {one['l2_percent']:6.2f} %  ln {one['log_likelihood']:9.5f}"
            f"  {one['seconds'] / ours['seconds']:7.1f} ×",
            flush=True,
        )


def print_summary(summary):
    print("time over ours, geometric mean over the slices (least); error, mean:")
    for name, one in summary.items():
        line = (
            f"  {name:21} {one['time_over_ours_geometric_mean']:7.1f} × ({one['time_over_ours_least']:.1f})"
            f"  L1 {one['l1_percent_mean']:6.2f} %  L2 {one['l2_percent_mean']:6.2f} %  ln {one['log_likelihood_mean']:.5f}"
        )
        for metric in rivals.METRICS:
            for key, text in (("no_better_in", "where no better in"), ("as_good_in", "until as good in")):
                if found := one.get(f"{key}_{metric}"):
                    ratio = found["time_over_ours_geometric_mean"]
                    count = f"{found['slices']}/{found['of']} slices"
                    line += f"\n      {text} {metric}: " + (f"{ratio:.1f} × ({count})" if ratio else "never")
        print(line, flush=True)


def run_rivals(arguments):
    fitter = Fitter(arguments.build / "liblobelight_fit_c.so")
    for brdf, alpha in rivals.MATERIALS:
        checks.check(fitter, fitter.slice(brdf, alpha, rivals.direction(50.0, 30.0), 64), rivals.LOBES)
    rows = rivals.compare(fitter, arguments.quick, print_row)
    summary = summarise(rows)
    print_summary(summary)
    lobe = [row["one_lobe"] for row in rows]
    one_lobe = geometric_mean([one["scipy_seconds"] / one["our_seconds"] for one in lobe])
    print(f"one lobe: scipy.stats.vonmises_fisher.fit takes {one_lobe:.1f} × our time (geometric mean)")
    return {"slices": rows, "summary": summary, "one_lobe_scipy_over_ours": one_lobe}


def run_curve(arguments):
    text = run([arguments.build / "lobelight_curve"] + (["--quick"] if arguments.quick else []))
    write(arguments.out / "curve.csv", text)
    rows = [
        {key: value if key == "brdf" else float(value) for key, value in row.items()}
        for row in csv.DictReader(io.StringIO(text))
    ]
    plots.curve(rows, arguments.out / "curve.svg")
    print(f"curve: {len(rows)} fits, {arguments.out / 'curve.svg'}", flush=True)
    return rows


def run_speed(arguments):
    """Google Benchmark; tables with 1 and 2 threads are interleaved and compared by their medians."""
    command = [arguments.build / "lobelight_speed", "--benchmark_format=json", "--benchmark_min_time=0.05"]
    if arguments.quick:
        command += ["--benchmark_filter=nodes:64$|lobes:8/nodes|lobes:8/elevations:8", "--benchmark_repetitions=3"]
    else:
        command += ["--benchmark_repetitions=5"]
    command += ["--benchmark_enable_random_interleaving=true", "--benchmark_report_aggregates_only=true"]
    found = json.loads(run(command))["benchmarks"]
    rows = []
    for one in found:
        if one["aggregate_name"] != "median":
            continue
        row = {"name": one["run_name"], "real_time": one["real_time"], "cpu_time": one["cpu_time"]}
        row["unit"] = one["time_unit"]
        row.update({key: one[key] for key in ("ns_per_node_lobe", "peak_bytes", "bound_bytes") if key in one})
        rows.append(row)
        print(f"  {row['name']:74} {row['real_time']:10.2f} {row['unit']}", flush=True)
    by_name = {row["name"]: row["real_time"] for row in rows}
    scaling = {
        name: time / by_name[name.replace("threads:1", "threads:2")]
        for name, time in by_name.items()
        if "threads:1" in name and name.replace("threads:1", "threads:2") in by_name
    }
    for name, ratio in scaling.items():
        print(f"  two threads are {ratio:.2f} × one: {name}", flush=True)
    exceeded = [row["name"] for row in rows if row.get("peak_bytes", 0) > row.get("bound_bytes", 0)]
    if exceeded:
        raise BenchError(f"more memory than the bound of fit/memory.h says: {', '.join(exceeded)}.")
    plots.speed(rows, arguments.out / "speed.svg")
    return {"benchmarks": rows, "two_threads_over_one": scaling}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        print(f"lobelight: bench: {message}", file=sys.stderr)
        sys.exit(2)


def main():
    parser = Parser(prog="./dev bench", description=__doc__)
    parser.add_argument("--build", required=True, type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--quick", action="store_true", help="two slices and few settings: a minute")
    parser.add_argument("--only", choices=PARTS, help="one part of it")
    parser.add_argument("--json", type=Path, help="write all numbers to this file too")
    parser.add_argument("--out", type=Path, default=Path("build/bench"), help="folder of figures and data (build/bench)")
    arguments = parser.parse_args()
    try:
        if arguments.json and not arguments.json.absolute().parent.is_dir():
            raise BenchError(f"{arguments.json}: its folder does not exist.")
        try:
            arguments.out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise BenchError(f"{arguments.out}: cannot be made a folder ({error.strerror}).") from error
        results = {"machine": machine(), "quick": arguments.quick}
        parts = {"rivals": run_rivals, "curve": run_curve, "speed": run_speed}
        for name in [arguments.only] if arguments.only else PARTS:
            results[name] = parts[name](arguments)
            write(arguments.out / f"{name}.json", json.dumps({"machine": results["machine"], name: results[name]}, indent=1) + "\n")
            if arguments.json:
                write(arguments.json.absolute(), json.dumps(results, indent=1) + "\n")
    except (BenchError, checks.CheckError, FitterError, OSError) as error:
        print(f"lobelight: bench: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
