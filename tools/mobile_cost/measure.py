"""Compiles variants for a GPU and counts: a row for each variant.

A row: {"gpu", "renderer", "variant", "instructions" (issue slots of the fragment shader a pixel, loops by their trips),
"registers" (vectors of four 32-bit numbers, two of 16 bits counting as one), "texture" (fetches), "nops", "move", "alu"
(with mad), "special", "full", "half", "waves", "static" (slots with loops once), "unknown_loops" (loops counted once because
the listing does not tell their trips), "vertex" (slots of the vertex shader), "mesa"}. Mali's compiler gives no listing here;
its rows have what it says itself, see mali.py.
"""

import math
import shutil
import subprocess

import engine
import ir3
import mali

ATTEMPTS = 6


def adreno_row(fragment, vertex):
    said, counts, loops = fragment.statistics, fragment.weighted(), fragment.loops()
    names = dict(zip(ir3.CATEGORIES, counts.categories))
    return {
        "instructions": counts.slots,
        "registers": said["full"] + math.ceil(said["half"] / 2),
        "texture": counts.fetches + fragment.prefetches,
        "nops": counts.nops,
        "move": names["move"],
        "alu": names["alu"] + names["mad"],
        "special": names["special"],
        "full": said["full"],
        "half": said["half"],
        "waves": said["waves"],
        "static": said["instructions"],
        "unknown_loops": sum(loop.trips is None for loop in loops),
        "vertex": vertex.weighted().slots,
    }


def mobile(gpu, names, paths):
    """Gives (variant, row) for Adreno GPUs in Mobile."""
    icd = paths.engine / "root/usr/share/vulkan/icd.d/freedreno_icd.json"
    variables = {
        "FD_GPU_ID": str(gpu.model),
        "IR3_SHADER_DEBUG": "vs,fs",
        "VK_DRIVER_FILES": str(icd),
        "MESA_VK_WSI_DEBUG": "sw",
    }
    missing, problem = list(names), None
    for _ in range(ATTEMPTS):
        run = engine.Engine(paths.engine, paths.work / gpu.name, "mobile", "vulkan", variables, paths.shim("freedreno"))
        with run:
            for name, lines in run.collect(missing, engine.is_compiled):
                try:
                    row = adreno_row(*engine.specialised(engine.pipelines_of(lines)))
                except (ir3.ListingError, engine.EngineError) as error:
                    # Two threads wrote at once; another time they will not.
                    problem = error
                    continue
                missing = [other for other in missing if other != name]
                yield name, row
        if not missing:
            return
    raise engine.EngineError(f"{missing[0]} on {gpu.label}: {problem}")


def capture(names, paths):
    """The GLSL of Compatibility for each variant, in paths.work/glsl/NAME."""
    stored, programs = paths.work / "stored", paths.work / "glsl"
    for folder in (stored, programs):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    variables = {"MESA_SHADER_CAPTURE_PATH": str(stored), "LIBGL_ALWAYS_SOFTWARE": "1"}
    known = set()

    def is_stored(_lines):
        return engine.drawn_program(stored, known) is not None

    def forget():
        known.update(path.name for path in stored.iterdir())

    run = engine.Engine(paths.engine, paths.work / "capture", "gl_compatibility", "opengl3_es", variables)
    with run:
        for name, _ in run.collect(names, is_stored, forget):
            vertex, fragment = engine.drawn_program(stored, known)
            forget()
            (programs / name).mkdir()
            (programs / name / "vertex.glsl").write_text(vertex, encoding="utf-8")
            (programs / name / "fragment.glsl").write_text(fragment, encoding="utf-8")
            yield name


def compile_glsl(gpu, name, paths):
    """What the driver says about a captured program, as lines."""
    program = paths.interpreter(gpu) + [str(engine.ROOT / "tools/mobile_cost/gl_compile.py"), str(paths.work / "glsl" / name)]
    environment = {**engine.base_environment(paths.engine, paths.work), **paths.gl_environment(gpu)}
    done = subprocess.run(
        program, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        errors="replace",
    )
    log = paths.work / gpu.name / f"{name}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    log.write_text(done.stdout, encoding="utf-8")
    lines = done.stdout.splitlines(keepends=True)
    begin = next((i for i, line in enumerate(lines) if line.startswith("gl: begin ")), None)
    if done.returncode or begin is None:
        raise engine.EngineError(f"{name} could not be compiled for {gpu.label}; the compiler's output: {log}")
    return lines[begin:]


def compatibility(gpu, names, paths):
    """Gives (variant, row) of captured programs."""
    for name in names:
        lines = compile_glsl(gpu, name, paths)
        if gpu.family == "mali":
            yield name, mali.row(lines)
            continue
        shaders = engine.pipelines_of(lines)
        fragment = [shader for shader in shaders if shader.stage == "FRAG"][-1]
        vertex = [shader for shader in shaders if shader.stage == "VERT"][-1]
        yield name, adreno_row(fragment, vertex)
