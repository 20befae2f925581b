"""Tests of arrows.py on repositories of a few lines."""

import sys
import tempfile
import unittest
from pathlib import Path

import arrows

# A run time as it may be: path below the addon, text.
SOUND = {
    "runtime/on_demand.gd": "extends Object\n",
    "runtime/table/set.gd": "class_name ASet\nextends Resource\n",
    "runtime/pyramid/pyramid.gd": 'const OnDemand := preload("../on_demand.gd")\n'
    'const S := preload("../shaders/round.gdshader")\nconst _CUBE := "res://addons/lobelight/runtime/skies/sky.gd"\n'
    "func f() -> void:\n\tOnDemand.fetch(_CUBE)\n",
    "runtime/light/light.gd": 'class_name ALight\nconst Pyramid := preload("../pyramid/pyramid.gd")\n',
    "runtime/material/material.gd": "class_name AMaterial\n## Not [AnEditor].\nvar a: ALight # AnEditor\nvar b: ASet\n",
    "runtime/skies/sky.gd": 'extends "../light/light.gd"\nvar text := "AMaterial # "\n',
    "editor/plugin.gd": "class_name AnEditor\nvar a: AMaterial\n",
}


class Arrows(unittest.TestCase):
    def check(self, **changed):
        """What is wrong with SOUND after `changed`: text by folder__file, of a script of the run time."""
        return self.check_files(
            {f"addons/lobelight/runtime/{key.replace('__', '/')}.gd": text for key, text in changed.items()}
        )

    def check_files(self, changed):
        with tempfile.TemporaryDirectory() as name:
            root = Path(name).resolve()
            sound = {f"addons/lobelight/{path}": text for path, text in SOUND.items()}
            for path, text in (sound | changed).items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return arrows.check(root)

    def test_a_sound_house_passes(self):
        self.assertEqual(self.check(), [])

    def test_this_house_is_sound(self):
        self.assertEqual(arrows.check(arrows.ROOT), [])

    def test_no_scripts_are_no_house(self):
        with tempfile.TemporaryDirectory() as name:
            self.assertIn("has no scripts", arrows.check(Path(name))[0])

    def test_paths_against_the_arrows_are_found(self):
        for line in (
            'const M := preload("../material/material.gd")',
            'extends "../material/material.gd"',
            'var m := load("res://addons/lobelight/runtime/material/material.gd")',
            'const P := "res://addons/lobelight/runtime/material/material.gd"\nconst M := preload(P)',
        ):
            number = 2 + line.count("\n")
            wrong = self.check(pyramid__other=f"@tool\n{line}\n")
            self.assertEqual(wrong, [f"runtime/pyramid/other.gd:{number}: pyramid must not know material/material.gd"])

    def test_classes_against_the_arrows_are_found(self):
        wrong = self.check(table__other="extends Object\n\nvar a: ALight\nvar b: ALight\n")
        self.assertEqual(wrong, ["runtime/table/other.gd:3: table must not know light/light.gd"])

    def test_optional_parts_are_reached_on_demand_only(self):
        wrong = self.check(light__other='const S := preload("../skies/sky.gd")\n')
        self.assertEqual(wrong, ["runtime/light/other.gd:1: light must not know skies/sky.gd"])

    def test_the_editor_is_unknown(self):
        for text in ('const E := preload("../../editor/plugin.gd")\n', "var e: AnEditor\n"):
            wrong = self.check(material__other=text)
            self.assertEqual(wrong, ["runtime/material/other.gd:1: the run time must not know editor/plugin.gd"])

    def test_a_new_folder_needs_an_entry(self):
        self.assertIn("the folder attic has no entry", self.check(attic__a="extends Object\n")[0])

    def test_the_addon_knows_nothing_outside_it(self):
        command = {"bake/command.gd": "class_name ACommand\n"}
        wrong = self.check_files(command | {"addons/lobelight/editor/plugin.gd": "class_name AnEditor\nvar a: ACommand\n"})
        self.assertEqual(wrong, ["editor/plugin.gd:2: the addon must not know bake/command.gd"])

    def test_a_constant_hides_the_class_of_its_name(self):
        text = 'const ACommand := preload("plugin.gd")\nvar a: ACommand\n'
        heir = 'extends "other.gd"\nvar b: ACommand\n'
        files = {"bake/command.gd": "class_name ACommand\n", "addons/lobelight/editor/other.gd": text}
        self.assertEqual(self.check_files(files | {"addons/lobelight/editor/heir.gd": heir}), [])

    def test_the_library_has_arrows_too(self):
        files = {"gdextension/src/fit/em.h": "", "gdextension/src/sg/lobe.cpp": '#include "fit/em.h"\n'}
        self.assertEqual(self.check_files(files), ["gdextension/src/sg/lobe.cpp:1: sg must not know fit/em.h"])

    def test_a_script_may_name_itself(self):
        self.assertEqual(self.check(light__a="class_name First\nvar other: First\n"), [])


if __name__ == "__main__":
    outcome = unittest.main(exit=False, verbosity=2).result
    wrong = len(outcome.failures) + len(outcome.errors)
    sys.stderr.flush()
    print(f"arrows: {outcome.testsRun - wrong} passed, {wrong} failed")
    sys.exit(1 if wrong else 0)
