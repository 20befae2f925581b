"""A synthetic map with the contrast of Grace Cathedral: its brightest texel is 60000 times its median.

A dim, textured interior with columns, a tiled floor, rows of windows, lamps, and two windows that the sun shines through.
The same bytes on every run: the only random numbers are those of `random.Random`, whose sequence Python guarantees, and
half floats take off what a machine's sine may differ by.
"""

import hashlib
import math
import pathlib
import random

import numpy as np
import OpenEXR

WIDTH, HEIGHT = 1024, 512
PEAK_OVER_MEDIAN = 6e4
SEED = 20150601
WAVES = 160
TINT = np.array([0.9, 0.6, 0.35])


def directions():
    """Polar angle and azimuth in radians of every texel's middle, each (HEIGHT, WIDTH)."""
    theta = (np.arange(HEIGHT) + 0.5) / HEIGHT * np.pi
    phi = ((np.arange(WIDTH) + 0.5) / WIDTH - 0.5) * 2 * np.pi
    return np.meshgrid(theta, phi, indexing="ij")


def noise(random_numbers, theta, phi):
    """Waves of all lengths through space, seen on the sphere: no seam and no poles. Standard deviation 1."""
    place = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)
    total = np.zeros(theta.shape)
    for _ in range(WAVES):
        frequency = 2.0 * 100.0 ** random_numbers.random()
        z = 2.0 * random_numbers.random() - 1.0
        angle = 2.0 * math.pi * random_numbers.random()
        side = math.sqrt(1.0 - z * z)
        wave = frequency * np.array([side * math.cos(angle), side * math.sin(angle), z])
        total += frequency**-0.35 * np.cos(place @ wave + 2.0 * math.pi * random_numbers.random())
    return total / total.std()


def make():
    """Radiance, float64 (HEIGHT, WIDTH, 3)."""
    numbers = random.Random(SEED)
    theta, phi = directions()
    tone, colour = noise(numbers, theta, phi), noise(numbers, theta, phi)
    shade = 0.08 * np.exp(1.1 * tone) * (1.0 + 1.5 * np.cos(theta) ** 2)
    columns = (np.cos(24 * phi) > 0.8) & (np.abs(theta - np.pi / 2) < 0.6)
    shade[columns] *= 0.35
    floor = theta > 2.1
    x, y = (2.0 * np.tan(theta - np.pi / 2) ** -1 * part for part in (np.cos(phi), np.sin(phi)))
    shade[floor & ((np.floor(x) + np.floor(y)) % 2 == 0)] *= 2.2
    radiance = shade[..., None] * TINT * np.exp(0.25 * colour[..., None] * np.array([-1.0, 0.0, 1.0]))

    def window(azimuth, polar, half_width, half_height, light):
        inside = np.abs((phi - azimuth + np.pi) % (2 * np.pi) - np.pi) < half_width
        radiance[inside & (np.abs(theta - polar) < half_height)] = light

    for k in range(14):
        azimuth = -np.pi + 2 * np.pi * (k + 0.5) / 14
        window(azimuth, 1.05, 0.022, 0.12, 20 * np.exp(numbers.gauss(0, 0.8)) * np.array([1.0, 1.0, 1.1]))
        window(azimuth + 0.06, 1.05, 0.012, 0.10, 15 * np.exp(numbers.gauss(0, 0.8)) * np.array([0.6, 0.8, 1.3]))
    for azimuth, light in ((-1.7, 300.0), (-1.2, 150.0), (-0.7, 400.0)):
        window(azimuth, 0.75, 0.03, 0.10, light * np.array([1.0, 1.0, 1.1]))
    for _ in range(24):
        light = 1000 * np.exp(numbers.gauss(0, 0.7)) * np.array([1.2, 0.95, 0.6])
        window(numbers.uniform(-np.pi, np.pi), numbers.uniform(0.5, 1.5), 0.007, 0.007, light)
    peak = PEAK_OVER_MEDIAN * np.median(radiance.mean(axis=-1))
    radiance = np.minimum(radiance, 0.7 * peak)
    window(1.6, 0.9, 0.010, 0.010, np.full(3, 0.75 * peak))
    window(-2.4, 0.6, 0.008, 0.008, np.full(3, peak))
    return radiance


def version():
    """Of this file, for the map's name."""
    return hashlib.sha256(pathlib.Path(__file__).read_bytes()).hexdigest()[:12]


def write(path):
    """Writes the map as half floats; an existing file is replaced as a whole."""
    temporary = path.with_name("." + path.name)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": make().astype(np.float16)}) as file:
        file.write(str(temporary))
    temporary.replace(path)
