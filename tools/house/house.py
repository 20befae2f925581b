"""./dev house: how the repository is built, in figures and as a picture. See tools/commands/house.sh --help."""

import argparse
import json
import os
import sys
import tempfile
from pathlib import Path

import picture
import references
import ways
from dependencies import CODE, House, find_cycles

ROOT = Path(__file__).resolve().parents[2]
PICTURE = "docs/pictures/architecture.svg"
PAGE = "docs/architecture.md"
# Where the ways stand in the page.
TABLE = "<!-- ./dev house --draw writes this: {} -->\n"
END = "<!-- end -->"
SHORT = {"addons/lobelight/runtime/": "runtime/", "gdextension/src/": "src/"}
WAYS = {"lobe": "tools/house/lobe_path.txt", "light": "tools/house/light_path.txt"}
BOXES = "tools/house/boxes.json"
# Files below these are in a box of the picture, but for the one that everybody may know.
DRAWN = ("addons/lobelight/runtime/", "gdextension/src/")
EVERYBODYS = "addons/lobelight/runtime/on_demand.gd"
# Counted as one folder each: so many levels below the root.
DEPTHS = {"addons/lobelight/runtime": 4, "addons/lobelight/editor": 4, "gdextension/src": 3, "tools": 2, "tests": 2}


def count_lines(house: House, path: str) -> int:
    return house.texts.get(path, "").count("\n")


def count_by_folder(house: House) -> dict[str, dict[str, int]]:
    folders: dict[str, dict[str, int]] = {}
    for path in house.files:
        if path.endswith(CODE):
            depth = next((depth for prefix, depth in DEPTHS.items() if path.startswith(prefix + "/")), 1)
            folder = "/".join(path.split("/")[:-1][:depth]) or "."
            counted = folders.setdefault(folder, {"files": 0, "lines": 0})
            counted["files"] += 1
            counted["lines"] += count_lines(house, path)
    return dict(sorted(folders.items()))


def look(root: Path) -> tuple[dict, dict[str, str]]:
    """The figures, "wrong" among them (a sentence each), and what is drawn: text by path."""
    house = House(root)
    texts = {name: (root / path).read_text(encoding="utf-8") for name, path in WAYS.items()}
    all_ways = {name: ways.read(text) for name, text in texts.items()}
    boxes = picture.Boxes((root / BOXES).read_text(encoding="utf-8"), house)
    entries = references.Entries((root / references.ENTRIES).read_text(encoding="utf-8"))
    cycles = find_cycles(house.needs)
    orphans = references.find_orphans(house, entries)
    uncalled = references.find_uncalled(house, entries)
    wrong = [f"a cycle: {' -> '.join([*cycle, cycle[0]])}" for cycle in cycles]
    wrong += [f"nobody refers to {path}: remove it, or say in {references.ENTRIES} who takes it" for path in orphans]
    wrong += [
        f"{place}: nobody names this function: remove it, or say in {references.ENTRIES} who calls it" for place in uncalled
    ]
    wrong += [f"{references.ENTRIES}: no file is named {pattern}" for pattern in entries.stale(house)]
    for name, way in all_ways.items():
        wrong += [f"{WAYS[name]}: {gap}" for gap in ways.find_gaps(way, house)]
    wrong += [f"{BOXES}: no file is in the box {name}" for name in boxes.empty]
    wrong += [
        f"{BOXES}: {path} is in no box" for prefix in DRAWN for path in boxes.outside(house, prefix) if path != EVERYBODYS
    ]
    drawn = picture.draw(boxes, {name: [path for path, _what in way] for name, way in all_ways.items()})
    code = [path for path in house.files if path.endswith(CODE)]
    longest = sorted(code, key=lambda path: (-count_lines(house, path), path))[:5]
    figures = {
        "files": len(house.files),
        "code_files": len(code),
        "code_lines": sum(count_lines(house, path) for path in code),
        "arrows": sum(len(needs) for needs in house.needs.values()),
        "cycles": cycles,
        "orphans": orphans,
        "uncalled": uncalled,
        "longest": [{"file": path, "lines": count_lines(house, path)} for path in longest],
        "folders": count_by_folder(house),
        "wrong": wrong,
    }
    for name, way in all_ways.items():
        with_headers = ways.with_headers(way, house)
        figures[f"{name}_path"] = {
            "steps": len(way),
            "files": len(with_headers),
            "lines": sum(count_lines(house, path) for path in with_headers),
            "way": [{"file": path, "what": what} for path, what in way],
        }
    page = (root / PAGE).read_text(encoding="utf-8")
    return figures, {PICTURE: drawn, PAGE: fill_page(page, all_ways)}


def fill_page(text: str, all_ways: dict[str, list[tuple[str, str]]]) -> str:
    """The page with the ways as they are."""
    for name, way in all_ways.items():
        before, start, rest = text.partition(TABLE.format(name))
        if start:
            text = before + start + make_table(way) + END + rest.partition(END)[2]
    return text


def make_table(way: list[tuple[str, str]]) -> str:
    rows = []
    for number, (path, what) in enumerate(way, 1):
        long = next((prefix for prefix in SHORT if path.startswith(prefix)), "")
        rows.append(f"| {number} | `{SHORT.get(long, '')}{path.removeprefix(long)}` | {what} |\n")
    return "| | File | What it does |\n|---|---|---|\n" + "".join(rows)


def write(path: Path, text: str) -> None:
    """All of it or nothing."""
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, delete=False) as file:
        file.write(text)
    os.chmod(file.name, 0o644)
    os.replace(file.name, path)


def show(figures: dict) -> None:
    for name in WAYS:
        way = figures[f"{name}_path"]
        print(
            f"the way of {'a lobe' if name == 'lobe' else name}: {way['steps']} steps, {way['files']} files, {way['lines']} lines"
        )
        for number, step in enumerate(way["way"], 1):
            print(f"  {number:2}  {step['file']}  {step['what']}")
    print("files of code by folder:")
    for folder, counted in figures["folders"].items():
        print(f"  {counted['files']:4} files {counted['lines']:6} lines  {folder}")
    print(f"  {figures['code_files']:4} files {figures['code_lines']:6} lines  in all")
    print(f"longest file: {figures['longest'][0]['lines']} lines, {figures['longest'][0]['file']}")
    print(
        f"{figures['arrows']} arrows, {len(figures['cycles'])} cycles, {len(figures['orphans'])} files that nobody refers to, "
        f"{len(figures['uncalled'])} functions that nobody names"
    )


def main() -> int:
    parser = argparse.ArgumentParser(prog="house")
    parser.add_argument("--draw", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--json")
    parser.add_argument("--root", type=Path, default=ROOT)
    options = parser.parse_args()
    figures, drawn = look(options.root)
    try:
        for name, text in drawn.items():
            target = options.root / name
            if options.draw:
                write(target, text)
            elif not target.is_file() or target.read_text(encoding="utf-8") != text:
                figures["wrong"].append(f"{name} is not what the files say: ./dev house --draw writes it")
        if options.json:
            write(Path(options.json), json.dumps(figures, indent=1) + "\n")
    except OSError as error:
        print(f"lobelight: house: {error.filename} cannot be written: {error.strerror}.", file=sys.stderr)
        return 1
    if not options.quiet:
        show(figures)
    for sentence in figures["wrong"]:
        print(sentence, file=sys.stderr)
    return 1 if figures["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
