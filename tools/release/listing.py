"""What Godot's Asset Store shows of Lobelight: docs/listing, in the form in which it is handed in."""

import json
import pathlib
import re
import struct

FOLDER = "docs/listing"
KEYS = ["title", "category", "godot", "licence", "tags", "short", "description", "icon", "clip", "pictures"]
# What the store shows beside the title is cut off after this many letters.
LONGEST_SHORT = 160
LEAST_ICON = 128
LARGEST_CLIP = 3_000_000


def read(root):
    return json.loads((root / FOLDER / "listing.json").read_text(encoding="utf-8"))


def problems(root):
    """Sentences that say what keeps the listing from being handed in."""
    name = f"{FOLDER}/listing.json"
    try:
        listing = read(root)
    except (OSError, ValueError) as error:
        return [f"{name}: cannot be read ({error})"]
    found = [f'{name}: there is no "{key}"' for key in KEYS if not listing.get(key)]
    if found:
        return found
    named = [listing["description"], listing["icon"], listing["clip"], *[shown["file"] for shown in listing["pictures"]]]
    found = [f"{name}: names {file}, which is missing" for file in named if not (root / FOLDER / file).is_file()]
    if found:
        return found
    if len(listing["short"]) > LONGEST_SHORT:
        found.append(f'{name}: "short" has {len(listing["short"])} letters, more than {LONGEST_SHORT}')
    if min(picture_size(root / FOLDER / listing["icon"])) < LEAST_ICON:
        found.append(f"{name}: the icon is no PNG of {LEAST_ICON} x {LEAST_ICON} pixels or more")
    if (root / FOLDER / listing["clip"]).stat().st_size > LARGEST_CLIP:
        found.append(f"{name}: the clip has more than {LARGEST_CLIP} bytes")
    extension = (root / "addons/lobelight/lobelight.gdextension").read_text(encoding="utf-8")
    if f'compatibility_minimum = "{listing["godot"]}"' not in extension:
        found.append(f"{name}: Godot {listing['godot']} is not the least version in lobelight.gdextension")
    if not (root / "LICENSE").read_text(encoding="utf-8").startswith(f"{listing['licence']} License"):
        found.append(f"{name}: {listing['licence']} is not the licence in LICENSE")
    return found


def picture_size(file):
    """Width and height of a PNG; (0, 0) of what is none."""
    head = file.read_bytes()[:24]
    return struct.unpack(">II", head[16:24]) if head[:8] == b"\x89PNG\r\n\x1a\n" else (0, 0)


def contents(root, version, archive, notes):
    """Bytes by name of what is handed in beside `archive`, with the release's notes."""
    listing = read(root)
    folder = root / FOLDER
    files = {"description.md": (folder / listing["description"]).read_bytes(), "changelog.md": notes.encode()}
    for kind in ["icon", "clip"]:
        files[listing[kind]] = (folder / listing[kind]).read_bytes()
    shown = []
    for number, picture in enumerate(listing["pictures"], 1):
        name = f"picture_{number}_{pathlib.PurePosixPath(picture['file']).name}"
        files[name] = (folder / picture["file"]).read_bytes()
        shown.append({"file": name, "caption": picture["caption"]})
    listing |= {"version": version, "archive": archive, "pictures": shown}
    listing |= {"description": "description.md", "changelog": "changelog.md"}
    files["listing.json"] = (json.dumps(listing, indent=2, ensure_ascii=False) + "\n").encode()
    return files


def installed(names):
    """Where the editor puts an archive's files: it takes off the only folder at the top, if there is one.
    (EditorAssetInstaller, which is told to for what comes from the store.)"""
    tops = {re.match("[^/]*", name)[0] for name in names}
    return [name.partition("/")[2] for name in names] if len(tops) == 1 else list(names)
