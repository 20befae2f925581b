"""The pyramid's other shaders, each by itself: level 0 from captured views, and a level as bytes."""

from dataclasses import dataclass

import numpy as np

from probes import HALF, U, Texture, pow_error
from shader_pyramid import atlas_faces
from verdict import Verdict

# Captured views


def view_colours(size, samples):
    """Six pictures, among whose pixels are some that are no light."""
    rng = np.random.default_rng(13)
    pictures = rng.uniform(0.0, 4.0, size=(6, size * samples, size * samples, 4)).astype(np.float32)
    pictures[0, 0, :3, :3] = [[np.nan, 1.0, 2.0], [np.inf, 0.5, -1.0], [1e10, 7e4, 65504.0]]
    return pictures


@dataclass
class Views:
    """Level 0 from six views."""

    name: str
    size: int
    samples: int
    group: str = "shader views"

    def job(self):
        return {
            "shader": "skies/pyramid_views",
            "width": 3 * self.size,
            "height": 2 * self.size,
            "half": True,
            "textures": {f"view_{n}": f"{self.name}_{n}" for n in range(6)},
            "integers": {"face_size": [self.size], "samples": [self.samples]},
        }

    def textures(self):
        side = self.size * self.samples
        for n, picture in enumerate(view_colours(self.size, self.samples)):
            yield f"{self.name}_{n}", Texture(picture.tobytes(), side, side, is_float=True)

    def judge(self, read, renderer):
        verdict = Verdict({"name": f"shader views of {self.samples} pixels a texel in {renderer}"}, self.group)
        verdict.result |= {"renderer": renderer, "precision": "single"}
        faces = atlas_faces(read(None), self.size)
        verdict.finite(faces.ravel().tolist(), "a texel")
        if verdict.result["finite"]:
            light = self.light(renderer)
            # A view's columns run the other way round.
            side, count = self.size, self.samples
            light = light[:, :, ::-1].reshape(6, side, count, side, count, 3)
            wanted = light.mean(axis=(2, 4))
            power = pow_error(1.0, 2.4) + pow_error(65504.0**0.4, 2.4) if renderer == "gl_compatibility" else 0.0
            bound = 1.01 * HALF / 2 * wanted + 2.0**-24 + (64 * U + power) * wanted
            off = np.abs(faces - wanted)
            worst = np.unravel_index(np.argmax(off / bound), off.shape)
            verdict.error(float(off[worst]), float(bound[worst]), "radiance")
        return [verdict.done()]

    def light(self, renderer):
        """What a half float can hold; negative or no number is none. Compatibility's viewports hold
        1.055 L^(1/2.4) - 0.055."""
        pixels = view_colours(self.size, self.samples)[..., :3].astype(float)
        sound = np.isfinite(pixels) & (pixels > 0)
        pixels = np.where(sound, pixels, 0.0)
        if renderer == "gl_compatibility":
            pixels = np.where(sound, ((pixels + 0.055) / 1.055) ** 2.4, 0.0)
        return np.minimum(pixels, 65504.0)


# Bytes


@dataclass
class Pack:
    """A level's face as bytes."""

    name: str
    size: int
    face: int
    group: str = "shader pack"

    def halves(self):
        rng = np.random.default_rng(17)
        bits = rng.integers(0, 0x7C00, size=(2 * self.size, 3 * self.size, 4), dtype=np.uint16)
        bits[0, 0, :3] = (0, 1, 0x7BFF)
        return bits

    def job(self):
        return {
            "shader": "compatibility/pyramid_pack",
            "width": 2 * self.size,
            "height": self.size,
            "half": False,
            "textures": {"level": self.name},
            "integers": {
                "level_size": [self.size],
                "level_face": [self.face],
                "extent": [2 * self.size, self.size],
            },
        }

    def textures(self):
        yield self.name, Texture(self.halves().tobytes(), 3 * self.size, 2 * self.size)

    def judge(self, read, renderer):
        verdict = Verdict({"name": f"shader pack face {self.face} of {self.size} in {renderer}"}, self.group)
        verdict.result |= {"renderer": renderer, "precision": "single"}
        x, y = self.face % 3 * self.size, self.face // 3 * self.size
        wanted = self.halves()[y : y + self.size, x : x + self.size].copy()
        wanted[..., 3] = 0x3C00
        found = np.frombuffer(read(None), dtype=np.uint16).reshape(wanted.shape)
        # Numbers below 6.1e-5 may come as zero: drivers may flush them, as Vulkan allows.
        tiny = wanted < 0x0400
        verdict.error(float(np.count_nonzero((found != wanted) & ~(tiny & (found == 0)))), 0.5, "wrong numbers")
        return [verdict.done()]


def passes(quick):
    views = [Views(f"views_{samples}", 4 if quick else 16, samples) for samples in ((1, 3) if quick else (1, 2, 3, 4))]
    packs = [Pack(f"pack_{size}_{face}", size, face) for size in ((4,) if quick else (2, 4, 16)) for face in (0, 4)]
    return [*views, *packs]
