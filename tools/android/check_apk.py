#!/usr/bin/env python3
"""Checks a signed APK: signature, manifest, processor, alignment and 16 KB pages.

check_apk.py APK --sdk FOLDER --package NAME. Prints one line a check; ends with 1 if one fails.
"""

import argparse
import pathlib
import re
import struct
import subprocess
import sys
import zipfile

PAGE = 16384
WORD = 4
LOAD_SEGMENT = 1
# Godot 4.6: Android 7 at least, and what the Play store asks for in 2026.
LEAST_SDK, TARGET_SDK = 24, 36
ABI = "arm64-v8a"
# Android's screenOrientation "fullUser": all four, as the user allows.
FULL_USER = 13


def output_of(*command):
    finished = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return finished.returncode, finished.stdout.decode(errors="replace")


def check_signature(options):
    """Verified by apksigner, with the schemes of Android 7 and 9."""
    status, text = output_of(options.sdk / "build-tools/debian/apksigner", "verify", "--verbose", options.apk)
    schemes = re.findall(r"Verified using (v[234]) scheme.*: true", text)
    return status == 0 and bool(schemes), ", ".join(schemes) or text.strip()[:200]


def check_manifest(options):
    """Name, SDK levels, OpenGL ES 3, no permission, an entry for the launcher, and a picture that turns with the phone."""
    aapt2 = options.sdk / "build-tools/debian/aapt2"
    status, text = output_of(aapt2, "dump", "badging", options.apk)
    wanted = {"package": options.package, "sdkVersion": f"{LEAST_SDK}", "targetSdkVersion": f"{TARGET_SDK}"}
    wanted |= {"native-code": ABI, "uses-gl-es": "0x30000"}
    found = {key: re.search(rf"^\s*{key}:(?: name=)? ?'([^']+)'", text, re.MULTILINE) for key in wanted}
    found = {key: match.group(1) if match else None for key, match in found.items()}
    asked = re.findall(r"uses-permission: name='([^']+)'", text)
    # The launcher's entry is an alias, which badging does not show.
    _status, tree = output_of(aapt2, "dump", "xmltree", options.apk, "--file", "AndroidManifest.xml")
    alias = tree.partition("E: activity-alias")[2].partition("E: activity ")[0]
    starts = all(word in alias for word in ("intent.action.MAIN", "intent.category.LAUNCHER", "com.godot.game.GodotApp"))
    orientation = re.search(r"screenOrientation\(0x0101001e\)=(\d+)", tree)
    turns = orientation is not None and int(orientation[1]) == FULL_USER
    what = ", ".join(f"{key} {value}" for key, value in found.items())
    what += f", launcher {'yes' if starts else 'no'}, permissions {', '.join(asked) or 'none'}"
    what += f", {'turns' if turns else 'does not turn'} with the phone"
    return status == 0 and found == wanted and starts and turns and not asked, what


def check_abi(options, archive):
    """Native libraries for arm64, and for nothing else."""
    abis = {name.split("/")[1] for name in archive.namelist() if name.startswith("lib/") and name.endswith(".so")}
    return abis == {ABI}, ", ".join(sorted(abis))


def data_offset(archive, entry):
    """Where an entry's bytes begin in the file; the local header has lengths of its own."""
    archive.fp.seek(entry.header_offset)
    header = archive.fp.read(30)
    name, extra = struct.unpack_from("<2H", header, 26)
    return entry.header_offset + 30 + name + extra


def check_alignment(options, archive):
    """What is stored as it is lies at multiples of four bytes, libraries at multiples of a page: it is mapped."""
    stored = [entry for entry in archive.infolist() if entry.compress_type == zipfile.ZIP_STORED and entry.file_size]
    wrong = [
        entry.filename
        for entry in stored
        if data_offset(archive, entry) % (PAGE if entry.filename.endswith(".so") else WORD)
    ]
    return bool(stored) and not wrong, f"{len(stored)} files stored as they are, not aligned: {wrong[:3] or 'none'}"


def check_pages(options, archive):
    """Segments of the libraries can be loaded where pages have 16 KB."""
    libraries = [name for name in archive.namelist() if name.endswith(".so")]
    alignments = {name.split("/")[-1]: least_alignment(archive.read(name)) for name in libraries}
    right = bool(alignments) and all(least % PAGE == 0 for least in alignments.values())
    return right, ", ".join(f"{name} {least}" for name, least in alignments.items())


def least_alignment(library):
    """The smallest alignment of a 64-bit ELF file's loaded segments, in bytes."""
    if library[:5] != b"\x7fELF\x02":
        return 0
    (headers,) = struct.unpack_from("<Q", library, 32)
    size, count = struct.unpack_from("<2H", library, 54)
    segments = [headers + size * number for number in range(count)]
    loaded = [at for at in segments if struct.unpack_from("<I", library, at)[0] == LOAD_SEGMENT]
    return min((struct.unpack_from("<Q", library, at + 48)[0] for at in loaded), default=0)


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("apk", type=pathlib.Path)
    parser.add_argument("--sdk", type=pathlib.Path, required=True)
    parser.add_argument("--package", required=True)
    options = parser.parse_args()
    try:
        with zipfile.ZipFile(options.apk) as archive:
            outcomes = {
                "signature": check_signature(options),
                "manifest": check_manifest(options),
                "processor": check_abi(options, archive),
                "alignment": check_alignment(options, archive),
                "pages of 16 KB": check_pages(options, archive),
            }
    except (OSError, zipfile.BadZipFile) as error:
        sys.exit(f"check_apk: {options.apk}: {error}")
    for name, (passed, what) in outcomes.items():
        print(f"  {name}: {'passed' if passed else 'FAILED'}, {what}")
    return 0 if all(passed for passed, _what in outcomes.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
