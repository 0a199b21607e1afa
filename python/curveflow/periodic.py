"""Nodal values as closed lines: what is known at the nodes only, smooth between them."""

from __future__ import annotations

import numpy as np

from .frames import Array

# Sides of a polygon that the eye takes for a curve.
_SMOOTH = 400


def closed(values: Array) -> Array:
    """Nodal values with the first one repeated at the end."""
    return np.concatenate([values, values[:1]])


def refined(values: Array) -> Array:
    """The trigonometric interpolant of nodal values, shape (node, …), at the nodes and, where they are few, between them.

    The fields of a run are such interpolants: straight lines between few nodes would be corners that no curve has.
    """
    count = len(values)
    if count >= _SMOOTH:
        return values
    parts = -(-_SMOOTH // count)
    spectrum = np.fft.rfft(values, axis=0)
    if count % 2 == 0:
        # The last mode stands for itself and its conjugate, which the finer grid tells apart.
        spectrum[-1] *= 0.5
    finer: Array = parts * np.fft.irfft(spectrum, parts * count, axis=0)
    return finer


def arc_length_fraction(metric: Array) -> Array:
    """Fraction of the arc length from the first node on, once around: the first value is 0, the last 1."""
    around = closed(metric)
    arc_length = np.append(0.0, np.cumsum(0.5 * (around[:-1] + around[1:])))
    fraction: Array = arc_length / arc_length[-1]
    return fraction
