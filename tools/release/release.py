#!/usr/bin/env python3
"""Looks whether a version is ready to be released, and makes the files of the release; see ./dev release --help.

--check       what needs no package: versions, CHANGELOG.md, licences, files, listing
--look        the same, before the package is made: nothing is printed if all is well
--pack FILE   of a package that has been made: looks at it, and writes the release's files
"""

import argparse
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile

import changelog
import checks
import listing

package = checks.package
ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKS = [
    ("versions", checks.versions),
    ("changelog", checks.changes),
    ("licence", checks.licence),
    ("files", checks.files),
    ("listing", checks.store),
]


class ReleaseError(Exception):
    """Says in a sentence, or in several, one a line, why there is no release."""


def read_arguments(arguments):
    parser = argparse.ArgumentParser(prog="release", add_help=False, allow_abbrev=False)
    parser.add_argument("--out", default="")
    parser.add_argument("--json", default="")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--no-library", action="store_true")
    # What release.sh asks for.
    parser.add_argument("--options", action="store_true", help="only look at the options")
    parser.add_argument("--look", action="store_true")
    parser.add_argument("--pack", type=pathlib.Path)
    parser.add_argument("--done", default="", help="checks that release.sh has made")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    parser.error = fail_with
    options = parser.parse_args(arguments)
    if options.check and options.out:
        raise ReleaseError("--check writes no release: --out does not go with it")
    here = pathlib.Path(os.environ.get("LOBELIGHT_CWD", "."))
    options.out = here / options.out if options.out else ROOT / ("build/release-try" if options.no_library else "build/release")
    if options.out.exists() and not options.out.is_dir():
        raise ReleaseError(f"{options.out}: is not a folder")
    parents = [] if options.check or options.out.parent == ROOT / "build" else [options.out]
    if options.json:
        options.json = here / options.json
        parents.append(options.json)
    for path in parents:
        if not path.parent.is_dir():
            raise ReleaseError(f"{path}: its folder does not exist")
    return options


def fail_with(message):
    raise ReleaseError(message)


def look(root):
    """Makes CHECKS and returns their names; raises ReleaseError with all that is wrong."""
    problems = [problem for _, check in CHECKS for problem in check(root)]
    if problems:
        raise ReleaseError("\n".join(problems))
    return [name for name, _ in CHECKS]


def pack(options, report):
    """Writes the release's files, all of them or none, and returns their names."""
    version = checks.version_of(options.root)
    targets = {} if options.no_library else package.packed_targets(True)
    problems = checks.packed(options.pack, version, targets)
    _, body = changelog.section((options.root / "CHANGELOG.md").read_text(encoding="utf-8"), version)
    notes = changelog.notes(body)
    top = f"lobelight-{version}"
    with zipfile.ZipFile(options.pack) as archive:
        addon = {entry.filename: archive.read(entry) for entry in archive.infolist()}
    store = {f"{top}/{name}": data for name, data in addon.items()}
    if sorted(listing.installed(store)) != sorted(addon):
        problems.append(f"{top}-store.zip: is not installed as the package is")
    if problems:
        raise ReleaseError("\n".join(problems))
    report["checks"] += ["package", "store"]
    options.out.parent.mkdir(exist_ok=True)
    work = pathlib.Path(tempfile.mkdtemp(prefix=f"{options.out.name}.", dir=options.out.parent))
    try:
        work.chmod(0o755)
        write_zip(work / f"{top}.zip", addon)
        write_zip(work / f"{top}-store.zip", store)
        write_zip(work / f"{top}-listing.zip", listing.contents(options.root, version, f"{top}-store.zip", notes))
        (work / f"{top}-notes.md").write_text(notes, encoding="utf-8")
        files = sorted(work.iterdir())
        for file in files:
            digest = hashlib.sha256(file.read_bytes()).hexdigest()
            report["files"].append({"file": file.name, "bytes": file.stat().st_size, "sha256": digest})
        sums = "".join(f"{entry['sha256']}  {entry['file']}\n" for entry in report["files"])
        (work / "SHA256SUMS").write_text(sums, encoding="utf-8")
        options.out.mkdir(exist_ok=True)
        for file in [*files, work / "SHA256SUMS"]:
            os.replace(file, options.out / file.name)
    finally:
        shutil.rmtree(work)


def write_zip(file, contents):
    """As package.py's: nothing of the machine's clock gets in."""
    with zipfile.ZipFile(file, "w") as archive:
        for name in sorted(contents):
            entry = zipfile.ZipInfo(name, package.TIMESTAMP)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = (0o100755 if name.endswith((".so", ".dylib")) else 0o100644) << 16
            archive.writestr(entry, contents[name], compresslevel=9)


def save_json(value, path):
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    part.write_text(json.dumps(value, indent=2) + "\n", encoding="utf-8")
    os.replace(part, path)


def main(arguments):
    try:
        options = read_arguments(arguments)
        if options.options:
            return 0
        done = look(options.root)
        if options.look:
            return 0
        report = {
            "version": checks.version_of(options.root),
            "commit": checks.git(options.root, "rev-parse", "HEAD").strip(),
            "changed": checks.changed_files(options.root),
            "checks": done + options.done.split(),
            "files": [],
        }
        if options.pack:
            pack(options, report)
        if options.json:
            save_json(report, options.json)
    except subprocess.CalledProcessError as error:
        print(f"release: git cannot say what belongs to the release ({error.stderr.strip()})", file=sys.stderr)
        return 1
    except (ReleaseError, package.PackageError, OSError) as error:
        for line in str(error).splitlines():
            print(f"release: {line}", file=sys.stderr)
        return 1
    for entry in report["files"]:
        print(f"{options.out / entry['file']}: {entry['bytes']} bytes, SHA-256 {entry['sha256']}")
    if report["changed"]:
        print(f"The working tree differs from the commit in {len(report['changed'])} files, {report['changed'][0]} first.")
    print(f"Lobelight {report['version']}, commit {report['commit'][:12]}: {', '.join(report['checks'])} as they should be")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
