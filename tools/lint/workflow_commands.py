"""That the calls of ./dev in GitHub's workflows name commands, options and groups of tests that there are."""

import sys
from collections.abc import Iterator
from pathlib import Path

from ruamel.yaml import YAML

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/docs"))
from commands import Commands  # noqa: E402 (found by the line above)


def calls(job: dict) -> Iterator[str]:
    """What a job's steps run, once for each command that its matrix names."""
    matrix = job.get("strategy", {}).get("matrix", {}).get("command", [""])
    for step in job.get("steps", []):
        for command in matrix:
            text = step.get("run", "").replace("${{ matrix.command }}", command)
            for _, line in Commands.lines(text):
                yield line.strip()


def main() -> int:
    known = Commands(ROOT)
    found: dict[str, None] = {}
    checked = 0
    for file in sorted((ROOT / ".github/workflows").glob("*.yml")):
        for job in YAML(typ="safe").load(file)["jobs"].values():
            for line in calls(job):
                checked += 1
                for problem in known.problems(line):
                    found[f"{file.relative_to(ROOT)}: {problem}"] = None
    for problem in found:
        print(problem)
    print(f"{checked} calls of ./dev")
    return 1 if found or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
