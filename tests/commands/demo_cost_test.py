"""What ./dev demo --cost makes of instructions and pixels: against a frame that is reckoned here by hand."""

import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/demo"))

import cost  # noqa: E402

PIXELS = 1920 * 1080
GPU = cost.Gpu("toy", "Toy", "mobile", (10, 20), 100, "made up")


def rows_of(instructions):
    return {("toy", name): {"instructions": count} for name, count in instructions.items()}


class DemoCostTest(unittest.TestCase):
    def test_a_frame_is_the_sum_over_its_surfaces(self):
        rows = rows_of({"gmm8_set": 300, "empty_backdrop": 50})
        layout = {"layout": "landscape", "shares": {"Disc": 0.25, "Backdrop": 0.75}}
        frame = cost.frame(rows, GPU, layout, 8)
        total = PIXELS * (0.25 * 300 + 0.75 * 50)
        self.assertAlmostEqual(frame["instructions"], total)
        # 20 and 10 units at 100 MHz do 2 and 1 instructions a nanosecond.
        self.assertAlmostEqual(frame["milliseconds"][0], total / 2e6)
        self.assertAlmostEqual(frame["milliseconds"][1], total / 1e6)
        self.assertEqual([part["surface"] for part in frame["surfaces"]], ["Disc", "Backdrop"])

    def test_sixteen_lobes_add_what_eight_more_take(self):
        rows = rows_of({"gmm8_set": 300, "gmm8": 290, "gmm16": 490, "empty_backdrop": 50})
        self.assertEqual(cost.instructions(rows, GPU, "Disc", 8), 300)
        self.assertEqual(cost.instructions(rows, GPU, "Disc", 16), 300 + 490 - 290)
        self.assertEqual(cost.instructions(rows, GPU, "Backdrop", 16), 50)
        # A coat is a second one.
        rows = rows_of({"gmm8_coat_isotropic": 700, "gmm8_isotropic": 270, "gmm16_isotropic": 470})
        self.assertEqual(cost.instructions(rows, GPU, "Pebble", 16), 700 + 2 * (470 - 270))

    def test_what_is_missing_is_named(self):
        with self.assertRaisesRegex(cost.Problem, "gmm8_set was not measured on toy"):
            cost.instructions({}, GPU, "Disc", 8)
        with self.assertRaisesRegex(cost.Problem, "Chandelier"):
            cost.frame({}, GPU, {"layout": "landscape", "shares": {"Chandelier": 1.0}}, 8)

    def test_every_row_is_a_variant_and_every_surface_is_in_the_scene(self):
        variants = json.loads((ROOT / "tools/mobile_cost/variants.json").read_text(encoding="utf-8"))
        self.assertLessEqual(set(cost.VARIANTS), set(variants))
        scene = (ROOT / "demo/demo.tscn").read_text(encoding="utf-8")
        for surface in cost.SURFACES:
            self.assertIn(f'[node name="{surface}"', scene)

    def test_the_committed_report_is_that_of_the_committed_rows(self):
        """docs/report/demo-cost from docs/report/mobile-cost, and the pixels that it says it has counted."""
        report = ROOT / "docs/report"
        listed = json.loads((report / "mobile-cost/results.json").read_text(encoding="utf-8"))
        rows = {(row["gpu"], row["variant"]): row for row in listed}
        kept = json.loads((report / "demo-cost/results.json").read_text(encoding="utf-8"))
        layouts = {
            entry["layout"]: {
                "layout": entry["layout"],
                "shares": {part["surface"]: part["share"] for part in entry["surfaces"]},
            }
            for entry in kept
        }
        frames = [cost.frame(rows, gpu, layouts[name], lobes) for gpu in cost.GPUS for name in layouts for lobes in cost.THESIS]
        self.assertEqual(frames, kept)
        for layout in layouts.values():
            # Shadows lie over the plinth; all else is beside one another.
            self.assertAlmostEqual(sum(share for name, share in layout["shares"].items() if name != cost.SHADOWS), 1.0)
        with tempfile.TemporaryDirectory() as folder:
            cost.write_report(frames, listed[0]["mesa"], pathlib.Path(folder))
            written = (pathlib.Path(folder) / "README.md").read_text(encoding="utf-8")
        self.assertEqual(written, (report / "demo-cost/README.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"demo-cost: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
