"""Instructions a pixel of the acceptance's materials, from the compilers of tools/mobile_cost."""

import json
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "mobile_cost"))
import measure  # noqa: E402
from engine import EngineError  # noqa: E402, F401
from gpus import GPUS, Paths  # noqa: E402
from ir3 import ListingError  # noqa: E402, F401

# The thesis' phone in Compatibility, and a newer one in Mobile.
GPU_NAMES = ("adreno320", "adreno630")
# What the engine adds around any material.
BASE_CODE = """shader_type spatial;
render_mode ambient_light_disabled;
uniform vec3 light;
void fragment() { ALBEDO = light; METALLIC = 1.0; EMISSION = light; }
"""


def add(rows, work):
    """Gives every material of the rows `instructions`, {GPU: {"instructions", "own", "registers"}}: issue slots of the
    fragment shader as in docs/report/mobile-cost, and without what the engine takes for an empty material."""
    materials = [material for row in rows for material in row["materials"]]
    # Drivers compile what they know no second time.
    codes = list(dict.fromkeys([BASE_CODE, *(material["code"] for material in materials)]))
    names = [f"material_{number}" for number in range(len(codes))]
    variants = {name: {"kind": "shader", "code": code.splitlines()} for name, code in zip(names, codes)}
    work.mkdir(parents=True, exist_ok=True)
    file = work / "variants.json"
    file.write_text(json.dumps(variants), encoding="utf-8")
    os.environ["LOBELIGHT_VARIANTS"] = str(file)
    paths = Paths(os.environ["MOBILE_ENGINE"], os.environ["MOBILE_COMPILERS"], work)
    for name in measure.capture(names, paths):
        print(f"GLSL of {name}", file=sys.stderr, flush=True)
    for gpu in (GPUS[name] for name in GPU_NAMES):
        method = measure.mobile if gpu.renderer == "mobile" else measure.compatibility
        counted = dict(method(gpu, names, paths))
        rows_of = {code: counted[name] for name, code in zip(names, codes)}
        for material in materials:
            row = rows_of[material["code"]]
            material.setdefault("instructions", {})[gpu.label] = {
                "instructions": row["instructions"],
                "own": row["instructions"] - rows_of[BASE_CODE]["instructions"],
                "registers": row["registers"],
            }
