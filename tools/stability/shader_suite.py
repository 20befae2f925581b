"""The shaders' half of ./dev stability: all probes in the three renderers, and with mediump rounded in one."""

from contextlib import ExitStack
from pathlib import Path

import mediump
import numpy as np
import probe_textures
import projects
import shader_antialiasing
import shader_fades
import shader_frames
import shader_light
import shader_line
import shader_material
import shader_occlusion
import shader_own
import shader_passes
import shader_placed
import shader_planes
import shader_points
import shader_pyramid
import shader_sources
import shader_tables
import shader_values
import shader_widths
from probes import (
    RENDERERS,
    ROOT,
    EngineError,
    Expectations,
    judge,
    read_results,
    run_engine,
    temporary_folder,
    write_jobs,
)
from shader_tables import Table, plane_texels
from verdict import broken, rows

# Where mediump is rounded; the formulas are the same in all.
HALF_RENDERER = "mobile"
# Of the fitted tables, every so many.
FITTED_STEP = 7


def fitted_tables(records, quick):
    """Tables as the native half has fitted them, at the extremes of the widths, and what they are called."""
    for number, record in enumerate(records[:: FITTED_STEP if quick else 1]):
        columns, azimuths = map(int, record["grid"])
        lobes = record["lobes"]
        # Views, elevations first, and their lobes; textures have lobes, then azimuths.
        halves = np.array(rows(record["half"], 4)).reshape(azimuths, columns, lobes, 4)
        texels = halves.transpose(2, 0, 1, 3).reshape(1, lobes * azimuths, columns, 4)
        if not np.isfinite(texels).all():
            continue
        if azimuths == 1:
            texels = plane_texels(texels, record["alpha"][0])
        table = Table(f"fitted_{number}", texels, lobes, tuple(record["alpha"]), azimuths == 1)
        yield table, record["name"].removeprefix("table ")


def make(quick, records):
    """(textures, probes, passes, pyramids)."""
    tables = shader_tables.tables(quick)
    fitted = list(fitted_tables(records, quick))
    lit_tables, lit = shader_light.probes(quick)
    worn_tables, worn_textures, worn = shader_material.probes(quick)
    own_tables, own = shader_own.probes(quick)
    lists, placed = shader_placed.probes(quick)
    textures = worn_textures | lists | probe_textures.textures() | {"panorama": shader_values.panorama_texture()}
    textures |= {table.name: table.texture() for table in [*tables, *lit_tables, *worn_tables, *own_tables, *(t for t, _title in fitted)]}
    probes = [
        *shader_values.probes(quick),
        *shader_points.probes(quick),
        *shader_fades.probes(),
        *shader_antialiasing.probes(),
        *shader_frames.probes(quick),
        *shader_widths.probes(quick),
        *shader_line.probes(quick),
        *shader_planes.probes(quick),
        *shader_occlusion.probes(quick),
        *shader_sources.probes(quick),
        *shader_tables.probes(quick, tables),
        *(shader_tables.lobe_probe(table, title, quick, few=True) for table, title in fitted),
        *lit,
        *worn,
        *own,
        *placed,
    ]
    passes, pyramids = shader_passes.passes(quick), shader_pyramid.pyramids(quick)
    return textures | shader_pyramid.textures(pyramids, passes), probes, passes, pyramids


def run(quick, records, progress):
    """The verdicts; `records` are the native half's tables."""
    textures, probes, passes, pyramids = make(quick, records)
    expectations = Expectations()
    verdicts = []

    def draw(title, renderer, chosen, whole, project, precision):
        found = []
        out = folder / title
        here = [[(one, 0, "res://") for one in some] for some in (chosen, *whole)]
        try:
            write_jobs(folder, textures, *here)
            run_engine(renderer, folder, out, project)
            for probe in chosen:
                before = read_results(folder / renderer, probe) if precision == "half" else None
                found += judge(probe, read_results(out, probe), renderer, expectations, precision, before)
            for one in (*whole[0], *whole[1]):
                found += one.judge(shader_pyramid.reader(out, one), renderer)
        except (EngineError, OSError) as error:
            found.append(broken(f"shader in {title}", str(error)))
        verdicts.extend(found)
        progress.end(f"shader in {title}: {len(found)} cases, {sum(not v['passed'] for v in found)} failed")

    with ExitStack() as stack:
        folder = Path(stack.enter_context(temporary_folder()))
        for renderer in RENDERERS:
            draw(renderer, renderer, probes, (passes, pyramids), ROOT, "single")
        rounded = folder / "rounded"
        projects.copy_shaders(rounded, mediump.change_of(projects.shaders()))
        (rounded / mediump.NAME).write_text(mediump.FUNCTIONS, encoding="utf-8")
        medium = [probe for probe in probes if probe.has_medium]
        draw(f"{HALF_RENDERER}, mediump as halves", HALF_RENDERER, medium, ([], []), rounded, "half")
    return verdicts

