"""What an exported pack holds, and why: under the names that the project has for it."""

import fnmatch
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "android"))
from pack_files import PackError, read_files  # noqa: E402

__all__ = ["PackError", "explain"]

# The first pattern counts.
REASONS = [
    ("demo/build/tables/thesis_8.res", "the tables of the method Thesis 2015"),
    ("demo/build/tables/*", "tables for the demo's choice of lobes"),
    ("addons/lobelight/tables/*", "lobes that materials are drawn with"),
    ("demo/environments/*", "an environment, shown behind the objects and lighting them"),
    ("demo/meshes/*", "one of the objects"),
    ("addons/lobelight/icons/*", "the project's icon"),
    ("addons/lobelight/runtime/*", "the addon's run time"),
    ("bake/comparators/*", "shaders of the methods that the demo compares with"),
    ("demo/*", "the demo"),
    (".godot/*", "the engine's lists of files and classes"),
    ("project.binary", "the project's settings"),
]


def own_name(name, remaps):
    """The project's name of a file that the engine made of one of its own."""
    name = remaps.get(name, name)
    name = re.sub(r"\.(remap|import)$", "", name)
    return re.sub(r"\.gdc$", ".gd", name)


def explain(pack, report):
    """A list of {path, bytes, why}, the largest first. `report` is what the addon's export plugin wrote."""
    reasons = {}
    if report.is_file():
        data = json.loads(report.read_text(encoding="utf-8"))
        for entry in data["tables"] + data["panoramas"]:
            reasons[entry["path"].removeprefix("res://")] = entry["why"]
    sizes = {}
    data = read_files(pack)
    remaps = {}
    for name, _size, start in data:
        imported = re.search(r"(?:^|/)([^/]+)-[0-9a-f]{32}\.\w+$", name)
        if imported and name.startswith(".godot/imported/"):
            remaps[name] = imported[1]
    whole = {name.split("/")[-1].removesuffix(".import"): name.removesuffix(".import") for name, _s, _d in data if name.endswith(".import")}
    for name, size, _start in data:
        path = own_name(whole.get(remaps.get(name, ""), name), {})
        sizes[path] = sizes.get(path, 0) + size
    entries = [{"path": path, "bytes": size, "why": reasons.get(path) or reason_of(path)} for path, size in sizes.items()]
    return sorted(entries, key=lambda entry: (-entry["bytes"], entry["path"]))


def reason_of(path):
    return next((why for pattern, why in REASONS if fnmatch.fnmatchcase(path, pattern)), "")
