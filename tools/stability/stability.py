"""Runs the cases of ./dev stability, judges them, and writes JSON, tables and heat maps.

The native half runs once for each group and prints a line of JSON a case while this half judges the lines before. The
shaders run in the engine (shader_suite.py), also on the tables that the native half has fitted. A
group that crashes or says nothing for a while is a failed case of its own. The last line is
"stability: N passed, N failed"; the exit status is 1 if any failed and 130 after an interruption, which leaves nothing
behind.
"""

import argparse
import json
import os
import queue
import subprocess
import sys
import threading
import time
from pathlib import Path

import shader_suite
from judge import judge
from verdict import is_finite, broken

GROUPS = ("gaussian", "brdf", "step", "slice", "data", "table", "shader")
# Seconds without a line after which a group counts as hanging: the longest case takes about one on an idle core.
SILENCE = 120.0


class Progress:
    """One line on a terminal, a line for each group elsewhere."""

    def __init__(self):
        self.terminal = sys.stderr.isatty()
        self.shown = 0.0

    def show(self, group, done, count):
        now = time.monotonic()
        if self.terminal and (now - self.shown > 0.2 or done == count):
            self.shown = now
            print(f"\r\033[K{group}: {done}/{count}", end="", file=sys.stderr, flush=True)

    def end(self, line):
        print(("\r\033[K" if self.terminal else "") + line, file=sys.stderr, flush=True)


def native_lines(process, group):
    """The process's lines, parsed; raises TimeoutError after SILENCE."""
    lines = queue.Queue(maxsize=64)

    def read():
        for line in process.stdout:
            lines.put(line)
        lines.put(None)

    threading.Thread(target=read, daemon=True).start()
    while True:
        try:
            line = lines.get(timeout=SILENCE)
        except queue.Empty:
            raise TimeoutError(f"{group} printed nothing for {SILENCE:.0f} s") from None
        if line is None:
            return
        yield json.loads(line)


def run_group(tool, group, quick, progress, records=None, is_judged=True):
    """The verdicts; the records go into `records` too."""
    command = [str(tool.resolve()), group] + (["--quick"] if quick else [])
    results, done, count = [], 0, None
    started = time.monotonic()
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            for record in native_lines(process, group):
                if count is None:
                    count = record["cases"]
                    continue
                if is_judged:
                    results += judge(group, record)
                if records is not None:
                    records.append(record)
                done += 1
                progress.show(group, done, count)
            status = process.wait(timeout=SILENCE)
            if status != 0 or done != count:
                results.append(broken(group, f"ended with status {status} after {done} of {count} cases"))
        except (TimeoutError, json.JSONDecodeError) as error:
            results.append(broken(group, f"{error}, after {done} of {count} cases"))
        finally:
            # Also where this process is interrupted: the native one must not outlive it.
            process.kill()
    failed = sum(not result["passed"] for result in results)
    if is_judged:
        progress.end(f"{group}: {len(results)} cases, {failed} failed, {time.monotonic() - started:.0f} s")
    return results


def strict(value):
    """JSON knows no NaN and no infinity."""
    if isinstance(value, dict):
        return {key: strict(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [strict(item) for item in value]
    return value if is_finite(value) else None


def write_whole(path, text):
    """A temporary name first, so that a half-written file never has the real one."""
    temporary = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


def run(arguments):
    progress = Progress()
    results, tables = [], []
    for group in arguments.group or GROUPS:
        if group != "shader":
            records = tables if group == "table" else None
            results += run_group(arguments.tool, group, arguments.quick, progress, records)
    if "shader" in (arguments.group or GROUPS):
        if not tables:
            results += run_group(arguments.tool, "table", True, progress, tables, is_judged=False)
        results += shader_suite.run(arguments.quick, tables, progress)
    failures = [result for result in results if not result["passed"]]
    for result in failures:
        print(f"  {result['name']}: FAILED, {result['reason']}")
    if arguments.json:
        write_whole(arguments.json, json.dumps(strict({"cases": results}), indent=1, allow_nan=False) + "\n")
    if not arguments.quick and not arguments.group:
        import report  # matplotlib, which takes a second to load, only where it is needed

        report.write(results, arguments.out)
        progress.end(f"The report is in {arguments.out}.")
    print(f"stability: {len(results) - len(failures)} passed, {len(failures)} failed")
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=Path, required=True, help="lobelight_stability")
    parser.add_argument("--quick", action="store_true", help="the reduced set, without a report")
    parser.add_argument("--json", type=Path, help="every case")
    parser.add_argument("--out", type=Path, required=True, help="folder of the report")
    parser.add_argument("--group", action="append", choices=GROUPS, help="only this one, without a report")
    try:
        return run(parser.parse_args())
    except KeyboardInterrupt:
        print("\nstability: interrupted", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"stability: {error.filename}: {error.strerror}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
