#!/usr/bin/env python3
"""Reads which files an exported pack holds (.pck, or .zip and .apk) and checks what has to be among them.

pack_files.py PACK [--present PATTERN]… [--absent PATTERN]… [--list]

Of this addon, run time and tables have to be there, and nothing that the editor alone needs.
"""

import argparse
import fnmatch
import pathlib
import struct
import sys
import zipfile

ADDON = "addons/lobelight"
RUN_TIME = [
    f"{ADDON}/runtime/lobe_material_3d.gd",
    f"{ADDON}/runtime/lobe_environment_3d.gd",
    f"{ADDON}/runtime/lobe_table_set.gd",
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


class PackError(Exception):
    """Says in one sentence what is wrong with a pack."""


def read_names(path):
    """The paths in a pack, without res:// and without what the engine appends to names of compiled scripts and
    remapped resources."""
    path = pathlib.Path(path)
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            names = [name.removeprefix("assets/") for name in archive.namelist()]
    else:
        names = read_pck(path.read_bytes(), path)
    return sorted(names)


def read_pck(data, path):
    """The paths in a .pck of format 2 to 4."""
    magic, version = struct.unpack_from("<2I", data)
    if magic != MAGIC or version not in (2, 3, 4):
        raise PackError(f"{path}: is not a pack of format 2 to 4")
    flags, _base = struct.unpack_from("<IQ", data, 20)
    offset = 32
    if version >= 3:
        offset = struct.unpack_from("<Q", data, 32)[0]
    else:
        offset += 64
    if flags & ~RELATIVE_BASE:
        raise PackError(f"{path}: is encrypted or sparse")
    count = struct.unpack_from("<I", data, offset)[0]
    offset += 4
    names = []
    for _ in range(count):
        length = struct.unpack_from("<I", data, offset)[0]
        name = data[offset + 4 : offset + 4 + length].rstrip(b"\0").decode()
        names.append(name.removeprefix("res://"))
        offset += 4 + length + 8 + 8 + 16 + 4
    return names


def has(names, pattern):
    """Whether a file is there under its name or, compiled or converted, under one that the engine gave it."""
    return any(fnmatch.fnmatchcase(name, pattern + ending) for name in names for ending in ("", "c", ".remap", ".import"))


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
    options = parser.parse_args()
    try:
        names = read_names(options.pack)
    except (PackError, OSError, struct.error, zipfile.BadZipFile) as error:
        print(f"pack_files: {error}", file=sys.stderr)
        return 1
    if options.list:
        print("\n".join(names))
    problems = check(names, RUN_TIME + options.present, EDITOR_ONLY + options.absent)
    for problem in problems:
        print(f"{options.pack}: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
