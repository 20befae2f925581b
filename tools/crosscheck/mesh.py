"""The teapot as pictures of its normals and tangents, drawn in NumPy: what the reference takes for a surface.

Orthographic: every pixel is seen from the same direction. A pixel shows the nearest triangle at its centre, with normals
interpolated between the corners; a corner's normal is the mean of its triangles', weighted by their angles there (Thürmer
and Wüthrich 1998), as in Mitsuba. The tangent is (0, 1, 0) × normal, as on the sphere of ./dev compare.
"""

from dataclasses import dataclass

import numpy as np

# Where the tangent is not clear, or the surface is seen from almost along itself, nothing is compared.
LEAST_TANGENT = 0.05
LEAST_COSINE = 0.05


@dataclass
class Camera:
    """A picture of width × height pixels, `scale` units wide, around `middle`; `view` points from it to the viewer."""

    view: tuple
    middle: tuple
    scale: float
    width: int
    height: int

    def axes(self):
        """Right, up and view as rows, (3, 3)."""
        view = np.array(self.view) / np.linalg.norm(self.view)
        right = np.cross([0.0, 1.0, 0.0], view)
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(view, right), view])

    def places(self):
        """The pixels' centres on the plane through the middle, (height, width, 3)."""
        right, up, _ = self.axes()
        step = self.scale / self.width
        x = (np.arange(self.width) + 0.5 - self.width / 2) * step
        y = (self.height / 2 - np.arange(self.height) - 0.5) * step
        return np.array(self.middle) + x[None, :, None] * right + y[:, None, None] * up


def read_obj(path):
    """Corners (n, 3) and triangles (m, 3) of indices from zero."""
    corners, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, *values = line.split() or [""]
        if kind == "v":
            corners.append([float(value) for value in values])
        elif kind == "f":
            triangles.append([int(value.split("/")[0]) - 1 for value in values])
    return np.array(corners), np.array(triangles)


def corner_normals(corners, triangles):
    """Unit vectors (n, 3)."""
    sums = np.zeros_like(corners)
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    flat = np.cross(b - a, c - a)
    flat /= np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-300)
    for k, (here, left, right) in enumerate(((a, b, c), (b, c, a), (c, a, b))):
        one, two = left - here, right - here
        angle = np.arctan2(np.linalg.norm(np.cross(one, two), axis=1), (one * two).sum(axis=1))
        np.add.at(sums, triangles[:, k], flat * angle[:, None])
    return sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-300)


def normals(path, camera):
    """Unit vectors (height, width, 3), 0 where the pixel shows nothing."""
    corners, triangles = read_obj(path)
    smooth = corner_normals(corners, triangles)
    right, up, view = camera.axes()
    step = camera.scale / camera.width
    relative = corners - np.array(camera.middle)
    # In pixels from the picture's corner; larger depths are nearer.
    x = relative @ right / step + camera.width / 2
    y = camera.height / 2 - relative @ up / step
    depth = relative @ view
    nearest = np.full((camera.height, camera.width), -np.inf)
    picture = np.zeros((camera.height, camera.width, 3))
    for corner in triangles:
        px, py = x[corner], y[corner]
        area = (px[1] - px[0]) * (py[2] - py[0]) - (px[2] - px[0]) * (py[1] - py[0])
        left, top = (max(0, int(np.floor(p.min() - 0.5))) for p in (px, py))
        columns = np.arange(left, min(camera.width, int(np.ceil(px.max() + 0.5)))) + 0.5
        rows = np.arange(top, min(camera.height, int(np.ceil(py.max() + 0.5)))) + 0.5
        if area == 0 or not len(columns) or not len(rows):
            continue
        cx, cy = np.meshgrid(columns, rows)
        shares = [
            ((px[j] - cx) * (py[k] - cy) - (px[k] - cx) * (py[j] - cy)) / area for j, k in ((1, 2), (2, 0), (0, 1))
        ]
        height = sum(share * depth[c] for share, c in zip(shares, corner))
        window = (slice(top, top + len(rows)), slice(left, left + len(columns)))
        seen = (np.minimum.reduce(shares) >= 0) & (height > nearest[window])
        nearest[window][seen] = height[seen]
        picture[window][seen] = sum(share[..., None] * smooth[c] for share, c in zip(shares, corner))[seen]
    length = np.linalg.norm(picture, axis=-1, keepdims=True)
    return np.where(length > 0, picture / np.maximum(length, 1e-300), 0.0)


def tangents(normal):
    """(0, 1, 0) × normal, not of unit length."""
    return np.stack([normal[..., 2], np.zeros(normal.shape[:-1]), -normal[..., 0]], axis=-1)


def compared(normal, camera):
    """True where a pixel shows the front of a surface whose tangent is clear."""
    facing = normal @ camera.axes()[2] > LEAST_COSINE
    return facing & (np.linalg.norm(tangents(normal), axis=-1) > LEAST_TANGENT)
