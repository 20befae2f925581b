"""Files that nobody refers to, and functions that nobody names.

A file refers to another one by needing it (dependencies.py), or by its path or name in a string or command, comments aside.
What prose says is no reference to code. Whoever takes all files of a folder, as a test runner does, is listed in entries.txt.
"""

import fnmatch
import os
import re
from pathlib import Path

from dependencies import CODE, House

ENTRIES = "tools/house/entries.txt"
# What tells of files without using them.
PROSE = (".md", ".xml")
LISTS = "tools/house/"
# As in "$ROOT/tools/x.sh", res://addons/y.gd, ../z.gdshaderinc, build.py, demo/%s.tscn.
PATH = re.compile(r"(?:[\w.+-]+/)*[\w.+-]*\w\.\w+")
GLOB = re.compile(r"(?:[\w.+-]+/)*[\w.+-]*\*[\w.*+-]*\.\w+")
FUNCTIONS = {
    ".gd": re.compile(r"^(?:static )?func (\w+)", re.MULTILINE),
    ".py": re.compile(r"^ *def (\w+)", re.MULTILINE),
    ".sh": re.compile(r"^(\w+)\(\) *[{(]", re.MULTILINE),
    ".gdshader": re.compile(r"^(?:\w+ )?\w+ (\w+)\((?!.*;$)", re.MULTILINE),
    ".gdshaderinc": re.compile(r"^(?:\w+ )?\w+ (\w+)\((?!.*;$)", re.MULTILINE),
    ".h": re.compile(r"^ *(?:\[\[nodiscard\]\] )?(?:[\w:<>,&*]+ )+[&*]?(\w+)\((?=[^;{]*[;{])", re.MULTILINE),
}
NAME = re.compile(r"\w+")


class Entries:
    """What is taken without being referred to: `PATTERN  WHO TAKES IT` a line, and `function PATTERN  WHO CALLS IT`.

    A function's pattern may begin with that of its file: tests/**:test_*.
    """

    def __init__(self, text: str):
        self.files: list[str] = []
        self.functions: list[str] = []
        for line in text.splitlines():
            if line.strip() and not line.startswith("#"):
                words = line.split()
                if words[0] == "function":
                    self.functions.append(words[1])
                else:
                    self.files.append(words[0])

    def takes(self, path: str) -> bool:
        return any(matches(path, pattern) for pattern in self.files)

    def calls(self, path: str, name: str) -> bool:
        for pattern in self.functions:
            file, _, function = pattern.rpartition(":")
            if fnmatch.fnmatchcase(name, function) and (not file or matches(path, file)):
                return True
        return False

    def stale(self, house: House) -> list[str]:
        """Patterns that no file has."""
        return [pattern for pattern in self.files if not any(matches(path, pattern) for path in house.files)]


def matches(path: str, pattern: str) -> bool:
    """Whether a path has a pattern: * stays in a folder, ** does not."""
    expression = re.escape(pattern).replace(r"\*\*", ".*").replace(r"\*", "[^/]*")
    return re.fullmatch(expression, path) is not None


def find_references(house: House) -> set[str]:
    """The files that another one needs or names."""
    found = {target for needs in house.needs.values() for target in needs}
    by_name: dict[str, list[str]] = {}
    for path in house.files:
        by_name.setdefault(os.path.basename(path), []).append(path)
    for start, code in house.codes.items():
        for name in set(PATH.findall(code)) if not start.startswith(LISTS) else ():
            for path in _named(name, start, by_name, house):
                if path != start and (not path.endswith(CODE) or not start.endswith(PROSE)):
                    found.add(path)
        if start.endswith((".cmake", "CMakeLists.txt")):
            for match in GLOB.finditer(code):
                pattern = os.path.join(os.path.dirname(start), match.group())
                found.update(path for path in house.files if matches(path, pattern))
    return found


def _named(name: str, start: str, by_name: dict[str, list[str]], house: House) -> list[str]:
    """The files that a path in a text stands for: from the root, from the text's folder, or the nearest ones that end so."""
    # What stands before it may be a variable's name: $ROOT/tools/x.sh.
    parts = name.split("/")
    tails = ["/".join(parts[first:]) for first in range(len(parts))]
    for tail in tails:
        for folder in ("", os.path.dirname(start)):
            path = os.path.normpath(os.path.join(folder, tail))
            if path in house:
                return [path]
    candidates = by_name.get(parts[-1], [])
    ends = [tail for tail in tails if any(path.endswith("/" + tail) for path in candidates)]
    candidates = [path for path in candidates if ends and path.endswith("/" + ends[0])]
    near = max((_common_folders(path, start) for path in candidates), default=0)
    return [path for path in candidates if _common_folders(path, start) == near]


def _common_folders(path: str, other: str) -> int:
    pairs = zip(path.split("/")[:-1], other.split("/")[:-1])
    return next((count for count, (one, two) in enumerate(pairs) if one != two), min(path.count("/"), other.count("/")))


def find_orphans(house: House, entries: Entries) -> list[str]:
    referred = find_references(house)
    return [path for path in house.files if path not in referred and not entries.takes(path)]


def find_uncalled(house: House, entries: Entries) -> list[str]:
    """Functions whose name no code has but where they are defined, as `FILE:LINE NAME`."""
    count: dict[str, int] = {}
    for path, code in house.codes.items():
        if not path.endswith(PROSE) and not path.startswith(LISTS + "entries"):
            for name in NAME.findall(code):
                count[name] = count.get(name, 0) + 1
    uncalled = []
    for path, code in house.codes.items():
        pattern = FUNCTIONS.get(Path(path).suffix)
        for match in pattern.finditer(code) if pattern else ():
            name = match.group(1)
            # A header's function is named where it is defined, too.
            own = 2 if path.endswith(".h") and _is_defined_beside(house, path, name) else 1
            if count[name] <= own and not entries.calls(path, name):
                uncalled.append(f"{path}:{code.count(chr(10), 0, match.start()) + 1} {name}")
    return uncalled


def _is_defined_beside(house: House, header: str, name: str) -> bool:
    return re.search(rf"\b{name}\(", house.codes.get(header.removesuffix(".h") + ".cpp", "")) is not None
