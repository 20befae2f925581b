"""How ./dev mobile-cost reads compilers: against listings that Mesa 26.1.6 wrote for a loop of 40 texture fetches.

Nothing is compiled here. tests/data/mobile_cost/adreno*.txt are IR3_SHADER_DEBUG=fs of one GLSL program,

    for (int k = 0; k < 40; k++) { … sum += textureLod(map, at, level) * exp2(-level); }

and mali-*.txt what the compilers for Mali say about an empty material of Godot's Compatibility.
"""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests/data/mobile_cost"
sys.path.insert(0, str(ROOT / "tools/mobile_cost"))

import engine  # noqa: E402
import ir3  # noqa: E402
import mali  # noqa: E402

TRIPS = 40
LISTINGS = ("adreno320", "adreno630", "adreno740")


def lines_of(name):
    return (DATA / f"{name}.txt").read_text(encoding="utf-8").splitlines(keepends=True)


def shader_of(lines):
    (listing,) = ir3.shaders_of(lines)
    return ir3.parse_listing(listing)


def listing_like(body, statistics="1 instr, 0 nops,"):
    """A listing of these instructions, with statistics that are not looked at."""
    categories = ", ".join(f"0 cat{i}" for i in range(8))
    end = [f"; FRAG prog 1/1: {statistics} 0 half, 1 full, {categories}, 0 sstall, 0 systall, 0 loops"]
    return ["Native code for unnamed FRAG shader", *body, *end, "; FRAG prog 1/1: 16 max_waves, 1 double_threadsize"]


class Ir3Test(unittest.TestCase):
    def test_counts_are_the_compilers(self):
        for name in LISTINGS:
            with self.subTest(name):
                shader = shader_of(lines_of(name))
                shader.check()
                counts = shader.once(shader.preamble_end())
                self.assertEqual(counts.slots, shader.statistics["instructions"])
                self.assertEqual(counts.fetches, 1)

    def test_loops_count_by_their_trips(self):
        for name in LISTINGS:
            with self.subTest(name):
                shader = shader_of(lines_of(name))
                (loop,) = shader.loops()
                self.assertEqual(loop.trips, TRIPS)
                once, weighted = shader.once(shader.preamble_end()), shader.weighted()
                self.assertEqual(weighted.fetches, TRIPS)
                inside = sum(x.slots for x in shader.instructions[loop.first : loop.last + 1])
                self.assertEqual(weighted.slots, once.slots + (TRIPS - 1) * inside)

    def test_a_changed_listing_is_refused(self):
        # Every line that is an instruction counts: without it, or twice, the totals differ.
        lines = lines_of("adreno630")
        end = next(i for i, line in enumerate(lines) if line.endswith(": end\n"))
        tried = 0
        for i, line in enumerate(lines[:end]):
            if ir3.parse_instruction(line.removeprefix("MESA: info: ").strip()) is None:
                continue
            tried += 1
            for changed in (lines[:i] + lines[i + 1 :], lines[: i + 1] + lines[i:]):
                with self.assertRaises(ir3.ListingError):
                    shader_of(changed).check()
        self.assertGreater(tried, 20)

    def test_other_registers_are_refused(self):
        # r5 would be a sixth one.
        lines = [re.sub(r"\br1\.w", "r5.w", line) if "(rpt1)mad" in line else line for line in lines_of("adreno630")]
        lines = [line.replace("(r)r1.z", "(r)r5.z") for line in lines]
        with self.assertRaises(ir3.ListingError):
            shader_of(lines).check()

    def test_lines_between_are_left_out(self):
        lines = lines_of("adreno320")
        lines[10:10] = ["WARNING: something else\n", "mobile-cost: drawing x\n"]
        shader_of(lines).check()

    def test_a_cut_listing_has_no_end(self):
        self.assertEqual(list(ir3.shaders_of(lines_of("adreno320")[:30])), [])

    def test_slots(self):
        cases = {
            "(ss)(rpt2)mad.f32 r0.x, (r)r1.x, c0.x, (r)r2.x": (3, 0),
            "(nop3) add.f r0.x, r0.x, r1.x": (4, 3),
            "(rpt5)nop": (6, 6),
            "swz.u32u32 r0.x, r0.y, r0.y, r0.x": (2, 0),
            "(sy)sam.3d (f32)(xyz)r1.z, r4.x, s#0, t#0": (1, 0),
        }
        for line, (slots, nops) in cases.items():
            with self.subTest(line):
                counts = ir3.Counts()
                counts.add(ir3.parse_instruction(line))
                self.assertEqual((counts.slots, counts.nops), (slots, nops))

    def test_trips(self):
        def trips(start, compare, step):
            body = [f"mov.u32u32 r0.x, {start}", "l1:", "sam (f32)(x)r1.x, r0.y, s#0, t#0", step, compare]
            shader = ir3.parse_listing(listing_like(body + ["br p0.x, #l5", "jump #l1", "l5:", "end"]))
            return shader.loops()[0].trips

        self.assertEqual(trips(0, "cmps.s.ge p0.x, r0.x, 12", "add.u r0.x, r0.x, 1"), 12)
        self.assertEqual(trips(2, "cmps.u.ge p0.x, r0.x, 12", "add.s r0.x, r0.x, 4"), 3)
        self.assertEqual(trips(0, "cmps.s.gt p0.x, r0.x, 12", "add.u r0.x, r0.x, 1"), 13)
        # A limit from a uniform, a start from an input, a step that is none.
        self.assertIsNone(trips(0, "cmps.s.ge p0.x, r0.x, c4.x", "add.u r0.x, r0.x, 1"))
        self.assertIsNone(trips("r3.x", "cmps.s.ge p0.x, r0.x, 12", "add.u r0.x, r0.x, 1"))
        self.assertIsNone(trips(0, "cmps.s.ge p0.x, r0.x, 12", "shl.b r0.x, r0.x, 1"))

    def test_prefetches_are_no_instructions(self):
        body = ["@tex(r0.z)	src=6, bindless=1, samp=33, tex=1, wrmask=0x7, opc=sam", "mov.f32f32 r0.x, r0.z", "end"]
        shader = ir3.parse_listing(listing_like(body))
        self.assertEqual((shader.prefetches, shader.weighted().fetches, shader.weighted().slots), (1, 0, 2))

    def test_loops_inside_loops(self):
        def count(register, limit):
            return [f"add.u {register}, {register}, 1", f"cmps.s.ge p0.x, {register}, {limit}"]

        body = ["mov.u32u32 r0.x, 0", "l1:", "mov.u32u32 r0.y, 0", "l2:", "sam (f32)(x)r1.x, r0.y, s#0, t#0"]
        body += [*count("r0.y", 3), "br p0.x, #l8", "jump #l2", "l8:", *count("r0.x", 5), "br p0.x, #l12", "jump #l1", "l12:", "end"]
        self.assertEqual(ir3.parse_listing(listing_like(body)).weighted().fetches, 15)


class EngineTest(unittest.TestCase):
    def test_the_specialised_pipeline_is_the_smaller_of_two(self):
        def shader(stage, program, instructions):
            return ir3.Shader(stage, program, 1, [], {}, [], 0, {"instructions": instructions})

        pipelines = [shader("VERT", 4, 30), shader("FRAG", 5, 400), shader("VERT", 6, 90), shader("FRAG", 7, 5000)]
        fragment, vertex = engine.specialised(pipelines)
        self.assertEqual((fragment.program, vertex.program), (5, 4))
        with self.assertRaises(engine.EngineError):
            engine.specialised(pipelines[:2])
        with self.assertRaises(engine.EngineError):
            engine.specialised([*pipelines, shader("FRAG", 9, 20)])


class MaliTest(unittest.TestCase):
    def test_statistics(self):
        bifrost, valhall = mali.row(lines_of("mali-g52")), mali.row(lines_of("mali-g610"))
        self.assertEqual((bifrost["instructions"], bifrost["registers"], bifrost["vertex"]), (228, 14, 74))
        self.assertEqual((bifrost["cycles"], bifrost["units"]["arith"], bifrost["waves"]), (7.25, 7.25, 2))
        # The vertex shader comes in two parts.
        self.assertEqual((valhall["instructions"], valhall["registers"], valhall["vertex"]), (295, 15, 87))
        self.assertEqual(valhall["units"]["sfu"], 1.875)

    def test_what_is_missing_is_said(self):
        with self.assertRaises(mali.StatisticsError):
            mali.row([line for line in lines_of("mali-g52") if "FRAGMENT" not in line])
        with self.assertRaises(mali.StatisticsError):
            mali.row([line.replace("registers used", "registers") for line in lines_of("mali-g52")])


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"cost: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
