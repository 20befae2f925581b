#!/usr/bin/env python3
"""./dev bench runtime --out from end to end, small, and what its page makes of measurements."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/bench"))

import runtime_report  # noqa: E402


class BenchRuntimeTest(unittest.TestCase):
    def test_a_small_run_writes_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "runtime"
            options = ["--renderer", "gl_compatibility", "--what", "memory,first-light", "--scale", "16", "--rounds", "1"]
            run = subprocess.run(
                [str(ROOT / "dev"), "bench", "runtime", *options, "--out", str(out)], capture_output=True, text=True, check=False
            )
            self.assertEqual(run.returncode, 0, run.stderr)
            results = json.loads((out / "results.json").read_text(encoding="utf-8"))
            self.assertEqual({row["renderer"] for row in results}, {"gl_compatibility"})
            lights = {row["mode"]: row for row in results if row["what"] == "first-light"}
            self.assertEqual(set(lights), {"once", "time_sliced"})
            for row in lights.values():
                self.assertGreater(row["frame_ms"], 0.0)
                self.assertGreater(row["longest_frame_ratio"], 0.0)
                self.assertGreaterEqual(row["until_light"], 1)
            self.assertGreater(lights["time_sliced"]["turn_longest_frame_ratio"], 0.0)
            bytes_of = {row["thing"]: row["texture_mib"] for row in results if row["what"] == "memory"}
            # Six faces of 128 texels and their levels, half floats, take 1 MiB.
            self.assertGreater(bytes_of["live light"], 0.9)
            self.assertGreater(bytes_of["baked light"], 0.0)
            self.assertGreater(bytes_of["tables of a material"], 0.0)
            page = (out / "README.md").read_text(encoding="utf-8")
            self.assertIn("## First light", page)
            self.assertNotIn("## Updates", page)
            self.assertTrue((out / "runtime.svg").stat().st_size > 0)

    def test_shares_of_what_is_to_be_kept(self):
        rows = [
            {"what": "first-light", "renderer": "mobile", "mode": "once", "first_light_frames": 8.0},
            {"what": "first-light", "renderer": "mobile", "mode": "time_sliced", "turn_longest_frame_ratio": 1.0},
            {"what": "idle", "renderer": "mobile", "source": "sky", "script_usec": 2.5},
            {"what": "properties", "renderer": "mobile", "property": "emission", "ratio": 6.0},
            {"what": "memory", "renderer": "mobile", "thing": "baked light", "texture_mib": 1.5},
            {"what": "memory", "renderer": "mobile", "thing": "live light", "texture_mib": 16.0},
        ]
        self.assertEqual([share for _, _, share in runtime_report.bounds(rows)], [2.0, 0.5, 0.5, 1.5, 0.5])


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"bench-runtime: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
