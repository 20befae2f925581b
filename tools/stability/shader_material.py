"""Probes of LobeMaterial3D's whole fragment function."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import exact_shader as shader
from about import About
from exact import mpf, normalised, vector
from probe_textures import LEVELS_SIZE
from probes import DIVISION, U, Near, Probe, Texture, pow_error, single
from shader_light import expect_diffuse, sums
from shader_frames import orthonormal_frame, projection
from shader_occlusion import hidden_odds, lit, open_share, share_above
from shader_points import light, turn, view_at
from shader_tables import odd_table
from shader_values import encode_error
from shader_widths import set_levels

LARGEST = 65504.0

# Textures of one texel a row: where its four numbers are in the row, the uniform, the defines.
MAPS = {
    "orm": (44, "orm_texture", ("ORM_TEXTURE", "AO", "OCCLUDED", "CONE")),
    "normal": (48, "normal_texture", ("NORMAL_TEXTURE", "OCCLUDED", "HORIZON")),
    "flow": (52, "flowmap", ("FLOWMAP",)),
    "albedo": (56, "albedo_texture", ("ALBEDO_TEXTURE",)),
    "emission": (60, "emission_texture", ("EMISSION_TEXTURE",)),
    "coat": (64, "coat_texture", ("COAT_TEXTURE",)),
    "roughness": (68, "roughness_texture", ("ROUGHNESS_TEXTURE",)),
    "metallic": (72, "metallic_texture", ("METALLIC_TEXTURE",)),
    "ao": (76, "ao_texture", ("AO", "AO_TEXTURE", "OCCLUDED", "CONE")),
    "bent": (80, "bent_normal_texture", ("BENT_NORMAL",)),
}
COAT_STRENGTH = 0.75
EMISSION_FACTOR = (2.0, 0.5, 1.0)
CHANNELS = {"roughness": (0, 1, 0, 0), "metallic": (0.5, 0.25, 0.25, 0), "ao": (0, 0, 0, 1)}


def fresnel(first, second, f0, f90):
    """f0 a + (f90 - f0) b."""
    return f0 * first + (f90 - f0) * second


@dataclass
class Surface:
    """The uniforms of a material."""

    table: object
    coat: object = None
    albedo: tuple = (0.8, 0.5, 0.2)
    alpha: float = 0.625
    roughness: float = 0.4
    metallic: float = 1.0
    dielectric: tuple | None = None
    compensated: bool = False
    emitted: tuple | None = None
    turned: tuple | None = None
    anisotropy: float = 0.7
    normal_scale: float = 1.0
    maps: tuple = ()

    def texel(self, row, name):
        """Of a map, where there is one."""
        first = MAPS[name][0]
        return tuple(mpf(x) for x in row[first : first + 4]) if name in self.maps else None

    def defines(self):
        names = [*self.table.defines(), "LOBELIGHT_ALPHA"]
        names += ["LOBELIGHT_DIELECTRIC"] * (self.dielectric is not None)
        names += ["LOBELIGHT_METALLIC"] * (self.dielectric is not None and self.metallic > 0)
        names += ["LOBELIGHT_COMPENSATED"] * self.compensated
        names += ["LOBELIGHT_EMISSION"] * (self.emitted is not None)
        names += ["LOBELIGHT_TURNED"] * (self.turned is not None)
        if self.coat:
            names.append("LOBELIGHT_COAT")
        names += dict.fromkeys(f"LOBELIGHT_{define}" for name in self.maps for define in MAPS[name][2])
        if self.maps:
            names += ["LOBELIGHT_TEXTURED", "LOBELIGHT_SAMPLING filter_nearest, repeat_disable"]
        return tuple(names)

    def uniforms(self):
        values = self.table.uniforms() | {
            "lobelight_albedo": self.albedo,
            "lobelight_alpha": [self.alpha],
            "lobelight_roughness": [self.roughness],
            "lobelight_metallic": [self.metallic],
            "lobelight_anisotropy": [self.anisotropy],
        }
        if self.dielectric:
            values["lobelight_dielectric"] = self.dielectric
        if self.emitted:
            values["lobelight_emitted"] = self.emitted
        if self.turned:
            values["lobelight_anisotropy_turn"] = self.turned
        if "normal" in self.maps:
            values["lobelight_normal_scale"] = [self.normal_scale]
        if "emission" in self.maps:
            values["lobelight_emission_factor"] = EMISSION_FACTOR
        values |= {f"lobelight_{name}_channel": CHANNELS[name] for name in self.maps if name in CHANNELS}
        if self.coat:
            lookup = self.coat.lookup()
            values |= {
                "lobelight_coat_amount": (COAT_STRENGTH, 0.3),
                "lobelight_coat_lookup": (lookup[0], lookup[1], lookup[3]),
            }
        return values


def shading_frame(surface, row):
    """(tangent, bitangent, normal) of the lobes, in view space."""
    normal = vector(row[:3])
    frame = orthonormal_frame(normal, vector(row[4:7]), vector(row[8:11]))
    if texel := surface.texel(row, "normal"):
        # z is what is left to one; the scale mixes the map's normal with the surface's.
        x, y = (2 * c - 1 for c in texel[:2])
        z = shader.mp.sqrt(max(1 - x * x - y * y, mpf(0)))
        scale = mpf(surface.normal_scale)
        normal = normalised(shader.columns_times(frame, (x * scale, y * scale, 1 + scale * (z - 1))))
    if surface.table.isotropic:
        tangent = shader.any_tangent(normal)
        return tangent, shader.cross(normal, tangent), normal
    direction = vector(surface.turned) if surface.turned else (mpf(1), mpf(0))
    if texel := surface.texel(row, "flow"):
        flow = tuple(2 * c - 1 for c in texel[:2])
        square = flow[0] ** 2 + flow[1] ** 2
        if mpf(surface.anisotropy) * texel[3] > mpf("0.01") and square > mpf("1e-4"):
            c, s = (f / shader.mp.sqrt(square) for f in flow)
            direction = (c * direction[0] - s * direction[1], c * direction[1] + s * direction[0])
    c, s = direction
    first = shader.plus(shader.scaled(frame[0], c), shader.scaled(frame[1], s))
    second = shader.minus(shader.scaled(frame[1], c), shader.scaled(frame[0], s))
    return orthonormal_frame(normal, first, second)


def bent_normal(surface, row):
    """In view space, and the map's z."""
    frame = orthonormal_frame(vector(row[:3]), vector(row[4:7]), vector(row[8:11]))
    x, y = (2 * c - 1 for c in surface.texel(row, "bent")[:2])
    x, y, z = normalised((x, y, shader.mp.sqrt(max(1 - x * x - y * y, mpf(0)))))
    return normalised(shader.columns_times((*frame[:2], shading_frame(surface, row)[2]), (x, y, z))), z


def occlusion_of(surface, row, ao, camera, normal, own, is_coat):
    """What sums() asks, about a normal in the environment's space; coats lie on the mesh."""
    is_bent = "bent" in surface.maps
    is_occluded = "orm" in surface.maps or "ao" in surface.maps
    if not is_occluded and "normal" not in surface.maps:
        return None
    bent, cosine = bent_normal(surface, row) if is_bent else (None, mpf(1))
    open_to = shader.columns_times(camera, bent) if is_bent else normal
    odds = hidden_odds(ao, cosine)
    geometric = shader.columns_times(camera, vector(row[:3]))

    def visible(lobe, mean):
        share, offs = mpf(1), [0.0, 0.0]
        parts = []
        for n in (0, 1):
            off = lobe.mean_bound[n] + (24 * U if n == 0 else 0.0), lobe.variance_bound[n]
            here = []
            if is_occluded:
                here.append(open_share(is_bent, odds, shader.dot(open_to, mean), lobe.variance, *off))
            if "normal" in surface.maps and not is_coat:
                cosines = shader.dot(normal, mean), shader.dot(geometric, mean)
                above, above_off = share_above(*cosines, lobe.variance, *off)
                here.append((lit(above, own.value), above_off + own.off + 4 * U))
            parts.append(here)
        for n in (0, 1):
            share = mpf(1)
            for part, off in parts[n]:
                offs[n] = offs[n] * float(part) + off * float(share) + U
                share *= part
        return share, *offs

    return visible


def channels(totals, off):
    """The four sums of a reflection, light by channel."""
    lights = [[About(totals[n][c], *off[n]) for c in range(3)] for n in (0, 1)]
    return *lights, About(totals[2], *off[2]), About(totals[3], *off[3])


def lost_share(albedo):
    """What microfacets lose by reflecting among themselves, of what they reflect."""
    albedo = albedo.clamped("0.05", 1e9)
    slope = 1 / float(albedo.value) ** 2
    return About(1 / albedo.value - 1, albedo.off * slope + DIVISION / float(albedo.value) + 2 * U, albedo.half * slope)


def expect_material(surface, cube, values, row, renderer):
    normal = vector(row[:3])
    parallel = row[28 + 15] > 0.5
    view = (mpf(0), mpf(0), mpf(1)) if parallel else vector(row[12:15])
    camera = [vector(row[16 + 4 * n : 19 + 4 * n]) for n in range(3)]
    axes = shading_frame(surface, row)
    local = tuple(shader.dot(view, axis) for axis in axes)

    def to_environment(direction):
        return shader.columns_times(camera, shader.columns_times(axes, direction))

    if surface.table.isotropic:
        axes_there = [shader.columns_times(camera, axis) for axis in axes]
        tangent = shader.any_tangent(axes_there[2])
        axes_there = (tangent, shader.cross(axes_there[2], tangent), axes_there[2])
        local = tuple(shader.dot(shader.columns_times(camera, view), axis) for axis in axes_there)

        def to_environment(direction):
            return shader.columns_times(axes_there, direction)

    ao, roughness, metallic = occlusion_roughness_metallic(surface, row)
    anisotropy = mpf(surface.anisotropy) * (surface.texel(row, "flow") or (0, 0, 0, 1))[3]
    base = [About(b, 2 * U) for b in vector(surface.albedo)]
    if texel := surface.texel(row, "albedo"):
        base = [b * decoded(x, renderer) for b, x in zip(base, texel)]
    own = ((base[0] + base[1] + base[2]) * About(mpf(1) / 3, U)).clamped(0, 1)
    visible = occlusion_of(surface, row, ao, camera, shader.columns_times(camera, axes[2]), own, False)
    reflection = channels(
        *sums(surface.table, local, cube, values, to_environment, float(roughness), float(anisotropy), visible)
    )
    is_occluded = "orm" in surface.maps or "ao" in surface.maps
    d0, d90 = vector(surface.dielectric or (0.0, 1.0))
    lost = lost_share(reflection[2])
    diffuse = None
    if surface.dielectric:
        centre = shader.columns_times(camera, axes[2])
        tangent = shader.any_tangent(centre)
        frame = [tangent, shader.cross(centre, tangent), centre]
        # About the normal the six lie in the view's frame.
        if surface.table.isotropic:
            there = shader.columns_times(camera, view)
            frame[0] = shader.view_of(centre, there)[2]
            frame[1] = shader.cross(centre, frame[0])
        else:
            frame = [shader.columns_times(camera, axis) for axis in axes]
        if "bent" in surface.maps:
            bent = shader.columns_times(camera, bent_normal(surface, row)[0])
            frame = orthonormal_frame(bent, frame[0], frame[1])
        diffuse = expect_diffuse(cube, values, [x for axis in frame for x in (*axis, 0)])
    coat = None
    if surface.coat:
        n = shader.columns_times(camera, normal)
        tangent = shader.any_tangent(n)
        coat_axes = (tangent, shader.cross(n, tangent), n)
        seen = tuple(shader.dot(shader.columns_times(camera, view), axis) for axis in coat_axes)
        coat = channels(
            *sums(
                surface.coat,
                seen,
                cube,
                values,
                lambda d: shader.columns_times(coat_axes, d),
                visible=occlusion_of(surface, row, ao, camera, n, own, True),
            )
        )
    checks = []
    for c in range(3):
        radiance = fresnel(reflection[0][c], reflection[1][c], base[c], About(mpf(1)))
        if surface.compensated:
            radiance = radiance * (1 + base[c] * lost)
        if surface.dielectric:
            # What is no metal, and all that it reflects.
            other = fresnel(reflection[0][c], reflection[1][c], About(d0), About(d90))
            reflected = fresnel(reflection[2], reflection[3], About(d0), About(d90))
            if surface.compensated:
                other = other * (1 + About(d0) * lost)
                reflected = reflected * (1 + About(d0) * lost)
            radiance = other * About(1 - metallic, 6 * U) + radiance * About(metallic, 6 * U)
            left = (About(mpf(1)) - reflected).clamped(0, 1e9)
            scattered = base[c] * About(1 - metallic, 6 * U) * left
            if is_occluded:
                scattered = scattered * ao
            radiance = radiance + scattered * About(mpf(diffuse[c].exact[0]), diffuse[c].bound, diffuse[c].medium)
        if coat:
            share = fresnel(coat[2], coat[3], About(mpf("0.04")), About(mpf(1)))
            above = fresnel(coat[0][c], coat[1][c], About(mpf("0.04")), About(mpf(1)))
            strength = COAT_STRENGTH * (surface.texel(row, "coat") or (mpf(1),))[0]
            radiance = radiance * (About(mpf(1)) - share * strength) + above * strength
        if renderer == "gl_compatibility":
            seen = row[28 + 10] > 0
        else:
            seen = not parallel or row[28 + 5] < 0
        radiance = radiance * (mpf(values["energy"]) if seen else 0)
        if surface.emitted:
            radiance = radiance + mpf(surface.emitted[c])
        if texel := surface.texel(row, "emission"):
            radiance = radiance + decoded(texel[c], renderer) * EMISSION_FACTOR[c]
        checks.append(written(c, radiance, renderer, "radiance"))
        checks.append(written(3 + c, base[c], renderer, "albedo"))
    checks.append(Near((6,), (metallic,), 6 * U, "metallic"))
    checks.append(Near((7,), (roughness,), 4 * U, "roughness"))
    alpha = surface.alpha * (surface.texel(row, "albedo") or (0, 0, 0, 1))[3]
    checks.append(Near((8,), (alpha,), U, "alpha"))
    return checks


def occlusion_roughness_metallic(surface, row):
    orm = [mpf(1), mpf(surface.roughness), mpf(surface.metallic if surface.dielectric else 1.0)]
    if texel := surface.texel(row, "orm"):
        orm = [a * b for a, b in zip(orm, texel)]
    for n, name in enumerate(("ao", "roughness", "metallic")):
        if texel := surface.texel(row, name):
            orm[n] *= shader.dot(texel, CHANNELS[name])
    return orm


def decoded(texel, renderer):
    """Of a texture of colours: Compatibility hands it out as sRGB."""
    if renderer != "gl_compatibility":
        return About(texel)
    linear = shader.srgb_to_linear(texel)
    power = pow_error(float(texel + mpf("0.055")) / 1.055, 2.4)
    return About(linear, float(linear) * (2.4 * (DIVISION + 2 * U) + power + DIVISION))


def written(at, light_, renderer, unit):
    """As the engine is to be told it: in Compatibility through the inverse of its cubic."""
    light_ = light_.clamped(0, LARGEST)
    if renderer != "gl_compatibility":
        return Near((at,), (light_.value,), light_.off + 1e-12, unit, light_.half)
    wanted = shader.encoded(light_.value)

    def stretched(off):
        low, high = max(light_.value - mpf(off), mpf(0)), light_.value + mpf(off)
        return float(max(wanted - shader.encoded(low), shader.encoded(high) - wanted))

    bound = stretched(light_.off) + float(wanted) * encode_error(max(float(light_.value), 1e-7)) + 1e-9
    return Near((at,), (wanted,), bound, unit, stretched(light_.half + light_.off))


def surfaces():
    """(name, surface, cube)."""
    round_table = odd_table("table_material_round", 8, 16, 0, tuple(single((0.15, 0.15))), seed=300)
    long_table = odd_table("table_material_long", 4, 8, 4, tuple(single((0.3, 0.06))), seed=301)
    coat = odd_table("table_material_coat", 4, 16, 0, tuple(single((0.05, 0.05))), seed=302)
    albedo, quarter = tuple(single((0.8, 0.5, 0.2))), tuple(single((math.cos(0.5), math.sin(0.5))))
    dielectric = tuple(single((0.04, 1.0)))
    metal = Surface(round_table, albedo=albedo, roughness=0.375)
    whole = Surface(
        round_table,
        coat,
        albedo,
        roughness=0.5,
        metallic=0.75,
        dielectric=dielectric,
        compensated=True,
        emitted=(0.25, 0.0, 4.0),
        maps=("orm",),
    )
    mapped = Surface(long_table, albedo=albedo, roughness=0.375, anisotropy=0.75, turned=quarter, normal_scale=0.5)
    mapped.maps = ("normal", "flow")
    plain = Surface(long_table, albedo=albedo, roughness=0.375, dielectric=dielectric, metallic=0.25)
    textured = Surface(round_table, coat, albedo, roughness=1.0, dielectric=dielectric, emitted=(0.125, 0.0, 0.0))
    textured.maps = ("albedo", "emission", "coat", "roughness", "metallic", "ao")
    behind = Surface(long_table, coat, albedo, roughness=0.375, dielectric=dielectric, metallic=0.25)
    behind.maps = ("normal", "ao", "bent")
    nine = set_levels(0.01, 1.0, 9)
    set_round = odd_table("table_material_set_round", 4, 8, 0, levels=nine, seed=303)
    set_long = odd_table("table_material_set_long", 4, 8, 4, levels=nine, seed=304)
    varying = Surface(set_round, albedo=albedo, roughness=1.0, maps=("roughness",))
    brushed = Surface(set_long, albedo=albedo, roughness=1.0, anisotropy=1.0, maps=("roughness", "flow"))
    across = Surface(set_long, albedo=albedo, roughness=1.0, anisotropy=-0.5, maps=("roughness", "flow"))
    half = Surface(long_table, albedo=albedo, roughness=0.375, dielectric=dielectric, metallic=0.5, compensated=True)
    matte = Surface(long_table, albedo=albedo, roughness=0.375, dielectric=dielectric, metallic=0.0, compensated=True)
    return [
        ("metal", metal, "levels"),
        ("half metal", half, "directions"),
        ("no metal", matte, "directions"),
        ("with all textures", textured, "levels"),
        ("of many widths", varying, "directions"),
        ("brushed in many ways", brushed, "directions"),
        ("brushed across", across, "directions"),
        ("everything", whole, "levels"),
        ("everything", whole, "directions"),
        ("with maps", mapped, "directions"),
        ("behind walls", behind, "directions"),
        ("brushed dielectric", plain, "directions"),
    ]


def row_texture(rows, first):
    """One texel a row, of the four numbers from `first` on."""
    values = np.array([row[first : first + 4] for row in rows], dtype=np.float32)
    values = np.pad(values, ((0, max(-len(values) % 64, 128 - len(values))), (0, 0)))
    return Texture(values.tobytes(), 64, len(values) // 64, is_float=True)


def probes(quick):
    """(tables, textures, probes)."""
    tables, textures, made = {}, {}, []
    rng, bends = np.random.default_rng(21), np.random.default_rng(22)
    for material, surface, cube in surfaces():
        tables[surface.table.name] = surface.table
        values = light(LEVELS_SIZE if cube == "levels" else 1, "disc", 0.0, cube, energy=0.75)
        title = f"material {material}, {cube}"
        probe = Probe(
            title.replace(" ", "_").replace(",", ""),
            "shader material",
            "material",
            9,
            partial(expect_material, surface, cube, values),
            light=values,
            by_renderer=True,
            has_medium=True,
        )
        probe.defines, probe.uniforms = surface.defines(), surface.uniforms()
        probe.textures = {"lobelight_table": surface.table.name}
        for elevation in (0.0, 50.0, 95.0) if quick else (0.0, 0.01, 10, 30, 50, 70, 80, 89, 90, 95, 120):
            if elevation == 0 and not surface.table.isotropic:
                elevation = 0.02  # the quadrant of a view along the normal is a matter of its last bit
            rows = []
            for azimuth, camera_seed, shot in (
                (20.0, 0, (False, True)),
                (140.0, 31, (False, False)),
                (250.0, 32, (True, True)),
                (310.0, 33, (True, False)),
            ):
                frame = turn(40 + camera_seed)
                if shot[0]:
                    # Parallel projections look along z.
                    tilt = view_at(elevation, azimuth)
                    frame = [tuple(column) for column in rotation_to(tilt)]
                view = [sum(frame[n][axis] * x for n, x in enumerate(view_at(elevation, azimuth))) for axis in range(3)]
                camera = [x for column in turn(camera_seed) for x in (*column, 0)]
                texels = (*rng.uniform(0.2, 1.0, 4), *rng.uniform(0.3, 0.7, 4), *rng.uniform(0, 1, 3), rng.uniform(0.5, 1))
                texels += (*rng.uniform(0.1, 1, 24), *bends.uniform(0.3, 0.7, 4))
                rows.append(
                    (*frame[2], 0, *frame[0], 0, *frame[1], 0, *view, 0, *camera, *projection(*shot), *texels)
                )
            probe.add(f"{title}, view {elevation:g}", rows)
        if surface.coat:
            tables[surface.coat.name] = surface.coat
            probe.textures["lobelight_coat_table"] = surface.coat.name
        for name in surface.maps:
            first, uniform, _defines = MAPS[name]
            textures[f"{probe.name}_{name}"] = row_texture(probe.rows, first)
            probe.textures[f"lobelight_{uniform}"] = f"{probe.name}_{name}"
        made.append(probe)
    return list(tables.values()), textures, made


def rotation_to(direction):
    """Columns (tangent, bitangent, normal) of a frame in which `direction` is the axis z of view space."""
    z = np.array(direction)
    x = np.cross([0.3, 1.0, 0.2], z)
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    # The rows of this matrix are view space's axes in the frame; its columns the frame's in view space.
    return np.array([x, y, z]).T

