#!/usr/bin/env python3
"""What exports leave out of several projects, and that their pictures stay the same: for `./dev diet --acceptance`.

acceptance.py --work DIR [--quick] [--out DIR] [--instructions] [--json FILE]

A project with the addon and some scenes is exported with all of the addon's run time, and once for each scene with the cut
and that scene alone. The packs draw the scenes in the three renderers, with --quick some of them in Compatibility alone. Bytes are those that the packs hold below
addons/lobelight. One line a check; ends with 1 if one fails.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/android"))
from pack_files import ADDON, read_files  # noqa: E402

import acceptance_page  # noqa: E402
import instructions  # noqa: E402

# The isotropic scene, by a light that was baked of its panorama.
BAKED = "baked"
LIGHT = f"tests/diet/scenes/{BAKED}_light.res"
# Of the panorama, in texels around.
LIGHT_WIDTH = 2048
OWN, OWN_ISOTROPIC = "own_shaders", "own_isotropic"
# Where what shaders of one's own need is, and nobody else does.
FOR_OWN = (f"{ADDON}/lobelight.gdshaderinc", f"{ADDON}/runtime/own_shaders/")
# The scenes, as the report names them.
SCENES = {
    "empty": "nothing of Lobelight",
    "isotropic": "one isotropic material, a static panorama",
    "anisotropic": "one anisotropic material, the scene's sky",
    "everything": "textures, clear coat, emission, capture",
    "by_script": "widths set by a script, the scene's sky",
    "panorama": "one isotropic material, a panorama that nothing else shows",
    BAKED: "one isotropic material, a baked light",
    OWN: "shaders of one's own, one of them anisotropic",
    OWN_ISOTROPIC: "an isotropic shader of one's own",
    # The last one, because its probe stays with the renderer for a while.
    "room": "one isotropic material in a room that a probe lights",
}
# The preset that cuts nothing.
WHOLE = "whole"
# The presets that export the isotropic scene alone, or that with a shader of its own, by what it depends on.
CHOSEN = "chosen"
CHOSEN_OWN = "chosen_own"
UNUSED = "tests/data/unused.exr"
# All that is drawn. The brushed one is there for a target: fewer lobes of a table beside all of them.
DRAWN = SCENES | {"brushed": "one anisotropic material of a table, the scene's sky"}
# Presets that ask for a PSNR: the scene, and decibels.
TARGETS = {"isotropic_target": ("isotropic", 30.0), "brushed_target": ("brushed", 24.0)}
PANORAMA = "demo/environments/sunset.exr"
START = '[gd_scene format=3]\n\n[node name="Start" type="Node"]\n'
LEAST_PSNR = 45.0
# Of the scene with a baked light, without tables.
MOST_RUN_TIME = 60 * 1024
MOST_LIGHT = 3_000_000
# Of the isotropic scene.
LEAST_SHARE_GONE = 0.8
SIDE = 128
# Rendering methods and their drivers. What materials are is the same in all, and told by the first that draws them.
RENDERERS = {"mobile": "vulkan", "forward_plus": "vulkan", "gl_compatibility": "opengl3"}
# What others than Compatibility draw with --quick: scenes of frozen materials, of materials that scripts change, and of everything.
# Rooms are drawn without it, and in Mobile by tests/render.
QUICK = {"mobile": ("isotropic", "by_script", "everything"), "forward_plus": ()}
COMPLAINT = re.compile(r"(^|\s)(SCRIPT |USER )?(ERROR|WARNING)(:|\s)|handle_crash|leaked at exit", re.MULTILINE)
# What the engine says in Compatibility wherever the driver draws in memory, and of a sky that another one follows.
ALWAYS_SAID = re.compile(r"^(WARNING: Could not set V-Sync mode|ERROR: Texture with GL ID of \d+: leaked).*$", re.MULTILINE)
# Uniforms of features, by what their names hold.
FEATURES = {
    "textures of its own": ("albedo_texture", "orm", "metallic_texture", "roughness_texture", "ao_", "normal", "flowmap"),
    "a clear coat": ("coat",),
    "emission": ("emitted", "emission"),
    "diffuse light": ("dielectric", "metallic", "specular_amount"),
    "anisotropy": ("anisotropy",),
    "widths per pixel": ("lobelight_widths",),
}
PLAIN = ("isotropic", "anisotropic", "by_script", "panorama")
# Scenes whose materials something may change, or whose lights take other shaders.
UNFROZEN = ("empty", "everything", "by_script", "room", OWN, OWN_ISOTROPIC)
# What nobody needs where all light is baked.
LIVE_PARTS = ("pyramid", "live", "skies", "rendering_device", "compatibility", "filters")
PROJECT = """config_version=5

[application]

config/name="Diet"
run/main_scene="res://start.tscn"
config/features=PackedStringArray("4.6", "Mobile")

[autoload]

Picture="*res://picture.gd"

[display]

window/size/viewport_width={side}
window/size/viewport_height={side}

[editor_plugins]

enabled=PackedStringArray("res://addons/lobelight/plugin.cfg")

[rendering]

renderer/rendering_method="mobile"
"""
PRESET = """[preset.{number}]

name="{name}"
platform="Linux"
runnable=false
{filter}
exclude_filter="{exclude}"
export_path=""
script_export_mode=2

[preset.{number}.options]

binary_format/architecture="x86_64"
lobelight/cut_tables={cut}
lobelight/freeze_materials={freeze}
lobelight/target_psnr={target}
"""


ALL_FILES = 'export_filter="all_resources"\ninclude_filter=""'
CHOSEN_FILES = 'export_filter="scenes"\n'
CHOSEN_FILES += 'export_files=PackedStringArray("res://start.tscn", "res://tests/diet/scenes/{scene}.tscn")\n'
CHOSEN_FILES += f'include_filter="{ADDON}/runtime/*"'


class AcceptanceError(Exception):
    """Says in one sentence what went wrong."""


def run_engine(*arguments, drawing=False, complaining=False):
    """The engine's output; an error or a warning in it ends the command, unless that is expected."""
    command = ["bash", str(ROOT / "tools/lib/with_display.sh")] if drawing else []
    command += [os.environ["GODOT"], *map(str, arguments)]
    # What a pack lacks, the engine looks for in the folder that it was called in.
    with tempfile.TemporaryDirectory() as nowhere:
        done = subprocess.run(
            command, cwd=nowhere, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
    text = ALWAYS_SAID.sub("", done.stdout.decode(errors="replace"))
    found = None if complaining else COMPLAINT.search(text)
    if done.returncode or found:
        line = text[found.start() :].strip().splitlines()[0] if found else f"status {done.returncode}"
        (ROOT / "build").mkdir(exist_ok=True)
        (ROOT / "build/diet.log").write_text(text, encoding="utf-8")
        raise AcceptanceError(f"the engine with {' '.join(map(str, arguments[:6]))}: {line} (all of it: build/diet.log)")
    return text


def make_project(project):
    """A project with the addon, the scenes, and a preset for each of them and each target."""
    shutil.rmtree(project, ignore_errors=True)
    scenes = project / "tests/diet/scenes"
    scenes.mkdir(parents=True)
    shutil.copytree(ROOT / ADDON, project / ADDON)
    for file in sorted((ROOT / "tests/diet/scenes").iterdir()):
        if file.name.split(".")[0] in DRAWN:
            shutil.copy(file, scenes)
    for name in ("tests/data/forest.exr", PANORAMA):
        (project / name).parent.mkdir(parents=True)
        for ending in ("", ".import"):
            shutil.copy(ROOT / f"{name}{ending}", project / f"{name}{ending}")
    (project / "start.tscn").write_text(START, encoding="utf-8")
    text = (scenes / "isotropic.tscn").read_text(encoding="utf-8")
    resource = f'[ext_resource type="Resource" path="res://{LIGHT}" id="light"]\n\n[sub_resource'
    text = text.replace("\n[sub_resource", resource, 1)
    text = text.replace('source = 2\npanorama = ExtResource("forest")', 'light = ExtResource("light")')
    (project / f"tests/diet/scenes/{BAKED}.tscn").write_text(text, encoding="utf-8")
    for name in ("picture.gd", "ask.gd", "bake_light.gd"):
        shutil.copy(ROOT / "tools/diet" / name, project)
    (project / "project.godot").write_text(PROJECT.format(side=SIDE), encoding="utf-8")
    # A panorama that no scene has.
    shutil.copy(ROOT / "tests/data/forest.exr", project / UNUSED)
    presets = []

    def add(name, files, exclude, cut="true", target=0.0, freeze="true"):
        exclude = ",".join(filter(None, [exclude, "bake_light.gd"]))
        values = {"name": name, "filter": files, "exclude": exclude, "cut": cut, "target": target, "freeze": freeze}
        presets.append(PRESET.format(number=len(presets), **values))

    add(WHOLE, ALL_FILES, "", cut="false")
    for name, (scene, target) in ({scene: (scene, 0.0) for scene in SCENES} | TARGETS).items():
        others = ",".join(f"tests/diet/scenes/{other}*" for other in DRAWN if other != scene)
        # A frozen material does not tell what it fetches.
        add(name, ALL_FILES, others, target=target, freeze="true" if target == 0.0 else "false")
    # All scripts count, and one of them binds materials.
    add(CHOSEN, CHOSEN_FILES.format(scene="isotropic"), f"tests/diet/scenes/{OWN}*")
    add(CHOSEN_OWN, CHOSEN_FILES.format(scene=OWN_ISOTROPIC), "")
    (project / "export_presets.cfg").write_text("\n".join(presets), encoding="utf-8")
    run_engine("--headless", "--path", project, "--import")
    arguments = ["res://tests/data/forest.exr", f"res://{LIGHT}", LIGHT_WIDTH]
    run_engine("--headless", "--path", project, "--script", "res://bake_light.gd", "--", *arguments)


def run_pack(pack, renderer, *arguments, **expected):
    """The output of a pack that draws, by one of RENDERERS."""
    return run_engine(
        *["--main-pack", pack, "--audio-driver", "Dummy"],
        *["--rendering-method", renderer, "--rendering-driver", RENDERERS[renderer], *arguments],
        drawing=True,
        **expected,
    )


def renderers_of(scene, quick):
    """Those that draw a scene."""
    return [name for name in RENDERERS if not quick or scene in QUICK.get(name, (scene,))]


def export(project, preset, scenes, folder, quick):
    """Exports a preset and draws scenes of the pack. Bytes below the addon by its folders, and by scene (materials,
    sizes of environments, pictures by renderer)."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    pack = folder / "game.pck"
    run_engine("--headless", "--path", project, "--export-pack", preset, pack)
    sizes = {}
    for name, size, _start in read_files(pack):
        if name.startswith(f"{ADDON}/"):
            part = name.split("/")[2]
            sizes[part] = sizes.get(part, 0) + size
    for renderer in RENDERERS:
        own = [f"res://tests/diet/scenes/{scene}.tscn" for scene in scenes if renderer in renderers_of(scene, quick)]
        if own:
            (folder / renderer).mkdir()
            run_pack(pack, renderer, "--", folder / renderer, *own)
    drawn = {}
    for scene in scenes:
        renderers = renderers_of(scene, quick)
        said = json.loads((folder / renderers[0] / f"{scene}.json").read_text(encoding="utf-8"))
        pictures = {renderer: read_picture(folder / renderer / f"{scene}.png") for renderer in renderers}
        drawn[scene] = (said["materials"], said["sizes"], pictures)
    return sizes, drawn


def read_picture(file):
    """(height, width, 3), from 0 to 1, as displayed."""
    return np.asarray(Image.open(file).convert("RGB"), dtype=float) / 255.0


def psnr(one, other):
    """Decibels between pictures; equal ones are 99 apart."""
    return min(-10.0 * np.log10(max(float(np.mean((one - other) ** 2)), 1e-12)), 99.0)


def features_of(material):
    """Which of FEATURES a material's shader has uniforms of."""
    return [
        feature
        for feature, parts in FEATURES.items()
        if any(part in uniform for uniform in material["uniforms"] for part in parts)
    ]


def is_same_shader(before, after):
    """Of a frozen material, the code has no #define and no include any more, but the same uniforms."""
    has_sources = "lobelight_sources" in before["uniforms"]
    uniforms = after["uniforms_for_sources" if has_sources and after["is_frozen"] else "uniforms"]
    return before["code"] == after["code"] or (after["is_frozen"] and before["uniforms"] == uniforms)


def row_of(scene, whole, cut, reason):
    """Of a scene: bytes before and after, materials, and how far apart the pictures are. `whole` and `cut` are of export()."""
    bytes_before, bytes_after = (sum(sizes.values()) for sizes, _drawn in (whole, cut))
    materials_before, sizes_before, pictures_before = whole[1][scene]
    materials, sizes, pictures = cut[1][scene]
    return {
        "scene": scene,
        "label": DRAWN[scene],
        "before": bytes_before,
        "after": bytes_after,
        "gone": 1.0 - bytes_after / bytes_before,
        "before_by_folder": whole[0],
        "after_by_folder": cut[0],
        "environments": {"before": sizes_before, "after": sizes},
        "psnr": {renderer: round(psnr(pictures_before[renderer], pictures[renderer]), 1) for renderer in pictures},
        "frozen": [material["is_frozen"] for material in materials],
        "same_shaders": all(map(is_same_shader, materials_before, materials)),
        "materials": [
            {
                "samplers": sum(material["uniforms"].values()),
                # Of frozen materials, those of what they were.
                "environment_fetches": (material["fetches"] or before["fetches"])["environment"],
                "table_fetches": (material["fetches"] or before["fetches"])["table"],
                "features": features_of(material),
                "code": material["code"],
            }
            for before, material in zip(materials_before, materials)
        ],
        "report": reason,
    }


class Checks:
    def __init__(self):
        self.passed = self.failed = 0

    def expect(self, name, holds):
        print(f"  {name}: {'passed' if holds else 'FAILED'}", flush=True)
        self.passed += bool(holds)
        self.failed += not holds


def check_chosen(checks, project, folder, rows):
    """Of a scene that is exported by what it depends on, another environment stays behind and the cut is as good."""
    folder.mkdir(parents=True, exist_ok=True)
    run_engine("--headless", "--path", project, "--export-pack", CHOSEN, folder / "game.pck")
    files = read_files(folder / "game.pck")
    names = " ".join(name for name, _size, _start in files)
    checks.expect("one scene: its panorama goes along", "forest.exr" in names)
    checks.expect("one scene: a panorama that it does not reach stays behind", "unused.exr" not in names)
    # Scripts of other scenes count, because classes may be reached by name.
    by_script = next(row for row in rows if row["scene"] == "by_script")
    ours = sum(size for name, size, _start in files if name.startswith(f"{ADDON}/"))
    checks.expect(f"one scene: {ours} bytes of the addon", 0 < ours <= by_script["after"])


def check_panorama(checks, whole, cut, rows):
    """A panorama that is finer than its cube map takes fewer bytes of the pack, all in all."""
    imported = sum(size for name, size, _start in read_files(whole) if "/sunset.exr-" in name)
    left = [name for name, _size, _start in read_files(cut) if "sunset" in name]
    checks.expect("panorama: what was imported stays behind", left == [f"{PANORAMA}.import"])
    row = next(row for row in rows if row["scene"] == "panorama")
    fitted = [(name, size) for name, size, _start in read_files(cut) if name.endswith(".ctex") and "exported/lobelight" in name]
    checks.expect("panorama: one is there in its place", len(fitted) == 1)
    row["panorama"] = {"before": imported, "after": sum(size for _name, size in fitted)}
    before, after = row["panorama"]["before"], row["panorama"]["after"]
    checks.expect(f"panorama: {before} bytes before, {after} after", 0 < after < before / 4)
    said = row["report"]["panoramas"]
    checks.expect("panorama: the report says so", [(one["before"], one["after"]) for one in said] == [(before, after)])


def check_probes(checks, work):
    """Only the scene with a probe has files of probes."""
    for scene in SCENES:
        folder = f"{ADDON}/runtime/probes/"
        files = [name for name, _size, _start in read_files(work / scene / "game.pck") if name.startswith(folder)]
        checks.expect(f"{scene}: {len(files)} files of probes", bool(files) == (scene == "room"))


def check_own_shaders(checks, work, rows, pictures):
    """What shaders of one's own need goes along with them and with nobody else, and all of it does."""
    names = {scene: " ".join(file[0] for file in read_files(work / scene / "game.pck")) for scene in SCENES}
    for scene, files in names.items():
        there = {part in files for part in FOR_OWN}
        checks.expect(f"{scene}: files for shaders of one's own", there == {scene in (OWN, OWN_ISOTROPIC)})
    for row in (row for row in rows if row["scene"] in (OWN, OWN_ISOTROPIC)):
        left = {entry["path"].split("/")[-1]: entry["after"] for entry in row["report"]["tables"] + row["report"]["files"]}
        is_brushed = row["scene"] == OWN
        checks.expect(f"{row['scene']}: {left['ggx_8.res']} bytes of lobes", (left["ggx_8.res"] > 1e6) == is_brushed)
        for part in ("line.gdshaderinc", "diffuse.gdshaderinc"):
            checks.expect(f"{row['scene']}: {left[part]} bytes of {part}", (left[part] > 1) == is_brushed)
        checks.expect(f"{row['scene']}: no class of materials", left["lobe_material_3d.gd"] == 0)
    # Of a chosen scene.
    folder = work / CHOSEN_OWN
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    run_engine("--headless", "--path", work / "project", "--export-pack", CHOSEN_OWN, folder / "game.pck")
    renderer, expected = next(iter(pictures[OWN_ISOTROPIC].items()))
    run_pack(folder / "game.pck", renderer, "--", folder, f"res://tests/diet/scenes/{OWN_ISOTROPIC}.tscn")
    decibels = psnr(read_picture(folder / f"{OWN_ISOTROPIC}.png"), expected)
    checks.expect(f"one scene with a shader of its own: {decibels:.1f} dB apart", decibels >= LEAST_PSNR)


def check_asking(checks, pack):
    """A script that reaches what the pack leaves out gets nothing, one sentence, and the light back when it asks no more."""
    scene = "res://tests/diet/scenes/isotropic.tscn"
    text = run_pack(pack, "gl_compatibility", "--script", "res://ask.gd", "--", scene, complaining=True)
    errors = [line for line in text.splitlines() if COMPLAINT.search(line)]
    for feature in ("conversion between materials", "light of skies and captures"):
        said = [line for line in errors if f"leaves out {feature}" in line and f'lobelight_features = ["{feature}"]' in line]
        checks.expect(f"asked for {feature}: one error says that they were left out", len(said) == 1)
    checks.expect(f"asked for what was left out: no other error of {len(errors)}", len(errors) == 2)
    for line in ("cube map before: true", "material: <null>", "cube map without: false", "cube map after: true"):
        checks.expect(f"asked for what was left out: {line}", line in text)


def check_targets(checks, targets):
    """Fewer lobes are drawn, they hold what was asked for, and the pictures are as near as that allows."""
    for row in targets:
        name, target = f"{row['scene']} with {row['target']:g} dB", row["target"]
        (said,) = row["report"]["lobes"]
        fetches = [material["environment_fetches"] for material in row["materials"]]
        checks.expect(f"{name}: {said['lobes']} lobes instead of {said['lobes_before']}", said["lobes"] < said["lobes_before"])
        checks.expect(f"{name}: as many are drawn", fetches == [said["lobes"]])
        checks.expect(f"{name}: {said['psnr']:.1f} dB are reached", said["psnr"] >= target)
        checks.expect(f"{name}: no set goes along", row["after_by_folder"].get("tables", 0) == 0)
        for renderer, decibels in row["psnr"].items():
            checks.expect(f"{name}: {renderer}, {decibels} dB from all lobes", decibels >= target)


def check_baked(checks, row, pack):
    """Where all light is baked, nothing that draws light goes along."""
    sizes = row["after_by_folder"]
    run_time = sum(size for folder, size in sizes.items() if folder != "tables")
    checks.expect(f"baked: {run_time} bytes of run time, {MOST_RUN_TIME} at most", run_time <= MOST_RUN_TIME)
    kept = [entry["path"].split("/")[-2] for entry in row["report"]["files"] if entry["after"] > 0]
    checks.expect("baked: nothing that draws light", not set(kept) & set(LIVE_PARTS))
    kept = [entry["path"] for entry in row["report"]["files"] if entry["after"] > 0]
    light = sum(size for name, size, _start in read_files(pack) if name == LIGHT)
    checks.expect(f"baked: {light} bytes of light, {MOST_LIGHT} at most", 0 < light <= MOST_LIGHT)
    checks.expect("baked: no shader that filters", not any(path.endswith(".gdshader") for path in kept))


def check(checks, rows, pictures):
    by_scene = {row["scene"]: row for row in rows}
    for row in rows:
        name = row["scene"]
        checks.expect(f"{name}: {row['before']} bytes before, {row['after']} after", row["after"] <= row["before"])
        for renderer, decibels in row["psnr"].items():
            checks.expect(f"{name}: {renderer}, {decibels} dB apart, {LEAST_PSNR} wanted", decibels >= LEAST_PSNR)
            checks.expect(f"{name}: {renderer}, the picture shows something", np.ptp(pictures[name][renderer]) > 0.3)
        checks.expect(f"{name}: the shaders are the same, too", row["same_shaders"])
        is_frozen = name not in UNFROZEN
        frozen = bool(row["frozen"]) and all(row["frozen"])
        checks.expect(f"{name}: materials are {'' if is_frozen else 'not '}frozen", frozen == is_frozen)
    gone = by_scene["isotropic"]["gone"]
    checks.expect(f"isotropic: {gone:.1%} of the bytes are gone, {LEAST_SHARE_GONE:.0%} wanted", gone >= LEAST_SHARE_GONE)
    for name in PLAIN:
        allowed = [] if name in ("isotropic", "panorama") else ["anisotropy"]
        for material in by_scene[name]["materials"]:
            checks.expect(f"{name}: what the material does not use is not in its shader", material["features"] == allowed)
            # The light, and what has the lobes; lobes along a long highlight are computed.
            wanted = 1 if name == "anisotropic" else 2
            checks.expect(f"{name}: samplers, {wanted} wanted", material["samplers"] == wanted)
    for name in PLAIN:
        row = by_scene[name]
        wanted = row["report"]["environment_size"]
        checks.expect(f"{name}: the environment has {wanted} texels a side", row["environments"]["after"] == [wanted])
        checks.expect(f"{name}: it was automatic and would be larger", row["environments"]["before"] == [0] and wanted < 512)
    full = by_scene["everything"]["materials"][0]["features"]
    checks.expect("everything: it is there where it is used", set(full) == set(FEATURES))
    # What says that pictures are the same must tell others apart.
    for renderer, other in pictures["by_script"].items():
        control = psnr(pictures["isotropic"][renderer], other)
        checks.expect(f"other widths are told apart: {renderer}, {control:.1f} dB", control < LEAST_PSNR)


def measure(work, quick, progress):
    """The rows of the scenes, those of TARGETS, and of each scene its pictures."""
    project = work / "project"
    # Of its own, so that the engine finds no shaders there that another driver compiled, and warns.
    shutil.rmtree(work / "user", ignore_errors=True)
    os.environ["XDG_DATA_HOME"] = str(work / "user")
    progress("importing")
    make_project(project)
    progress("everything of the addon")
    whole = export(project, WHOLE, list(DRAWN), work / WHOLE, quick)
    rows, pictures = [], {}
    for scene in SCENES:
        progress(scene)
        cut = export(project, scene, [scene], work / scene, quick)
        reason = json.loads((project / ".godot/lobelight_export.json").read_text(encoding="utf-8"))
        rows.append(row_of(scene, whole, cut, reason))
        pictures[scene] = cut[1][scene][2]
    targets = []
    for preset, (scene, target) in TARGETS.items():
        progress(f"{scene} with {target:g} dB")
        cut = export(project, preset, [scene], work / preset, quick)
        reason = json.loads((project / ".godot/lobelight_export.json").read_text(encoding="utf-8"))
        targets.append(row_of(scene, whole, cut, reason) | {"target": target})
    return rows, targets, pictures


def write(path, text):
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--instructions", action="store_true")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    steps = len(SCENES) + len(TARGETS) + 2
    said = iter(range(1, steps + 1))
    checks = Checks()
    try:
        work = options.work.resolve()
        rows, targets, pictures = measure(
            work, options.quick, lambda text: print(f"[{next(said)}/{steps}] {text}", file=sys.stderr, flush=True)
        )
        check_chosen(checks, work / "project", work / CHOSEN, rows)
        check_panorama(checks, work / WHOLE / "game.pck", work / "panorama/game.pck", rows)
        check_probes(checks, work)
        check_own_shaders(checks, work, rows, pictures)
        check_asking(checks, work / "isotropic_target/game.pck")
        if options.instructions:
            print("instructions", file=sys.stderr, flush=True)
            instructions.add(rows + targets, work / "instructions")
    except (AcceptanceError, instructions.EngineError, instructions.ListingError, OSError) as error:
        print(f"diet: {error}", file=sys.stderr)
        return 1
    check(checks, rows, pictures)
    check_baked(checks, next(row for row in rows if row["scene"] == BAKED), work / BAKED / "game.pck")
    check_targets(checks, targets)
    results = json.dumps({"scenes": rows, "targets": targets}, indent=1) + "\n"
    if options.json:
        write(options.json, results)
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        write(options.out / "results.json", results)
        write(options.out / "README.md", acceptance_page.page(rows, targets, LEAST_PSNR))
    print(f"diet: {checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed else 0


if __name__ == "__main__":
    sys.exit(main())
