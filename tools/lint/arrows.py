"""Checks who knows whom among the run time's scripts: arrows.py [FOLDER].

A script knows what it preloads, loads by a literal path, extends, or names by its class. Each folder may know those
of KNOWS and itself, and no script comes back to itself. What is loaded by a path that a constant holds is loaded on
demand: it may be absent, and is no arrow. One line for each violation; the exit status is 1 if there is one.
"""

import re
import sys
from pathlib import Path

ADDON = Path(__file__).resolve().parents[2] / "addons/lobelight"
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

STRING = r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\''
COMMENT = re.compile(rf"({STRING})|#[^\n]*")
PATH = re.compile(r'\b(?:pre)?load\(\s*["\']([^"\']+)["\']|\bextends\s+["\']([^"\']+)["\']')
NAMED_PRELOAD = re.compile(r"\bpreload\(\s*(\w+)\s*\)")
CONSTANT = re.compile(r'\bconst (\w+)\s*(?::\s*\w*\s*)?=\s*"([^"]+)"')
CLASS = re.compile(r"^class_name (\w+)", re.MULTILINE)
WORD = re.compile(r"\b[A-Z]\w+\b")


class Script:
    """Whom a script knows, and in which line it names it first."""

    def __init__(self, path, root):
        self.path = path
        self.folder = path.relative_to(root).parts[0] if path.parent != root else ""
        self.text = COMMENT.sub(lambda match: match.group(1) or "", path.read_text(encoding="utf-8"))
        self.knows = {}

    def look(self, addon, classes):
        constants = dict(CONSTANT.findall(self.text))
        for match in PATH.finditer(self.text):
            self._add(self._resolve(match.group(1) or match.group(2), addon), match.start())
        for match in NAMED_PRELOAD.finditer(self.text):
            if match.group(1) in constants:
                self._add(self._resolve(constants[match.group(1)], addon), match.start())
        code = re.sub(STRING, lambda match: " " * len(match.group()), self.text)
        for match in WORD.finditer(code):
            if match.group() in classes:
                self._add(classes[match.group()], match.start())

    def _resolve(self, name, addon):
        if name.startswith("res://addons/lobelight/"):
            return addon / name.removeprefix("res://addons/lobelight/")
        return Path(name) if "://" in name else (self.path.parent / name).resolve()

    def _add(self, path, at):
        if path != self.path:
            self.knows.setdefault(path, self.text.count("\n", 0, at) + 1)


def read(addon):
    """The scripts of the run time by their paths."""
    root = addon / "runtime"
    scripts = {path: Script(path, root) for path in sorted(root.rglob("*.gd"))}
    classes = {}
    for path in sorted(addon.rglob("*.gd")):
        for name in CLASS.findall(path.read_text(encoding="utf-8")):
            classes[name] = path
    for script in scripts.values():
        script.look(addon, classes)
    return scripts


def find_trespasses(scripts, addon):
    root = addon / "runtime"
    for script in scripts.values():
        where = script.path.relative_to(addon)
        if script.folder and script.folder not in KNOWS:
            yield f"{where}: the folder {script.folder} has no entry in tools/lint/arrows.py"
            continue
        for path, line in script.knows.items():
            if path == addon / FOR_OTHERS and script.folder == WITH_IT:
                continue
            if not path.is_relative_to(root):
                whom = path.relative_to(addon) if path.is_relative_to(addon) else path
                yield f"{where}:{line}: the run time must not know {whom}"
                continue
            whom = path.relative_to(root)
            if whom.parts[0] not in (EVERYBODYS, script.folder, *KNOWS.get(script.folder, ())):
                yield f"{where}:{line}: {script.folder or where.name} must not know {whom}"


def find_cycle(start, scripts):
    """The shortest way from a script back to itself; empty if there is none."""
    came_from = {}
    queue = [start]
    for path in queue:
        for known in scripts[path].knows if path in scripts else ():
            if known == start:
                way = [path]
                while way[-1] != start:
                    way.append(came_from[way[-1]])
                return way[::-1]
            if known not in came_from:
                came_from[known] = path
                queue.append(known)
    return []


def find_cycles(scripts, addon):
    """Each script is in one of them at most."""
    seen = set()
    for path in scripts:
        cycle = find_cycle(path, scripts) if path not in seen else []
        if cycle:
            seen.update(cycle)
            names = [str(one.relative_to(addon)) for one in [*cycle, path]]
            yield f"{names[0]}:{scripts[path].knows[[*cycle, path][1]]}: a cycle: {' -> '.join(names)}"


def check(addon):
    """What is wrong, a line each."""
    scripts = read(addon)
    if not scripts:
        return [f"{addon}/runtime has no scripts"]
    return [*find_trespasses(scripts, addon), *find_cycles(scripts, addon)]


def main():
    wrong = check(Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ADDON)
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
