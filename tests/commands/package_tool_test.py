"""Which libraries ./dev package --all builds and packs, without building them."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/package"))

import licences  # noqa: E402
import package  # noqa: E402


class LibrariesTest(unittest.TestCase):
    def test_every_library_has_the_name_that_cmake_gives_it(self):
        names = (ROOT / "gdextension/cmake/LibraryName.cmake").read_text(encoding="utf-8")
        for name, target in package.targets().items():
            system, processor = target.split(".")
            self.assertIn(f".{system}.", name)
            generic = name.removeprefix("bin/").replace(processor, "${_architecture}")
            self.assertIn(f'"{generic}"', names)

    def test_every_target_is_known_to_the_toolchain(self):
        toolchain = (ROOT / "gdextension/cmake/Zig.cmake").read_text(encoding="utf-8")
        known = re.findall(r'LOBELIGHT_TARGET STREQUAL "([^"]+)"', toolchain)
        self.assertEqual(sorted(known), sorted(package.targets().values()))
        self.assertIn("windows.x86_64", known)

    def test_a_package_names_only_the_libraries_that_it_has(self):
        names = list(package.targets())
        self.assertGreater(len(names), 1)
        for kept in names:
            text = package.extension_text([kept]).decode()
            self.assertEqual([kept], re.findall(r'"res://addons/lobelight/(bin/[^"]+)"', text))
            self.assertIn("entry_symbol", text)

    def test_a_package_is_for_this_machine_or_for_all(self):
        self.assertEqual([package.target_of_this_machine()], list(package.packed_targets(False).values()))
        self.assertEqual(package.targets(), package.packed_targets(True))
        self.assertGreater(len(package.targets()), 1)

    def test_a_missing_library_is_named(self):
        with self.assertRaisesRegex(package.PackageError, r"liblobelight\S+ is missing$"):
            package.built_libraries(pathlib.Path("/absent"), package.targets())

    def test_a_missing_licence_is_named(self):
        with self.assertRaisesRegex(licences.LicenceError, "^the licence of libc"):
            licences.read_licence(pathlib.Path("/absent/LICENSE.TXT"), "libc++")


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"libraries: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
