"""Probes of the lights of a pixel's place: where on a box's walls a lobe is looked up, how wide, and how much counts.

The lights are drawn as light_list.gd writes them; what is expected comes from the boxes by geometry: the nearest of the
planes ahead, the point on it, and what an angle there is from where the light was captured.
"""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import exact_shader as shader
from exact import dot, mpf, norm, normalised, vector
from probes import DIVISION, FILTER, HALF, Holds, Near, Probe, Texture, U, single
from shader_light import DIRECTION_BOUND, direction_light
from shader_points import exact_level, level_bound, light, turn

WIDTH, TEXELS = 16, 8
WORLD = 3
EVERYWHERE = 1e9
# As near as a wall counts as: in metres, and of half the box (LOBELIGHT_NEAREST_WALL, LOBELIGHT_NEAREST_SHARE).
NEAREST_WALL, NEAREST_SHARE = float(np.float32(0.15)), float(np.float32(0.9))
SIZE, FILTER_NAME = 128, "disc"


@dataclass
class Room:
    """A light of the list; `axes` are its axes in the world."""

    axes: tuple
    middle: tuple
    half: tuple
    fade: float
    capture: tuple  # from the middle, along the axes
    is_lower: bool
    share: float = 1.0

    def __post_init__(self):
        self.axes = tuple(tuple(single(axis)) for axis in self.axes)
        moved = [-sum(a * m for a, m in zip(axis, self.middle)) for axis in self.axes]
        self.moved = tuple(single(moved))
        self.slope = float(single(0.0 if self.is_everywhere else 1.0 / self.fade))
        self.reach = 1e18 if self.is_everywhere else 1.0001 * sum((h + self.fade) ** 2 for h in self.half)

    @property
    def is_everywhere(self):
        return self.half[0] == EVERYWHERE

    def texels(self):
        values = light(SIZE, FILTER_NAME, 0.0, "directions")
        texel = 4.0 / SIZE**2
        c = values["level_variance"]
        sharpest, level = texel * c, -0.5 * math.log2(texel * (c + 1.0 / 6.0))
        rows = [(*axis, t) for axis, t in zip(self.axes, self.moved)]
        return [
            *rows,
            (*self.half, self.slope),
            (*(-x for x in self.capture), -1.0),
            (self.share, 1.0, sharpest, level),
            (0.0, 0.0, 0.0, 0.0),
            (*self.middle, -self.reach if self.is_lower else self.reach),
        ]

    def local(self, place):
        """The place in the box and what single precision may be off by, along each axis."""
        at = [dot(vector(axis), place) + mpf(t) for axis, t in zip(self.axes, self.moved)]
        off = 4 * U * max(
            sum(abs(a * float(x)) for a, x in zip(axis, place)) + abs(t) for axis, t in zip(self.axes, self.moved)
        )
        return at, off

    def own_share(self, place):
        """(share before priorities, bound)."""
        at, off = self.local(place)
        depth = min(mpf(h) - abs(x) for h, x in zip(self.half, at))
        share = min(max(self.share + depth * mpf(self.slope), mpf(0)), mpf(1))
        if norm([place[n] - mpf(self.middle[n]) for n in range(3)]) ** 2 > self.reach:
            share = mpf(0)
        return share, self.slope * (off + 2 * U * max(self.half)) + 4 * U

    def seen(self, place, direction, variance):
        """(direction from the capture to where the lobe meets the walls, over the distance to there; its bound; by what slant
        the blur is seen from there; its relative bound)."""
        at, off = self.local(place)
        d = [dot(vector(axis), direction) for axis in self.axes]
        largest = [mpf(max(NEAREST_SHARE * h, h - NEAREST_WALL)) for h in self.half]
        inside = [min(max(x, -most), most) for x, most in zip(at, largest)]
        each, worst = [], 0.0
        for x, m, h in zip(inside, d, map(mpf, self.half)):
            each.append(abs(m) / (h - x if m > 0 else h + x))
            # H^2 - p^2 cancels near a wall, and m along + |m| aside where the ray leaves the near one.
            left = float(h * h - x * x)
            relative = DIVISION + 10 * U + (4 * float(h) * off + 6 * U * float(h) ** 2) / left
            size = float((abs(x) + h) / (h * h - x * x))
            worst = max(worst, (abs(float(m)) * relative + 6 * U) * size)
        offset = [x - mpf(c) for x, c in zip(inside, self.capture)]
        nearness = max(each)
        # The mean distance of a lobe: 1.2 V more, 0.35 at most.
        nearer = nearness * (1 - min(mpf("1.2") * variance, mpf("0.35")))
        found = [m + o * nearer for m, o in zip(d, offset)]
        length, s = float(norm(offset)), float(nearness)
        reach = float(norm(found))
        shift = 2 * off + 4 * U * (length + max(map(abs, self.capture)))
        bound = length * worst + s * shift + 8 * U * (1 + length * s)
        # Of walls that are equally near, either is right.
        slants, slant_bound = [], 0.0
        for n in range(3):
            if each[n] > 0 and each[n] >= nearness - 2 * worst:
                growth = offset[n] * nearness / d[n]
                slants.append(min(max((1 + growth) / norm(found), mpf("0.4")), mpf("1.6")))
                size = (float(abs(offset[n])) * worst + s * shift) / abs(float(d[n])) + 8 * U * (1 + abs(float(growth)))
                slant_bound = max(slant_bound, size / reach + abs(1 + float(growth)) / reach * bound / reach)
        slant_bound += float(max(slants) - min(slants)) + 8 * U
        return found, bound, max(slants), slant_bound / float(min(slants))


def list_texture(rooms):
    height = 1 << (len(rooms) + TEXELS).bit_length()
    texels = np.zeros((height, WIDTH, 4), dtype=np.float32)
    texels[0, WORLD, :2] = (1, 1 + len(rooms))
    for line, room in enumerate(rooms, start=1):
        for k, texel in enumerate(room.texels()):
            texels[line + k, k] = texel
    return Texture(texels.tobytes(), WIDTH, height, is_float=True)


def shares_of(rooms, place, last):
    """The share of each light up to `last`, their sum, and the sum of the bounds."""
    total, covered, bound, found = mpf(0), mpf(0), 0.0, []
    for room in rooms[: last + 1]:
        if room.is_lower:
            covered = min(total, mpf(1))
        own, off = room.own_share(place)
        found.append(own * (1 - covered))
        total += found[-1]
        bound += off + 2 * U
    return found, total, 2 * bound


def expect_placed(rooms, row):
    place, last = vector(row[:3]), int(row[3])
    direction, variance = vector(row[4:7]), mpf(row[7])
    found, total, bound = shares_of(rooms, place, last)
    checks = [Near((4,), (found[last],), bound, "share"), Near((5,), (total,), bound, "share")]
    if found[last] <= bound:
        return checks
    wanted, off, slant, slant_off = rooms[last].seen(place, direction, variance)
    square = dot(wanted, wanted)
    length = float(norm(wanted))
    checks.append(Near((0, 1, 2), wanted, off, "direction"))
    values = light(SIZE, FILTER_NAME, 0.0, "directions")
    narrow = variance / square * slant
    level = float(exact_level(narrow, wanted, values))
    level_off = level_bound(float(narrow), values) + (2.0 * off / length + slant_off) / math.log(2)
    checks.append(Holds(lambda results: (abs(max(results[3], 0.0) - max(level, 0.0)), level_off, "levels")))
    light_off = 2 * (DIRECTION_BOUND + off / length) + FILTER * 0.01
    checks.append(Near((6, 7, 8), direction_light(normalised(wanted)), light_off, "radiance", 3 * HALF))
    return checks


def rooms_of(number):
    everywhere = Room(turn(5), (0, 0, 0), (EVERYWHERE,) * 3, 0.0, (0, 0, 0), True)
    plain = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    if number == 0:
        return [Room(plain, (0, 0, 0), (3, 1.5, 4), 1.0, (0.5, -0.25, 1.0), False), everywhere]
    return [
        Room(turn(1), (2, 1, -3), (2, 3, 1), 0.5, (-1.0, 0.5, 0.25), False),
        Room(turn(2), (3, 1, -2), (4, 2, 3), 2.0, (1.0, 0.5, -2.0), False),
        Room(turn(3), (0, 0, 0), (30, 20, 10), 4.0, (0.0, 0.0, 0.0), True),
        Room(turn(4), (0, 0, 0), (EVERYWHERE,) * 3, 0.0, (0, 0, 0), True, 0.25),
        everywhere,
    ]


def probes(quick):
    """(textures, probes)."""
    textures, made = {}, []
    for number in (0, 1):
        rooms = rooms_of(number)
        name = f"placed_{number}"
        textures[name + "_list"] = list_texture(rooms)
        probe = Probe(name, "shader placed light", "placed", 9, partial(expect_placed, rooms))
        probe.textures = {"lobelight_lights": name + "_list", "lobelight_environment": "directions"}
        random = np.random.default_rng(number)
        for last, room in enumerate(rooms):
            half = [min(h, 50.0) for h in room.half]
            for title, spread in (("inside", 0.98), ("at the walls", 1.0), ("around", 1.6)):
                rows = []
                for _ in range(12 if quick else 200):
                    at = random.uniform(-spread, spread, 3)
                    if spread == 1.0:
                        axis = random.integers(3)
                        at[axis] = math.copysign(random.choice([1.0, 0.9999, 0.99]), at[axis])
                    local = [x * h for x, h in zip(at, half)]
                    place = [room.middle[n] + sum(a[n] * x for a, x in zip(room.axes, local)) for n in range(3)]
                    direction = normalised(vector(random.normal(size=3)))
                    rows.append((*place, last, *map(float, direction), 10.0 ** random.uniform(-6, 0)))
                probe.add(f"placed light {last} of {len(rooms)}, {title}", rows)
        made.append(probe)
    return textures, made
