"""The state of a simulation at one time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from .frames import Array
from .read_only import ReadOnlyArrays


@dataclass(frozen=True, slots=True, eq=False)
class State(ReadOnlyArrays):
    """A curve with its densities at one time, in the units of the scene; arrays are read-only."""

    time: float
    """Simulated time."""
    energy: float
    """Energy."""
    dissipation: float
    """Dissipation, minus the rate of change of the energy."""
    length: float
    """Length of the curve."""
    area: float
    """Enclosed area, positive for a counter-clockwise curve."""
    position: Array
    """Position of the nodes, shape (node, 2)."""
    curvature: Array
    """Curvature, positive on a circle, shape (node,)."""
    metric: Array
    """Arc length per unit parameter, shape (node,)."""
    normal_velocity: Array
    """Velocity along the outward normal, shape (node,)."""
    density: Mapping[str, Array]
    """Each density by name, shape (node,)."""
