"""What an exported pack holds, under the names that the project has for it, and why."""

import fnmatch
import hashlib
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
    ("addons/lobelight/icons/*", "the project's icon"),
    ("addons/lobelight/runtime/*", "the addon's run time"),
    ("addons/lobelight/*.gdshaderinc", "functions for shaders of one's own"),
    ("demo/environments/*", "an environment, seen behind the objects and lighting them"),
    ("demo/meshes/*", "one of the objects, or what builds them"),
    ("demo/*", "the demo"),
    ("bake/comparators/*", "shaders of the methods that the demo compares with"),
    (".godot/*", "the engine's lists of files and classes"),
    ("project.binary", "the project's settings"),
]
# What the addon's export plugin and the engine make of a file, and how they name that.
BY_PATH = re.compile(r"\.godot/exported/lobelight/(?P<digest>[0-9a-f]{32})\.\w+$")
MADE = re.compile(r"\.godot/(?:imported/(?P<imported>.+)-|exported/\d+/export-)[0-9a-f]{32}(?:-(?P<exported>.+))?\.\w+$")


def explain(pack, report):
    """A list of {path, bytes, why}, the largest first. `report` is what the addon's export plugin wrote about the export."""
    told = json.loads(report.read_text(encoding="utf-8"))
    reasons = {entry["path"].removeprefix("res://"): entry["why"] for entry in told["tables"] + told["panoramas"]}
    files = read_files(pack)
    sources = {}
    for name, _size, _start in files:
        source = re.sub(r"\.(remap|import)$", "", name)
        if source != name:
            sources[pathlib.PurePath(source).name] = source
            sources[pathlib.PurePath(source).stem] = source
            sources[hashlib.md5(f"res://{source}".encode()).hexdigest()] = source
    sizes = {}
    for name, size, _start in files:
        path = source_of(name, sources)
        sizes[path] = sizes.get(path, 0) + size
    entries = [{"path": path, "bytes": size, "why": reasons.get(path, reason_of(path))} for path, size in sizes.items()]
    return sorted(entries, key=lambda entry: (-entry["bytes"], entry["path"]))


def source_of(name, sources):
    """The project's file that a file in the pack was made of."""
    if made := BY_PATH.match(name):
        return sources.get(made["digest"], name)
    if made := MADE.match(name):
        return sources.get(made["imported"] or made["exported"], name)
    return re.sub(r"\.gdc$", ".gd", re.sub(r"\.(remap|import)$", "", name))


def reason_of(path):
    return next((why for pattern, why in REASONS if fnmatch.fnmatchcase(path, pattern)), "")
