"""What the measurements say: Pareto fronts, the best method within a time, goals, the thesis' claim.

Works on the entries of results.json, see measurements.py. Times are ratios to gmm8 in the same renderer, medians over
interleaved rounds; those of a material on cases.TIMED_MAP serve for the other maps too.
"""

import dataclasses
import math

import cases
import metrics
import numpy as np

# Of FIS 40's time, in one run.
MOST_OF_FIS_TIME = 1.0 / 3.0
GOAL_RIVAL = "fis40"
GOAL_ANISOTROPIC = ("ward", (0.05, 0.2))
MOST_GOAL_FETCHES = 16
# Töral 2015: PSNR in dB with Grace Cathedral, FIS with about 40 samples.
THESIS = {
    ("ward", (0.01, 0.01)): {"FIS": 30.28, "all-frequency": 34.93, "GMM 8": 34.11},
    ("ward", (0.01, 0.2)): {"FIS": 23.58, "all-frequency": 20.17, "GMM 8": 30.20},
}
USUAL_COVERAGE = 0.47


@dataclasses.dataclass(frozen=True)
class Point:
    """One method at one material; time over gmm8's, None where it was not measured."""

    method: str
    time: float | None
    psnr: float
    fetches: int


@dataclasses.dataclass(frozen=True)
class Place:
    """Where a comparison was made."""

    device: str
    renderer: str
    map: str
    material: tuple

    def title(self):
        return f"{cases.material_name(self.material)}, {self.map}, {self.renderer}"


def material_of(entry):
    return (entry["brdf"], tuple(entry["alpha"]))


def find(entries, place, stage=None):
    """The entry of a place under these settings (none: the usual), or None."""
    for entry in entries:
        own = Place(entry["device"], entry["renderer"], entry["map"], material_of(entry))
        if own == place and entry["stage"] == (stage or {}):
            return entry
    return None


def places(entries, device=None, renderer=None, map_name=None):
    """Where all methods were compared, in the order of the entries."""
    found = []
    for entry in entries:
        place = Place(entry["device"], entry["renderer"], entry["map"], material_of(entry))
        same = device in (None, place.device) and renderer in (None, place.renderer) and map_name in (None, place.map)
        if same and not entry["stage"] and place not in found:
            found.append(place)
    return found


def points(entries, place):
    """The drawn methods of a place, by time; those without a time at the end."""
    entry = find(entries, place)
    timed = find(entries, dataclasses.replace(place, map=cases.TIMED_MAP)) or entry
    found = []
    for method, figures in entry["methods"].items():
        if method != cases.REFERENCE and figures["psnr"] is not None:
            time = timed["methods"].get(method, {}).get("gpu_ms_ratio")
            found.append(Point(method, time, figures["psnr"], figures["fetches"]))
    return sorted(found, key=lambda p: (p.time is None, p.time or 0.0, -p.psnr))


def pareto(found):
    """The points that no other is both as fast and as accurate as, from the fastest to the most accurate."""
    front = []
    for point in sorted((p for p in found if p.time is not None), key=lambda p: (p.time, -p.psnr)):
        if not front or point.psnr > front[-1].psnr:
            front.append(point)
    return front


def best_within(found, budget, cost=lambda point: point.time):
    """The most accurate point within a time, of equals the faster one; None if there is none. `cost` may be another than
    the time; None: the point takes no part."""
    affordable = [p for p in found if cost(p) is not None and cost(p) <= budget]
    return max(affordable, key=lambda p: (p.psnr, -cost(p)), default=None)


def fetches_of(point):
    """None for what fetches nothing that is counted."""
    return point.fetches or None


def verdict(entries, place):
    """{"place", "points", "front": [method], "best" and "best_by_fetches": [(budget, Point | None)],
    "rivals": [(rival, ours)] on the front}.

    A rival is on the list where nothing of ours is as accurate in its time; `ours` is our most accurate one within that
    time, or None.
    """
    found = points(entries, place)
    front = pareto(found)
    own = [p for p in found if cases.is_ours(p.method)]
    rivals = [(p, best_within(own, p.time)) for p in front if not cases.is_ours(p.method)]
    return {
        "place": place,
        "points": found,
        "front": [p.method for p in front],
        "best": [(budget, best_within(found, budget)) for budget in cases.BUDGETS],
        "best_by_fetches": [(budget, best_within(found, budget, fetches_of)) for budget in cases.FETCH_BUDGETS],
        "rivals": rivals,
    }


def verdicts(entries):
    """Of every place whose methods have times."""
    found = [verdict(entries, place) for place in places(entries)]
    return [v for v in found if any(p.time is not None for p in v["points"])]


def time_ratio(entry, method, baseline):
    """Median over the rounds of a method's GPU time over another's; None where either was not measured."""
    rounds = [entry["methods"].get(name, {}).get("gpu_ms_rounds", []) for name in (method, baseline)]
    return metrics.median_ratio(*rounds)


def time_ratio_without_fixed(entry, method, baseline):
    """As time_ratio(), of what both have above the time of a sphere that reflects nothing."""
    rounds = [entry["methods"].get(name, {}).get("gpu_ms_rounds", []) for name in (method, baseline)]
    return metrics.median_ratio_without(entry["fixed_ms_rounds"], *rounds)


def fixed_parts(entries):
    """[(renderer, ms, share)]: medians of the time of a sphere that reflects nothing, and of its share of fis40's."""
    found = {}
    for entry in entries:
        rival = entry["methods"][GOAL_RIVAL]["gpu_ms_rounds"]
        where = entry["renderer"] + (", GPU" if entry["device"] == cases.GPU else "")
        found.setdefault(where, []).extend(zip(entry["fixed_ms_rounds"], rival))
    return [
        (where, float(np.median([fixed for fixed, _ in rounds])), float(np.median([f / time for f, time in rounds])))
        for where, rounds in found.items()
        if rounds
    ]


def ratio_range(entry, method, baseline=cases.BASELINE):
    """Lower and upper quartile of the rounds' ratios; None where either was not measured."""
    rounds = [entry["methods"].get(name, {}).get("gpu_ms_rounds", []) for name in (method, baseline)]
    ratios = sorted(time / base for time, base in zip(*rounds) if base > 0)
    return tuple(np.quantile(ratios, (0.25, 0.75))) if ratios else None


def goal_materials():
    return [*(m for m in cases.MATERIALS if cases.is_isotropic(m)), GOAL_ANISOTROPIC]


def goals(entries):
    """Issue 5's check: [{"place", "method", "psnr", "rival_psnr", "time", "time_without_fixed", "reached"}], times over
    those of fis40; what is reached is judged by the whole frame's.

    Of equal widths gmm8; of (0.05, 0.2) the fewest lobes up to 16 that are as accurate as fis40 in a third of its time,
    and where there are none, the fastest that are as accurate.
    """
    rows = []
    for place in places(entries, map_name=cases.TIMED_MAP):
        entry = find(entries, place)
        rival = entry["methods"].get(GOAL_RIVAL)
        if place.material not in goal_materials() or rival is None or rival["psnr"] is None:
            continue
        candidates = []
        for method, figures in entry["methods"].items():
            allowed = method == cases.BASELINE if cases.is_isotropic(place.material) else cases.is_ours(method)
            time = time_ratio(entry, method, GOAL_RIVAL)
            if allowed and figures["fetches"] <= MOST_GOAL_FETCHES and figures["psnr"] is not None and time is not None:
                accurate = figures["psnr"] >= rival["psnr"]
                row = {"place": place, "method": method, "psnr": figures["psnr"], "rival_psnr": rival["psnr"], "time": time}
                row["time_without_fixed"] = time_ratio_without_fixed(entry, method, GOAL_RIVAL)
                candidates.append({**row, "reached": accurate and time <= MOST_OF_FIS_TIME, "accurate": accurate})
        reached = [row for row in candidates if row["reached"]] or [row for row in candidates if row["accurate"]]
        if candidates:
            rows.append(min(reached or candidates, key=lambda row: row["time"]))
    return rows


def coverages(entries, place, method):
    """{coverage: PSNR} of a method of the thesis."""
    found = {}
    for coverage in (USUAL_COVERAGE, *cases.COVERAGES):
        entry = find(entries, place, None if coverage == USUAL_COVERAGE else {"toral_coverage": coverage})
        if entry and entry["methods"].get(method, {}).get("psnr") is not None:
            found[coverage] = entry["methods"][method]["psnr"]
    return found


def thesis(entries):
    """The thesis' figures beside ours: [{"place", "thesis", "toral8", "fis", "above", "as_high"}].

    toral8: (coverage, PSNR) of the best coverage; above: more than FIS; as_high: at least the thesis' figure.
    """
    rows = []
    for place in places(entries):
        first_renderer = next(iter(entries))["renderer"]
        claimed = THESIS.get(place.material)
        if claimed is None or place.device != cases.SOFTWARE or place.renderer != first_renderer:
            continue
        own, entry = coverages(entries, place, "toral8"), find(entries, place)
        rival = entry["methods"].get(GOAL_RIVAL, {}).get("psnr")
        if own and rival is not None:
            best = max(own.items(), key=lambda item: item[1])
            rows.append(
                {
                    "place": place,
                    "thesis": claimed,
                    "toral8": best,
                    "fis": rival,
                    "above": best[1] > rival,
                    "as_high": best[1] >= claimed["GMM 8"],
                }
            )
    return rows


def tally(found, by="best"):
    """Of the cells of the budget tables, of times or (by="best_by_fetches") of fetches: {"ours", "rivals", "none"}."""
    count = {"ours": 0, "rivals": 0, "none": 0}
    for own in found:
        for _, best in own[by]:
            count["none" if best is None else "ours" if cases.is_ours(best.method) else "rivals"] += 1
    return count


def budget_name(budget):
    return "any" if math.isinf(budget) else f"≤ {budget:g}"
