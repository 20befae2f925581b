"""Which file of the repository needs which.

A file needs what it cannot be read without: what a script preloads, loads by a literal path, extends or names by its class;
what a shader or a C++ file includes; what a Python file imports; what a shell script sources; what a scene names by its path.
A path in a string is not enough, nor is a program that is run: the file then is referred to, but not needed.
"""

import os
import re
import subprocess
from pathlib import Path

# Made by the engine beside each file, under its name.
COMPANIONS = (".uid", ".import")
CODE = (".gd", ".gdshader", ".gdshaderinc", ".cpp", ".h", ".hpp", ".py", ".sh", ".cmake")
TEXT = (*CODE, ".cfg", ".css", ".gdextension", ".godot", ".html", ".js", ".json", ".md", ".svg", ".template", ".tres", ".tscn")
TEXT += (".txt", ".xml", ".yaml", ".yml", "")
SHADERS = (".gdshader", ".gdshaderinc")
CPP = (".cpp", ".h", ".hpp")

STRING = r'"""(?:(?!""")[\s\S])*"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\''
COMMENTS = {
    ".gd": re.compile(rf"({STRING})|#[^\n]*"),
    ".py": re.compile(rf'^ *"""(?:(?!""")[\s\S])*"""|({STRING})|#[^\n]*', re.MULTILINE),
    ".sh": re.compile(r"()^\s*#[^\n]*", re.MULTILINE),
    ".cmake": re.compile(r"()^\s*#[^\n]*", re.MULTILINE),
    ".cpp": re.compile(rf"({STRING})|//[^\n]*"),
}
LOADED = re.compile(r'\b(?:pre)?load\(\s*["\']([^"\']+)["\']|\bextends\s+["\']([^"\']+)["\']')
NAMED_PRELOAD = re.compile(r"\bpreload\(\s*(\w+)\s*\)")
CONSTANT = re.compile(r'\bconst (\w+)\s*(?::\s*\w*\s*)?=\s*"([^"]+)"')
PROJECT_PATH = re.compile(r'"(res://[^"\s]+)"')
CLASS = re.compile(r"^class_name (\w+)", re.MULTILINE)
BASE = re.compile(r'^extends (?:(\w+)|"([^"]+)")', re.MULTILINE)
NATIVE_CLASS = re.compile(r"\bGDCLASS\((\w+),")
WORD = re.compile(r"\b[A-Z]\w+\b")
INCLUDED = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<(godot_cpp/[^>]+)>)', re.MULTILINE)
IMPORTED = re.compile(r"^\s*(?:from (\w+) import\b|import (\w+(?:, *\w+)*))", re.MULTILINE)
SOURCED = re.compile(r'^\s*(?:source|\.)\s+"([^\n]*?)"(?:\s|$)', re.MULTILINE)
RESOURCE = re.compile(r'\[ext_resource [^\]]*path="res://([^"]+)"')
INCLUDE_FOLDERS = (
    "gdextension/src",
    "gdextension/bench",
    "gdextension/fuzz",
    "gdextension/tests",
    "gdextension/binding/include",
)


def list_files(root: Path) -> list[str]:
    """The paths of the repository's files: those that git knows or would take; in a folder without git, all."""
    if (root / ".git").exists():
        command = ["git", "-C", str(root), "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
        names = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\0")
        return sorted({name for name in names if name and (root / name).is_file()})
    return sorted(path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_file())


class House:
    """The files below a folder.

    `needs` has for each file whom it needs, and the line that says so first. `loads` has the scripts and shaders that a script
    names by their paths without needing them: it loads them when it wants them, and exports may lack them.
    """

    def __init__(self, root: Path):
        self.root = root
        self.files = [path for path in list_files(root) if not path.endswith(COMPANIONS)]
        self._known = set(self.files)
        self.texts = {path: self._read(path) for path in self.files if os.path.splitext(path)[1] in TEXT}
        # Without comments, which bind nobody.
        self.codes = {path: self._strip(path, text) for path, text in self.texts.items()}
        self._classes = self._find_classes()
        self._modules: dict[str, list[str]] = {}
        for path in self.files:
            if path.endswith(".py"):
                self._modules.setdefault(Path(path).stem, []).append(path)
        self.needs: dict[str, dict[str, int]] = {path: self._find_needs(path) for path in self.files}
        self.loads: dict[str, dict[str, int]] = {path: self._find_loads(path) for path in self.files if path.endswith(".gd")}

    def __contains__(self, path: str) -> bool:
        return path in self._known

    def _read(self, path: str) -> str:
        try:
            return (self.root / path).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            return ""

    def _strip(self, path: str, text: str) -> str:
        kind = os.path.splitext(path)[1]
        pattern = COMMENTS.get(".cpp" if kind in CPP + SHADERS else ".cmake" if path.endswith("CMakeLists.txt") else kind)
        return pattern.sub(lambda match: match.group(1) or re.sub(r"[^\n]", "", match.group()), text) if pattern else text

    def _find_classes(self) -> dict[str, str]:
        classes = {}
        for path, code in self.codes.items():
            if path.endswith(".gd"):
                classes.update(dict.fromkeys(CLASS.findall(code), path))
            elif path.endswith(".h"):
                # What GDScript calls is in the file of code, not in the header.
                classes.update(dict.fromkeys(NATIVE_CLASS.findall(code), path.removesuffix(".h") + ".cpp"))
        return classes

    def resolve(self, name: str, start: str, folders: tuple[str, ...] = ()) -> str | None:
        """The file that `start` means by `name`: a path from the project, from itself, or from one of the folders."""
        if name.startswith("res://"):
            candidates = [name.removeprefix("res://")]
        else:
            candidates = [os.path.normpath(os.path.join(folder, name)) for folder in (os.path.dirname(start), *folders)]
        return next((path for path in candidates if path in self._known), None)

    def _find_needs(self, path: str) -> dict[str, int]:
        code = self.codes.get(path, "")
        kind = os.path.splitext(path)[1]
        found: dict[str, int] = {}

        def add(target: str | None, at: int) -> None:
            if target is not None and target != path:
                found.setdefault(target, code.count("\n", 0, at) + 1)

        if kind == ".gd":
            constants = dict(CONSTANT.findall(code))
            for match in LOADED.finditer(code):
                add(self.resolve(match.group(1) or match.group(2), path), match.start())
            for match in NAMED_PRELOAD.finditer(code):
                add(self.resolve(constants.get(match.group(1), ""), path), match.start())
            # Native classes are asked for by their names, as they may be absent.
            for match in re.finditer(r'&"(\w+)"', code):
                add(self._native(match.group(1)), match.start())
            plain = re.sub(STRING, lambda match: re.sub(r"[^\n]", " ", match.group()), code)
            hidden = self._find_constants(path)
            for match in WORD.finditer(plain):
                if match.group() not in hidden:
                    add(self._classes.get(match.group()), match.start())
        elif kind in SHADERS or kind in CPP:
            for match in INCLUDED.finditer(code):
                add(self.resolve(match.group(1) or match.group(2), path, INCLUDE_FOLDERS), match.end())
        elif kind == ".py":
            for match in IMPORTED.finditer(code):
                for name in (match.group(1) or match.group(2)).replace(" ", "").split(","):
                    add(self._module(name, path), match.end())
        elif kind in (".sh", "") and path in self.codes:
            for match in SOURCED.finditer(code):
                # "$ROOT/tools/lib/x.sh", "$(dirname "${BASH_SOURCE[0]}")/../lib/x.sh"
                name = re.sub(r'^\$\{?\w+\}?/|^\$\(dirname "\$\{BASH_SOURCE\[0\]\}"\)/', "", match.group(1))
                add(self.resolve(name, path, ("",)), match.start(1))
        elif kind in (".tscn", ".tres"):
            for match in RESOURCE.finditer(code):
                add(self.resolve("res://" + match.group(1), path), match.start())
        return found

    def _find_loads(self, path: str) -> dict[str, int]:
        code = self.codes[path]
        found: dict[str, int] = {}
        for match in PROJECT_PATH.finditer(code):
            target = self.resolve(match.group(1), path)
            if target not in (None, path) and target.endswith((".gd", *SHADERS)) and target not in self.needs[path]:
                found.setdefault(target, code.count("\n", 0, match.start()) + 1)
        return found

    def _find_constants(self, path: str) -> set[str]:
        """The names of a script's constants and of those it inherits: they hide classes of the same names."""
        code = self.codes[path]
        found = set(re.findall(r"\bconst (\w+)", code))
        base = BASE.search(code)
        above = base and (self._classes.get(base.group(1) or "") or self.resolve(base.group(2) or "", path))
        return found | self._find_constants(above) if above and above != path else found

    def _native(self, name: str) -> str | None:
        path = self._classes.get(name, "")
        return path if path.endswith(".cpp") else None

    def _module(self, name: str, start: str) -> str | None:
        beside = os.path.join(os.path.dirname(start), name + ".py")
        if beside in self._known:
            return beside
        found = self._modules.get(name, [])
        return found[0] if len(found) == 1 else None


def find_cycles(needs: dict[str, dict[str, int]]) -> list[list[str]]:
    """The cycles, each as the files on its way, and each file in one of them at most."""
    cycles = []
    seen: set[str] = set()
    for start in sorted(needs):
        if start in seen:
            continue
        came_from: dict[str, str] = {}
        queue = [start]
        for path in queue:
            if start in needs.get(path, {}):
                way = [path]
                while way[-1] != start:
                    way.append(came_from[way[-1]])
                cycles.append(way[::-1])
                seen.update(way)
                break
            for other in needs.get(path, {}):
                if other not in came_from and other != start:
                    came_from[other] = path
                    queue.append(other)
    return cycles
