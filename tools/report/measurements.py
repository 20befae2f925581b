"""results.json and results.csv of `./dev report`: what was measured, where, and whether it is still true.

{"cases": [{"study", "device", "renderer", "map", "brdf", "alpha", "stage", "size", "samples", "timing_rounds",
"timing_size" in pixels along the side (0: no times), "key",
"sheet": a picture's file or "", "where": {"machine", "driver", "driver_version", "engine", "date"},
"methods": {METHOD: {"fetches", "probes", "table_fetches", "psnr" in dB, "flip", "relative_rmse", "gpu_ms",
"gpu_ms_ratio" to gmm8, "fixed_ms", "gpu_ms_ratio_without_fixed", "gpu_ms_rounds", "settings"}}, "fixed_ms_rounds": of a
sphere that reflects nothing, "unavailable": {METHOD: reason}}]}

A case counts as measured if its key, a hash of the sources that draw it and of the map, is today's, and if every method
wanted is in it or cannot be drawn.
"""

import csv
import json
import math
import os
import pathlib
import platform

IDENTITY = ("device", "renderer", "map", "brdf", "alpha", "stage")
COLUMNS = ("fetches", "probes", "table_fetches", "psnr", "flip", "relative_rmse", "gpu_ms", "gpu_ms_ratio", "fixed_ms")
COLUMNS += ("gpu_ms_ratio_without_fixed",)


def machine():
    """Processor and number of cores, for people."""
    model = platform.processor() or platform.machine()
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        names = [line.split(":", 1)[1].strip() for line in cpuinfo.read_text().splitlines() if "model name" in line]
        model = names[0] if names else model
    return f"{model}, {os.cpu_count()} cores"


def conditions_of(case, options, keys):
    """What the figures of a case depend on, beside the methods."""
    return {
        "device": case.device,
        "renderer": case.renderer,
        "map": case.map,
        "brdf": case.brdf,
        "alpha": list(case.alpha),
        "stage": case.stage,
        "size": options.size,
        "samples": options.samples,
        "timing_rounds": options.timing_rounds if case.timed else 0,
        "timing_size": options.timing_size if case.timed else 0,
        "key": keys[case.map],
    }


def methods_of(rows, plan):
    """The methods of an entry from the rows and the plan of ./dev compare; what is not finite is null, as in JSON."""
    planned = {entry["method"]: entry for entry in plan["methods"]}
    found = {}
    for row in rows:
        own = planned[row["method"]]
        figures = {name: row[name] for name in COLUMNS}
        figures = {name: v if v is None or math.isfinite(v) else None for name, v in figures.items()}
        found[row["method"]] = {
            **figures,
            "gpu_ms_rounds": own["gpu_ms_rounds"],
            "settings": own.get("settings", {}),
        }
    return found


def write(path, text):
    """Under a temporary name first, so that nobody reads half a file."""
    temporary = path.with_name("." + path.name)
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


class Measurements:
    """The measured cases, saved after each; reads what an earlier run left in a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.path = folder / "results.json"
        self._kept = []
        try:
            self._kept = json.loads(self.path.read_text(encoding="utf-8"))["cases"]
            for entry in self._kept:
                entry["methods"], entry["unavailable"], entry["where"], entry["sheet"]
        except FileNotFoundError:
            pass
        except (ValueError, KeyError, TypeError) as error:
            raise ValueError(f"{self.path}: not the results of an earlier run ({error}); remove it.") from error

    def entry(self, conditions, methods, pictured=False):
        """What was measured under these conditions, if all these methods were tried; otherwise None."""
        for entry in self._kept:
            if all(entry.get(name) == value for name, value in conditions.items()):
                tried = entry["methods"].keys() | entry["unavailable"].keys()
                sheet = entry["sheet"] and (self.folder / entry["sheet"]).is_file()
                if set(methods) <= tried and (sheet or not pictured):
                    return entry
        return None

    def of_other_devices(self, device):
        return [entry for entry in self._kept if entry["device"] != device]

    def add(self, entry):
        """In the place of what was measured of the same case before."""
        self._kept = [old for old in self._kept if any(old.get(name) != entry[name] for name in IDENTITY)]
        self._kept.append(entry)

    def save(self, entries=None):
        """Writes everything, or only the entries given."""
        kept = self._kept if entries is None else entries
        lines = ",\n".join(json.dumps(entry, allow_nan=False, ensure_ascii=False) for entry in kept)
        write(self.path, f'{{"cases": [\n{lines}\n]}}\n')


def write_csv(path, entries):
    """One line for each method of each case."""
    temporary = path.with_name("." + path.name)
    with temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(
            ("device", "driver", "renderer", "study", "map", "brdf", "alpha_x", "alpha_y", "settings", "method", *COLUMNS)
        )
        for entry in entries:
            place = (entry["device"], entry["where"]["driver"], entry["renderer"], entry["study"], entry["map"], entry["brdf"])
            stage = " ".join(f"{name}={value}" for name, value in entry["stage"].items())
            for method, figures in entry["methods"].items():
                shown = ["" if figures[c] is None else f"{figures[c]:.5g}" for c in COLUMNS]
                writer.writerow((*place, *(f"{a:g}" for a in entry["alpha"]), stage, method, *shown))
    temporary.replace(path)
