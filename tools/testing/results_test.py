"""Tests of results.py: what must count as a failure does. Ends with the closing line that results.py reads."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RESULTS = Path(__file__).with_name("results.py")
GOOD_REPORT = '<testsuites><testsuite><testcase classname="a" name="t"/></testsuite></testsuites>'
GOOD_STANDIN_LOG = "stand-in: begin\n  t passed\nstand-in: end, 1 passed, 0 failed, 0 skipped, exit code 0\n"


class JudgeTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def judge(
        self, log: str, report: str | None = None, status: int = 0, engine: bool = False, took: str = ""
    ) -> dict:
        """Runs the judge; returns its outcome, which must agree with its exit status."""
        (self.folder / "log").write_text(log, encoding="utf-8")
        command = [sys.executable, str(RESULTS), "judge", "--runner", "r", "--status", str(status)]
        command += ["--log", str(self.folder / "log"), "--out", str(self.folder / "out.json"), "--took", took]
        if report is not None:
            (self.folder / "report.xml").write_text(report, encoding="utf-8")
            command += ["--junit", str(self.folder / "report.xml")]
        if engine:
            command.append("--engine")
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        outcome = json.loads((self.folder / "out.json").read_text(encoding="utf-8"))
        self.assertEqual(result.returncode, 1 if outcome["failed"] else 0)
        self.assertIn(f"r: {outcome['passed']} passed, {outcome['failed']} failed", result.stdout)
        return outcome

    def assert_counts(self, outcome: dict, passed: int, failed: int) -> None:
        self.assertEqual((outcome["passed"], outcome["failed"]), (passed, failed), outcome["problems"])

    def test_good_report(self) -> None:
        self.assert_counts(self.judge("", GOOD_REPORT), 1, 0)

    def test_failures_errors_and_skips_are_counted_once_a_test(self) -> None:
        report = (
            "<testsuites><testcase name='a'><failure message='x'/><error message='y'/></testcase>"
            "<testcase name='b'><error message='z'/></testcase><testcase name='c'><skipped/></testcase>"
            "<testcase name='d'/></testsuites>"
        )
        outcome = self.judge("", report, status=100)
        self.assert_counts(outcome, 1, 2)
        self.assertEqual(outcome["skipped"], 1)

    def test_no_test_is_a_failure(self) -> None:
        self.assert_counts(self.judge("", "<testsuites/>"), 0, 1)

    def test_broken_report_is_a_failure(self) -> None:
        self.assert_counts(self.judge("", GOOD_REPORT[:30]), 0, 1)

    def test_bad_status_with_a_good_report_is_a_failure(self) -> None:
        self.assert_counts(self.judge("", GOOD_REPORT, status=134), 1, 1)

    def test_seconds_are_kept(self) -> None:
        outcome = self.judge("", GOOD_REPORT, took="12 20 3")
        self.assertEqual((outcome["wall_s"], outcome["processor_s"]), (12.0, 23.0))

    def test_time_limit_is_a_failure(self) -> None:
        self.assert_counts(self.judge("", GOOD_REPORT, status=124), 1, 1)

    def test_closing_line(self) -> None:
        self.assert_counts(self.judge("  a passed\nlint: 3 passed, 0 failed\n"), 3, 0)
        self.assert_counts(self.judge("b FAILED\nlint: 3 passed, 2 failed\na hint\n", status=1), 3, 2)

    def test_missing_closing_line_is_a_failure(self) -> None:
        self.assert_counts(self.judge("  a passed\n"), 0, 1)
        self.assert_counts(self.judge(""), 0, 1)

    def test_closing_line_with_nothing_run_is_a_failure(self) -> None:
        self.assert_counts(self.judge("lint: 0 passed, 0 failed\n"), 0, 1)

    def test_standin_log(self) -> None:
        self.assert_counts(self.judge(GOOD_STANDIN_LOG, GOOD_REPORT, engine=True), 1, 0)

    def test_missing_end_of_the_standin_is_a_failure(self) -> None:
        log = GOOD_STANDIN_LOG.splitlines()[0]
        self.assert_counts(self.judge(log, GOOD_REPORT, engine=True), 1, 1)

    def test_standin_that_disagrees_with_its_report_is_a_failure(self) -> None:
        log = GOOD_STANDIN_LOG.replace("1 passed", "2 passed")
        self.assert_counts(self.judge(log, GOOD_REPORT, engine=True), 1, 1)

    def test_errors_inside_the_tests_are_the_standins(self) -> None:
        log = GOOD_STANDIN_LOG.replace("  t passed", "ERROR: expected\n  t passed")
        self.assert_counts(self.judge(log, GOOD_REPORT, engine=True), 1, 0)

    def test_engine_complaints_outside_the_tests_are_failures(self) -> None:
        for line in (
            "ERROR: something",
            "SCRIPT ERROR: something",
            "SHADER ERROR: something",
            "USER ERROR: something",
            "\x1b[31mERROR: in colour\x1b[0m",
            "WARNING: ObjectDB instances leaked at exit (run with --verbose for details).",
            "ERROR: 2 RID allocations of type 'Texture' were leaked at exit.",
            'WARNING: 8 RIDs of type "Texture" were leaked.',
            "Leaked instance: Node:1234",
            "Orphan StringName: x",
            "handle_crash: Program crashed with signal 11",
        ):
            with self.subTest(line):
                self.assert_counts(self.judge(f"{line}\n{GOOD_STANDIN_LOG}", GOOD_REPORT, engine=True), 1, 1)
                self.assert_counts(self.judge(f"{GOOD_STANDIN_LOG}{line}\n", GOOD_REPORT, engine=True), 1, 1)

    def test_errors_inside_a_test_of_gdunit4_are_its_own(self) -> None:
        log = "  res://a_test.gd > t STARTED\nERROR: expected\n  res://a_test.gd > t PASSED 3ms\n"
        self.assert_counts(self.judge(log, GOOD_REPORT, engine=True), 1, 0)
        self.assert_counts(self.judge(log + "ERROR: after it\n", GOOD_REPORT, engine=True), 1, 1)


class TotalTest(unittest.TestCase):
    def total(self, *counts: tuple[int, int]) -> tuple[int, str]:
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for index, (passed, failed) in enumerate(counts):
                paths.append(Path(folder) / f"{index}.json")
                outcome = {"runner": "r", "log": "", "passed": passed, "failed": failed, "skipped": 0}
                problems = [f"problem {i} of {index}" for i in range(failed)]
                paths[-1].write_text(json.dumps({**outcome, "problems": problems}), encoding="utf-8")
            command = [sys.executable, str(RESULTS), "total", *map(str, paths), "--json", f"{folder}/sum"]
            command += ["--preparation", "100 150 7"]
            result = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertRegex(result.stdout, r"(?m)^  preparation +100 s +157 s$")
            written = json.loads(Path(f"{folder}/sum").read_text(encoding="utf-8"))
            self.assertEqual(written["passed"], sum(passed for passed, _failed in counts))
            for index, (_passed, failed) in enumerate(counts):
                for i in range(failed):
                    self.assertIn(f"problem {i} of {index}", result.stdout)
            return result.returncode, result.stdout.splitlines()[-1]

    def test_sum(self) -> None:
        self.assertEqual(self.total((2, 0), (3, 0)), (0, "5 passed, 0 failed"))

    def test_one_failure(self) -> None:
        self.assertEqual(self.total((2, 0), (3, 1)), (1, "5 passed, 1 failed"))

    def test_times_are_those_of_the_runners(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for name, wall, processor in (("short", 1.0, 1.0), ("long", 300.0, 500.0), ("brief", 2.0, 2.0)):
                paths.append(Path(folder) / f"{name}.json")
                outcome = {"runner": name, "log": "", "passed": 1, "wall_s": wall, "processor_s": processor}
                paths[-1].write_text(json.dumps(outcome), encoding="utf-8")
            command = [sys.executable, str(RESULTS), "total", *map(str, paths)]
            lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(lines[2].split(), ["long", "300", "s", "500", "s"])
        self.assertEqual(lines[3].split(), ["2", "others", "3", "s", "3", "s"])
        self.assertEqual(lines[4].split(), ["together", "303", "s", "503", "s"])

    def test_nothing_passed(self) -> None:
        self.assertEqual(self.total((0, 0)), (1, "0 passed, 0 failed"))


if __name__ == "__main__":
    outcome = unittest.main(exit=False, verbosity=2).result
    wrong = len(outcome.failures) + len(outcome.errors)
    sys.stderr.flush()
    print(f"harness: {outcome.testsRun - wrong} passed, {wrong} failed")
    sys.exit(1 if wrong else 0)
