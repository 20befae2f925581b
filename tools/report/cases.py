"""What `./dev report` measures. The one place that names methods, materials, maps and settings.

A study is a question; each of its cases is one material on one map in one renderer, drawn by several methods under one
set of settings (the properties of bake/comparators/comparison_stage.gd that differ from the usual).
"""

import dataclasses

from runs import SYNTHETIC

REFERENCE = "reference"
BASELINE = "gmm8"
# Lobes of a table, of a line without one, and as many as a material draws by itself.
OURS = ("gmm", "line", "auto")
# Every method of the contract, by family. Those that bake/methods.gd does not know, or that a renderer cannot draw, are
# recorded with the reason.
FAMILIES = {
    "Lobelight, tables": ("gmm1", "gmm2", "gmm3", "gmm4", "gmm8", "gmm16", "gmm24", "gmm32"),
    "Lobelight, lines": ("line8", "line16", "line24", "line32"),
    "Lobelight, automatic": ("auto",),
    "Töral 2015": ("toral8", "toral16"),
    "importance sampling": ("fis8", "fis16", "fis40"),
    "importance sampling, our pyramid": ("fis40g",),
    "all-frequency": ("allfreq1", "allfreq8"),
    "anisotropic Gaussian": ("asg",),
    "major axis": ("majoraxis8", "majoraxis32"),
    "closed form": ("closed8",),
    "split sum": ("splitsum",),
    "Godot": ("stock",),
}
METHODS = tuple(method for family in FAMILIES.values() for method in family)
RIVALS = tuple(method for method in METHODS if not method.startswith(OURS))
# Beside each other in the pictures.
PICTURED = ("auto", "gmm8", "line16", "fis40", "toral8", "allfreq1", "asg", "majoraxis32", "splitsum", "stock")

BRDF_NAMES = {"ward": "Ward", "ggx": "GGX"}
THESIS_WIDTHS = (0.01, 0.05, 0.1, 0.15, 0.2)
ISOTROPIC = tuple(("ward", (width, width)) for width in THESIS_WIDTHS)
ANISOTROPIC = tuple(("ward", alpha) for alpha in ((0.01, 0.2), (0.05, 0.2), (0.05, 0.5)))
OTHER = (("ggx", (0.1, 0.1)), ("ggx", (0.05, 0.2)), ("ggx", (0.01, 0.2)), ("ggx", (0.5, 0.5)))
# Of which the thesis gives figures.
THESIS_MATERIALS = (ISOTROPIC[0], ANISOTROPIC[0])
MATERIALS = (*ISOTROPIC, *ANISOTROPIC, *OTHER)
# On a GPU, by other coverages, and with one more in the renderers after the first and on other maps than the timed one.
FEWER_MATERIALS = (ISOTROPIC[0], ISOTROPIC[2], ANISOTROPIC[0], ANISOTROPIC[1])
# These too, in every renderer and on every map.
FEWER_OTHER = (OTHER[0], OTHER[2])
STUDIED = (ISOTROPIC[0], ISOTROPIC[2], ANISOTROPIC[1])
QUICK_MATERIALS = (ISOTROPIC[2], ANISOTROPIC[1])

RENDERERS = ("mobile", "gl_compatibility", "forward_plus")
# GPU times are taken here: they hardly depend on the map.
TIMED_MAP = "hall"
OTHER_MAPS = ("sunset", "forest")

# The thesis does not give its coverage. The usual one, 0.47, makes the texels' variance the lobe's.
COVERAGES = (0.77, 0.9)
# Křivánek and Colbert 2008 add one level to what the chapter of 2007 has.
FIS_BIASES = (1.0,)
# Beside the best, which is compared everywhere; see bake/comparators/fis.gd.
FIS_FORMS = ("published", "integral")
FORM_MATERIALS = (ISOTROPIC[2], ANISOTROPIC[1], OTHER[0], OTHER[3])
FIS_METHODS = ("fis8", "fis16", "fis40", "fis40g")
FILTERS = ("box", "binomial", "gaussian", "disc")
USUAL_FILTER = "disc"
FACE_SIZES = (64, 128, 256, 512)
ISOTROPIC_VIEWS = ((4, 1), (8, 1), (16, 1), (32, 1), (64, 1))
ANISOTROPIC_VIEWS = ((4, 2), (8, 4), (16, 8), (32, 16))
# GPU time over that of gmm8 in the same renderer; infinity: however long it takes.
BUDGETS = (0.5, 0.75, 1.0, 1.5, 2.0, 3.0, float("inf"))
# Fetches of the environment.
FETCH_BUDGETS = (1, 2, 3, 4, 8, 16, 24, 32, 40)

SOFTWARE, GPU = "software", "gpu"


@dataclasses.dataclass
class Case:
    """One picture's worth of work; `stage`: settings that differ from the usual, `pictured`: a sheet is kept."""

    study: str
    renderer: str
    map: str
    brdf: str
    alpha: tuple[float, float]
    methods: tuple[str, ...]
    timed: bool = False
    pictured: bool = False
    stage: dict = dataclasses.field(default_factory=dict)
    device: str = SOFTWARE

    def title(self):
        settings = "".join(f", {name} {shown(value)}" for name, value in self.stage.items())
        return f"{self.renderer}, {self.map}, {material_name((self.brdf, self.alpha))}{settings}"

    def name(self):
        """For files."""
        parts = [self.map, self.brdf, *(f"{a:g}" for a in self.alpha)]
        parts += [f"{name}-{shown(value)}" for name, value in self.stage.items()]
        return "_".join([self.device, self.renderer, *parts])

    def weight(self):
        """About how long it takes, for the time left: drawing and judging, times of rounds, the table's fits."""
        return 4.0 + len(self.methods) * (2.0 if self.timed else 0.8)


def shown(value):
    return "x".join(str(v) for v in value) if isinstance(value, (list, tuple)) else str(value)


def material_name(material):
    brdf, alpha = material
    return f"{BRDF_NAMES.get(brdf, brdf)} ({alpha[0]:g}, {alpha[1]:g})"


def family_of(method):
    return next((family for family, methods in FAMILIES.items() if method in methods), method)


def is_ours(method):
    return method.startswith(OURS)


def is_isotropic(material):
    return material[1][0] == material[1][1]


def full(renderers=RENDERERS, given_maps=()):
    """A whole run: every material on one map in the first renderer, fewer on other maps and renderers, and the studies."""
    first, *others = renderers
    plan = _materials(first, MATERIALS, (TIMED_MAP,))
    plan += _materials(first, (*FEWER_MATERIALS, *FEWER_OTHER), (*OTHER_MAPS, SYNTHETIC, *given_maps))
    plan += _studies(first, STUDIED, FEWER_MATERIALS, ISOTROPIC_VIEWS, ANISOTROPIC_VIEWS, FACE_SIZES)
    for renderer in others:
        plan += _materials(renderer, (*FEWER_MATERIALS, *FEWER_OTHER), (TIMED_MAP,))
    return plan


def quick(renderers=RENDERERS[:1], given_maps=()):
    """A few cases of everything."""
    first, *others = renderers
    plan = _materials(first, QUICK_MATERIALS, (TIMED_MAP, *given_maps))
    plan += _studies(first, QUICK_MATERIALS, QUICK_MATERIALS, ((4, 1), (16, 1)), ((4, 2), (16, 8)), (64, 512))
    for renderer in others:
        plan += _materials(renderer, QUICK_MATERIALS[:1], (TIMED_MAP,))
    return plan


def on_gpu(renderers=RENDERERS):
    """What a GPU is asked: times."""
    materials = [case for renderer in renderers for case in _materials(renderer, FEWER_MATERIALS, (TIMED_MAP,))]
    return [dataclasses.replace(case, device=GPU, pictured=False) for case in materials]


def only_methods(plan, methods):
    """The cases without other methods than these and the reference; those that then have none are left out."""
    found = []
    for case in plan:
        kept = tuple(method for method in case.methods if method in methods)
        if kept:
            found.append(dataclasses.replace(case, methods=(*kept, REFERENCE)))
    return found


def _materials(renderer, materials, maps):
    return [
        Case(
            "materials", renderer, map_name, brdf, alpha, (*METHODS, REFERENCE),
            timed=map_name == TIMED_MAP,
            pictured=map_name == TIMED_MAP and renderer == RENDERERS[0],
        )
        for map_name in maps
        for brdf, alpha in materials
    ]  # fmt: skip


def _studies(renderer, studied, covered, isotropic_views, anisotropic_views, face_sizes):
    def cases(study, chosen, methods, stage, map_name=TIMED_MAP):
        return [Case(study, renderer, map_name, *material, (*methods, REFERENCE), stage=stage) for material in chosen]

    plan = []
    for coverage in COVERAGES:
        stage = {"toral_coverage": coverage}
        plan += cases("coverage", covered, ("toral8", "toral16"), stage)
        if covered == FEWER_MATERIALS:
            plan += cases("coverage", THESIS_MATERIALS, ("toral8", "toral16"), stage, SYNTHETIC)
    for bias in FIS_BIASES:
        plan += cases("bias", studied, FIS_METHODS, {"fis_bias": bias})
    for form in FIS_FORMS:
        plan += cases("form", FORM_MATERIALS, FIS_METHODS, {"fis_form": form})
    for name in FILTERS:
        if name != USUAL_FILTER:
            plan += cases("filter", studied, ("gmm8", "gmm16", "fis40g"), {"filter": name})
    for size in face_sizes:
        plan += cases("pyramid", studied, ("gmm8", "gmm16", "fis40"), {"pyramid_size": size})
    for material in studied:
        for views in isotropic_views if is_isotropic(material) else anisotropic_views:
            plan += cases("table", [material], ("gmm8", "gmm16"), {"table_views": [*views]})
    return plan
