"""Files of KHR_materials_anisotropy drawn by the engine through the addon, against Mitsuba's microfacets.

write   writes the files and cases.json to FOLDER
judge   reads the pictures that gltf_pictures.gd has drawn there and compares them

The files are written to the extension's text and hold what Khronos' samples show: strengths on a sphere, rotations on
a sphere, directions and strengths from a texture on a disc. The reference takes the text's two widths and the turned
direction for each pixel, Mitsuba's GGX with alpha_u and alpha_v, and Mitsuba's environment map; nothing of it goes
through the addon. Microfacet materials of the addon make up for the light that is lost between facets (Turquin 2019,
eq. 16); a white metal's picture is then the reflected light over the share that a white world reflects, and so is the
reference. The view is that of ./dev compare: orthographic from +z, the unit disc filling the picture.

The last line is "crosscheck-gltf: N passed, N failed".
"""

import argparse
import base64
import io
import json
import sys
from pathlib import Path

import numpy as np
from PIL import Image

import contract

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "compare"))
import metrics  # noqa: E402

SIZE = 96
LEAST_DB = 30.0
RINGS = 128
TEXELS = 128
# (name, shape, roughness, strength, rotation, texture): a roughness of 0.3 is a width of 0.09.
CASES = [
    *((f"strength_{s:g}", "sphere", 0.3, s, 0.0, None) for s in (0.25, 0.5, 0.75, 1.0)),
    *((f"rotation_{d}", "sphere", 0.3, 0.6, np.radians(d), None) for d in (30, 90, 135)),
    ("disc_direction", "disc", 0.3, 0.6, 0.0, "direction"),
    ("disc_turned", "disc", 0.3, 0.6, np.radians(30), "direction"),
    ("disc_strength", "disc", 0.3, 0.8, 0.0, "strength"),
    ("sphere_texture", "sphere", 0.4, 0.7, np.radians(20), "both"),
    # Khronos' tests have widths that are up to 26:1 apart: more than eight lobes hold in a world with sharp edges.
    ("khronos_rotation", "sphere", 0.1, 0.5, np.radians(30), None),
    ("khronos_strength", "sphere", 0.2, 0.8, 0.0, None),
]
# The lobes of tables that are fitted for a material, where it does not take those of the ready set. Such tables are
# drawn as they are.
LOBES = {"khronos_rotation": 24, "khronos_strength": 24}


def surface(shape, count=RINGS):
    """Positions, normals, tangents and texture coordinates of a grid of points, and its triangles."""
    if shape == "disc":
        x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(1, -1, 9))
        position = np.stack([x, y, 0 * x], axis=-1)
        normal = np.broadcast_to([0.0, 0.0, 1.0], position.shape)
        tangent = np.broadcast_to([1.0, 0.0, 0.0], position.shape)
        uv = np.stack([(x + 1) / 2, (1 - y) / 2], axis=-1)
    else:
        # Around the z axis, so that the poles of the mesh are not those of its tangents; the front is enough.
        polar, azimuth = np.meshgrid(
            np.linspace(1e-4, 0.52 * np.pi, count), np.linspace(0, 2 * np.pi, 2 * count + 1), indexing="ij"
        )
        position = np.stack(
            [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=-1
        )
        normal = position
        tangent, uv = tangents_of(normal), coordinates_of(normal)
    rows, columns = position.shape[:2]
    at = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
    triangles = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    flat = [part.reshape(-1, part.shape[-1]) for part in (position, normal, tangent, uv)]
    # Counter-clockwise seen from outside.
    corners = flat[0][triangles]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    turned = (facing * flat[1][triangles].mean(axis=1)).sum(axis=1) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return *flat, triangles


def tangents_of(normal):
    tangent = np.cross([0.0, 1.0, 0.0], normal)
    return tangent / np.linalg.norm(tangent, axis=-1, keepdims=True)


def coordinates_of(normal):
    return np.stack([(normal[..., 0] + 1) / 2, (1 - normal[..., 1]) / 2], axis=-1)


def texture_at(kind, uv):
    """Direction (…, 2), unit, and strength (…) of the texture at coordinates: what its texels hold."""
    x, y = 2 * uv[..., 0] - 1, 1 - 2 * uv[..., 1]
    radius = np.hypot(x, y)
    # Grooves around the middle stretch highlights away from it.
    angle = np.arctan2(y, x) if kind != "strength" else np.full_like(x, np.radians(60))
    strength = np.clip(0.3 + 0.7 * radius, 0, 1) if kind != "direction" else np.ones_like(x)
    if kind == "both":
        angle = 0.8 * np.sin(2.0 * x) + y
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1), strength


def png_of(kind):
    centre = (np.arange(TEXELS) + 0.5) / TEXELS
    direction, strength = texture_at(kind, np.stack(np.meshgrid(centre, centre), axis=-1))
    texels = np.concatenate([(direction + 1) / 2, strength[..., None]], axis=-1)
    stream = io.BytesIO()
    Image.fromarray(np.round(255 * texels).astype(np.uint8)).save(stream, "png")
    return stream.getvalue()


def embedded(data, kind):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def document(name, shape, roughness, strength, rotation, texture):
    """The glTF file of a case."""
    position, normal, tangent, uv, triangles = surface(shape)
    tangent = np.concatenate([tangent, np.ones((len(tangent), 1))], axis=1)
    parts = [part.astype(np.float32) for part in (position, normal, tangent, uv)] + [triangles.astype(np.uint32)]
    views, accessors, offset = [], [], 0
    for part, form in zip(parts, ("VEC3", "VEC3", "VEC4", "VEC2", "SCALAR"), strict=True):
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": part.nbytes})
        component, count = (5125, part.size) if form == "SCALAR" else (5126, len(part))
        accessors.append({"bufferView": len(accessors), "componentType": component, "count": count, "type": form})
        offset += part.nbytes
    accessors[0] |= {"min": position.min(axis=0).tolist(), "max": position.max(axis=0).tolist()}
    data = b"".join(part.tobytes() for part in parts)
    anisotropy = {"anisotropyStrength": strength, "anisotropyRotation": float(rotation)}
    file = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_anisotropy"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3},
                        "indices": 4,
                        "material": 0,
                    }
                ]
            }
        ],
        "materials": [
            {
                "name": name,
                "pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": roughness},
                "extensions": {"KHR_materials_anisotropy": anisotropy},
            }
        ],
        "buffers": [{"byteLength": len(data), "uri": embedded(data, "application/octet-stream")}],
        "bufferViews": views,
        "accessors": accessors,
    }
    if texture:
        anisotropy["anisotropyTexture"] = {"index": 0}
        file |= {
            "textures": [{"source": 0, "sampler": 0}],
            "samplers": [{"magFilter": 9729, "minFilter": 9987}],
            "images": [{"uri": embedded(png_of(texture), "image/png")}],
        }
    return file


def write(folder):
    for case in CASES:
        (folder / f"{case[0]}.gltf").write_text(json.dumps(document(*case)))
    (folder / "lobes.json").write_text(json.dumps(LOBES))


def pixels(shape, roughness, strength, rotation, texture):
    """Of each pixel of the disc: frames (n, 3, 3) of rows tangent, bitangent, normal, and widths (n, 2), by the text."""
    centre = (2 * np.arange(SIZE) + 1) / SIZE - 1
    x, y = np.meshgrid(centre, -centre)
    inside = metrics.sphere_mask(SIZE)
    x, y = x[inside], y[inside]
    if shape == "disc":
        normal = np.broadcast_to([0.0, 0.0, 1.0], (len(x), 3))
        tangent = np.broadcast_to([1.0, 0.0, 0.0], (len(x), 3))
    else:
        normal = np.stack([x, y, np.sqrt(1 - x**2 - y**2)], axis=-1)
        tangent = tangents_of(normal)
    bitangent = np.cross(normal, tangent)
    direction, factor = np.broadcast_to([1.0, 0.0], (len(x), 2)), np.ones(len(x))
    if texture:
        direction, factor = texture_at(texture, np.stack([(x + 1) / 2, (1 - y) / 2], axis=-1))
    cosine, sine = np.cos(rotation), np.sin(rotation)
    along = np.stack(
        [cosine * direction[:, 0] - sine * direction[:, 1], sine * direction[:, 0] + cosine * direction[:, 1]], axis=-1
    )
    first = along[:, :1] * tangent + along[:, 1:] * bitangent
    narrow = np.full(len(x), roughness**2)
    wide = narrow + (1.0 - narrow) * (strength * factor) ** 2
    return np.stack([first, np.cross(normal, first), normal], axis=1), np.stack([wide, narrow], axis=-1)


def reference(panorama, samples, compensated, *case):
    """Radiance (n, 3) of the disc's pixels."""
    import drjit as dr
    import mitsuba as mi

    import mitsuba_renderer

    frames, widths = pixels(*case)
    light = mi.load_dict(mitsuba_renderer.environment(panorama))
    count, per_batch = len(frames), 256

    def repeated(values):
        return mi.Float(np.repeat(values, per_batch).astype(np.float32))

    axes = [mi.Vector3f(*(repeated(frames[:, row, part]) for part in range(3))) for row in range(3)]
    o = mi.Vector3f(*(repeated(frames[:, row, 2]) for row in range(3)))
    alpha = [repeated(widths[:, axis]) for axis in range(2)]
    facets = mi.MicrofacetDistribution(mi.MicrofacetType.GGX, *alpha, True)

    def smith_lambda(v):
        slope = (dr.square(alpha[0] * v.x) + dr.square(alpha[1] * v.y)) / dr.square(v.z)
        return 0.5 * (dr.sqrt(1 + slope) - 1)

    def reflected(i):
        """The reflectance times the cosine, D G2 / (4 o_z), and the density of sampled directions."""
        h = dr.normalize(i + o)
        # Height-correlated (Heitz 2014, eq. 99).
        value = facets.eval(h) / (4 * o.z * (1 + smith_lambda(i) + smith_lambda(o)))
        pdf = facets.pdf(o, h) / (4 * dr.dot(o, h))
        return dr.select(i.z > 0, value, 0), dr.select(i.z > 0, pdf, 0)

    radiance, share = np.zeros((count, 3)), np.zeros((count, 1))
    for number in range(max(1, samples // per_batch)):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(number, count * per_batch)
        # Balance heuristic (Veach 1997) of facets and light.
        m, _ = facets.sample(o, sampler.next_2d())
        i = 2 * dr.dot(o, m) * m - o
        value, pdf = reflected(i)
        seen = dr.zeros(mi.SurfaceInteraction3f, count * per_batch)
        found = dr.zeros(mi.DirectionSample3f, count * per_batch)
        found.d = axes[0] * i.x + axes[1] * i.y + axes[2] * i.z
        seen.wi = -found.d
        from_light = light.pdf_direction(seen, found)
        total = dr.select(pdf > 0, value * light.eval(seen) / (pdf + from_light), 0)
        weight = dr.select(pdf > 0, value / pdf, 0)

        point = dr.zeros(mi.SurfaceInteraction3f, count * per_batch)
        found, over_pdf = light.sample_direction(point, sampler.next_2d())
        value, pdf = reflected(mi.Vector3f(*(dr.dot(axis, found.d) for axis in axes)))
        total += dr.select(found.pdf > 0, value * over_pdf * (found.pdf / (pdf + found.pdf)), 0)
        radiance += mitsuba_renderer.averaged(total, count, per_batch)
        share += np.array(weight).reshape(count, per_batch).mean(axis=1, dtype=np.float64)[:, None]
    return radiance / (share if compensated else max(1, samples // per_batch))


def judge(folder, panorama, samples, json_path):
    texels = contract.read_panorama(panorama)
    mask = metrics.sphere_mask(SIZE)
    results = []
    for name, *case in CASES:
        path = folder / f"{name}.f32"
        drawn = np.fromfile(path, dtype=np.float32).astype(np.float64).reshape(SIZE, SIZE, 4)[..., :3]
        truth = np.zeros_like(drawn)
        truth[mask] = reference(texels, samples, name not in LOBES, *case)
        decibels = float(metrics.psnr(drawn, truth, metrics.exposure_of(truth, mask), mask))
        results.append({"case": name, "psnr": decibels, "least": LEAST_DB, "passed": decibels >= LEAST_DB})
        verdict = "ok    " if results[-1]["passed"] else "FAILED"
        print(f"{verdict} gltf {name:18} {decibels:6.1f} dB  at least {LEAST_DB:.0f} dB", flush=True)
        contract.write_panorama(folder / f"{name}_mitsuba.exr", truth)
    if json_path:
        metrics.write_json(str(json_path), results)
    failed = sum(not result["passed"] for result in results)
    print(f"crosscheck-gltf: {len(results) - failed} passed, {failed} failed")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(prog="./dev crosscheck-gltf")
    parser.add_argument("step", choices=("write", "judge"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--env", type=Path)
    parser.add_argument("--samples", type=int, default=2048, help="of the reference, a pixel")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    if arguments.step == "write":
        write(arguments.folder)
        return 0
    try:
        return judge(arguments.folder, arguments.env, arguments.samples, arguments.json)
    except (OSError, metrics.MetricError) as error:
        print(f"crosscheck-gltf: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
