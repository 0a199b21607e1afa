"""How the curve may move: tables ``[flow]`` and ``[[flow.switch]]``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from .schema import default
from .table import Formula, Table


@dataclass(frozen=True, slots=True, kw_only=True)
class Switch(Table):
    """A change of the gauge on the way; the curve is the same, its nodes lie elsewhere (THEORY.md, F18)."""

    time: float
    """When, in [0, end]; the run makes a step end there."""
    gauge: Literal["scaled-arc-length", "graded", "co-moving"]
    """The gauge from then on."""
    grading: Formula | None = None
    """Its metric, as :attr:`Flow.grading`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flow(Table):
    """The mobility of the curve and the gauge of its nodes."""

    normal_mobility: Literal[
        "identity", "incompressible", "area-preserving", "incompressible-area-preserving", "surface-diffusion"
    ] = default("flow", "normal_mobility")
    """``identity``, the L2 flow; ``incompressible``: every piece keeps its length (THEORY.md, F8); ``area-preserving``
    (F9); ``incompressible-area-preserving``, both (F10); ``surface-diffusion``, the H^-1 flow (F12)."""
    gauge: Literal["scaled-arc-length", "graded", "co-moving"] = default("flow", "gauge")
    """``scaled-arc-length``: equidistant nodes (F1); ``graded``: node distances proportional to ``grading`` (D8);
    ``co-moving``: nodes are material points, and the metric is a field (F19)."""
    grading: Formula | None = None
    """The metric of the graded gauge, and the first one of the co-moving gauge, a positive expression of ``s`` up to a factor: nodes
    crowd where it is small. Without one the nodes of the graded gauge follow the solution (D13)."""
    stop_on_contact: bool = default("flow", "stop_on_contact")
    """Whether the run stops once the curve crosses itself more often than at the start: its last state is from just before (G7)."""
    switch: Sequence[Switch] = ()
    """Changes of the gauge on the way, in the order of their times; kept as a tuple."""
