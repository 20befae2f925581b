"""Tests of shader_names.py on includes of a few lines."""

import sys
import tempfile
import unittest
from pathlib import Path

import shader_names

SOUND = """struct LobelightOne {
	vec3 view; // a member
};
uniform float lobelight_width;
vec3 lobelight_two(LobelightOne one_, vec3 view_, float a_)
{
	// view is no name here
	const float b_ = 2.0, c_ = max(1.0, a_);
	for (int i_ = 0; i_ < 2; i_++) {
		a_ += step(b_, c_);
	}
	return one_.view * view_.x * lobelight_width;
}
"""


class ShaderNames(unittest.TestCase):
    def test_sound_code_is_left_alone(self):
        self.assertEqual(shader_names.wrong_names(SOUND), {})

    def test_arguments_and_variables_are_found_and_renamed(self):
        for name, line in {"one": 5, "view": 5, "a": 5, "b": 8, "c": 8, "i": 9}.items():
            # Not members, which stand behind a dot.
            changed = SOUND.replace(f"{name}_", name)
            self.assertEqual(shader_names.wrong_names(changed), {name: line})
            self.assertEqual(shader_names.renamed(changed, {name}), SOUND)

    def test_functions_of_these_names_stay(self):
        text = "float lobelight_f(float step)\n{\n\treturn step(step, 1.0);\n}\n"
        self.assertEqual(shader_names.renamed(text, {"step"}), "float lobelight_f(float step_)\n{\n\treturn step(step_, 1.0);\n}\n")

    def test_includes_of_includes_are_looked_at(self):
        with tempfile.TemporaryDirectory() as name:
            addon = Path(name).resolve()
            (addon / "runtime").mkdir()
            (addon / shader_names.ENTRY).write_text('// #include "not.gdshaderinc"\n#include "runtime/a.gdshaderinc"\n', encoding="utf-8")
            (addon / "runtime/a.gdshaderinc").write_text('#include "b.gdshaderinc"\n', encoding="utf-8")
            (addon / "runtime/b.gdshaderinc").write_text('#include "a.gdshaderinc"\n', encoding="utf-8")
            found = [file.name for file in shader_names.reached(addon)]
            self.assertEqual(found, [shader_names.ENTRY, "a.gdshaderinc", "b.gdshaderinc"])


if __name__ == "__main__":
    outcome = unittest.main(exit=False, verbosity=2).result
    wrong = len(outcome.failures) + len(outcome.errors)
    sys.stderr.flush()
    print(f"shader-names: {outcome.testsRun - wrong} passed, {wrong} failed")
    sys.exit(1 if wrong else 0)
