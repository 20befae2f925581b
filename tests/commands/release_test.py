"""What ./dev release refuses, and that it writes the same bytes each time; without an engine and without libraries."""

import contextlib
import hashlib
import io
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/release"))

import changelog  # noqa: E402
import checks  # noqa: E402
import listing  # noqa: E402
import release  # noqa: E402

CHANGELOG = """# Changelog

## [Unreleased]

### Fixed

- Something that is not out yet.

## [0.1.0] - 2026-11-30

The first release.

### Added

- One thing, whose [line](docs/line.md)
  goes on.
- Another.

## [0.0.1] - 2026-01-01

- Older.

[Unreleased]: https://example.org
"""
# What is looked at, of the repository.
LOOKED_AT = ["LICENSE", "export_presets.cfg", "addons/lobelight/plugin.cfg", "addons/lobelight/LICENSE"]
LOOKED_AT += ["addons/lobelight/README.md", "addons/lobelight/lobelight.gdextension", "docs/listing", "docs/pictures"]
LOOKED_AT += ["docs/guide/pictures"]


class ReleaseTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = pathlib.Path(tempfile.mkdtemp())
        cls.package = cls.work / "package.zip"
        subprocess.run(
            [sys.executable, ROOT / "tools/package/package.py", "--no-library", "--out", cls.package],
            check=True,
            capture_output=True,
        )

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.work)

    # A repository that is ready.
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(dir=self.work))
        for name in LOOKED_AT:
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            if (ROOT / name).is_dir():
                shutil.copytree(ROOT / name, self.root / name)
            else:
                shutil.copy(ROOT / name, self.root / name)
        self.write("CHANGELOG.md", CHANGELOG.replace("0.1.0", checks.version_of(ROOT)))
        self.write("README.md", f"Lobelight {checks.version_of(ROOT)}, lobelight-{checks.version_of(ROOT)}.zip\n")
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("-c", "user.name=test", "-c", "user.email=test@example.org", "commit", "-qm", "All")

    def git(self, *arguments):
        subprocess.run(["git", "-C", self.root, *arguments], check=True, capture_output=True)

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")

    def replace(self, name, old, new):
        text = (self.root / name).read_text(encoding="utf-8")
        self.assertIn(old, text)
        self.write(name, text.replace(old, new))

    # Exit status, lines of stdout, lines of stderr.
    def run_tool(self, *arguments):
        out, error = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            status = release.main(["--root", str(self.root), *map(str, arguments)])
        return status, out.getvalue().splitlines(), error.getvalue().splitlines()

    def assert_refused(self, sentence):
        status, out, error = self.run_tool("--check")
        self.assertEqual((1, []), (status, out))
        self.assertEqual([f"release: {sentence}"], error)

    def test_what_is_ready_passes(self):
        status, out, error = self.run_tool("--check")
        self.assertEqual((0, []), (status, error))
        self.assertEqual(1, len(out))
        self.assertIn("versions, changelog, licence, files, listing as they should be", out[0])

    def test_files_that_are_not_committed_are_told(self):
        self.write("README.md", "No version.\n")
        self.write("new.txt", "")
        status, out, _ = self.run_tool("--check")
        self.assertEqual(0, status)
        self.assertRegex(out[0], "differs from the commit in 2 files, README.md first")

    def test_another_version_is_refused(self):
        self.replace("README.md", "lobelight-", "lobelight-9")
        version = checks.version_of(ROOT)
        self.assert_refused(f"README.md: says lobelight-9{version}, but plugin.cfg has version {version}")

    def test_another_version_of_the_demo_is_refused(self):
        self.replace("export_presets.cfg", 'version/name="', 'version/name="7')
        version = checks.version_of(ROOT)
        self.assert_refused(f'export_presets.cfg: says version/name="7{version}, but plugin.cfg has version {version}')

    def test_no_version_is_refused(self):
        self.replace("addons/lobelight/plugin.cfg", f'version="{checks.version_of(ROOT)}"', 'version="next"')
        self.assertEqual(
            ['addons/lobelight/plugin.cfg: the version is "next", not one like 0.1.0'], checks.versions(self.root)
        )

    def test_a_changelog_without_the_version_is_refused(self):
        version = checks.version_of(ROOT)
        self.replace("CHANGELOG.md", f"[{version}] - 2026-11-30", "[7.0.0] - 2026-11-30")
        self.assert_refused(
            f'CHANGELOG.md: there is no section "## [{version}] - DATE" for the version of plugin.cfg'
        )

    def test_a_section_without_a_date_is_refused(self):
        for date in ["", " - soon", " - 2026-13-30"]:
            with self.assertRaisesRegex(changelog.ChangelogError, 'has the date "'):
                changelog.section(CHANGELOG.replace(" - 2026-11-30", date), "0.1.0")

    def test_an_empty_section_is_refused(self):
        with self.assertRaisesRegex(changelog.ChangelogError, r"the section \[1.0.0\] is empty"):
            changelog.section("## [Unreleased]\n\n## [1.0.0] - 2026-11-30\n\n## [0.1.0] - 2026-01-01\n\n- One.\n", "1.0.0")

    def test_another_licence_is_refused(self):
        self.replace("addons/lobelight/LICENSE", "MIT", "Other")
        self.assert_refused("addons/lobelight/LICENSE: is not the LICENSE of the repository")

    def test_large_files_and_what_editors_leave_are_refused(self):
        (self.root / "large.bin").write_bytes(bytes(checks.MOST_BYTES + 1))
        self.write("addons/lobelight/plugin.cfg~", "")
        self.git("add", "-A")
        self.assertEqual(
            [
                "addons/lobelight/plugin.cfg~: does not belong into an addon",
                f"large.bin: has {checks.MOST_BYTES + 1} bytes, more than {checks.MOST_BYTES}",
            ],
            checks.files(self.root),
        )

    def test_a_listing_without_its_picture_is_refused(self):
        picture = listing.read(self.root)["pictures"][0]["file"]
        (self.root / listing.FOLDER / picture).unlink()
        self.assert_refused(f"docs/listing/listing.json: names {picture}, which is missing")

    def test_two_runs_write_equal_bytes(self):
        sums = []
        for number in range(2):
            out = self.root.parent / f"{self.root.name}-{number}"
            status, _, error = self.run_tool("--no-library", "--pack", self.package, "--out", out)
            self.assertEqual((0, []), (status, error))
            sums.append((out / "SHA256SUMS").read_text())
            for line in sums[-1].splitlines():
                digest, name = line.split("  ")
                self.assertEqual(digest, hashlib.sha256((out / name).read_bytes()).hexdigest())
        self.assertEqual(sums[0], sums[1])
        version = checks.version_of(ROOT)
        names = [line.split("  ")[1] for line in sums[0].splitlines()]
        self.assertEqual([f"lobelight-{version}{end}" for end in ["-listing.zip", "-notes.md", "-store.zip", ".zip"]], names)
        self.assertEqual(
            "The first release.\n\n### Added\n\n- One thing, whose line goes on.\n- Another.\n",
            (out / f"lobelight-{version}-notes.md").read_text(),
        )
        # What the editor makes of the store's form is what the package holds.
        installed = {}
        for end in ["-store.zip", ".zip"]:
            with zipfile.ZipFile(out / f"lobelight-{version}{end}") as archive:
                installed[end] = sorted(archive.namelist())
        self.assertEqual(installed[".zip"], listing.installed(installed["-store.zip"]))
        self.assertNotEqual(installed[".zip"], listing.installed(installed[".zip"]))

    def test_a_package_without_its_libraries_is_refused(self):
        status, out, error = self.run_tool("--pack", self.package, "--out", self.root / "out")
        self.assertEqual((1, []), (status, out))
        missing = [line for line in error if re.search(r"/bin/liblobelight\S+ is missing$", line)]
        self.assertEqual(len(checks.package.targets()), len(missing))
        self.assertFalse((self.root / "out").exists())

    def test_what_does_not_belong_into_a_package_is_refused(self):
        version = checks.version_of(ROOT)
        for name, sentence in [
            ("project.godot", "package.zip: holds project.godot, outside of addons/lobelight/"),
            ("addons/lobelight/.godot/x", "package.zip: holds .godot/x, which is no part of the addon"),
        ]:
            odd = self.root / "package.zip"
            shutil.copy(self.package, odd)
            with zipfile.ZipFile(odd, "a") as archive:
                archive.writestr(name, "")
            self.assertEqual([sentence], checks.packed(odd, version, {}))
        self.assertEqual([], checks.packed(self.package, version, {}))
        self.assertEqual(
            ["package.zip: its plugin.cfg does not have version 9.9.9"], checks.packed(self.package, "9.9.9", {})
        )

    def test_a_missing_licence_is_named(self):
        rule = checks.licences.RULE
        long = "x" * checks.LEAST_LICENCE
        # With a heading of its own, as LLVM's has.
        text = f"{rule}\nGLM\n{rule}\n\n{rule}\nIts own heading\n{rule}\n{long}\n{rule}\nOpenEXR\n{rule}\n\n"
        lacking = checks.missing_licences(text, "x.zip")
        self.assertIn("x.zip: bin/LICENCES.txt lacks the licence of Imath", lacking)
        self.assertIn("x.zip: bin/LICENCES.txt lacks the licence of OpenEXR", lacking)
        self.assertFalse([line for line in lacking if line.endswith("GLM")])

    def test_libraries_are_told_apart(self):
        elf = b"\x7fELF" + bytes(14) + struct.pack("<H", 62) + bytes(100)
        self.assertTrue(checks.is_library(elf, "linux.x86_64"))
        for target in ["linux.arm64", "windows.x86_64", "macos.arm64"]:
            self.assertFalse(checks.is_library(elf, target))


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"release: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
