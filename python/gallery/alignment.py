"""Two star-shaped curves laid on top of each other: same centre, best rotation, and where they cross."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DIRECTIONS = 1440
# The flows turn a curve little.
LARGEST_ROTATION = 0.1
# The nodes are joined by straight lines; this many more of them, by Fourier interpolation, hide the corners.
REFINEMENT = 16


@dataclass(frozen=True)
class Aligned:
    """A curve laid on another; both as radii over :attr:`directions`, in radians, about their centres."""

    directions: Array
    gap: Array
    """Radius of the curve less that of the other, by direction."""
    rotation: float
    """Angle that the curve was turned by."""
    position: Array
    """The curve, centred and turned, shape (node, 2)."""

    @property
    def crossings(self) -> Array:
        """Directions in which the two curves cross."""
        following = np.roll(self.gap, -1)
        before = np.flatnonzero((self.gap > 0) != (following > 0))
        share = self.gap[before] / (self.gap[before] - following[before])
        crossings: Array = self.directions[before] + share * 2 * np.pi / len(self.directions)
        return crossings


def centred(curve: Array) -> Array:
    """The curve about the centre of its nodes, which lie at equal distances along it."""
    middle: Array = curve - curve.mean(axis=0)
    return middle


def radius(curve: Array, directions: Array) -> Array:
    """Distance of a star-shaped curve from the origin, by direction."""
    nodes = len(curve)
    spectrum = np.fft.rfft(curve, axis=0) * REFINEMENT
    x, y = np.fft.irfft(spectrum, nodes * REFINEMENT, axis=0).T
    angle = np.unwrap(np.arctan2(y, x))
    if not (np.diff(angle) > 0).all():
        raise ValueError("the curve turns back as seen from its centre: only star-shaped curves can be aligned")
    distance: Array = np.interp(directions, angle, np.hypot(x, y), period=2 * np.pi)
    return distance


def align(curve: Array, other: Array) -> Aligned:
    """Lay ``curve`` on ``other``: the rotation with the least square difference of the radii."""
    directions = np.linspace(0, 2 * np.pi, DIRECTIONS, endpoint=False)
    curve, fixed = centred(curve), radius(centred(other), directions)

    def gap(rotation: float) -> Array:
        return radius(curve, directions - rotation) - fixed

    def slope(rotation: float) -> float:
        return float((gap(rotation + 1e-4) ** 2).sum() - (gap(rotation - 1e-4) ** 2).sum())

    low, high = -LARGEST_ROTATION, LARGEST_ROTATION
    if not slope(low) < 0 < slope(high):
        raise ValueError(f"the best rotation is larger than {LARGEST_ROTATION} rad: are these the same curve, aged?")
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slope(middle) < 0 else (low, middle)
    cos, sin = np.cos(low), np.sin(low)
    return Aligned(directions, gap(low), low, curve @ np.array([[cos, sin], [-sin, cos]]))
