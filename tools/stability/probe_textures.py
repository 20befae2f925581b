"""Textures for probes: environments whose light is known everywhere, and tables."""

import numpy as np

from probes import Texture

# A cube map, every level of one colour: what is looked up says at which level.
LEVELS_SIZE = 64


def level_colours():
    count = LEVELS_SIZE.bit_length()
    n = np.arange(count)
    return np.stack([1 + 0.25 * n, 2 - 0.125 * n, 0.5 + 0.0 * n], axis=1)


def levels_cube(colours):
    face = b""
    for n, colour in enumerate(colours):
        side = LEVELS_SIZE >> n
        face += np.tile(np.array([*colour, 1.0], dtype=np.float32), side * side).tobytes()
    return Texture(face * 6, LEVELS_SIZE, LEVELS_SIZE, 6, True, "cube", True)


# A cube map without levels: 1 + d/2 of the direction d, which says where it is looked up.
DIRECTIONS_SIZE = 256


def face_directions(size):
    """(6, size, size, 3), not unit: OpenGL 4.6, table 8.19, rows from the top."""
    at = (np.arange(size) + 0.5) * 2 / size - 1
    x, y = np.meshgrid(at, at)
    one = np.ones_like(x)
    faces = [(one, -y, -x), (-one, -y, x), (x, one, y), (x, -one, -y), (x, -y, one), (-x, -y, -one)]
    return np.stack([np.stack(face, axis=-1) for face in faces])


def directions_cube():
    d = face_directions(DIRECTIONS_SIZE)
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    texels = np.concatenate([1 + 0.5 * d, np.ones((*d.shape[:-1], 1))], axis=-1).astype(np.float32)
    return Texture(texels.tobytes(), DIRECTIONS_SIZE, DIRECTIONS_SIZE, 6, True, "cube", False)


def textures():
    colours = level_colours()
    return {
        "levels": levels_cube(colours),
        "flat": levels_cube(np.ones_like(colours)),
        "directions": directions_cube(),
    }
