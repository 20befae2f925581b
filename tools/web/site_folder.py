#!/usr/bin/env python3
"""Puts together the folder that any host serves: the page, the engine's Web template and a pack.

site_folder.py --page FOLDER --template FOLDER --pack FILE --pictures FILE… --licences FILE… --report FILE --out FOLDER
    [--json FILE]

Each file is replaced whole. Prints what the folder weighs, and of the pack the largest files with the reasons for them.
Ends with 1 where the pack is larger than a page should load.
"""

import argparse
import json
import os
import pathlib
import sys
import zlib

import contents

# Beside the engine, which is the same for all games.
MOST_PACK_BYTES = 5_000_000
TEMPLATE_FILES = ["index.js", "index.wasm", "index.audio.worklet.js", "index.audio.position.worklet.js"]
PLACE_OF_SIZES = "{{FILES}}"
LARGEST = 12


def replace(file, data):
    """Writes a file beside its place first: who reads it meanwhile gets the old one or the new one."""
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    part.write_bytes(data)
    os.replace(part, file)


def collect(options):
    """The folder's files by name."""
    files = {name: (options.template / name).read_bytes() for name in TEMPLATE_FILES}
    files["index.pck"] = options.pack.read_bytes()
    for file in sorted(options.page.iterdir()):
        files[file.name] = file.read_bytes()
    for file in options.pictures:
        files[file.name] = file.read_bytes()
    files["licences.txt"] = b"\n".join(file.read_bytes() for file in options.licences)
    # What hosts send compressed has no length of its own to go by.
    sizes = json.dumps({name: len(files[name]) for name in ("index.wasm", "index.pck")})
    files["index.html"] = files["index.html"].replace(PLACE_OF_SIZES.encode(), sizes.encode())
    return files


def weigh(files):
    """Bytes of the parts, as they are and as hosts send them, compressed by gzip."""
    parts = {"engine": TEMPLATE_FILES, "pack": ["index.pck"]}
    parts["page"] = [name for name in files if name not in TEMPLATE_FILES and name != "index.pck"]
    sizes = {}
    for part in ("page", "engine", "pack"):
        sizes[part] = sum(len(files[name]) for name in parts[part])
        sizes[f"{part}_gzip"] = sum(len(zlib.compress(files[name], 6)) for name in parts[part])
    return sizes


def judge(sizes):
    """What is wrong with the sizes, in a sentence; empty if nothing is."""
    if sizes["pack"] > MOST_PACK_BYTES:
        return f"the pack has {sizes['pack']} bytes, but a page should load {MOST_PACK_BYTES} at most"
    return ""


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    for name in ("page", "template", "pack", "report", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    parser.add_argument("--pictures", type=pathlib.Path, nargs="+", required=True)
    parser.add_argument("--licences", type=pathlib.Path, nargs="+", required=True)
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    try:
        files = collect(options)
        entries = contents.explain(options.pack, options.report)
        for name, data in files.items():
            replace(options.out / name, data)
    except (OSError, contents.PackError) as error:
        sys.exit(f"web: {error}")
    sizes = weigh(files)
    if options.json:
        result = {"out": str(options.out), **sizes, "pack_limit": MOST_PACK_BYTES, "pack_files": entries}
        replace(options.json, (json.dumps(result, indent=1) + "\n").encode())
    print(f"{'':8} {'bytes':>10}  {'by gzip':>10}")
    for part in ("page", "engine", "pack"):
        print(f"{part:8} {sizes[part]:10}  {sizes[f'{part}_gzip']:10}")
    print("\nThe pack's largest files:")
    for entry in entries[:LARGEST]:
        print(f"{entry['bytes']:9}  {entry['path']}: {entry['why']}")
    rest = entries[LARGEST:]
    print(f"{sum(entry['bytes'] for entry in rest):9}  {len(rest)} others")
    if problem := judge(sizes):
        sys.exit(f"web: {problem}")


if __name__ == "__main__":
    main()
