#!/usr/bin/env python3
"""Rooms for `./dev compare --room`: six pictures of walls and ROOM.json in a folder.

  rooms.py PANORAMA|synthetic FOLDER [--size X,Y,Z] [--probe X,Y,Z] [--centre X,Y,Z] [--radius R] [--texels N]

A wall's texel at the point q shows the panorama in the direction q / |q|, as it looks from the room's middle. `synthetic`
is a made-up room: tiles, stripes, a window and lamps.
"""

import argparse
import json
import pathlib
import sys

import metrics
import numpy as np
import OpenEXR

WALLS = ("+x", "-x", "+y", "-y", "+z", "-z")
# Of d = q / (size / 2): the axis across, its sign, and (axis, sign) of s and of t, as `./dev compare --help` has them.
FACES = {
    "+x": (0, 1, (2, -1), (1, -1)),
    "-x": (0, -1, (2, 1), (1, -1)),
    "+y": (1, 1, (0, 1), (2, 1)),
    "-y": (1, -1, (0, 1), (2, -1)),
    "+z": (2, 1, (0, 1), (1, -1)),
    "-z": (2, -1, (0, -1), (1, -1)),
}
BOX = (6.0, 3.0, 8.0)


def wall_points(wall, size, texels):
    """The points of the wall's texels, (texels, texels, 3), in metres."""
    axis, sign, (s_axis, s_sign), (t_axis, t_sign) = FACES[wall]
    centres = (2 * np.arange(texels) + 1) / texels - 1
    d = np.empty((texels, texels, 3))
    d[..., axis] = sign
    d[..., s_axis] = s_sign * centres[None, :]
    d[..., t_axis] = t_sign * centres[:, None]
    return d * np.asarray(size) / 2


def sample_panorama(panorama, directions):
    """Bilinear, wrapped in u, clamped in v; directions (…, 3) of any length."""
    height, width = panorama.shape[:2]
    d = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    u = np.mod(np.arctan2(d[..., 0], -d[..., 2]) / (2 * np.pi), 1)
    v = np.arccos(np.clip(d[..., 1], -1, 1)) / np.pi
    x, y = u * width - 0.5, np.clip(v * height - 0.5, 0, height - 1)
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    across, down = (x - left)[..., None], (y - top)[..., None]
    columns, rows = (left % width, (left + 1) % width), (top, np.minimum(top + 1, height - 1))
    upper = panorama[rows[0], columns[0]] * (1 - across) + panorama[rows[0], columns[1]] * across
    lower = panorama[rows[1], columns[0]] * (1 - across) + panorama[rows[1], columns[1]] * across
    return upper * (1 - down) + lower * down


def cut(panorama, size, texels):
    """{wall: picture} of a panorama's light on the walls of a box."""
    light = np.nan_to_num(np.maximum(panorama, 0), nan=0, posinf=0)
    return {wall: sample_panorama(light, wall_points(wall, size, texels)) for wall in WALLS}


def synthetic(size, texels):
    """{wall: picture}: a tiled floor, striped walls, a window at -z, three lamps at the ceiling and a small one at -x."""
    colours = {
        "+x": (0.30, 0.12, 0.08),
        "-x": (0.08, 0.16, 0.28),
        "+y": (0.40, 0.38, 0.34),
        "-y": (0.22, 0.18, 0.14),
        "+z": (0.16, 0.24, 0.12),
        "-z": (0.26, 0.22, 0.20),
    }
    pictures = {}
    for wall in WALLS:
        q = wall_points(wall, size, texels)
        x, y, z = np.moveaxis(q, -1, 0)
        if wall == "-y":
            shade = np.where((np.floor(2 * x) + np.floor(2 * z)) % 2 == 0, 1.0, 0.25)
        elif wall == "+y":
            shade = np.full(x.shape, 1.0)
        else:
            shade = np.where(np.floor(3 * (x + z)) % 2 == 0, 1.0, 0.4) * (1 + 0.4 * y)
        picture = shade[..., None] * np.array(colours[wall])
        if wall == "+y":
            for place in (-2.5, 0.0, 2.5):
                picture[(np.abs(x) < 0.6) & (np.abs(z - place) < 0.2)] = (22.0, 20.0, 16.0)
        if wall == "-z":
            picture[(np.abs(x + 0.8) < 1.0) & (np.abs(y - 0.1) < 0.8)] = (5.0, 7.0, 9.0)
        if wall == "-x":
            picture[(y - 0.3) ** 2 + (z - 1.5) ** 2 < 0.04] = (40.0, 30.0, 12.0)
        pictures[wall] = picture
    return pictures


def write(folder, pictures, size, probe, centre, radius):
    """Writes the pictures and ROOM.json below `folder`; its path."""
    folder.mkdir(parents=True, exist_ok=True)
    names = {}
    for wall, picture in pictures.items():
        names[wall] = {"+": "plus_", "-": "minus_"}[wall[0]] + wall[1] + ".exr"
        header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
        channels = {"RGB": np.ascontiguousarray(picture, dtype=np.float32)}
        OpenEXR.File(header, channels).write(str(folder / names[wall]))
    path = folder / "ROOM.json"
    room = {
        "size": list(size),
        "walls": names,
        "probe": list(probe),
        "sphere": {"centre": list(centre), "radius": radius},
    }
    metrics.write_json(str(path), room)
    return path


def three(text):
    numbers = [float(part) for part in text.split(",")]
    if len(numbers) != 3:
        raise argparse.ArgumentTypeError(f"takes three numbers X,Y,Z, not {text}")
    return numbers


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("light", help="an OpenEXR panorama, or: synthetic")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", type=three, default=BOX)
    parser.add_argument("--probe", type=three, default=(0.0, 0.0, 0.0))
    parser.add_argument("--centre", type=three, default=(0.3, -0.2, 0.3))
    parser.add_argument("--radius", type=float, default=0.4)
    parser.add_argument("--texels", type=int, default=512)
    options = parser.parse_args()
    try:
        if options.light == "synthetic":
            pictures = synthetic(options.size, options.texels)
        else:
            pictures = cut(metrics.read_rgb(options.light), options.size, options.texels)
        print(write(options.folder, pictures, options.size, options.probe, options.centre, options.radius))
    except (metrics.MetricError, OSError) as problem:
        sys.exit(f"rooms: {problem}")


if __name__ == "__main__":
    main()
