"""docs/report/diet: the acceptance's rows as a page."""

HEAD = """# What exports leave out

Written by `./dev diet --acceptance --instructions --out docs/report/diet`. A project with the addon and some scenes is exported
with everything, and once for each scene with that scene alone and what it can reach; each pack is run and draws its scene in
the three renderers.
Bytes are those of the pack below `addons/lobelight`. *environment* is the size, in texels along a face, that an environment of
automatic size gets where 512 would be more than the sharpest lobe needs; each halving leaves a quarter of the memory. Pictures
are compared as displayed; equal ones are 99 dB apart, and the least of the renderers' figures stands here.

"""
COSTS = """
## What a pixel costs

*samplers* are all of the material's shader. *instructions* are counted by Mesa's compilers as in
[docs/report/mobile-cost](../mobile-cost/README.md), the engine's own for an empty material left out. A material's shader is made
for what it uses, and is the same before and after: what a project has besides costs a material nothing. Shaders of one's own
are counted there.

"""
PANORAMA = """
## Panoramas

A panorama that is seen through the cube map alone is exported no finer than that shows. Where nothing else shows it, the scene's
takes {after:,} bytes of the pack instead of {before:,} ({why}).
"""
TARGETS = """
## With a target error

The preset's *Lobelight > Target Psnr* gives each material the fewest lobes that hold it on a synthetic environment and on the
project's panoramas; *held* is that PSNR. The pictures are compared with those of all lobes. These
materials are not frozen.

"""
TARGET_HEADINGS = ["scene's material", "target", "lobes", "held", "bytes", "pictures apart at least"]
PARTS = """
## Without the addon's fancy parts

The isotropic scene has one isotropic material and a static panorama. Of what the addon has for anisotropy, textures, clear coats,
emission, skies and captures, it takes along {bytes:,} bytes less than the scene that uses all of it, and none of it is in its
shader: {samplers} samplers instead of {other_samplers}, {fetches} fetches instead of {other_fetches}{instructions}. A panorama is
filtered once, when the scene starts; from then on the environment costs nothing but the fetches.

## Why each thing stayed

"""

HEADINGS = ["scene", "before", "after", "of it run time", "tables", "gone", "environment", "pictures apart at least"]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| --- |" + " ---: |" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


def byte_rows(rows):
    for row in rows:
        sizes = row["after_by_folder"]
        run_time = sizes.get("runtime", 0) + sizes.get("frozen", 0)
        folders = [f"{run_time:,}", f"{sizes.get('tables', 0):,}"]
        size = row["report"]["environment_size"] or "as set"
        bytes_left = [f"{row['before']:,}", f"{row['after']:,}", *folders, f"{row['gone']:.1%}"]
        yield [row["label"], *bytes_left, size, f"{min(row['psnr'].values()):.1f} dB"]


def target_rows(rows, gpus):
    for row in rows:
        (lobes,) = row["report"]["lobes"]
        (material,) = row["materials"]
        # Beside the scene that uses it, not below the addon.
        reduced = sum(table["after"] for table in row["report"]["tables"] if table["before"] == 0)
        yield [
            row["label"],
            f"{row['target']:g} dB",
            f"{lobes['lobes']} instead of {lobes['lobes_before']}",
            f"{lobes['psnr']:.1f} dB",
            f"{row['after'] + reduced:,}",
            f"{min(row['psnr'].values()):.1f} dB",
            *[material["instructions"][gpu]["own"] for gpu in gpus],
        ]


def cost_rows(rows, gpus):
    for row in rows:
        # Of shaders of one's own nothing is counted here.
        if row["scene"] == "empty":
            yield [row["label"], 0, 0, *[0 for _ in gpus]]
        for material in row["materials"]:
            fetches = material["environment_fetches"] + material["table_fetches"]
            yield [row["label"], material["samplers"], fetches, *[material["instructions"][gpu]["own"] for gpu in gpus]]


def reasons(row):
    text = f"### {row['label'][0].upper()}{row['label'][1:]}\n\n"
    for entry in row["report"]["tables"] + row["report"]["files"]:
        if entry["after"]:
            name = entry["path"].removeprefix("res://addons/lobelight/")
            sizes = f"{entry['before']:,} → {entry['after']:,}" if entry["after"] != entry["before"] else f"{entry['after']:,}"
            text += f"- `{name}` ({sizes}): {entry['why']}\n"
    if text.endswith("\n\n"):
        text += "Nothing did.\n"
    return text


def parts(plain, full, gpus):
    """The paragraph on the isotropic scene beside the one that uses everything."""
    one, other = plain["materials"][0], full["materials"][0]
    counts = "".join(
        f", {one['instructions'][gpu]['own']} instructions instead of {other['instructions'][gpu]['own']} on {gpu}" for gpu in gpus
    )
    return PARTS.format(
        bytes=full["after"] - plain["after"],
        samplers=one["samplers"],
        other_samplers=other["samplers"],
        fetches=one["environment_fetches"] + one["table_fetches"],
        other_fetches=other["environment_fetches"] + other["table_fetches"],
        instructions=counts,
    )


def page(rows, targets, least_psnr):
    """The text of README.md."""
    by_scene = {row["scene"]: row for row in rows}
    gpus = list(by_scene["isotropic"]["materials"][0].get("instructions", {}))
    text = HEAD + table(HEADINGS, byte_rows(rows))
    text += f"\nAt least {least_psnr:.0f} dB are wanted, and 80 % gone for the isotropic scene.\n"
    share = by_scene["panorama"]["panorama"]
    text += PANORAMA.format(**share, why=by_scene["panorama"]["report"]["panoramas"][0]["why"])
    text += COSTS + table(["scene's material", "samplers", "fetches", *gpus], cost_rows(rows, gpus))
    text += TARGETS + table([*TARGET_HEADINGS, *gpus], target_rows(targets, gpus))
    text += parts(by_scene["isotropic"], by_scene["everything"], gpus)
    return text + "\n".join(map(reasons, rows))
