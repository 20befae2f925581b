#!/usr/bin/env python3
"""./dev report from end to end, small: draws two cases, is stopped after the first, goes on, and has nothing to do then."""

import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
METHODS = "gmm1,gmm8,fis8,allfreq1"
CASES = 2


class ReportSmokeTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.out = self.folder / "report"

    def start(self, *more):
        arguments = ["--cases", str(CASES), "--renderers", "mobile", "--methods", METHODS, "--size", "32", "--samples", "16"]
        arguments += ["--timing-rounds", "1", "--out", str(self.out), *more]
        return subprocess.Popen(
            [str(ROOT / "dev"), "report", *arguments],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True,
        )  # fmt: skip

    def run_to_the_end(self, *more):
        """What it says on stderr; it must succeed."""
        process = self.start(*more)
        said = process.communicate()[1]
        self.assertEqual(process.returncode, 0, said)
        return said

    def stop_after_the_first_case(self):
        process, said = self.start(), ""
        for line in process.stderr:
            said += line
            if line.startswith(f"[1/{CASES}]"):
                os.killpg(process.pid, signal.SIGINT)
                break
        said += process.communicate()[1]
        self.assertIn("the same command goes on from here", said)
        self.assertNotEqual(process.returncode, 0)

    def test_a_stopped_run_goes_on_and_writes_the_report(self):
        self.stop_after_the_first_case()
        kept = json.loads((self.out / "compare/results.json").read_text(encoding="utf-8"))["cases"]
        self.assertEqual(len(kept), 1)

        said = self.run_to_the_end("--json", str(self.folder / "summary.json"))
        self.assertIn(f"1 of {CASES} cases are measured already", said)
        self.assertRegex(said, r"\[1/1\] .* left\n")
        self.check_report(kept[0])

        written = (self.out / "compare/results.json").read_bytes()
        again = self.run_to_the_end()
        self.assertIn(f"{CASES} of {CASES} cases are measured already", again)
        self.assertNotRegex(again, r"\[\d+/\d+\]")
        self.assertEqual((self.out / "compare/results.json").read_bytes(), written)

    def check_report(self, first):
        entries = json.loads((self.out / "compare/results.json").read_text(encoding="utf-8"))["cases"]
        self.assertEqual(entries[0], first)
        self.assertEqual(len(entries), CASES)
        for entry in entries:
            self.assertEqual(set(entry["methods"]), {*METHODS.split(","), "reference"})
            self.assertEqual(entry["unavailable"], {})
            # Which device every figure is from.
            self.assertTrue(all(entry["where"][name] for name in ("machine", "driver", "driver_version", "engine", "date")))
            self.assertEqual(len(entry["fixed_ms_rounds"]), 1)
            drawn = {name: own for name, own in entry["methods"].items() if name != "reference"}
            self.assertTrue(all(10.0 < own["psnr"] < 100.0 and own["gpu_ms"] > 0.0 for own in drawn.values()), drawn)
            self.assertGreater(drawn["gmm8"]["psnr"], drawn["allfreq1"]["psnr"])
        with (self.out / "compare/results.csv").open(encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), CASES * (len(METHODS.split(",")) + 1))
        summary = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.assertEqual(len(summary["verdicts"]), CASES)
        html = (self.out / "index.html").read_text(encoding="utf-8")
        shown = re.findall(r'<img src="([^"]+)"', html)
        self.assertIn("compare/time_mobile.svg", shown)
        # A sheet of each case.
        self.assertEqual(sum(name.startswith("compare/hall_") for name in shown), CASES)
        self.assertTrue(all((self.out / name).stat().st_size > 1000 for name in shown))
        self.assertIn(entries[0]["where"]["driver"], (self.out / "README.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"report-smoke: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
