"""What `./dev accuracy` measures: cases, each one material on one map drawn by several methods.

A part is a question; the same material on the same map in two parts is one case that both read. GPU times hardly depend on
the map: they are taken on one.
"""

import dataclasses
import itertools

from runs import SYNTHETIC

REFERENCE = "reference"
RIVAL = "fis40"
# Lobes of a table, of a line without one, and as many as a material draws by itself.
OURS = ("gmm", "line", "auto")
AUTOMATIC = "auto"
TIMED_MAP = "hall"
MAPS = ("hall", "sunset", "forest", SYNTHETIC)
# Those of Töral 2015, and one more.
ISOTROPIC_WIDTHS = (0.01, 0.02, 0.05, 0.1, 0.15, 0.2)
ANISOTROPIC = (0.05, 0.2)
HARD = (0.01, 0.2)
BRDFS = ("ward", "ggx")
RATIO_MAPS = ("hall", "forest", SYNTHETIC)
# One narrow width, the other wider and wider; 1:100 has no room for that below 0.5.
RATIO_WIDTHS = {ratio: (0.01, 0.01 * ratio) for ratio in (1, 2, 5, 10, 20, 50)} | {100: (0.005, 0.5)}
RATIO_METHODS = ("gmm4", "gmm8", "gmm16", "gmm24", "gmm32", "line8", "line16", "line24", "line32", AUTOMATIC, RIVAL)
GRID_MAPS = ("hall", "forest", SYNTHETIC)
# Here the other half of the grid is measured too.
WHOLE_GRID_MAP = "hall"
GRID_WIDTHS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5)
GRID_METHODS = ("gmm8", "gmm16", "line16", AUTOMATIC, RIVAL)
MOST_FETCHES = 16
# What is furthest from the reference: strong anisotropy, and lobes as wide as they get.
LEADS = (HARD, (0.01, 0.5), (0.005, 0.5), (0.5, 0.5))
LEAD_METHODS = ("gmm8", "gmm16", "gmm24", "line16", "line24", "line32", AUTOMATIC, RIVAL)
PARTS = ("maps", "leads", "ratios", "grid")


@dataclasses.dataclass
class Case:
    """One material on one map; `methods` in the order in which they are drawn."""

    map: str
    brdf: str
    alpha: tuple[float, float]
    methods: list[str]
    timed: bool

    def key(self):
        return (self.map, self.brdf, self.alpha)

    def title(self):
        return f"{self.map}, {self.brdf} ({self.alpha[0]:g}, {self.alpha[1]:g})"


class Plan:
    """Collects cases; what several parts ask of one case is drawn together."""

    def __init__(self):
        self._cases = {}

    def add(self, map_name, brdf, alpha, methods, timed):
        alpha = (round(alpha[0], 9), round(alpha[1], 9))
        case = self._cases.setdefault((map_name, brdf, alpha), Case(map_name, brdf, alpha, [], False))
        case.methods = sorted({*case.methods, *methods}, key=order)
        case.timed = case.timed or timed

    def cases(self):
        """The part "leads" before the others, and map by map, so that a pyramid serves many cases."""
        maps = list(dict.fromkeys(case.map for case in self._cases.values()))

        def rank(case):
            return (case.alpha not in LEADS, maps.index(case.map), case.brdf != "ward", case.alpha)

        return sorted(self._cases.values(), key=rank)


def is_ours(method):
    return method.startswith(OURS)


def order(method):
    """gmm by their lobes, lines by theirs, the automatic choice, then the rival, then the reference."""
    if method.startswith("gmm"):
        return (0, int(method[3:]))
    if method.startswith("line"):
        return (1, int(method[4:]))
    return (("auto", RIVAL, REFERENCE).index(method) + 2, 0)


def grid_widths(map_name):
    """Pairs of widths; half of them where the other half is the same materials turned by 90 degrees."""
    pairs = itertools.product(GRID_WIDTHS, GRID_WIDTHS)
    return [pair for pair in pairs if map_name == WHOLE_GRID_MAP or pair[0] <= pair[1]]


def full(parts, given_maps):
    """The plan of a whole run; given_maps are the names of maps beside the repository's."""
    plan = Plan()
    if "maps" in parts:
        for map_name in (*MAPS, *given_maps):
            for brdf in BRDFS:
                for width in ISOTROPIC_WIDTHS:
                    plan.add(map_name, brdf, (width, width), ["gmm8", REFERENCE], False)
                plan.add(map_name, brdf, ANISOTROPIC, ["gmm8", REFERENCE], False)
                plan.add(map_name, brdf, HARD, ["gmm8", "gmm16", REFERENCE], False)
    if "leads" in parts:
        for map_name in (*MAPS, *given_maps):
            for brdf in BRDFS:
                for alpha in LEADS:
                    plan.add(map_name, brdf, alpha, [*LEAD_METHODS, REFERENCE], map_name == TIMED_MAP)
    if "ratios" in parts:
        for map_name in RATIO_MAPS:
            for alpha in RATIO_WIDTHS.values():
                plan.add(map_name, "ward", alpha, [*RATIO_METHODS, REFERENCE], map_name == TIMED_MAP)
    if "grid" in parts:
        for map_name in GRID_MAPS:
            for alpha in grid_widths(map_name):
                plan.add(map_name, "ward", alpha, [*GRID_METHODS, REFERENCE], map_name == TIMED_MAP)
    return plan.cases()


def quick(parts, given_maps):
    """A few cases of each part."""
    plan = Plan()
    if "maps" in parts:
        for map_name in ("hall", SYNTHETIC, *given_maps):
            for alpha in ((0.05, 0.05), ANISOTROPIC):
                plan.add(map_name, "ward", alpha, ["gmm8", REFERENCE], False)
    if "leads" in parts:
        for map_name in (TIMED_MAP, *given_maps):
            plan.add(map_name, "ggx", HARD, ["gmm8", "line16", AUTOMATIC, RIVAL, REFERENCE], map_name == TIMED_MAP)
    if "ratios" in parts:
        for ratio in (1, 20):
            plan.add("hall", "ward", RATIO_WIDTHS[ratio], ["gmm4", "gmm8", "gmm16", RIVAL, REFERENCE], True)
    if "grid" in parts:
        for alpha in ((0.05, 0.2), (0.1, 0.1)):
            plan.add("hall", "ward", alpha, [*GRID_METHODS, REFERENCE], True)
    return plan.cases()
