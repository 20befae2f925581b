"""The C++ fitter in this process, through gdextension/bench/fit_c_api.cpp.

Directions are arrays (N, 3) of unit vectors, lobes rows of (weight, mean x, y, z, kappa).
"""

import ctypes
from dataclasses import dataclass

import numpy as np

_ARRAY = np.ctypeslib.ndpointer(dtype=np.float64, flags="C_CONTIGUOUS")
LOBE_SIZE = 5


class FitterError(Exception):
    """What the library said in one sentence."""


@dataclass(frozen=True)
class Slice:
    """ρ(i, o) i_z for one view o of one material, and its quadrature: ∫ f ρ i_z di ≈ weights · f(directions)."""

    brdf: str
    alpha: np.ndarray  # (2,)
    view: np.ndarray  # (3,)
    directions: np.ndarray  # (N, 3)
    weights: np.ndarray  # (N,)

    def name(self):
        elevation = np.degrees(np.arccos(self.view[2]))
        azimuth = np.degrees(np.arctan2(self.view[1], self.view[0]))
        return f"{self.brdf} ({self.alpha[0]:g}, {self.alpha[1]:g}) at {elevation:.0f}°, {azimuth:.0f}°"


class Fitter:
    def __init__(self, path):
        self._library = ctypes.CDLL(str(path))
        self._library.lobelight_last_error.restype = ctypes.c_char_p
        integer, text = ctypes.c_int, ctypes.c_char_p
        for name, types in {
            "sample_slice": [text, _ARRAY, _ARRAY, integer, integer, _ARRAY, _ARRAY],
            "evaluate": [text, _ARRAY, _ARRAY, integer, _ARRAY, _ARRAY],
            "initial_guess": [integer, _ARRAY, _ARRAY, integer, _ARRAY],
            "run_em": [integer, _ARRAY, _ARRAY, integer, _ARRAY, integer, ctypes.c_double, integer, _ARRAY],
        }.items():
            function = getattr(self._library, f"lobelight_{name}")
            function.argtypes = types
            setattr(self, f"_{name}", function)

    def _checked(self, result):
        if result < 0:
            raise FitterError(self._library.lobelight_last_error().decode())
        return result

    def slice(self, brdf, alpha, view, nodes_per_axis):
        """The quadrature that tables are fitted to."""
        alpha, view = np.array(alpha, dtype=np.float64), np.array(view, dtype=np.float64)
        capacity = (nodes_per_axis + 3) ** 2
        directions, weights = np.empty((capacity, 3)), np.empty(capacity)
        count = self._checked(
            self._sample_slice(brdf.encode(), alpha, view, nodes_per_axis, capacity, directions, weights)
        )
        return Slice(brdf, alpha, view, directions[:count].copy(), weights[:count].copy())

    def evaluate(self, of, directions):
        """ρ(i, o) i_z (N,) of the slice `of` at directions (N, 3)."""
        values = np.empty(len(directions))
        self._checked(
            self._evaluate(of.brdf.encode(), of.alpha, of.view, len(directions), directions, values)
        )
        return values

    def start(self, of, lobes):
        """The lobes (K, 5) from which every method starts."""
        out = np.empty((lobes, LOBE_SIZE))
        self._checked(self._initial_guess(len(of.weights), of.directions, of.weights, lobes, out))
        return out

    def em(self, of, start, max_iterations, tolerance, accelerate=True):
        """Lobes (K, 5) and iterations."""
        out = np.empty_like(start)
        iterations = self._run_em(
            len(of.weights), of.directions, of.weights, len(start), start, max_iterations, tolerance, accelerate, out
        )  # fmt: skip
        return out, self._checked(iterations)
