"""Checks who knows whom: arrows.py [FOLDER].

Each folder of the run time and of the C++ library may know those of KNOWS or NATIVE_KNOWS and itself; the addon knows nothing
outside it but the native classes. What a file knows is what it needs, see tools/house/dependencies.py: a script that is loaded
by a path in a constant may be absent, and is no arrow. One line for each violation; the exit status is 1 if there is one.
Cycles are ./dev house's.
"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/house"))

from dependencies import House  # noqa: E402

ADDON = "addons/lobelight/"
RUNTIME = ADDON + "runtime/"
NATIVE = "gdextension/src/"
BINDING = "gdextension/binding/"
EVERYBODYS = "on_demand.gd"
# What shaders of others include, which lies above the run time, and who goes along with it.
FOR_OTHERS = "lobelight.gdshaderinc"
WITH_IT = "own_shaders"

KNOWS = {
    # What BRDFs are fitted with: numbers, from which everything else starts.
    "table": (),
    "shaders": (),
    # Filters pictures, whatever they are for.
    "pyramid": ("shaders",),
    # What a pyramid was made of and where it is; it does not know who shows it.
    "light": ("pyramid",),
    # Shows a light through a table. It preloads what its shader includes.
    "material": (
        *("table", "light", "shaders", "antialiasing", "clear_coat", "diffuse", "occlusion"),
        *("detail", "fades", "lamps", "line", "msdf", "parallax", "sheen", "sources", "triplanar", "vertices"),
    ),
    # Parts that exports may leave out. They know those whom they serve, and these load them on demand.
    "antialiasing": (),
    "clear_coat": (),
    "detail": (),
    "diffuse": (),
    "fades": (),
    "frozen": ("light",),
    "lamps": (),
    "line": (),
    "engine_light": ("light",),
    "mixing": ("material", "table", "pyramid", "shaders"),
    "msdf": (),
    "parallax": (),
    "triplanar": (),
    "vertices": (),
    "sheen": (),
    "sources": (),
    "filters": (),
    "occlusion": (),
    "compatibility": ("pyramid",),
    "rendering_device": ("pyramid",),
    "own_shaders": ("material", "table", "light", "shaders", "diffuse", "line", "sources"),
    "visual_shader": (),
    "live": ("light", "pyramid"),
    "skies": ("light", "pyramid"),
    "probes": ("light", "pyramid"),
    "conversion": ("material", "table"),
    "gltf": ("material", "table"),
    "warnings": ("light", "pyramid", "probes"),
}

NATIVE_KNOWS = {
    "base": (),
    "sg": ("base",),
    "brdf": ("base",),
    "table": ("base", "sg"),
    "image": ("base", "table"),
    "fit": ("base", "brdf", "sg", "table"),
    "reference": ("base", "brdf", "image", "sg", "table"),
    "bake": ("base", "brdf", "fit", "image", "reference", "sg", "table"),
    "godot": ("base", "bake", "brdf", "fit", "image", "reference", "sg", "table"),
}


def find_trespasses(house):
    for path, needs in house.needs.items():
        if path.startswith(RUNTIME) and path.endswith(".gd"):
            yield from _check_runtime(path, needs)
        elif path.startswith(NATIVE):
            yield from _check_native(path, needs)
        elif path.startswith(ADDON):
            for other, line in needs.items():
                if not other.startswith((ADDON, NATIVE + "godot/")):
                    yield f"{path.removeprefix(ADDON)}:{line}: the addon must not know {other}"


def _check_runtime(path, needs):
    where = path.removeprefix(ADDON)
    folder, _, name = path.removeprefix(RUNTIME).partition("/")
    folder = folder if name else ""
    if folder and folder not in KNOWS:
        yield f"{where}: the folder {folder} has no entry in tools/lint/arrows.py"
        return
    for other, line in needs.items():
        if other == ADDON + FOR_OTHERS and folder == WITH_IT:
            continue
        whom = other.removeprefix(RUNTIME)
        if whom == other:
            yield f"{where}:{line}: the run time must not know {other.removeprefix(ADDON)}"
        elif whom.partition("/")[0] not in (EVERYBODYS, folder, *KNOWS.get(folder, ())):
            yield f"{where}:{line}: {folder or path.rpartition('/')[2]} must not know {whom}"


def _check_native(path, needs):
    folder = path.removeprefix(NATIVE).partition("/")[0]
    if folder not in NATIVE_KNOWS:
        yield f"{path}: the folder {folder} has no entry in tools/lint/arrows.py"
        return
    for other, line in needs.items():
        if other.startswith(BINDING) and folder == "godot":
            continue
        if other.removeprefix(NATIVE).partition("/")[0] not in (folder, *NATIVE_KNOWS[folder]):
            yield f"{path}:{line}: {folder} must not know {other.removeprefix(NATIVE)}"


def check(root):
    """What is wrong, a line each."""
    house = House(root)
    if not any(path.startswith(RUNTIME) and path.endswith(".gd") for path in house.files):
        return [f"{root / RUNTIME} has no scripts"]
    return list(find_trespasses(house))


def main():
    wrong = check(Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT)
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
