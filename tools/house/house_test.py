"""Tests of ./dev house on repositories of a few files."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

import house

SVG = house.PICTURE
TABLES = "".join(house.TABLE.format(name) + house.END + "\n" for name in ("lobe", "light"))
# A repository as it may be: path, text.
SOUND = {
    "run.sh": "bash tools/start.py\n",
    "tools/start.py": "import part\n\npart.work()\n",
    "tools/part.py": "def work():\n    pass\n",
    "addons/lobelight/runtime/one.gd": 'class_name One\nconst Two := preload("two.gd")\nconst LATE := "res://addons/late.gd"\n',
    "addons/lobelight/runtime/two.gd": "# One is not needed here.\nextends Object\n",
    "addons/late.gd": "extends Object\nvar a: One\n",
    "gdextension/src/a.h": '#pragma once\n#include "b.h"\n',
    "gdextension/src/a.cpp": '#include "a.h"\n',
    "gdextension/src/b.h": "int b();\nint c() { return b(); }\nint d() { return c() + d(); }\n",
    "CMakeLists.txt": "file(GLOB SOURCES gdextension/src/*.cpp)\n",
    "docs/pictures/x.svg": "",
    "docs/page.md": "![x](pictures/x.svg) tools/lonely.py\n",
    house.PAGE: f"# Page\n{TABLES}The rest.\n",
    SVG: "",
    "tools/house/entries.txt": "run.sh  a person\nCMakeLists.txt  CMake\ndocs/*.md  readers\ntools/house/*  the test\n"
    + SVG
    + "  readers\n",
    "tools/house/lobe_path.txt": "gdextension/src/a.cpp  first\ngdextension/src/b.h  then\n",
    "tools/house/light_path.txt": "addons/lobelight/runtime/two.gd  first\naddons/lobelight/runtime/one.gd  then\naddons/late.gd  last\n",
    "tools/house/boxes.json": json.dumps(
        {
            "regions": [],
            "boxes": [
                {"name": "native", "title": "n", "says": "", "files": ["gdextension/src/**"], "place": [0, 0]},
                {"name": "runtime", "title": "r", "says": "", "files": ["addons/lobelight/**"], "place": [1, 0]},
            ],
        }
    ),
}


class HouseTest(unittest.TestCase):
    def look(self, **changed):
        """The figures of SOUND after `changed`: text by number, as {"file": text}; None takes a file away."""
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            for path, text in (SOUND | changed.get("files", {})).items():
                if text is not None:
                    (root / path).parent.mkdir(parents=True, exist_ok=True)
                    (root / path).write_text(text, encoding="utf-8")
            figures, drawn = house.look(root)
            for path, text in drawn.items():
                (root / path).write_text(text, encoding="utf-8")
            # With its picture and tables it is the same house.
            self.assertEqual(house.look(root)[1], drawn)
            self.page = drawn[house.PAGE]
            return figures

    def wrong(self, files):
        return self.look(files=files)["wrong"]

    def test_a_sound_house_passes(self):
        figures = self.look(files={})
        self.assertEqual(figures["wrong"], [])
        self.assertEqual(figures["lobe_path"]["steps"], 2)
        self.assertEqual(figures["lobe_path"]["files"], 3)
        self.assertEqual(figures["folders"]["gdextension/src"], {"files": 3, "lines": 6})
        self.assertIn("| 2 | `src/b.h` | then |\n<!-- end -->\n", self.page)
        self.assertTrue(self.page.endswith("| 3 | `addons/late.gd` | last |\n<!-- end -->\nThe rest.\n"), self.page)

    def test_cycles_are_found_once(self):
        two = 'const Three := preload("three.gd")\n'
        wrong = self.wrong({"addons/lobelight/runtime/two.gd": two, "addons/lobelight/runtime/three.gd": "var a: One\n"})
        way = [f"addons/lobelight/runtime/{name}.gd" for name in ("one", "two", "three", "one")]
        self.assertEqual(wrong, [f"a cycle: {' -> '.join(way)}"])

    def test_cycles_are_found_in_each_language(self):
        for path, text in (
            ("tools/part.py", "import start\n\n\ndef work():\n    start.x()\n"),
            ("gdextension/src/b.h", '#include "a.h"\nint b() { return b(); }\n'),
        ):
            self.assertEqual([sentence[:8] for sentence in self.wrong({path: text})], ["a cycle:"])

    def test_files_that_only_prose_or_a_comment_names_are_orphans(self):
        for path in ("tools/lonely.py", "addons/lobelight/runtime/lonely.gd"):
            note = {"run.sh": f"# See {path}.\nbash tools/start.py\n"}
            wrong = self.wrong({path: "", **note})
            self.assertEqual(wrong, [f"nobody refers to {path}: remove it, or say in tools/house/entries.txt who takes it"])

    def test_functions_that_nobody_names_are_found(self):
        wrong = self.wrong({"tools/part.py": "def work():\n    pass\n\n\ndef rest():\n    pass\n"})
        self.assertEqual(len(wrong), 1)
        self.assertTrue(wrong[0].startswith("tools/part.py:5 rest: nobody names this function"), wrong)

    def test_gaps_in_a_way_are_found(self):
        for way, gap in (
            (
                "run.sh  first\ngdextension/src/b.h  then\n",
                "gdextension/src/b.h neither needs a file before it nor is needed by one",
            ),
            ("run.sh  first\nrun.sh  again\n", "run.sh comes twice"),
            ("gone.gd\n", "there is no file gone.gd"),
        ):
            wrong = self.wrong({"tools/house/lobe_path.txt": way})
            self.assertIn(f"tools/house/lobe_path.txt: {gap}", wrong)

    def test_entries_that_no_file_has_are_found(self):
        wrong = self.wrong({"tools/house/entries.txt": SOUND["tools/house/entries.txt"] + "gone/*  nobody\n"})
        self.assertEqual(wrong, ["tools/house/entries.txt: no file is named gone/*"])

    def test_the_picture_has_the_arrows_of_the_files(self):
        def arrows(files):
            with tempfile.TemporaryDirectory() as name:
                root = Path(name)
                for path, text in (SOUND | files).items():
                    (root / path).parent.mkdir(parents=True, exist_ok=True)
                    (root / path).write_text(text, encoding="utf-8")
                return house.look(root)[1][SVG].count('<path class="lobelight-arrow"')

        include = '#include "../../addons/lobelight/runtime/x.h"\n#include "a.h"\n'
        before = arrows({"addons/lobelight/runtime/x.h": ""})
        self.assertEqual(arrows({"addons/lobelight/runtime/x.h": "", "gdextension/src/a.cpp": include}), before + 1)

    def test_this_house_is_sound(self):
        figures, drawn = house.look(house.ROOT)
        self.assertEqual(figures["wrong"], [])
        for path, text in drawn.items():
            self.assertEqual(text, (house.ROOT / path).read_text(encoding="utf-8"), path)


if __name__ == "__main__":
    outcome = unittest.main(exit=False, verbosity=2).result
    wrong = len(outcome.failures) + len(outcome.errors)
    sys.stderr.flush()
    print(f"house: {outcome.testsRun - wrong} passed, {wrong} failed")
    sys.exit(1 if wrong else 0)
