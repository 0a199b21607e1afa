"""The initial curve, counter-clockwise: table ``[curve]``, one class for each shape.

Lengths are in the unit of the scene, angles phi run over [0, 2 pi). ``turning_number`` is the integral of the
curvature over 2 pi, a whole number; what the shape measures must agree.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from .schema import default
from .table import Count, Formula, Numbers, Rows, Table


@dataclass(frozen=True, slots=True)
class Circle(Table):
    """A circle about the origin. A circle of radius R has the curvature +1/R (THEORY.md, G2)."""

    shape: ClassVar[str] = "circle"

    radius: float
    """Radius > 0."""
    turning_number: Count = default("curve", "turning_number", "circle")
    """1."""


@dataclass(frozen=True, slots=True)
class Ellipse(Table):
    """An ellipse with its axes along x and y."""

    shape: ClassVar[str] = "ellipse"

    semi_axes: Numbers
    """Semi-axes along x and y, both > 0."""
    turning_number: Count = default("curve", "turning_number", "ellipse")
    """1."""


@dataclass(frozen=True, slots=True)
class Trillium(Table):
    """(x, y) = r (cos phi, sin phi) + (0.05 sin 4 phi, 0) with r = 1 + 0.35 cos 3 phi, the curve of [PVW]."""

    shape: ClassVar[str] = "trillium"

    turning_number: Count = default("curve", "turning_number", "trillium")
    """1."""


@dataclass(frozen=True, slots=True)
class Polar(Table):
    """(x, y) = r(phi) (cos phi, sin phi)."""

    shape: ClassVar[str] = "polar"

    r: Formula
    """Radius, an expression of ``phi``."""
    turning_number: Count = default("curve", "turning_number", "polar")
    """0 to 16."""


@dataclass(frozen=True, slots=True)
class Parametric(Table):
    """(x, y) = (x(phi), y(phi))."""

    shape: ClassVar[str] = "parametric"

    x: Formula
    """First coordinate, an expression of ``phi``."""
    y: Formula
    """Second coordinate, an expression of ``phi``."""
    turning_number: Count = default("curve", "turning_number", "parametric")
    """0 to 16."""


@dataclass(frozen=True, slots=True, repr=False)
class Points(Table):
    """A closed curve through points; the first may be repeated at the end, where it does not count."""

    shape: ClassVar[str] = "points"

    points: Rows | None = None
    """The points in order, shape (n, 2), n from 8 to 16384, and perhaps the first again; or else ``file``."""
    file: str | os.PathLike[str] | None = None
    """File of the points, one on each line, x and y. A checked scene holds the points themselves."""
    turning_number: Count = default("curve", "turning_number", "points")
    """0 to 16."""

    def __repr__(self) -> str:
        points = f"<{len(self.points)} points>" if isinstance(self.points, tuple) else repr(self.points)
        return f"Points({points}, file={self.file!r}, turning_number={self.turning_number!r})"


@dataclass(frozen=True, slots=True)
class FigureEight(Table):
    """A symmetric figure eight."""

    shape: ClassVar[str] = "figure-eight"

    size: float = default("curve", "size", "figure-eight")
    """Half its width, > 0."""
    turning_number: Count = default("curve", "turning_number", "figure-eight")
    """0."""


Curve: TypeAlias = Circle | Ellipse | Trillium | Polar | Parametric | Points | FigureEight
"""Any initial curve."""

CURVES: tuple[type[Curve], ...] = (Circle, Ellipse, Trillium, Polar, Parametric, Points, FigureEight)
