"""What ./dev report makes of measurements, without drawing: made-up ones whose answers are known."""

import contextlib
import io
import json
import pathlib
import random
import re
import sys
import tempfile
import unittest
import unittest.mock
from html.parser import HTMLParser

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/report"))

import report  # noqa: E402 (finds the modules of the other folders)

import analysis  # noqa: E402
import batch  # noqa: E402
import cases  # noqa: E402
import document  # noqa: E402
import figures  # noqa: E402
import measurements  # noqa: E402
import pages  # noqa: E402
import runs  # noqa: E402
import verdicts  # noqa: E402

WHERE = {"machine": "a loom, 2 cores", "driver": "llvmpipe", "driver_version": "1.4", "engine": "4.6", "date": "2026-01-02"}
ISOTROPIC, ANISOTROPIC = ("ward", (0.1, 0.1)), ("ward", (0.05, 0.2))


def measured(psnr, fetches, rounds, baseline=None):
    """One method's, with the ratio to gmm8's rounds."""
    ratio = sorted(t / b for t, b in zip(rounds, baseline or rounds))[len(rounds) // 2] if rounds else None
    return {
        "fetches": fetches, "probes": fetches, "table_fetches": 0, "psnr": psnr, "flip": 0.01, "relative_rmse": 0.02,
        "gpu_ms": sorted(rounds)[len(rounds) // 2] if rounds else None, "gpu_ms_ratio": ratio, "gpu_ms_rounds": rounds,
        "fixed_ms": 0.1 if rounds else None, "gpu_ms_ratio_without_fixed": ratio, "settings": {},
    }  # fmt: skip


def entry(material, methods, **changes):
    """methods: {name: (dB, fetches, GPU ms)}; three rounds, of which the second is twice as slow for everybody."""
    rounds = {name: [own[2], 2 * own[2], own[2]] if own[2] else [] for name, own in methods.items()}
    made = {
        "study": "materials", "device": cases.SOFTWARE, "renderer": "mobile", "map": cases.TIMED_MAP, "brdf": material[0],
        "alpha": list(material[1]), "stage": {}, "size": 64, "samples": 64, "timing_rounds": 3, "timing_size": 256, "key": "k",
        "sheet": "", "where": WHERE, "unavailable": {}, "fixed_ms_rounds": [0.2, 0.4, 0.2],
        "methods": {n: measured(own[0], own[1], rounds[n], rounds.get("gmm8")) for n, own in methods.items()},
    }  # fmt: skip
    return {**made, **changes}


USUAL = {
    "gmm4": (35.0, 4, 0.6), "gmm8": (40.0, 8, 1.0), "gmm16": (41.0, 16, 1.8), "toral8": (26.0, 8, 1.1),
    "fis40": (31.0, 40, 3.3), "splitsum": (30.0, 1, 0.2), "reference": (60.0, 0, None),
}  # fmt: skip


def points_of(*values):
    return [analysis.Point(f"m{i}", time, psnr, 1) for i, (time, psnr) in enumerate(values)]


class ParetoTest(unittest.TestCase):
    def test_front_of_many(self):
        """On the front exactly if nothing else is at least as good in both and better in one."""
        numbers = random.Random(7)
        for count in (1, 2, 5, 40):
            found = points_of(*((numbers.randrange(12) / 4, float(numbers.randrange(12))) for _ in range(count)))
            front = analysis.pareto(found)
            for p in found:
                others = [q for q in found if (q.time, q.psnr) != (p.time, p.psnr)]
                beaten = any(q.time <= p.time and q.psnr >= p.psnr for q in others)
                equal_in_front = any((q.time, q.psnr) == (p.time, p.psnr) for q in front)
                self.assertEqual(equal_in_front, not beaten, p)
            self.assertTrue(all(a.time < b.time and a.psnr < b.psnr for a, b in zip(front, front[1:])))

    def test_without_times_there_is_no_front(self):
        self.assertEqual(analysis.pareto(points_of((None, 30.0))), [])

    def test_best_within_a_time(self):
        found = points_of((0.5, 30.0), (1.0, 40.0), (2.0, 40.0), (None, 99.0))
        self.assertIsNone(analysis.best_within(found, 0.4))
        self.assertEqual(analysis.best_within(found, 0.5).method, "m0")
        self.assertEqual(analysis.best_within(found, 0.99).method, "m0")
        # As accurate, but faster.
        self.assertEqual(analysis.best_within(found, float("inf")).method, "m1")

    def test_more_time_is_never_worse(self):
        numbers = random.Random(11)
        found = points_of(*((numbers.random() * 4, numbers.random() * 40) for _ in range(30)))
        best = [analysis.best_within(found, budget) for budget in cases.BUDGETS]
        values = [-1.0 if p is None else p.psnr for p in best]
        self.assertEqual(values, sorted(values))
        front = analysis.pareto(found)
        self.assertTrue(all(p is None or p in front for p in best))


class VerdictTest(unittest.TestCase):
    def test_rivals_on_the_front_are_named(self):
        (verdict,) = analysis.verdicts([entry(ISOTROPIC, USUAL)])
        self.assertEqual(verdict["front"], ["splitsum", "gmm4", "gmm8", "gmm16"])
        self.assertEqual([(rival.method, ours) for rival, ours in verdict["rivals"]], [("splitsum", None)])
        self.assertEqual(analysis.tally([verdict]), {"ours": 6, "rivals": 1, "none": 0})

    def test_a_rival_that_wins_is_not_hidden(self):
        (verdict,) = analysis.verdicts([entry(ISOTROPIC, {**USUAL, "fis40": (50.0, 40, 3.3)})])
        (_, (rival, ours)) = verdict["rivals"]
        self.assertEqual((rival.method, ours.method), ("fis40", "gmm16"))
        self.assertEqual(dict(verdict["best"])[float("inf")].method, "fis40")

    def test_budgets_of_fetches(self):
        """Whatever it takes: fewer fetches are within more; what is not drawn by fetches takes no part."""
        (verdict,) = analysis.verdicts([entry(ISOTROPIC, {**USUAL, "line8": (40.5, 8, 9.0)})])
        best = {budget: point and point.method for budget, point in verdict["best_by_fetches"]}
        self.assertEqual([best[n] for n in (1, 3, 4, 8, 16, 40)], ["splitsum", "splitsum", "gmm4", "line8", "gmm16", "gmm16"])
        count = analysis.tally([verdict], "best_by_fetches")
        self.assertEqual(count, {"ours": len(cases.FETCH_BUDGETS) - 3, "rivals": 3, "none": 0})

    def test_other_maps_take_the_times_of_the_timed_one(self):
        untimed = {name: (own[0] - 5.0, own[1], None) for name, own in USUAL.items()}
        entries = [entry(ISOTROPIC, USUAL), entry(ISOTROPIC, untimed, map="forest", timing_rounds=0)]
        verdict = analysis.verdicts(entries)[1]
        point = next(p for p in verdict["points"] if p.method == "fis40")
        self.assertEqual((point.psnr, round(point.time, 6)), (26.0, 3.3))

    def test_goals(self):
        entries = [entry(ISOTROPIC, USUAL), entry(ANISOTROPIC, USUAL)]
        first, second = analysis.goals(entries)
        self.assertEqual((first["method"], first["reached"]), ("gmm8", True))
        self.assertAlmostEqual(first["time"], 1 / 3.3)
        # The renderer's 0.2 ms of each.
        self.assertAlmostEqual(first["time_without_fixed"], 0.8 / 3.1)
        # Of different widths the fewest lobes that do.
        self.assertEqual((second["method"], second["reached"]), ("gmm4", True))

    def test_the_renderers_part_of_a_frame(self):
        entries = [entry(ISOTROPIC, USUAL), entry(ISOTROPIC, USUAL, renderer="forward_plus")]
        entries[1]["fixed_ms_rounds"] = [0.66, 1.32, 0.66]
        (first, *own), (second, *other) = analysis.fixed_parts(entries)
        self.assertEqual((first, second), ("mobile", "forward_plus"))
        self.assertEqual([round(v, 4) for v in (*own, *other)], [0.2, round(0.2 / 3.3, 4), 0.66, 0.2])

    def test_goals_are_missed_by_time_or_error(self):
        slow = {**USUAL, "fis40": (31.0, 40, 2.9)}
        (missed,) = analysis.goals([entry(ISOTROPIC, slow)])
        self.assertEqual((missed["method"], missed["reached"]), ("gmm8", False))
        coarse = {**USUAL, "fis40": (40.5, 40, 9.0)}
        (missed,) = analysis.goals([entry(ISOTROPIC, coarse)])
        self.assertFalse(missed["reached"])
        # Only sixteen lobes are as accurate, and they are.
        (reached,) = analysis.goals([entry(ANISOTROPIC, coarse)])
        self.assertEqual((reached["method"], reached["reached"]), ("gmm16", True))

    def test_the_thesis_is_judged_at_its_best_coverage(self):
        material = cases.THESIS_MATERIALS[0]
        entries = [
            entry(material, {**USUAL, "toral8": (29.0, 8, 1.0)}),
            entry(material, {"toral8": (35.0, 8, None)}, stage={"toral_coverage": 0.77}, study="coverage"),
        ]
        (row,) = analysis.thesis(entries)
        self.assertEqual((row["toral8"], row["above"], row["as_high"]), ((0.77, 35.0), True, True))
        (row,) = analysis.thesis(entries[:1])
        self.assertEqual((row["toral8"], row["above"], row["as_high"]), ((0.47, 29.0), False, False))


    def test_quartiles_are_of_the_rounds_ratios(self):
        """Rounds that slow everybody down alike leave no spread."""
        made = entry(ISOTROPIC, USUAL)
        self.assertEqual([round(v, 6) for v in analysis.ratio_range(made, "fis40")], [3.3, 3.3])
        made["methods"]["fis40"]["gpu_ms_rounds"] = [3.0, 8.0, 5.0]
        self.assertEqual([round(v, 6) for v in analysis.ratio_range(made, "fis40")], [3.5, 4.5])
        self.assertIsNone(analysis.ratio_range(made, "reference"))


class CasesTest(unittest.TestCase):
    def test_cases_are_told_apart(self):
        for plan in (cases.full(given_maps=("own",)), cases.quick(), cases.on_gpu()):
            names = [(case.name(), case.renderer) for case in plan]
            self.assertEqual(len(names), len(set(names)))
            self.assertTrue(all(cases.REFERENCE in case.methods for case in plan))

    def test_every_method_has_a_family_and_a_description(self):
        for method in cases.METHODS:
            self.assertNotEqual(cases.family_of(method), method)
            self.assertTrue(any(method.startswith(name) for name in verdicts.DESCRIPTIONS), method)

    def test_what_says_the_most_comes_first(self):
        """A run that is stopped early has the goals' cases, in every renderer."""
        plan = report.ordered(cases.full())
        timed = [case.timed for case in plan]
        self.assertEqual(timed, sorted(timed, reverse=True))
        first = plan[: timed.index(False)]
        self.assertEqual(list(dict.fromkeys(case.renderer for case in first)), list(cases.RENDERERS))
        for renderer in cases.RENDERERS:
            of_goal = [(c.brdf, tuple(c.alpha)) in analysis.goal_materials() for c in first if c.renderer == renderer]
            self.assertEqual(of_goal, sorted(of_goal, reverse=True))
            self.assertGreaterEqual(sum(of_goal), 4)

    def test_some_methods_only(self):
        plan = cases.only_methods(cases.full(), ("gmm8", "fis40"))
        self.assertTrue(all({"gmm8", "fis40"} & set(case.methods) for case in plan))
        self.assertTrue(all(set(case.methods) <= {"gmm8", "fis40", cases.REFERENCE} for case in plan))
        self.assertTrue(all(case.study != "coverage" for case in plan))

    def test_order_keeps_pyramids(self):
        """What shares a renderer, a map and settings is drawn in a row."""
        plan = report.ordered(cases.full())
        seen = [(case.renderer, case.timed, case.map, str(case.stage)) for case in plan]
        runs = [key for key, before in zip(seen, [None, *seen]) if key != before]
        self.assertEqual(len(runs), len(set(runs)))


class MeasurementsTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def options(self, *arguments):
        return report.read_options(["--quick", "--out", str(self.folder), *arguments])

    def test_what_is_measured_is_kept_while_nothing_changes(self):
        case, keys = cases.quick()[0], {cases.TIMED_MAP: "k"}
        kept = measurements.Measurements(self.folder)
        conditions = measurements.conditions_of(case, self.options(), keys)
        own = {name: measured(30.0, 8, []) for name in case.methods[:-1]}
        made = {**entry((case.brdf, case.alpha), {}), **conditions, "methods": own, "unavailable": {case.methods[-1]: "no"}}
        kept.add(made)
        kept.save()
        again = measurements.Measurements(self.folder)
        self.assertEqual(again.entry(conditions, case.methods), made)
        # A new method, other samples, other sources, or a picture that was deleted.
        self.assertIsNone(again.entry(conditions, [*case.methods, "new"]))
        for changed in (self.options("--samples", "9"), self.options("--size", "65"), self.options("--timing-rounds", "2")):
            self.assertIsNone(again.entry(measurements.conditions_of(case, changed, keys), case.methods))
        self.assertIsNone(again.entry({**conditions, "key": "other"}, case.methods))
        self.assertIsNone(again.entry(conditions, case.methods, pictured=True))
        # Measured anew, the old one goes.
        again.add({**made, "key": "other"})
        self.assertIsNone(again.entry(conditions, case.methods))

    def test_only_what_draws_makes_figures_stale(self):
        """Work on the editor and on other commands keeps what was measured; a shader, a table, a method does not."""
        files = ("addons/lobelight/runtime/shaders/lobe.gdshaderinc", "addons/lobelight/tables/ggx.res", "bake/comparison.gd")
        files += ("bake/comparators/fis.gd", "gdextension/src/fit/em.cpp", "addons/lobelight/runtime/pyramid/pyramid.gd")
        kept = ("addons/lobelight/editor/plugin.gd", "addons/lobelight/editor/export/diet.gd", "addons/lobelight/plugin.cfg")
        kept += ("bake/bake.gd", "bake/bake_demo.gd", "bake/recipes/brushed_ward.json", "demo/demo.gd")
        kept += ("addons/lobelight/doc_classes/LobeTable.xml",)
        for name in (*files, *kept):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text("a", encoding="utf-8")
        before = batch.source_key(self.folder)
        for name in kept:
            (self.folder / name).write_text("b", encoding="utf-8")
        self.assertEqual(batch.source_key(self.folder), before)
        for name in files:
            (self.folder / name).write_text("b", encoding="utf-8")
            self.assertNotEqual(batch.source_key(self.folder), before, name)
            (self.folder / name).write_text("a", encoding="utf-8")

    def test_a_broken_file_is_refused(self):
        (self.folder / "results.json").write_text('{"cases": [1]}', encoding="utf-8")
        with self.assertRaisesRegex(ValueError, "remove it"):
            measurements.Measurements(self.folder)

    def test_a_case_that_stops_the_engine_is_left_out(self):
        """The engine dies twice at the second of three cases; the others are measured."""
        plan = cases.quick()[:3]
        bad, tried = plan[1], []

        def draw(entries, *_):
            for index, one in enumerate(entries):
                tried.append(one["out"])
                if one["out"].endswith(bad.name()):
                    return
                yield index

        with contextlib.ExitStack() as changed:
            for place, name, value in (
                (batch, "draw", draw),
                (batch, "failure", lambda _: "it died"),
                (report, "judge", lambda *_: "fine"),
            ):
                changed.enter_context(unittest.mock.patch.object(place, name, value))
            changed.enter_context(contextlib.redirect_stderr(io.StringIO()))
            paths = dict.fromkeys([cases.TIMED_MAP], pathlib.Path("map"))
            left_out = report.measure(plan, self.options(), paths, {}, None)
        self.assertEqual(left_out, {bad.title(): "it died"})
        self.assertEqual([pathlib.Path(out).name for out in tried], [c.name() for c in (plan[0], bad, bad, plan[2])])

    def test_it_stops_when_the_time_is_over(self):
        """The case that is being drawn is kept; none is tried after it, and none counts as left out."""
        plan, tried = cases.quick()[:3], []

        def draw(entries, *_):
            for index in range(len(entries)):
                tried.append(index)
                yield index

        options = self.options("--minutes", "5")
        with contextlib.ExitStack() as changed:
            for place, name, value in (
                (batch, "draw", draw),
                (report, "judge", lambda *_: "fine"),
                (runs.Progress, "seconds", lambda progress: 200.0 * progress.done),
            ):
                changed.enter_context(unittest.mock.patch.object(place, name, value))
            changed.enter_context(contextlib.redirect_stderr(io.StringIO()))
            paths = dict.fromkeys([cases.TIMED_MAP], pathlib.Path("map"))
            self.assertEqual(report.measure(plan, options, paths, {}, None), {})
        self.assertEqual(tried, [0, 1])

    def test_a_software_driver_is_no_gpu(self):
        for plan in ({"driver": "llvmpipe (LLVM 21)", "driver_type": 0}, {"driver": "Some CPU", "driver_type": 4}):
            with self.assertRaisesRegex(runs.Problem, "found no GPU"):
                report.require_gpu(plan)
        report.require_gpu({"driver": "Radeon 780M", "driver_type": 1})


class PageTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "compare").mkdir()

    def write(self, entries, left_out=None, drawn=False):
        """The two pages' texts; without `drawn`, figures are empty files."""
        if not drawn:
            empty = unittest.mock.patch.object(figures, "save", lambda figure, path: (figures.plt.close(figure), path.touch()))
            self.enterContext(empty)
        summary = pages.write(self.folder, entries, self.folder / "elsewhere", left_out or {})
        json.dumps(summary, allow_nan=False)
        return [(self.folder / name).read_text(encoding="utf-8") for name in ("README.md", "index.html")]

    def entries(self):
        alone = {"fis40": (31.0, 40, None), "gmm8": (38.0, 8, None), "gmm16": (39.0, 16, None)}
        unavailable = {"stock": "not in this renderer"}
        return [
            entry(ISOTROPIC, USUAL, unavailable=unavailable),
            entry(ANISOTROPIC, {**USUAL, "gmm8": (36.123, 8, 1.0)}),
            entry(ISOTROPIC, {n: (own[0], own[1], None) for n, own in USUAL.items()}, map="forest", timing_rounds=0),
            entry(ISOTROPIC, alone, study="filter", stage={"filter": "box"}),
            entry(ISOTROPIC, alone, study="pyramid", stage={"pyramid_size": 64}),
            entry(ISOTROPIC, alone, study="bias", stage={"fis_bias": 1.0}),
            entry(cases.THESIS_MATERIALS[0], USUAL),
            entry(ISOTROPIC, USUAL, renderer="forward_plus"),
        ]

    def test_the_pages_numbers_are_the_measurements(self):
        entries = self.entries()
        markdown, html = self.write(entries)
        for e in entries:
            if e["stage"]:
                continue
            for method, own in e["methods"].items():
                time = "–" if own["gpu_ms"] is None else f"{own['gpu_ms']:.3f}"
                cells = [method, str(own["fetches"]), f"{own['psnr']:.2f}", time]
                row = re.escape(cells[0]) + r" \| " + cells[1] + r" \|.*\| " + re.escape(cells[2]) + r" \|.*\| " + re.escape(time)
                self.assertRegex(markdown, row)
                self.assertRegex(html, r"<td[^>]*>" + r"</td>.*<td[^>]*>".join(map(re.escape, cells)) + "</td>")

    def test_what_is_not_there_is_said(self):
        markdown, html = self.write(self.entries(), {"a case": "the engine stopped"})
        for text in (markdown, html):
            self.assertIn("not in this renderer", text)
            self.assertIn("the engine stopped", text)

    def test_pictures_and_sources(self):
        """Every picture that the pages show exists, and says where it was measured."""
        markdown, html = self.write(self.entries(), drawn=True)
        shown = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", markdown)
        self.assertGreaterEqual(len(shown), 6)
        self.assertEqual(sorted(shown), sorted(re.findall(r'<img src="([^"]+)"', html)))
        self.assertTrue(all((self.folder / name).is_file() for name in shown))
        after = re.findall(r"\*[^*\n]+\* `\./dev report`: ([^\n]+)", markdown)
        self.assertEqual(len(after), len(shown))
        self.assertTrue(all(WHERE[name] in line for line in after for name in WHERE))

    def test_labels_do_not_touch(self):
        numbers = random.Random(3)
        for count in (1, 2, 7, 30):
            values = [numbers.random() * 10 for _ in range(count)]
            places = figures.spread(values, 0.5)
            order = sorted(range(count), key=lambda i: values[i])
            self.assertTrue(all(places[b] - places[a] > 0.4999 for a, b in zip(order, order[1:])))
            self.assertAlmostEqual(sum(places), sum(values))
        self.assertEqual(figures.spread([1.0, 9.0, 4.0], 0.5), [1.0, 9.0, 4.0])

    def test_links_lead_to_files_that_exist(self):
        elsewhere = self.folder / "elsewhere/bench"
        elsewhere.mkdir(parents=True)
        (elsewhere / "README.md").write_text("x", encoding="utf-8")
        markdown, _ = self.write(self.entries())
        self.assertIn("](elsewhere/bench/README.md)", markdown)
        self.assertNotIn("stability/README.md", markdown)

    def test_bad_values_do_not_stop_it(self):
        """A method whose error is not known, times that were not taken, a single case."""
        without = {name: (own[0], own[1], None) for name, own in USUAL.items()}
        one = entry(ISOTROPIC, without, timing_rounds=0)
        one["methods"]["toral8"]["psnr"] = None
        markdown, _ = self.write([one])
        self.assertIn("| toral8 | 8 | 8 | 0 | – |", markdown)

    def test_every_tag_is_closed(self):
        _, html = self.write(self.entries())
        open_tags = []

        class Reader(HTMLParser):
            def handle_starttag(self, tag, attributes):
                if tag not in ("meta", "img"):
                    open_tags.append(tag)

            def handle_endtag(self, tag):
                assert open_tags.pop() == tag, tag

        Reader().feed(html)
        self.assertEqual(open_tags, [])

    def test_the_references_checks_are_shown(self):
        results = self.folder / "elsewhere/crosscheck/results.json"
        results.parent.mkdir(parents=True)
        own = {"check": "teapot", "brdf": "ggx", "alpha": [0.05, 0.3], "passed": True, "difference": -0.0021}
        results.write_text(json.dumps([own, {**own, "passed": False, "difference": 0.001}]), encoding="utf-8")
        markdown, _ = self.write(self.entries())
        self.assertIn("teapot without shadows | GGX (0.05, 0.3) | 1 of 2 | 0.210 % |", markdown)

    def test_a_changing_environment_costs_an_update(self):
        entries = self.entries()
        settings = {"gmm8": 9.0, "splitsum": 49.8}
        for method, time in settings.items():
            entries[0]["methods"][method]["settings"] = {"prefilter_ms": time}
        markdown, _ = self.write(entries)
        # (49.8 + 0.2) / (9 + 1).
        self.assertIn("| Ward (0.1, 0.1) | splitsum | 49.8 | 0.20 | 5.00 | 30.0 |", markdown)
        self.assertNotIn("| Ward (0.1, 0.1) | fis40 | ", markdown.split("When the environment changes")[1].split("</details>")[0])

    def test_updates_by_the_clock_are_not_mixed_with_gpu_times(self):
        entries = self.entries()
        own = entry(ISOTROPIC, USUAL, renderer="gl_compatibility")
        for method, time in {"gmm8": 8.0, "splitsum": 50.0}.items():
            own["methods"][method]["settings"] = {"prefilter_wall_ms": time}
        markdown, _ = self.write([*entries, own])
        self.assertIn("| Ward (0.1, 0.1) | gl_compatibility | splitsum | 50.0 | 6.25 | 30.0 |", markdown)
        self.assertNotIn("Updates and frames", markdown)

    def test_html_is_escaped(self):
        html = document.html_page("a < b", [document.Text("1 < 2 & `x<y>` **bold** [a](b.md)")])
        self.assertIn("1 &lt; 2 &amp; <code>x&lt;y&gt;</code> <strong>bold</strong>", html)
        self.assertIn('<a href="b.md">a</a>', html)


class OptionsTest(unittest.TestCase):
    def test_wrong_options_are_one_sentence(self):
        for arguments, text in (
            (["--renderers", "vulkan9"], "vulkan9"),
            (["--maps", "absent.exr"], "no such map"),
            (["--maps", "demo/environments/hall.exr"], "another map"),
            (["--size", "4"], "--size"),
            (["--json", "missing/x.json"], "folder does not exist"),
            (["--colour"], "--colour"),
        ):
            with self.assertRaisesRegex(runs.Problem, text), contextlib.chdir(ROOT):
                report.read_options(arguments)

    def test_only_the_whole_report_goes_to_docs(self):
        self.assertEqual(report.read_options([]).out, report.REPORT)
        self.assertEqual(report.read_options(["--device"]).out, report.REPORT)
        for arguments in (["--quick"], ["--size", "64"], ["--renderers", "mobile"]):
            self.assertNotEqual(report.read_options(arguments).out, report.REPORT)


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"report: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
