"""What ./dev accuracy makes of measurements, without drawing: made-up ones whose answers are known."""

import pathlib
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/compare"))
sys.path.insert(0, str(ROOT / "tools/accuracy"))

import cases  # noqa: E402
import report  # noqa: E402
import results  # noqa: E402

WHOLE = cases.full(cases.PARTS, [])
RIVAL_PSNR = 30.0


def lobes_of(method):
    return int("".join(letter for letter in method if letter.isdigit()) or 24)


def entry(case, psnr_of):
    """Measured as planned: a lobe takes a fortieth of the rival's time, and only a timed case has times."""
    figures = {
        method: {
            "fetches": lobes_of(method), "probes": lobes_of(method), "table_fetches": 0, "psnr": psnr_of(method), "flip": 0.0,
            "relative_rmse": 0.0, "gpu_ms": 1.0 if case.timed else None, "gpu_ratio": lobes_of(method) / 40 if case.timed else None,
        }
        for method in case.methods
    }  # fmt: skip
    return {
        "map": case.map, "brdf": case.brdf, "alpha": list(case.alpha), "timing_rounds": int(case.timed), "methods": figures,
    }  # fmt: skip


def entries(psnr_of):
    return results.with_times([entry(case, psnr_of) for case in WHOLE])


def better_by(gain):
    return lambda method: RIVAL_PSNR + gain if cases.is_ours(method) else RIVAL_PSNR


class PlanTest(unittest.TestCase):
    def test_the_leads_come_first_on_every_map(self):
        leads = [case for case in WHOLE if case.alpha in cases.LEADS]
        self.assertEqual(WHOLE[: len(leads)], leads)
        whole = [(m, brdf, alpha) for m in cases.MAPS for brdf in cases.BRDFS for alpha in cases.LEADS]
        self.assertEqual(sorted(whole), sorted(case.key() for case in leads))
        for case in leads:
            self.assertLessEqual({*cases.LEAD_METHODS, cases.REFERENCE}, {*case.methods})

    def test_times_are_of_one_map(self):
        self.assertEqual({case.map for case in WHOLE if case.timed}, {cases.TIMED_MAP})
        for found in entries(better_by(0.0)):
            for method, own in found["methods"].items():
                if found["map"] != cases.TIMED_MAP and cases.RIVAL in found["methods"]:
                    self.assertEqual(own["gpu_ratio"], lobes_of(method) / 40, (found["map"], found["alpha"], method))


class GoalsTest(unittest.TestCase):
    def missed(self, psnr_of, alpha):
        _, missed = report.of_leads(entries(psnr_of))
        return [line for line in missed if report.widths(alpha) in line]

    def test_leads_are_judged_by_their_own_goals(self):
        for alpha, least in report.LEAST_LEADS.items():
            count = len(cases.MAPS) * len(cases.BRDFS)
            self.assertEqual(self.missed(better_by(least), alpha), [])
            self.assertEqual(len(self.missed(better_by(least - 0.1), alpha)), count, alpha)

    def test_photographed_maps_want_more_than_a_lead(self):
        missed = self.missed(lambda method: 32.9 if cases.is_ours(method) else 20.0, cases.HARD)
        self.assertEqual(len(missed), (len(cases.MAPS) - 1) * len(cases.BRDFS))
        self.assertFalse(any(cases.SYNTHETIC in line for line in missed))

    def test_what_takes_longer_than_the_rival_does_not_count(self):
        found = {"fis40": {"psnr": 30.0, "fetches": 40, "gpu_ratio": 1.0}}
        found["gmm8"] = {"psnr": 31.0, "fetches": 8, "gpu_ratio": 0.3}
        found["line32"] = {"psnr": 45.0, "fetches": 32, "gpu_ratio": 1.1}
        self.assertEqual(report.best_within(found, 40), ("gmm8", 1.0, 0.3))
        found["line32"]["gpu_ratio"] = 0.9
        self.assertEqual(report.best_within(found, 40), ("line32", 15.0, 0.9))
        self.assertEqual(report.best_within(found, 16), ("gmm8", 1.0, 0.3))

    def test_the_page_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            options = types.SimpleNamespace(size=96, renderer="mobile", samples=640)
            said = report.write(pathlib.Path(folder), entries(better_by(10.0)), "llvmpipe", options)
            self.assertIn(f"{len(WHOLE)} cases", said)
            text = (pathlib.Path(folder) / "README.md").read_text(encoding="utf-8")
            for part in ("## Maps", "## Ahead of fis40", "## Strong anisotropy", "## Grid of widths"):
                self.assertIn(part, text)


class ResultsTest(unittest.TestCase):
    def test_what_could_not_be_drawn_is_not_tried_again(self):
        with tempfile.TemporaryDirectory() as folder:
            kept = results.Results(pathlib.Path(folder) / "results.json")
            conditions = {"map": "hall", "brdf": "ward", "alpha": [0.1, 0.1], "key": "k"}
            kept.add(conditions, {"gmm8": {}}, {"line8": "no"})
            kept.save("mobile")
            again = results.Results(pathlib.Path(folder) / "results.json")
            self.assertIsNotNone(again.entry(conditions, ["gmm8", "line8"]))
            self.assertIsNone(again.entry(conditions, ["gmm8", "line16"]))
            self.assertIsNone(again.entry({**conditions, "key": "other"}, ["gmm8"]))


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"accuracy-report: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
