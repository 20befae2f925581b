#!/usr/bin/env python3
"""Reads which files an exported pack holds (.pck, or .zip and .apk) and checks what has to be among them.

pack_files.py PACK [--present PATTERN]… [--absent PATTERN]… [--list] [--sizes FILE]

Of this addon, run time and tables have to be there, and nothing that the editor alone needs.
"""

import argparse
import fnmatch
import json
import os
import pathlib
import struct
import sys
import zipfile

ADDON = "addons/lobelight"
RUN_TIME = [
    f"{ADDON}/runtime/material/lobe_material_3d.gd",
    f"{ADDON}/runtime/light/lobe_environment_3d.gd",
    f"{ADDON}/runtime/table/lobe_table_set.gd",
    f"{ADDON}/runtime/shaders/material.gdshaderinc",
    f"{ADDON}/runtime/shaders/pyramid_round.gdshader",
    f"{ADDON}/tables/ggx_8.res",
    "project.binary",
]
EDITOR_ONLY = [
    "*.gdextension",
    ".godot/extension_list.cfg",
    f"{ADDON}/bin/*",
    f"{ADDON}/editor/*",
    f"{ADDON}/doc_classes/*",
    f"{ADDON}/plugin.cfg",
    "*_test.gd*",
    "*/gdUnit4/*",
]
MAGIC = 0x43504447
RELATIVE_BASE = 2
# Image.Format of RF to RGBAF, which OpenGL ES need not filter; of a .ctex, it is the last of the header's numbers.
UNFILTERED_FORMATS = range(8, 12)
CTEX_HEADER = 52


class PackError(Exception):
    """Says in one sentence what is wrong with a pack."""


def read_files(path):
    """Of every file in a pack its path, without res://, its bytes as the game reads them, and how it begins."""
    path = pathlib.Path(path)
    if not zipfile.is_zipfile(path):
        return sorted(read_pck(path.read_bytes(), path))
    files = []
    with zipfile.ZipFile(path) as archive:
        for entry in archive.infolist():
            with archive.open(entry) as file:
                files.append((entry.filename.removeprefix("assets/"), entry.file_size, file.read(CTEX_HEADER)))
    return sorted(files)


def read_pck(data, path):
    """As read_files, of the bytes of a .pck of format 2 to 4."""
    magic, version = struct.unpack_from("<2I", data)
    if magic != MAGIC or version not in (2, 3, 4):
        raise PackError(f"{path}: is not a pack of format 2 to 4")
    flags, base = struct.unpack_from("<IQ", data, 20)
    offset = 32
    if version >= 3:
        offset = struct.unpack_from("<Q", data, 32)[0]
    else:
        offset += 64
    if flags & ~RELATIVE_BASE:
        raise PackError(f"{path}: is encrypted or sparse")
    count = struct.unpack_from("<I", data, offset)[0]
    offset += 4
    files = []
    for _ in range(count):
        length = struct.unpack_from("<I", data, offset)[0]
        name = data[offset + 4 : offset + 4 + length].rstrip(b"\0").decode()
        offset += 4 + length
        start, size = struct.unpack_from("<2Q", data, offset)
        start += base if flags & RELATIVE_BASE else 0
        files.append((name.removeprefix("res://"), size, data[start : start + min(size, CTEX_HEADER)]))
        offset += 8 + 8 + 16 + 4
    return files


def write_sizes(file, files):
    """How many bytes of the pack are the addon's, by its folders, and how many are others'."""
    sizes = {"addon": 0, "runtime": 0, "tables": 0, "others": 0}
    for name, size, _start in files:
        folder = name.removeprefix(f"{ADDON}/").split("/")[0] if name.startswith(f"{ADDON}/") else ""
        sizes["addon" if folder else "others"] += size
        if folder in ("runtime", "tables"):
            sizes[folder] += size
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    part.write_text(json.dumps(sizes) + "\n", encoding="utf-8")
    os.replace(part, file)


def has(names, pattern):
    """Whether a file is there under its name or, compiled or converted, under one that the engine gave it."""
    return any(fnmatch.fnmatchcase(name, pattern + ending) for name in names for ending in ("", "c", ".remap", ".import"))


def unfiltered_textures(files):
    """Sentences about textures in formats that phones need not filter."""
    return [
        f"{name} has 32 bits a channel, which phones need not filter"
        for name, _size, start in files
        if name.endswith(".ctex") and struct.unpack_from("<I", start, CTEX_HEADER - 4)[0] in UNFILTERED_FORMATS
    ]


def check(names, present, absent):
    """Sentences about what is missing and what is too much."""
    problems = [f"{pattern} is missing" for pattern in present if not has(names, pattern)]
    for pattern in absent:
        problems += [f"{name} does not belong in it" for name in names if fnmatch.fnmatchcase(name, pattern)]
    doubled = sorted({name for name in names if names.count(name) > 1})
    return problems + [f"{name} is there twice" for name in doubled]


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("pack")
    parser.add_argument("--present", action="append", default=[])
    parser.add_argument("--absent", action="append", default=[])
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--sizes", type=pathlib.Path)
    options = parser.parse_args()
    try:
        files = read_files(options.pack)
        if options.sizes:
            write_sizes(options.sizes, files)
    except (PackError, OSError, struct.error, zipfile.BadZipFile) as error:
        print(f"pack_files: {error}", file=sys.stderr)
        return 1
    names = [name for name, _size, _start in files]
    if options.list:
        print("\n".join(names))
    problems = check(names, RUN_TIME + options.present, EDITOR_ONLY + options.absent) + unfiltered_textures(files)
    for problem in problems:
        print(f"{options.pack}: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
