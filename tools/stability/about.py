"""Numbers with what they may be off by, carried through sums and products."""

from dataclasses import dataclass

from exact import mpf
from probes import U


@dataclass
class About:
    """A number, and how far off it may be in single precision and, beyond that, with halves."""

    value: mpf
    off: float = 0.0
    half: float = 0.0

    def __add__(self, other):
        other = other if isinstance(other, About) else About(mpf(other))
        value = self.value + other.value
        return About(value, self.off + other.off + U * abs(float(value)), self.half + other.half)

    def __sub__(self, other):
        return self + About(-other.value, other.off, other.half)

    def __mul__(self, other):
        other = other if isinstance(other, About) else About(mpf(other))
        a, b = abs(float(self.value)), abs(float(other.value))
        return About(
            self.value * other.value, a * other.off + b * self.off + U * a * b, a * other.half + b * self.half
        )

    __rmul__ = __mul__
    __radd__ = __add__

    def clamped(self, low, high):
        return About(min(max(self.value, mpf(low)), mpf(high)), self.off, self.half)
