"""Copies of the shaders in a project of their own: changed in one place, or with mediump rounded."""

from probes import ROOT

RUNTIME = "addons/lobelight/runtime"
FOR_OTHERS = "addons/lobelight/lobelight.gdshaderinc"
SCRIPTS = ("light/lobe_light.gd", "on_demand.gd", "pyramid/canvas_pass.gd", "pyramid/pyramid.gd")
PROJECT = """config_version=5

[application]

config/name="Stability"

[rendering]

textures/vram_compression/import_etc2_astc=true
"""

CLASSES = f"""list=[{{
"base": &"Resource",
"class": &"LobeLight",
"icon": "",
"is_abstract": false,
"is_tool": true,
"language": &"GDScript",
"path": "res://{RUNTIME}/light/lobe_light.gd"
}}]
"""


def shaders():
    """The shaders of the run time, and what those of others include."""
    own = (path for path in (ROOT / RUNTIME).rglob("*.gdshader*") if path.suffix != ".uid")
    return sorted([*own, ROOT / FOR_OTHERS])


def copy_shaders(project, change, variant=""):
    """What stability.gd needs, below `project`, or below variants/`variant` in it; returns the folder as res://.

    change(name, text) gives the text of each shader of the run time."""
    root = f"res://variants/{variant}/" if variant else "res://"
    folder = project / "variants" / variant if variant else project
    scripts = [f"{RUNTIME}/{name}" for name in SCRIPTS]
    sources = [ROOT / name for name in scripts]
    own = shaders()
    sources += own
    sources += sorted((ROOT / "bake/stability").rglob("*.gd*"))
    for source in sources:
        if source.suffix not in (".gd", ".gdshader", ".gdshaderinc"):
            continue
        target = folder / source.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        text = source.read_text(encoding="utf-8").replace("res://", root)
        if source in own:
            text = change(source.name, text)
        target.write_text(text, encoding="utf-8")
    # The project is not imported, which is what finds classes.
    classes = project / ".godot/global_script_class_cache.cfg"
    classes.parent.mkdir(exist_ok=True)
    classes.write_text(CLASSES, encoding="utf-8")
    if not (project / "project.godot").exists():
        (project / "project.godot").write_text(PROJECT, encoding="utf-8")
    return root
