"""Checks the names in the shader includes that shaders of users include: shader_names.py [--fix].

Godot 4.6 takes every variable of a shader for the uniform of that name, if there is one, arguments and local variables of
included functions as well (servers/rendering/shader_compiler.cpp): with a `uniform float roughness` in the user's shader, a
function's argument `roughness` would be that. So all of them end with an underscore in what lobelight.gdshaderinc includes.
One line for each that does not; the exit status is 1 if there is one. With --fix they get one.
"""

import re
import sys
from pathlib import Path

ADDON = Path(__file__).resolve().parents[2] / "addons/lobelight"
ENTRY = "lobelight.gdshaderinc"

INCLUDE = re.compile(r'^\s*#include\s+"([^"]+)"', re.MULTILINE)
# What declares no variable: members have their structs, and uniforms are the addon's own.
BESIDE = re.compile(r'//[^\n]*|"[^"\n]*"|\bstruct\s+\w+\s*\{[^}]*\}|\buniform\b[^;]*;')
TYPE = r"(?:float|int|uint|bool|[biu]?vec[234]|mat[234]|[iu]?sampler\w+|Lobelight\w+)"
DECLARED = re.compile(rf"\b{TYPE}\s+([A-Za-z]\w*)\s*(?=[=;,)\[:])")
NEXT = re.compile(r"\s*([A-Za-z]\w*)\s*(?=[=,;\[])")
WORD = re.compile(r"(?<![\w.])([A-Za-z]\w*)\b(?!\s*\()")
# The addon's own: functions, uniforms and constants.
OWN = re.compile(r"lobelight|LOBELIGHT|Lobelight")


def reached(addon=ADDON):
    """The files, the entry first."""
    files = [addon / ENTRY]
    for file in files:
        for path in INCLUDE.findall(file.read_text(encoding="utf-8")):
            found = (file.parent / path).resolve()
            if found not in files:
                files.append(found)
    return files


def code_of(text):
    """The text, of the same length and lines, with blanks where there is no code."""
    return BESIDE.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def declared_together(code, first):
    """Where names begin that one statement declares, and the names."""
    yield first.start(1), first.group(1)
    depth = 0
    for at in range(first.end(1), len(code)):
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(code[at], 0)
        if depth < 0 or depth == 0 and code[at] == ";":
            return
        following = NEXT.match(code, at + 1) if depth == 0 and code[at] == "," else None
        if following:
            yield following.start(1), following.group(1)


def wrong_names(text):
    """The names of arguments and local variables without an underscore, each with the line that declares it first."""
    code = code_of(text)
    found = {}
    for match in DECLARED.finditer(code):
        for start, name in declared_together(code, match):
            found.setdefault(name, code.count("\n", 0, start) + 1)
    return {name: line for name, line in found.items() if not name.endswith("_") and not OWN.match(name)}


def renamed(text, names):
    """The text with an underscore after each of the names."""
    code = code_of(text)
    parts = []
    at = 0
    for match in WORD.finditer(code):
        if match.group(1) in names:
            parts += [text[at : match.end(1)], "_"]
            at = match.end(1)
    return "".join(parts) + text[at:]


def main():
    files = reached()
    wrong = {file: wrong_names(file.read_text(encoding="utf-8")) for file in files}
    if sys.argv[1:] == ["--fix"]:
        names = {name for found in wrong.values() for name in found}
        for file in files:
            file.write_text(renamed(file.read_text(encoding="utf-8"), names), encoding="utf-8")
        return 0
    for file, found in wrong.items():
        for name, line in found.items():
            print(f"{file.relative_to(ADDON.parents[1])}:{line}: {name} is to be {name}_, see tools/lint/shader_names.py --fix")
    return 1 if any(wrong.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
