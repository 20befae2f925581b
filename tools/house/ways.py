"""Ways through the files: lobe_path.txt, light_path.txt, checked against who needs whom."""

import os

from dependencies import CPP, House


def read(text: str) -> list[tuple[str, str]]:
    """The files of a way, and what happens in each."""
    lines = [line.split(None, 1) for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return [(line[0], line[1].strip() if len(line) > 1 else "") for line in lines]


def unit(path: str) -> str:
    """A C++ file and its header are one."""
    stem, kind = os.path.splitext(path)
    return stem if kind in CPP else path


def find_gaps(way: list[tuple[str, str]], house: House) -> list[str]:
    """What is wrong with a way: files that are not there, and files that no earlier one knows of or is known to."""
    wrong = []
    linked: dict[str, set[str]] = {}
    for relation in (house.needs, house.loads):
        for path, others in relation.items():
            for other in others:
                linked.setdefault(unit(path), set()).add(unit(other))
                linked.setdefault(unit(other), set()).add(unit(path))
    before: list[str] = []
    for path, _what in way:
        if path not in house:
            wrong.append(f"there is no file {path}")
        elif unit(path) in before:
            wrong.append(f"{path} comes twice")
        elif before and not linked.get(unit(path), set()).intersection(before):
            wrong.append(f"{path} neither needs a file before it nor is needed by one")
        before.append(unit(path))
    return wrong


def with_headers(way: list[tuple[str, str]], house: House) -> list[str]:
    """All files of a way."""
    return [path for path in house.files if unit(path) in {unit(one) for one, _what in way}]
