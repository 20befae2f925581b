"""Reads what Mesa's compilers for Mali GPUs say about a shader, one line of KHR_debug:

    Bifrost (G52): "MESA_SHADER_FRAGMENT shader: 1369 instrs, 1130 tuples, 158 clauses, 46.0 cycles, 46.0 arith, 8.0 t,
                    18.0 ldst, 0.5 v, 16 preloads, 1 threads, 15312 code size, 0 loops, 0:0 spills:fills, …"
    Valhall (G610): "… 1556 instrs, 18.0 cycles, 13.9 fma, 7.2 cvt, 10.1 sfu, 1.5 v, 2.0 t, 18.0 ls, …"

Cycles are the compiler's own estimate of a pixel's cost in its busiest unit; `arith`, `fma`, `cvt`, `sfu`, `t` (textures),
`ldst` and `ls` (memory, uniforms), `v` (varyings) are those of the units. `threads` is 2 if so few registers are used that
twice as many threads run at once. Loops are counted once, and `row` says where there is one: over the lights around a pixel.
"""

import re

_SHADER = re.compile(r"gl: said MESA_SHADER_(FRAGMENT|VERTEX|POSITION) shader: (.*)")


class StatisticsError(Exception):
    """Says in one sentence what of the statistics is missing."""


def read_statistics(text):
    """{name: number} of "1369 instrs, 1130 tuples, …"."""
    return {name: float(number) for number, name in re.findall(r"([\d.]+) ([a-z][a-z ]*)(?:,|$)", text)}


def row(lines):
    """As measure.adreno_row; "texture" is left out, since the compiler gives the unit's cycles and not the fetches."""
    found = {stage: read_statistics(text) for stage, text in (m.groups() for m in map(_SHADER.match, lines) if m)}
    if not {"FRAGMENT", "VERTEX"} <= set(found):
        raise StatisticsError("the compiler's statistics of the fragment and the vertex shader are not both there")
    fragment = found["FRAGMENT"]
    for name in ("instrs", "cycles", "threads", "loops", "registers used"):
        if name not in fragment:
            raise StatisticsError(f"the compiler's statistics have no {name}")
    units = {name: fragment[name] for name in ("arith", "fma", "cvt", "sfu", "t", "ldst", "ls", "v") if name in fragment}
    return {
        "instructions": int(fragment["instrs"]),
        "registers": int(fragment["registers used"]),
        "cycles": fragment["cycles"],
        "units": units,
        "waves": int(fragment["threads"]),
        "static": int(fragment["instrs"]),
        "unknown_loops": int(fragment["loops"]),
        # Valhall has one shader for the position and one for the rest.
        "vertex": int(sum(found[stage]["instrs"] for stage in ("POSITION", "VERTEX") if stage in found)),
    }
