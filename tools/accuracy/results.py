"""results.json of `./dev accuracy`: what was measured, and whether it is still true.

{"renderer", "driver", "cases": [{"map", "brdf", "alpha", "size", "samples", "renderer", "timing_rounds", "key",
"methods": {METHOD: {"fetches", "probes", "table_fetches", "psnr" in dB, "flip", "relative_rmse", "gpu_ms", "gpu_ratio"}},
"unavailable": {METHOD: why it was not drawn}}]}

gpu_ratio is the median over the rounds of a method's GPU time over that of fis40 in the same round; null where it was not
measured. A case counts as measured if its key, a hash of the sources that draw it and of the map, is today's.
"""

import csv
import json

from cases import RIVAL

COLUMNS = ("fetches", "probes", "table_fetches", "psnr", "flip", "relative_rmse", "gpu_ms", "gpu_ratio")


class Results:
    """The measured cases, saved after each; reads what an earlier run left."""

    def __init__(self, path):
        self.path = path
        self.driver = ""
        self._kept = []
        try:
            kept = json.loads(path.read_text(encoding="utf-8"))
            self._kept = [entry for entry in kept["cases"] if entry["methods"]]
            self.driver = kept["driver"]
        except FileNotFoundError:
            pass
        except (ValueError, KeyError, TypeError) as error:
            raise ValueError(f"{path}: not the results of an earlier run ({error}); remove it.") from error

    def entry(self, conditions, methods):
        """What was measured under these conditions, if all these methods were tried; otherwise None."""
        for entry in self._kept:
            same = all(entry.get(name) == value for name, value in conditions.items())
            if same and set(methods) <= entry["methods"].keys() | entry.get("unavailable", {}).keys():
                return entry
        return None

    def add(self, conditions, methods, unavailable):
        identity = ("map", "brdf", "alpha")
        self._kept = [e for e in self._kept if any(e[name] != conditions[name] for name in identity)]
        self._kept.append({**conditions, "methods": methods, "unavailable": unavailable})

    def save(self, renderer, entries=None):
        """Writes everything, or only the entries given."""
        value = {"renderer": renderer, "driver": self.driver, "cases": self._kept if entries is None else entries}
        temporary = self.path.with_name("." + self.path.name)
        temporary.write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")
        temporary.replace(self.path)


def with_times(entries):
    """The entries, those without times with the times of the same material where it has been timed."""
    timed = {(e["brdf"], tuple(e["alpha"])): e["methods"] for e in entries if e["timing_rounds"]}
    found = []
    for entry in entries:
        other = timed.get((entry["brdf"], tuple(entry["alpha"])), {})
        methods = {
            name: own if own["gpu_ratio"] is not None else {**own, "gpu_ratio": other.get(name, {}).get("gpu_ratio")}
            for name, own in entry["methods"].items()
        }
        found.append({**entry, "methods": methods})
    return found


def write_csv(path, entries):
    """One line for each method of each case."""
    temporary = path.with_name("." + path.name)
    with temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("map", "brdf", "alpha_x", "alpha_y", "method", *COLUMNS))
        for entry in entries:
            for method, figures in entry["methods"].items():
                values = [figures[column] for column in COLUMNS]
                shown = ["" if v is None else f"{v:.5g}" for v in values]
                writer.writerow((entry["map"], entry["brdf"], *(f"{a:g}" for a in entry["alpha"]), method, *shown))
    temporary.replace(path)


def figures_of(rows, plan, median_ratio):
    """The methods of a results entry from the rows and the plan of ./dev compare."""
    rounds = {entry["method"]: entry["gpu_ms_rounds"] for entry in plan["methods"]}
    figures = {}
    for row in rows:
        ratio = median_ratio(rounds[row["method"]], rounds.get(RIVAL, []))
        figures[row["method"]] = {**{name: row[name] for name in COLUMNS if name != "gpu_ratio"}, "gpu_ratio": ratio}
    return figures
