"""The licences of what is linked into the native library, from the sources that it was built from."""

import pathlib
import re
import tarfile

SETUP = "tools/setup/openexr.sh"
# Name, archive in the cache's downloads with the versions that SETUP sets, path in the archive.
SOURCES = [
    ("OpenEXR", "openexr-{OPENEXR_VERSION}.tar.gz", "LICENSE.md"),
    ("libdeflate, in OpenEXR", "openexr-{OPENEXR_VERSION}.tar.gz", "external/deflate/COPYING"),
    ("OpenJPH, in OpenEXR", "openexr-{OPENEXR_VERSION}.tar.gz", "external/OpenJPH/LICENSE"),
    ("Imath", "imath_{IMATH_VERSION}.orig.tar.gz", "LICENSE.md"),
]
# What Zig's compiler links beside it, below its folder.
FROM_ZIG = [
    ("libc++", "lib/libcxx/LICENSE.TXT"),
    ("libc++abi", "lib/libcxxabi/LICENSE.TXT"),
    ("libunwind", "lib/libunwind/LICENSE.TXT"),
    ("mingw-w64, in the libraries for Windows", "lib/libc/mingw/COPYING"),
    ("Zig's own compiler-rt", "LICENSE"),
]
# GLM is a system package, of headers only.
GLM_FILES = ["/usr/share/doc/libglm-dev/copyright", "/usr/local/share/doc/libglm-dev/copyright"]
RULE = "=" * 78


class LicenceError(Exception):
    """Says in one sentence which licence could not be found."""


def collect(downloads, root, zig, interface):
    """One text with every licence. `downloads` is the folder that holds the archives, `root` the repository, `zig` the
    compiler's folder, `interface` the engine's gdextension_interface.h."""
    parts = [("Lobelight", (root / "LICENSE").read_text(encoding="utf-8"))]
    versions = dict(re.findall(r"^(\w+_VERSION)=(\S+)$", (root / SETUP).read_text(encoding="utf-8"), re.MULTILINE))
    parts += [(name, from_archive(downloads / archive.format(**versions), path)) for name, archive, path in SOURCES]
    parts.append(("GLM", first_text(GLM_FILES, "GLM")))
    parts += [(name, read_licence(zig / path, name)) for name, path in FROM_ZIG]
    engine = "Godot Engine, its extension interface"
    parts.append((engine, comment_at_top(read_licence(interface, engine))))
    blocks = [f"{RULE}\n{name}\n{RULE}\n\n{text.strip()}\n" for name, text in parts]
    return "The native library contains, and is under the licences of:\n\n" + "\n".join(blocks)


def from_archive(file, path):
    if not file.is_file():
        raise LicenceError(f"{file}: the source that licences are taken from is missing; {SETUP} fetches it")
    with tarfile.open(file) as archive:
        top = archive.next().name.split("/")[0]
        try:
            return archive.extractfile(f"{top}/{path}").read().decode("utf-8")
        except (KeyError, AttributeError) as error:
            raise LicenceError(f"{file}: there is no {path} in it") from error


def read_licence(file, name):
    if not file.is_file():
        raise LicenceError(f"the licence of {name} is not in {file}")
    return file.read_text(encoding="utf-8")


def first_text(candidates, name):
    for candidate in candidates:
        if pathlib.Path(candidate).is_file():
            return read_licence(pathlib.Path(candidate), name)
    raise LicenceError(f"the licence of {name} is not in {candidates[0]}")


def comment_at_top(text):
    """The lines of comment that a source begins with, without their frame."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("/*"):
            break
        lines.append(line.strip("/* ").rstrip())
    return "\n".join(lines)
