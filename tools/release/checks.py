"""What has to be true of a release. Each check returns the sentences that say what is not, none if all is well."""

import pathlib
import re
import struct
import subprocess
import sys
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "package"))

import changelog  # noqa: E402
import licences  # noqa: E402
import listing  # noqa: E402
import package  # noqa: E402

ADDON = "addons/lobelight/"
VERSION = re.compile(r"\d+\.\d+\.\d+")
# Beside plugin.cfg: where a version stands, and what stands before it.
MENTIONS = {
    "export_presets.cfg": [r'version/name="'],
    "README.md": [r"\bLobelight ", r"\blobelight-"],
    "docs/**/*.md": [r"\bLobelight ", r"\blobelight-"],
    "addons/lobelight/README.md": [r"\bLobelight ", r"\blobelight-"],
}
# In these other versions are mentioned on purpose.
ABOUT_OTHERS = ["docs/upgrade.md"]
MOST_BYTES = 4_000_000
JUNK = re.compile(
    r"(^|/)(\.|__pycache__|Thumbs\.db|desktop\.ini)|\.(tmp|bak|orig|rej|swp|part|log|blend1|pyc|o|a|lib|exp|pdb)$|~$|/project\.godot$"
)
# What a package is no package without.
NEEDED = ["plugin.cfg", "LICENSE", "README.md", "lobelight.gdshaderinc", "editor/plugin.gd", "tables/ggx_8.res"]
NEEDED_WITH_LIBRARY = ["lobelight.gdextension", package.LICENCES]
# Shorter than any licence.
LEAST_LICENCE = 500


def version_of(root):
    text = (root / ADDON / "plugin.cfg").read_text(encoding="utf-8")
    found = re.search(r'^version="([^"]*)"', text, re.MULTILINE)
    return found[1] if found else ""


def versions(root):
    """Whoever names Lobelight's version names that of plugin.cfg."""
    version = version_of(root)
    if not VERSION.fullmatch(version):
        return [f'{ADDON}plugin.cfg: the version is "{version}", not one like 0.1.0']
    problems = []
    for pattern, before in MENTIONS.items():
        for file in sorted(root.glob(pattern)):
            name = file.relative_to(root).as_posix()
            if name in ABOUT_OTHERS:
                continue
            text = file.read_text(encoding="utf-8")
            for mention in re.finditer(f"(?:{'|'.join(before)})({VERSION.pattern})", text):
                if mention[1] != version:
                    problems.append(f"{name}: says {mention[0]}, but plugin.cfg has version {version}")
    return problems


def changes(root):
    """CHANGELOG.md has the version's section, with a date."""
    try:
        changelog.section((root / "CHANGELOG.md").read_text(encoding="utf-8"), version_of(root))
    except changelog.ChangelogError as error:
        return [str(error)]
    return []


def licence(root):
    """The addon has the repository's licence, which names a year and a holder."""
    text = (root / "LICENSE").read_text(encoding="utf-8")
    if not re.search(r"^Copyright \(c\) \d{4}", text, re.MULTILINE):
        return ["LICENSE: names no year and no holder of the copyright"]
    if (root / ADDON / "LICENSE").read_text(encoding="utf-8") != text:
        return [f"{ADDON}LICENSE: is not the LICENSE of the repository"]
    return []


def files(root):
    """No file of the repository is too large for it, and none is left over from an editor."""
    problems = []
    for name in git(root, "ls-files", "-z").split("\0"):
        file = root / name
        if name and file.is_file() and file.stat().st_size > MOST_BYTES:
            problems.append(f"{name}: has {file.stat().st_size} bytes, more than {MOST_BYTES}")
        if name.startswith(ADDON) and JUNK.search(name.removeprefix(ADDON)):
            problems.append(f"{name}: does not belong into an addon")
    return problems


def store(root):
    """What the Asset Store shows is there."""
    return listing.problems(root)


def changed_files(root):
    """Files that differ from the commit."""
    return [line[3:] for line in git(root, "status", "--porcelain").splitlines()]


def git(root, *arguments):
    return subprocess.run(["git", "-C", root, *arguments], check=True, capture_output=True, text=True).stdout


def packed(file, version, targets):
    """A package: `targets` are the libraries that it is to have, by their paths below the addon."""
    with zipfile.ZipFile(file) as archive:
        contents = {entry.filename: archive.read(entry) for entry in archive.infolist()}
    problems = [f"{file.name}: holds {name}, outside of {ADDON}" for name in contents if not name.startswith(ADDON)]
    inside = {name.removeprefix(ADDON): data for name, data in contents.items() if name.startswith(ADDON)}
    problems += [f"{file.name}: holds {name}, which is no part of the addon" for name in inside if JUNK.search(name)]
    needed = NEEDED + (NEEDED_WITH_LIBRARY if targets else []) + list(targets)
    problems += [f"{file.name}: {ADDON}{name} is missing" for name in needed if name not in inside]
    if problems:
        return problems
    if f'version="{version}"'.encode() not in inside["plugin.cfg"]:
        problems.append(f"{file.name}: its plugin.cfg does not have version {version}")
    problems += [
        f"{file.name}: {name} has {len(data)} bytes, more than {MOST_BYTES}"
        for name, data in inside.items()
        if len(data) > MOST_BYTES and name not in targets
    ]
    for name, target in targets.items():
        if not is_library(inside[name], target):
            problems.append(f"{file.name}: {name} is no library for {target}")
    if targets:
        problems += missing_licences(inside[package.LICENCES].decode(), file.name)
    return problems


def missing_licences(text, file):
    """Of all that is linked into the libraries."""
    names = ["Lobelight", "GLM", "Godot Engine, its extension interface"]
    names += [source[0] for source in [*licences.SOURCES, *licences.FROM_ZIG]]
    # Licences have such rules of their own: only the headings that are looked for count.
    headings = {name: f"{licences.RULE}\n{name}\n{licences.RULE}\n" for name in names}
    starts = sorted(text.find(heading) for heading in headings.values())
    lacking = []
    for name, heading in headings.items():
        start = text.find(heading)
        end = next((other for other in starts if other > start), len(text))
        if start < 0 or len(text[start + len(heading) : end].strip()) < LEAST_LICENCE:
            lacking.append(f"{file}: {package.LICENCES} lacks the licence of {name}")
    return lacking


def is_library(data, target):
    """Whether bytes begin as a library for a system and processor, "linux.x86_64", does."""
    system, processor = target.split(".")
    if system == "linux":
        machine = {"x86_64": 62, "arm64": 183}[processor]
        return data[:4] == b"\x7fELF" and struct.unpack_from("<H", data, 18)[0] == machine
    if system == "windows":
        machine = {"x86_64": 0x8664, "arm64": 0xAA64}[processor]
        at = struct.unpack_from("<I", data, 60)[0]
        return data[:2] == b"MZ" and data[at : at + 4] == b"PE\0\0" and struct.unpack_from("<H", data, at + 4)[0] == machine
    kind = {"x86_64": 0x01000007, "arm64": 0x0100000C}[processor]
    return data[:4] == b"\xcf\xfa\xed\xfe" and struct.unpack_from("<I", data, 4)[0] == kind
