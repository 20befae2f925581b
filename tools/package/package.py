#!/usr/bin/env python3
"""Packs addons/lobelight into the zip that a user unpacks into a project.

What belongs into it is listed in PATTERNS; a file that no pattern names stays out, so that nothing gets in unseen.
"""

import argparse
import hashlib
import json
import os
import pathlib
import platform
import re
import sys
import zipfile

import licences

ROOT = pathlib.Path(__file__).resolve().parents[2]
ADDON = pathlib.PurePosixPath("addons/lobelight")
EXTENSION = "lobelight.gdextension"
# A line of it that names a library: the features that it is for, the path below the addon.
LIBRARY_LINE = re.compile(rf'^([\w.]+) = "res://{ADDON}/(bin/[^"]+)"$', re.MULTILINE)
LICENCES = "bin/LICENCES.txt"
PATTERNS = [
    "plugin.cfg",
    "LICENSE",
    "README.md",
    "lobelight.gdshaderinc",
    "lobelight.gdshaderinc.uid",
    "icons/*.svg",
    "icons/*.svg.import",
    "tables/*.res",
    "runtime/**/*.gd",
    "runtime/**/*.gd.uid",
    "runtime/**/*.gdshader",
    "runtime/**/*.gdshader.uid",
    "runtime/**/*.gdshaderinc",
    "runtime/**/*.gdshaderinc.uid",
    "editor/**/*.gd",
    "editor/**/*.gd.uid",
    "editor/**/*.gdshader",
    "editor/**/*.gdshader.uid",
    "editor/**/*.json",
    "editor/**/*.svg",
    "editor/**/*.svg.import",
    "editor/**/*.tscn",
]
# Nothing of the machine's clock may get into the package; a zip's calendar begins here.
TIMESTAMP = (1980, 1, 1, 0, 0, 0)


class PackageError(Exception):
    """Says in one sentence why there is no package."""


def read_arguments(arguments):
    parser = argparse.ArgumentParser(prog="package", add_help=False, allow_abbrev=False)
    parser.add_argument("--check", action="store_true", help="only look at the options")
    parser.add_argument("--out", default="")
    parser.add_argument("--json", default="")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--targets", action="store_true", help="print what libraries are packed for")
    parser.add_argument("--no-library", action="store_true")
    parser.add_argument("--libraries", type=pathlib.Path, default=pathlib.Path(), help="folder with one for each target")
    parser.add_argument("--zig", type=pathlib.Path, default=pathlib.Path(), help="folder of the compiler that built these")
    parser.add_argument("--interface", type=pathlib.Path, default=pathlib.Path(), help="the engine's C interface")
    parser.add_argument("--downloads", type=pathlib.Path, default=pathlib.Path())
    parser.error = fail_with
    options = parser.parse_args(arguments)
    if options.all and options.no_library:
        raise PackageError("--all packs every library, --no-library none: give one of them")
    here = pathlib.Path(os.environ.get("LOBELIGHT_CWD", "."))
    options.out = here / options.out if options.out else ROOT / "build/lobelight.zip"
    if options.out.suffix != ".zip":
        raise PackageError(f"{options.out}: a package ends in .zip")
    if options.out.is_dir():
        raise PackageError(f"{options.out} is a folder")
    paths = [options.out]
    if options.json:
        options.json = here / options.json
        paths.append(options.json)
    for path in paths:
        if not path.parent.is_dir() and path.parent != ROOT / "build":
            raise PackageError(f"{path}: its folder does not exist")
    return options


def fail_with(message):
    raise PackageError(message)


def addon_files():
    """Paths below the addon, of the files that every package has; raises PackageError if a pattern's kind is missing
    altogether."""
    folder = ROOT / ADDON
    files = {path.relative_to(folder).as_posix() for pattern in PATTERNS for path in folder.glob(pattern)}
    for needed in ["plugin.cfg", "LICENSE", "runtime/material/lobe_material_3d.gd", "editor/plugin.gd", "tables/ggx_8.res"]:
        if needed not in files:
            raise PackageError(f"{ADDON / needed} is missing")
    return files


def targets():
    """The system and processor of each library that .gdextension names, "linux.arm64", by its path below the addon."""
    lines = LIBRARY_LINE.findall((ROOT / ADDON / EXTENSION).read_text(encoding="utf-8"))
    return {name: ".".join([*features.split(".")[:1], *features.split(".")[-1:]]) for features, name in lines}


def target_of_this_machine():
    processor = platform.machine().lower()
    processor = {"aarch64": "arm64", "amd64": "x86_64"}.get(processor, processor)
    return f"{platform.system().lower()}.{processor}"


def packed_targets(everything):
    """Those of targets() that a package has libraries for: all, or that of this machine."""
    here = target_of_this_machine()
    return {name: target for name, target in targets().items() if everything or target == here}


def built_libraries(folder, wanted):
    """Bytes by path below the addon, of the libraries in `wanted`, a part of targets(). `folder` holds a folder for each
    target."""
    libraries = {}
    for name, target in wanted.items():
        file = folder / target / pathlib.PurePosixPath(name).name
        if not file.is_file():
            raise PackageError(f"{file} is missing")
        libraries[name] = file.read_bytes()
    return libraries


def extension_text(libraries):
    """The .gdextension, bytes, that names no library which is not in the package."""
    lines = []
    for line in (ROOT / ADDON / EXTENSION).read_text(encoding="utf-8").splitlines():
        name = LIBRARY_LINE.match(line)
        if name is None or name.group(2) in libraries:
            lines.append(line)
    return ("\n".join(lines) + "\n").encode()


def contents(options):
    """Bytes by path below the addon."""
    folder = ROOT / ADDON
    files = {name: (folder / name).read_bytes() for name in addon_files()}
    libraries = {}
    if not options.no_library:
        libraries = built_libraries(options.libraries, packed_targets(options.all))
    if libraries:
        files |= libraries
        files[EXTENSION] = extension_text(libraries)
        files[f"{EXTENSION}.uid"] = (folder / f"{EXTENSION}.uid").read_bytes()
        files[LICENCES] = licences.collect(options.downloads, ROOT, options.zig, options.interface).encode()
    return files, list(libraries)


def write_zip(out, files):
    """Writes the package beside `out` and then moves it there, so that `out` is whole or as it was."""
    part = out.with_name(f"{out.name}.{os.getpid()}.part")
    try:
        with zipfile.ZipFile(part, "w") as package:
            for name in sorted(files):
                entry = zipfile.ZipInfo(str(ADDON / name), TIMESTAMP)
                entry.compress_type = zipfile.ZIP_DEFLATED
                entry.create_system = 3  # Unix, whatever this runs on
                entry.external_attr = (0o100755 if name.endswith((".so", ".dylib")) else 0o100644) << 16
                package.writestr(entry, files[name], compresslevel=9)
        os.replace(part, out)
    finally:
        part.unlink(missing_ok=True)


def main():
    try:
        options = read_arguments(sys.argv[1:])
        if options.targets:
            print(*packed_targets(options.all).values(), sep="\n")
            return 0
        if options.check:
            return 0
        files, libraries = contents(options)
        options.out.parent.mkdir(exist_ok=True)
        write_zip(options.out, files)
        digest = hashlib.sha256(options.out.read_bytes()).hexdigest()
        if options.json:
            listing = [{"path": str(ADDON / name), "bytes": len(files[name])} for name in sorted(files)]
            report = {"package": str(options.out), "bytes": options.out.stat().st_size, "sha256": digest}
            report |= {"libraries": libraries, "files": listing}
            part = options.json.with_name(f"{options.json.name}.{os.getpid()}.part")
            part.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
            os.replace(part, options.json)
    except (PackageError, licences.LicenceError, OSError) as error:
        print(f"package: {error}", file=sys.stderr)
        return 1
    size = options.out.stat().st_size / 1e6
    what = "no native library"
    if libraries:
        what = ", ".join(f"{name} ({len(files[name]) / 1e6:.1f} MB)" for name in libraries)
    print(f"{options.out}: {len(files)} files, {size:.1f} MB, {what}, SHA-256 {digest}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
