"""Judges what a test runner did, and adds the runners up.

judge: reads a runner's exit status, its JUnit report or closing line and its log, prints what went wrong and one
summary line, and writes the outcome as JSON. A runner that crashed, left no report or ran no test has failed, and so
has one whose engine reported errors or leaks that no test answers for.

total: adds up outcomes, prints where the time went, and the last line of `./dev test`, "N passed, N failed".
"""

import argparse
import json
import re
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import asdict, dataclass, field
from pathlib import Path

# What the engine says when something is wrong, at the start of a line of its output.
ENGINE_PROBLEM = re.compile(
    r"^(?:USER )?(?:SCRIPT |SHADER )?ERROR:|^Parse Error|^WARNING: .*(?:[Ll]eaked|[Oo]rphan)|^Leaked instance"
    r"|^Orphan|^handle_crash"
)

# The engine's own noise, with the reason why it says nothing about this project.
KNOWN_NOISE: list[tuple[re.Pattern[str], str]] = [
    (
        re.compile(r'^WARNING: (?:7|14) RIDs of type "Texture" were leaked\.$'),
        "Forward+ and Mobile of Godot 4.6.3 leave seven behind for each kind of atlas that a ReflectionProbe has been drawn in; the tests have two",
    ),
]

# Of all processor time: what took less is shown together.
LEAST_SHARE_SHOWN = 0.01

CLOSING_LINE = re.compile(r"(?P<name>[\w -]+): (?P<passed>\d+) passed, (?P<failed>\d+) failed")
STANDIN_BEGIN = "stand-in: begin"
STANDIN_END = re.compile(
    r"stand-in: end, (?P<passed>\d+) passed, (?P<failed>\d+) failed, (?P<skipped>\d+) skipped,"
)
# gdUnit4's own lines about a test.
GDUNIT_TEST_BEGIN = re.compile(r"\s*res://\S+ > .* STARTED")
GDUNIT_TEST_END = re.compile(r"\s*res://\S+ > .* (?:PASSED|FAILED|SKIPPED|WARNING|FLAKY|ERROR)\b")
ESCAPE_SEQUENCE = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")


@dataclass
class Outcome:
    """What one runner did. `problems` are sentences; each that is no test's own failure counts as one failure."""

    runner: str
    log: str
    passed: int = 0
    failed: int = 0
    skipped: int = 0
    problems: list[str] = field(default_factory=list)
    wall_s: float = 0.0
    processor_s: float = 0.0

    def add_problem(self, sentence: str) -> None:
        self.failed += 1
        self.problems.append(sentence)

    def summary(self) -> str:
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        return f"{self.runner}: {self.passed} passed, {self.failed} failed{skipped}"


def read_junit(outcome: Outcome, path: Path) -> None:
    """Counts the test cases of a JUnit report, one failure for each case that has any."""
    try:
        cases = list(ElementTree.parse(path).iter("testcase"))
    except (OSError, ElementTree.ParseError) as error:
        outcome.add_problem(f"there is no readable report ({error})")
        return
    for case in cases:
        wrong = [child for child in case if child.tag in ("failure", "error")]
        if wrong:
            message = " ".join((wrong[0].get("message") or wrong[0].text or "").split())
            outcome.add_problem(f"{case_title(case)}: {message or 'failed'}")
        elif case.find("skipped") is not None or case.get("status") in ("notrun", "disabled"):
            outcome.skipped += 1
        else:
            outcome.passed += 1


def case_title(case: ElementTree.Element) -> str:
    """CTest gives a test's name as its class too."""
    name, group = case.get("name", ""), case.get("classname", "")
    return name if group in ("", name) else f"{group} > {name}"


def read_closing_line(outcome: Outcome, lines: list[str]) -> None:
    """Takes the counts from the closing line, `NAME: N passed, N failed`; a hint may follow it."""
    match = next(filter(None, map(CLOSING_LINE.fullmatch, reversed(lines[-3:]))), None)
    if match is None:
        outcome.add_problem("the runner ended without its closing line")
        return
    outcome.passed += int(match["passed"])
    outcome.failed += int(match["failed"])
    outcome.problems += [line.strip() for line in lines if "FAILED" in line]


def check_standin_end(outcome: Outcome, lines: list[str]) -> None:
    """The stand-in's end marker has to be there, and to agree with the report."""
    matches = [match for match in map(STANDIN_END.match, lines) if match]
    if len(matches) != 1:
        outcome.add_problem("the engine ended before the tests did")
        return
    counted = (outcome.passed, outcome.failed, outcome.skipped)
    said = tuple(int(matches[0][key]) for key in ("passed", "failed", "skipped"))
    if counted != said:
        outcome.add_problem(f"the report counts {counted}, the runner {said} (passed, failed, skipped)")


def check_engine_log(outcome: Outcome, lines: list[str]) -> None:
    """Counts the engine's complaints outside the tests as failures.

    Those inside belong to a test, which may have expected them. The stand-in charges the others to their test;
    gdUnit4 does so with script errors.
    """
    inside_tests = False
    for number, line in enumerate(lines, start=1):
        if line == STANDIN_BEGIN or GDUNIT_TEST_BEGIN.fullmatch(line):
            inside_tests = True
        elif STANDIN_END.match(line) or GDUNIT_TEST_END.match(line):
            inside_tests = False
        elif not inside_tests and ENGINE_PROBLEM.search(line) and not is_known_noise(line):
            outcome.add_problem(f"{outcome.log}:{number}: {line}")


def is_known_noise(line: str) -> bool:
    return any(pattern.search(line) for pattern, _reason in KNOWN_NOISE)


def read_took(text: str) -> tuple[float, float]:
    """Wall-clock seconds and processor seconds of "WALL USER SYSTEM", or of nothing."""
    wall, *processor = (float(part) for part in text.split() or ["0"])
    return wall, sum(processor)


def print_times(outcomes: list[Outcome], preparation: str) -> None:
    """A line for each runner, those that took most first; those that took little in one line."""
    rows = [(outcome.runner, outcome.wall_s, outcome.processor_s) for outcome in outcomes]
    if preparation:
        rows.append(("preparation", *read_took(preparation)))
    rows.sort(key=lambda row: -row[2])
    together = sum(row[2] for row in rows)
    shown = [row for row in rows if row[2] >= LEAST_SHARE_SHOWN * together]
    others = [row for row in rows if row not in shown]
    if others:
        shown.append((f"{len(others)} others", sum(row[1] for row in others), sum(row[2] for row in others)))
    shown.append(("together", sum(row[1] for row in rows), together))
    print(f"\n{'Where the time went':28} wall    processor")
    for name, wall, processor in shown:
        print(f"  {name:24} {wall:6.0f} s {processor:8.0f} s")


def judge(arguments: argparse.Namespace) -> int:
    outcome = Outcome(arguments.runner, str(arguments.log))
    outcome.wall_s, outcome.processor_s = read_took(arguments.took)
    text = arguments.log.read_text(encoding="utf-8", errors="replace")
    lines = ESCAPE_SEQUENCE.sub("", text).rstrip("\n").splitlines()
    if arguments.junit:
        read_junit(outcome, arguments.junit)
    else:
        read_closing_line(outcome, lines)
    if arguments.engine:
        if STANDIN_BEGIN in lines:
            check_standin_end(outcome, lines)
        check_engine_log(outcome, lines)
    if outcome.passed + outcome.failed == 0:
        outcome.add_problem("no test ran")
    if arguments.status == 124:
        outcome.add_problem("the runner took too long and was stopped")
    elif arguments.status != 0 and outcome.failed == 0:
        outcome.add_problem(f"the runner ended with status {arguments.status}")
    for problem in outcome.problems:
        print(f"  {problem}")
    print(outcome.summary() + (f" (log: {outcome.log})" if outcome.failed else ""), flush=True)
    arguments.out.write_text(json.dumps(asdict(outcome), indent=2) + "\n", encoding="utf-8")
    return 1 if outcome.failed else 0


def total(arguments: argparse.Namespace) -> int:
    outcomes = [Outcome(**json.loads(path.read_text(encoding="utf-8"))) for path in arguments.outcomes]
    sums = {key: sum(getattr(outcome, key) for outcome in outcomes) for key in ("passed", "failed", "skipped")}
    if arguments.json:
        temporary = arguments.json.with_name(arguments.json.name + ".tmp")
        temporary.write_text(json.dumps({**sums, "runners": list(map(asdict, outcomes))}, indent=2) + "\n", encoding="utf-8")
        temporary.replace(arguments.json)
    print_times(outcomes, arguments.preparation)
    print()
    for outcome in outcomes:
        print(outcome.summary())
        # Once more, for who sees only the end of a long log.
        for problem in outcome.problems:
            print(f"  {problem}")
    print(f"{sums['passed']} passed, {sums['failed']} failed")
    return 1 if sums["failed"] or not sums["passed"] else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    judging = commands.add_parser("judge")
    judging.add_argument("--runner", required=True, help="the runner's name")
    judging.add_argument("--status", type=int, required=True, help="its exit status")
    judging.add_argument("--log", type=Path, required=True, help="its output")
    judging.add_argument("--junit", type=Path, help="its report; without one the log's last line counts")
    judging.add_argument("--engine", action="store_true", help="the log is the engine's: look for its complaints")
    judging.add_argument("--took", default="", help="its seconds: wall, user and system")
    judging.add_argument("--out", type=Path, required=True, help="where the outcome goes, as JSON")
    judging.set_defaults(run=judge)
    adding = commands.add_parser("total")
    adding.add_argument("outcomes", type=Path, nargs="+", help="what judge wrote")
    adding.add_argument("--preparation", default="", help="seconds before the first runner: wall, user and system")
    adding.add_argument("--json", type=Path, help="where the sum goes, as JSON")
    adding.set_defaults(run=total)
    arguments = parser.parse_args()
    return arguments.run(arguments)


if __name__ == "__main__":
    sys.exit(main())
