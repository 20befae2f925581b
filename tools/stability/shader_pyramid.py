"""The pyramid's levels from a panorama, by every filter and of every size.

Levels are sums over many texels; they are held against double precision, of which nothing is left beside the half floats
that they are stored as. Each level is judged by the finer one that the engine itself has drawn.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from probe_textures import face_directions
from probes import ATAN, HALF, U, EngineError, Texture
from shader_values import face_of
from verdict import Verdict

# As runtime/pyramid/pyramid.gd has them, and c of environment.gdshaderinc.
FILTERS = {"box": 0, "binomial": 1, "gaussian": 2, "disc": 3}
LEVEL_VARIANCES = {"box": 1 / 12, "binomial": 1 / 4, "gaussian": 5 / 6, "disc": 5 / 6}
# The tent of the sampler, in texels.
TENT = 1 / 6
# A Gaussian ends at three standard deviations, and has this share of its variance then.
REACH = 3.0
REACHED_SHARE = 1 - REACH**2 / 2 * math.exp(-(REACH**2) / 2) / (1 - math.exp(-(REACH**2) / 2))
# The rim falls off linearly over one sample: half the fourth moment over the second, less that of a sharp disc.
RIM_VARIANCE = 5 / 48
MOST_REACH = 1.5
# (kernel_variance, shrinking_variance, disc_slope) of the coarsest levels
COARSE_DISCS = {
    8: (3.5345, 0.3712, -0.6316),
    4: (4.3997, 0.4158, -0.9311),
    2: (2.3639, 0.4549, 0.0),
    1: (0.7939, 0.0, 0.0),
}
# What the constants of the shader, which have three to five digits, leave of a texel's weight.
CONSTANTS = 2e-4
# Texels of a level that are compared, at most.
MOST_TEXELS = 200


def panorama_texels(width):
    """Steep: small lights on grey."""
    rng = np.random.default_rng(11)
    texels = rng.uniform(0.05, 0.2, size=(width // 2, width, 4))
    texels[rng.integers(0, width // 2, 12), rng.integers(0, width, 12), :3] = rng.uniform(5, 60, size=(12, 3))
    return texels.astype(np.float32)


# Of u and v: 4096 units in the last place of an angle up to pi.
ANGLES = 0.5 * ATAN + 12 * U


def panorama_spread(texels, d):
    """How far the light can be off that way."""
    middle = panorama_light(texels, d)
    corners = [(u, v) for u in (-ANGLES, ANGLES) for v in (-ANGLES, ANGLES)]
    return middle, np.max([np.abs(panorama_light(texels, d, *corner) - middle) for corner in corners], axis=0)


def panorama_light(texels, d, u_off=0.0, v_off=0.0):
    """Bilinear, of directions (n, 3); as panorama.gdshaderinc documents it."""
    height, width = texels.shape[:2]
    u = np.arctan2(d[:, 0], -d[:, 2]) / (2 * np.pi) + u_off
    v = np.arctan2(np.hypot(d[:, 0], d[:, 2]), d[:, 1]) / np.pi + v_off
    x, y = (u - np.floor(u)) * width - 0.5, v * height - 0.5
    x0, y0 = np.floor(x).astype(int), np.floor(y).astype(int)
    f, g = (x - x0)[:, None], (y - y0)[:, None]
    x1, y1 = (x0 + 1) % width, np.clip(y0 + 1, 0, height - 1)
    x0, y0 = x0 % width, np.clip(y0, 0, height - 1)
    t = texels[..., :3].astype(float)
    return (1 - g) * ((1 - f) * t[y0, x0] + f * t[y0, x1]) + g * ((1 - f) * t[y1, x0] + f * t[y1, x1])


def tent_below(t):
    """The integral of max(1 - |t|, 0) up to t."""
    return np.where(t < 0, np.clip(1 + t, 0, 1) ** 2 / 2, 1 - np.clip(1 - t, 0, 1) ** 2 / 2)


def square_mean(texels, d, azimuth, polar, u_off=0.0, v_off=0.0):
    """The mean of the bilinear light within these angles to each side of a direction (3)."""
    height, width = texels.shape[:2]
    x = (math.atan2(d[0], -d[2]) / (2 * math.pi) + u_off) * width - 0.5
    y = (math.atan2(math.hypot(d[0], d[2]), d[1]) / math.pi + v_off) * height - 0.5
    half_columns, half_rows = azimuth / (2 * math.pi) * width, polar / math.pi * height
    columns, across = tents_under(x, half_columns)
    rows, along = tents_under(y, half_rows)
    columns = np.bincount(columns % width, across, minlength=width)
    rows = np.bincount(np.clip(rows, 0, height - 1), along, minlength=height)
    return np.einsum("y,x,yxc->c", rows, columns, texels[..., :3].astype(float))


def tents_under(at, half):
    """The texels whose tents reach into an interval, and their share of it."""
    every = np.arange(math.floor(at - half) - 1, math.ceil(at + half) + 2)
    return every, (tent_below(at + half - every) - tent_below(at - half - every)) / (2 * half)


def unit(d):
    return d / np.linalg.norm(d, axis=-1, keepdims=True)


def face_direction(face, x, y):
    """OpenGL 4.6, table 8.19."""
    one = np.ones_like(x)
    return np.stack(
        [(one, -y, -x), (-one, -y, x), (x, one, y), (x, -one, -y), (x, -y, one), (-x, -y, -one)][face], axis=-1
    )


def atlas_faces(data, size):
    """(6, size, size, 3) of an atlas of 3 x 2 faces."""
    atlas = np.frombuffer(data, dtype=np.float16).reshape(2 * size, 3 * size, 4)[..., :3].astype(float)
    return np.stack([atlas[f // 3 * size : (f // 3 + 1) * size, f % 3 * size : (f % 3 + 1) * size] for f in range(6)])


@dataclass
class Pyramid:
    """Levels from a panorama."""

    name: str
    filter: str
    size: int
    width: int
    as_sky: bool = False
    group: str = "shader pyramid"
    chosen: dict = field(default_factory=dict)
    known: dict = field(default_factory=dict)

    def job(self):
        return {
            "filter": FILTERS[self.filter],
            "size": self.size,
            "panorama": f"panorama_{self.width}",
            "as_sky": self.as_sky,
        }

    @property
    def is_round(self):
        return self.filter in ("gaussian", "disc")

    @property
    def base(self):
        """What level 0 is blurred by."""
        return 0.5 * LEVEL_VARIANCES[self.filter] if self.is_round and self.width <= 2 * self.size else 0.0

    def texels(self, size):
        """(face, row, column) of those that are compared: all of small levels, also at edges and corners."""
        if size not in self.chosen:
            every = np.indices((6, size, size)).reshape(3, -1).T
            if len(every) > MOST_TEXELS:
                rng = np.random.default_rng(size)
                every = every[rng.choice(len(every), MOST_TEXELS, replace=False)]
                every[:30, 1], every[10:40, 2] = 0, size - 1
            self.chosen[size] = every
        return self.chosen[size]

    def judge(self, read, renderer):
        """One case a level; read(level) gives a level's bytes."""
        verdicts, finer, before = [], None, b""
        for level in range(self.size.bit_length()):
            size = self.size >> level
            title = f"pyramid {self.filter} {self.size} of {self.width}, level {level}"
            verdict = Verdict({"name": f"shader {title} in {renderer}"}, self.group)
            verdict.result |= {"renderer": renderer, "precision": "single"}
            data = read(level)
            faces = atlas_faces(data, size)
            verdict.finite(faces.ravel().tolist(), "a texel")
            if not verdict.result["finite"]:
                verdicts.append(verdict.done())
                break
            # Renderers mostly agree on the finer level.
            if (level, before) not in self.known:
                self.known[level, before] = [
                    self.from_panorama(*at) if level == 0 else self.from_finer(finer, *at, level)
                    for at in self.texels(size)
                ]
            for (face, row, column), (wanted, slack) in zip(self.texels(size), self.known[level, before]):
                # Half floats, below 6e-5 in steps of 2^-24, and sums of a few thousand terms.
                bound = 1.01 * HALF / 2 * wanted + 2.0**-24 + slack + 64 * U * wanted
                off = np.abs(faces[face, row, column] - wanted)
                worst = int(np.argmax(off / bound))
                verdict.error(float(off[worst]), float(bound[worst]), "radiance")
            finer, before = faces, data
            verdicts.append(verdict.done())
        return verdicts

    # Level 0

    def from_panorama(self, face, row, column):
        texels = panorama_texels(self.width)
        centre = [(n + 0.5) * 2 / self.size - 1 for n in (column, row)]
        if self.base == 0.0:
            samples = min(max(math.ceil(self.width / (2 * self.size)), 1), 8)
            within = (np.arange(samples) + 0.5) / samples
            x, y = np.meshgrid((column + within) * 2 / self.size - 1, (row + within) * 2 / self.size - 1)
            d = face_direction(face, x.ravel(), y.ravel())
            light, spread = panorama_spread(texels, d)
            return light.mean(axis=0), spread.mean(axis=0)
        # The mean over a square as wide as its variance has it, along the panorama's rows and columns.
        variance = self.base + TENT * (1 - (1 + centre[0] ** 2 + centre[1] ** 2) ** -1.5)
        half = math.sqrt(3 * variance) * 2 / self.size
        d = unit(face_direction(face, np.array(centre[0]), np.array(centre[1])))
        azimuth = 2 * math.atan2(half, 2 * math.hypot(d[0], d[2]))
        mean = square_mean(texels, d, azimuth, half)
        corners = [(u, v) for u in (-ANGLES, ANGLES) for v in (-ANGLES, ANGLES)]
        seen = [square_mean(texels, d, azimuth * (1 + wide), half, *at) for at in corners for wide in (-ATAN, ATAN)]
        return mean, np.max(np.abs(np.array(seen) - mean), axis=0)

    # The others

    def from_finer(self, finer, face, row, column, level):
        if self.is_round:
            return self.round_mean(finer, face, row, column, level)
        return self.reduced(finer, face, row, column), 0.0

    def round_mean(self, finer, face, row, column, level):
        """A disc or a Gaussian about the texel's direction, over all texels by their solid angles."""
        size, finer_size = self.size >> level, finer.shape[1]
        x, y = ((n + 0.5) * 2 / size - 1 for n in (column, row))
        # Outermost texels take their light from a little nearer to the middle.
        shortened = 1 - 0.25 / size
        x, y = (
            x * (shortened if row in (0, size - 1) else 1.0),
            y * (shortened if column in (0, size - 1) else 1.0),
        )
        d = unit(face_direction(face, np.array(x), np.array(y)))
        step = 2 / finer_size
        blurred = level > 1 or self.base > 0
        kernel = (3 * LEVEL_VARIANCES[self.filter], 3 * TENT, 0.0)
        base, shrinking, slope = COARSE_DISCS.get(size, kernel)
        if not blurred:
            shrinking += TENT
        texels = base + shrinking * (1 - (1 + x * x + y * y) ** -1.5)
        raw = face_directions(finer_size).reshape(-1, 3)
        length = np.linalg.norm(raw, axis=1)
        cosine = raw @ d / length
        distance = np.sqrt(np.maximum(2 - 2 * cosine, 0))
        light = finer.reshape(-1, 3)
        variance = texels / REACHED_SHARE * step**2
        radius = 2 * math.sqrt(texels - RIM_VARIANCE) * step
        is_gaussian = self.filter == "gaussian" and size not in COARSE_DISCS
        if is_gaussian:
            reach = REACH * math.sqrt(variance)
        else:
            reach = 2 * math.asin(min(0.5 * radius + 0.25 * step, 1.0))
        if is_gaussian:
            kernel = np.exp(-0.5 * distance**2 / variance)
        else:
            kernel = np.clip((radius - distance) / step + 0.5, 0, 1)
            kernel = kernel * (1 + slope * np.minimum((distance / radius) ** 2, 1))
        weights = kernel / length**3
        angle = np.arccos(np.clip(cosine, -1, 1))
        # What lies beyond the reach is looked at in the corners of rectangles only: it may count or not.
        everywhere = reach >= MOST_REACH
        sure = (angle < reach - (0.75 * step if is_gaussian else 1e-6)) | everywhere
        some = weights * sure
        mean = (some[:, None] * light).sum(axis=0) / some.sum()
        unsure = (weights * ~sure)[:, None] * np.abs(light - mean)
        rim = CONSTANTS * ((kernel > 0) & sure)[:, None] * np.abs(light - mean) / length[:, None] ** 3
        return mean, (unsure.sum(axis=0) + rim.sum(axis=0)) / some.sum()

    def reduced(self, finer, face, row, column):
        """[1 1] / 2 or [1 3 3 1] / 8 along each axis, by solid angles; beyond an edge the neighbouring face's texel."""
        size = finer.shape[1]
        offsets = {0: 1.0, 1: 1.0} if self.filter == "box" else {-1: 1.0, 0: 3.0, 1: 3.0, 2: 1.0}
        total, weights = np.zeros(3), 0.0
        for j, wy in offsets.items():
            for i, wx in offsets.items():
                tap = [2 * column + i, 2 * row + j]
                inside = [min(max(t, 0), size - 1) for t in tap]
                taps = [(tap, 1.0)]
                if tap[0] != inside[0] and tap[1] != inside[1]:
                    # No texel lies diagonally across a corner of the cube: the two beside it share.
                    taps = [([tap[0], inside[1]], 0.5), ([inside[0], tap[1]], 0.5)]
                for (x, y), share in taps:
                    at = self.neighbour(face, x, y, size)
                    p = [(n + 0.5) * 2 / size - 1 for n in at[1:]]
                    weight = wx * wy * share * (1 + p[0] ** 2 + p[1] ** 2) ** -1.5
                    total += weight * finer[at[0], at[2], at[1]]
                    weights += weight
        return total / weights

    @staticmethod
    def neighbour(face, x, y, size):
        """(face, column, row) of a texel at most one step beyond the edge."""
        if 0 <= x < size and 0 <= y < size:
            return face, x, y
        p = [(n + 0.5) * 2 / size - 1 for n in (x, y)]
        beyond = 0 if not 0 <= x < size else 1
        p[1 - beyond] *= 1 + 1 / size
        d = face_direction(face, np.array(p[0]), np.array(p[1]))
        other, px, py = face_of([float(c) for c in d])
        return other, *(min(max(int((float(c) + 1) / 2 * size), 0), size - 1) for c in (px, py))


def pyramids(quick):
    """Panoramas finer than the cube, and so coarse that level 0 is blurred."""
    sizes = ((16, 32), (8, 64)) if quick else ((4, 8), (16, 32), (16, 128), (64, 64), (64, 256), (256, 256))
    return [Pyramid(f"pyramid_{f}_{size}_{width}", f, size, width) for f in FILTERS for size, width in sizes]


def textures(all_pyramids, all_passes):
    found = {}
    for width in {pyramid.width for pyramid in all_pyramids}:
        found[f"panorama_{width}"] = Texture(panorama_texels(width).tobytes(), width, width // 2, is_float=True)
    for one in all_passes:
        found |= dict(one.textures())
    return found


def reader(out, one, number=0):
    def read(level):
        name = f"{one.name}.{number}.bin" if level is None else f"{one.name}.{number}.{level}.bin"
        path = out / name
        if not path.exists():
            raise EngineError(f"{name} was not written")
        return path.read_bytes()

    return read

