"""./dev stability finds a change of one constant in any of the shaders.

Each file of the run time's shaders is copied with one of its constants changed, and the probes that run it are judged: at
least one has to fail. The same probes pass with the files as they are. All copies are drawn by one run of the engine.
"""

import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/stability"))

import mediump  # noqa: E402
import probes  # noqa: E402
import projects  # noqa: E402
import shader_pyramid  # noqa: E402
import shader_suite  # noqa: E402

# Compatibility starts fastest, and has branches that the others lack.
RENDERER = "gl_compatibility"

# By file: a constant, what it becomes, and what probes run it.
CHANGES = {
    "clear_coat.gdshaderinc": ("LOBELIGHT_COAT_F0 = 0.04", "LOBELIGHT_COAT_F0 = 0.041", ["coat_levels"]),
    "colour.gdshaderinc": ("6.97891534", "6.98891534", ["colour"]),
    "cube_faces.gdshaderinc": ("return vec3(p.x, 1.0, p.y);", "return vec3(p.x, 1.001, p.y);", ["faces"]),
    "diffuse.gdshaderinc": ("ASIDE = 0.645833", "ASIDE = 0.655833", ["diffuse_directions"]),
    "environment.gdshaderinc": ("0.5175971", "0.5275971", ["level_disc_size_16"]),
    "fades.gdshaderinc": ("opacity < 0.001", "opacity < 0.002", ["fades"]),
    "frame.gdshaderinc": ("square_ < 1e8", "square_ < 1e2", ["frame"]),
    "half_float.gdshaderinc": ("0xFFFu", "0xFFEu", ["half"]),
    "lamps.gdshaderinc": ("return lobelight_rim_amount;", "return lobelight_rim_amount.yx;", ["fades"]),
    "line.gdshaderinc": ("REACH = 2.84", "REACH = 2.85", ["line_ggx_16"]),
    "lobe_table.gdshaderinc": ("0.1141528", "0.1151528", ["position_16x8_lobes_1"]),
    "lobelight.gdshaderinc": ("f0_ = 0.16 *", "f0_ = 0.163 *", ["own_lines_flat"]),
    "material.gdshaderinc": ("max(1.0 - share, 0.0)", "max(0.99 - share, 0.0)", ["material_everything_levels"]),
    "material_inputs.gdshaderinc": ("texel * 2.0 - 1.0", "texel * 2.0 - 0.99", ["material_with_maps_directions"]),
    "normal_variance.gdshaderinc": ("texels / 16.0", "texels / 16.1", ["antialiasing"]),
    "occlusion.gdshaderinc": ("2.0 / 3.0 - occlusion", "2.1 / 3.0 - occlusion", ["occlusion"]),
    "panorama.gdshaderinc": ("0.156583", "0.157583", ["panorama_1"]),
    "placed_light.gdshaderinc": ("along = p_ * quotient_", "along = 0.999 * p_ * quotient_", ["placed_0"]),
    "pyramid_pack.gdshader": ("uvec4(255u)", "uvec4(254u)", ["pack_4_0"]),
    "panorama_level.gdshaderinc": ("sqrt(3.0 * variance)", "sqrt(3.1 * variance)", ["pyramid_disc_16_32"]),
    "pyramid_reduce.gdshader": ("near_x ? 3.0", "near_x ? 2.9", ["pyramid_binomial_16_32"]),
    "pyramid_round.gdshader": ("1.0 - 0.25 /", "1.0 - 0.35 /", ["pyramid_disc_16_32"]),
    "round_kernel.gdshaderinc": ("RIM_VARIANCE = 0.104", "RIM_VARIANCE = 0.124", ["pyramid_disc_16_32"]),
    "sheen.gdshaderinc": ("over.kept = 1.0 -", "over.kept = 1.003 -", ["sheen_levels"]),
    "source_highlights.gdshaderinc": ("+ 2.50662827", "+ 2.51662827", ["sources"]),
    "sources.gdshaderinc": ("reach_ = 1.5957691", "reach_ = 1.5967691", ["sources"]),
    "specular.gdshaderinc": ("reflection_.albedo, 0.05) - 1.0", "reflection_.albedo, 0.05) - 0.999", ["reflect_3_long_levels"]),
    "triplanar.gdshaderinc": ("share.y + share.z", "share.y + 0.999 * share.z", ["planes"]),
    "views.gdshaderinc": ("vec3(2.4)", "vec3(2.41)", ["views_1"]),
    "views_level.gdshaderinc": ("float(samples * samples)", "float(samples * samples + 1)", ["views_1"]),
    "widths.gdshaderinc": ("1.0 - 0.9 * anisotropy", "1.0 - 0.91 * anisotropy", ["widths_9_anisotropic"]),
}

# The engine's formulas, drawn beside its own material: tests/render/vocabulary_coordinates_test.gd and engine_diffuse_test.gd.
BESIDE_THE_ENGINE = {
    "coordinates.gdshaderinc",
    "detail.gdshaderinc",
    "engine_light.gdshaderinc",
    # Its numbers are those of the engine's antialiasing, drawn in tests/render/line_shift_test.gd.
    "line_shift.gdshaderinc",
    # Compared with LobeTableSet.table_at() by tests/render/moving_widths_test.gd.
    "mix_tables.gdshader",
    "msdf.gdshaderinc",
    "parallax.gdshaderinc",
    "vertex.gdshaderinc",
    "vertices.gdshaderinc",
}

# What they find is compared with what the library finds, and with all the light that there is, by
# tests/render/live_sources_test.gd.
SEARCHES_SOURCES = {
    "moment_units.gdshaderinc",
    "panorama_rest.gdshaderinc",
    "panorama_texels.gdshaderinc",
    "pyramid_rest.gdshader",
    "seed_numbers.gdshaderinc",
    "source_cells.gdshaderinc",
    "source_excess.gdshaderinc",
    "source_found.gdshader",
    "source_grid.gdshaderinc",
    "source_map.gdshaderinc",
    "source_pack.gdshader",
    "source_peaks.gdshaderinc",
    "source_reach.gdshaderinc",
    "source_rest.gdshaderinc",
    "source_rows.gdshaderinc",
    "source_seeds.gdshaderinc",
    "source_shapes.gdshaderinc",
    "split_float.gdshaderinc",
    "view_texels.gdshaderinc",
    "views_rest.gdshader",
}
# Nothing but an include.
WITHOUT_ARITHMETIC = {"nodes.gdshaderinc", "pyramid_panorama.gdshader", "pyramid_views.gdshader"}


def changed(wanted, old, new):
    def change(name, text):
        if name != wanted:
            return text
        if old not in text:
            raise AssertionError(f"{name} has no longer {old!r}: choose another constant")
        return text.replace(old, new)

    return change


class ShaderChanges(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="stability-test-")
        folder = pathlib.Path(cls.folder.name)
        project = folder / "project"
        textures, every, passes, pyramids = shader_suite.make(True, [])
        cls.kinds = [{one.name.removeprefix("table_"): one for one in some} for some in (every, passes, pyramids)]
        named = sorted({name for _old, _new, names in CHANGES.values() for name in names})
        projects.copy_shaders(project, lambda _name, text: text)
        jobs = [[(kind[name], 0, "res://") for name in named if name in kind] for kind in cls.kinds]
        for number, (file, (old, new, names)) in enumerate(CHANGES.items(), start=1):
            root = projects.copy_shaders(project, changed(file, old, new), f"v{number}")
            for kind, some in zip(cls.kinds, jobs):
                some += [(kind[name], number, root) for name in names if name in kind]
        cls.out = folder / "out"
        probes.write_jobs(folder, textures, *jobs)
        probes.run_engine(RENDERER, folder, cls.out, project)
        cls.expectations = probes.Expectations()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def verdicts(self, name, number):
        every, passes, pyramids = self.kinds
        if name in every:
            found = probes.read_results(self.out, every[name], number)
            return probes.judge(every[name], found, RENDERER, self.expectations, "single")
        one = (passes | pyramids)[name]
        return one.judge(shader_pyramid.reader(self.out, one, number), RENDERER)

    def test_every_shader_is_changed_once(self):
        files = {path.name for path in projects.shaders()}
        self.assertEqual(set(CHANGES) | BESIDE_THE_ENGINE | SEARCHES_SOURCES | WITHOUT_ARITHMETIC, files)
        self.assertEqual(set(CHANGES) & BESIDE_THE_ENGINE, set())

    def test_the_shaders_as_they_are_pass(self):
        for name in sorted({name for _old, _new, names in CHANGES.values() for name in names}):
            self.assertEqual([v["reason"] for v in self.verdicts(name, 0) if not v["passed"]], [], name)


class Constants(unittest.TestCase):
    def test_none_is_too_small_for_the_engine(self):
        """Godot 4.6 hands constants on with 14 decimals or so: smaller ones become 0."""
        small = []
        for folder in ("addons", "bake", "demo", "tests"):
            for path in (ROOT / folder).rglob("*.gdshader*"):
                if path.suffix != ".uid":
                    code = mediump.COMMENT.sub("", path.read_text(encoding="utf-8"))
                    numbers = re.findall(r"(?<![\w.])[\d.]+e-\d+", code)
                    small += [f"{path.name}: {number}" for number in numbers if float(number) < 1e-12]
        self.assertEqual(small, [])


class Mediump(unittest.TestCase):
    def test_fetches_are_rounded(self):
        text = "uniform mediump sampler2D map;\nvec4 f(vec2 p) { return textureLod(map, p * (1.0 + p.x), 0.0); }\n"
        rounded = mediump.round_mediump(text, {"map"})
        self.assertIn("half_of_phones(textureLod(map, p * (1.0 + p.x), 0.0))", rounded)

    def test_arithmetic_of_mediump_is_rounded(self):
        text = "mediump vec2 t = f();\nhighp float u = 3.0 - t.x - t.y;\nhighp float v = w * t.x;\n"
        rounded = mediump.round_mediump(text, {"map"})
        self.assertIn("half_of_phones_1(half_of_phones_1(3.0 - t.x) - t.y)", rounded)
        self.assertIn("v = w * t.x;", rounded)

    def test_what_it_does_not_know_is_refused(self):
        with self.assertRaises(mediump.UnknownForm):
            mediump.round_mediump("mediump float f(mediump vec2 p);\n", {"map"})

    def test_every_shader_can_be_rounded(self):
        change = mediump.change_of(projects.shaders())
        rounded = 0
        for path in (path for path in projects.shaders() if path.suffix == ".gdshaderinc"):
            rounded += change(path.name, path.read_text(encoding="utf-8")).count("half_of_phones(")
        # The table twice over and its tints, the coat's table and the sheen's, each twice, the environment for lobes and diffuse light, and of
        # placed lights that, four probes, their array and three more environments.
        self.assertEqual(rounded, 19)


def add_tests():
    """One for each file."""
    for number, (file, (_old, _new, names)) in enumerate(CHANGES.items(), start=1):

        def finds_it(self, number=number, names=names):
            found = [verdict for name in names for verdict in self.verdicts(name, number)]
            self.assertTrue(any(not verdict["passed"] for verdict in found))

        setattr(ShaderChanges, f"test_a_change_is_found_in_{file.replace('.', '_')}", finds_it)


add_tests()

if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"stability-changes: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
