"""Many comparisons in one run of the engine (bake/compare_list.gd), and what their pictures depend on."""

import contextlib
import hashlib
import json
import os
import pathlib
import signal
import subprocess

import metrics

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ("gdextension/src", "addons/lobelight", "bake")
# The library is built from the sources and has other bytes on every machine; the rest draws nothing here.
LEFT_OUT = (
    "addons/lobelight/bin/",
    "addons/lobelight/editor/",
    "bake/bake.gd",
    "bake/bake_demo.gd",
    "bake/bake_tables.gd",
    "bake/compare.gd",
    "bake/recipes/",
)
ENDINGS = {".cpp", ".h", ".gd", ".gdshader", ".gdshaderinc", ".res", ".tres", ".json"}
ENGINE = 'source "$0/tools/lib/common.sh"; godot_rendered "$@"'
DONE = "compared "


def source_key(root=ROOT):
    """Hash of the names and contents of everything that a picture is made with."""
    digest = hashlib.sha256()
    for folder in SOURCES:
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix in ENDINGS and not name.startswith(LEFT_OUT):
                digest.update(name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def case_key(sources, map_path):
    """Short hash of source_key() and of a map's contents."""
    return hashlib.sha256(sources.encode() + map_path.read_bytes()).hexdigest()[:16]


def draw(entries, renderer, folder, environment=None):
    """Yields the index of each entry as soon as it is drawn; fewer where the engine stops before the last one.

    entries: dictionaries as bake/compare_list.gd wants them. The engine's messages go to folder/engine.log, see
    failure(). environment: variables beside those of this process. Leaving the loop stops the engine.
    """
    work_list, log = folder / f"list-{os.getpid()}.json", folder / "engine.log"
    work_list.write_text(json.dumps(entries), encoding="utf-8")
    command = ["bash", "-c", ENGINE, str(ROOT), renderer, "--no-header"]
    command += ["--script", "res://bake/compare_list.gd", "--", "--list", str(work_list)]
    done = 0
    with log.open("w", encoding="utf-8") as messages:
        engine = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=messages,
            stdin=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
            env={**os.environ, **(environment or {}), "LOBELIGHT_TERMINAL": "0"},
        )
        try:
            for line in engine.stdout:
                if line.startswith(DONE):
                    done += 1
                    yield int(line.removeprefix(DONE))
        finally:
            if engine.poll() is None and done < len(entries):
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(engine.pid, signal.SIGTERM)
            engine.wait()
            work_list.unlink()


def failure(folder):
    """Why the engine stopped: its own sentence, or where its messages are."""
    log = folder / "engine.log"
    said = [
        line.split(": ", 1)[1]
        for line in log.read_text(encoding="utf-8", errors="replace").splitlines()
        if line.startswith(("accuracy: ", "lobelight: "))
    ]
    return said[-1] if said else f"the engine stopped before the last case; its output: {log}"


def judge(folder):
    """metrics.judge() without the methods whose pictures cannot be judged: (plan, rows); plan["unavailable"] says why."""
    path = pathlib.Path(folder) / "plan.json"
    while True:
        try:
            return metrics.judge(str(folder))
        except metrics.MetricError as problem:
            plan = json.loads(path.read_text(encoding="utf-8"))
            bad = next((m for m in plan["methods"] if f"{m['method']}.exr" in str(problem)), None)
            if bad is None or bad["method"] == "reference":
                raise
            plan["methods"].remove(bad)
            reason = str(problem).replace(f"{folder}{os.sep}", "")
            plan["unavailable"] = {**plan.get("unavailable", {}), bad["method"]: reason}
            metrics.write_json(str(path), plan)
