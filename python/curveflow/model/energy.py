"""The terms of the energy: tables ``[energy.*]``. A term that a scene does not have does not exist.

Integrals are over the arc length, kappa is the curvature, Gamma the curve, |Gamma| its length.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias, get_args

from .table import Formula, Rows, Table


@dataclass(frozen=True, slots=True)
class Bending(Table):
    """Bending, (b/2) times the integral of (kappa - c0)^2 (THEORY.md, E1)."""

    name: ClassVar[str] = "bending"

    rigidity: float
    """Rigidity b >= 0, in energy times length."""
    preferred_curvature: Formula | None = None
    """Preferred curvature c0, a number or an expression of ``rho``; 0 if absent."""
    density: str | None = None
    """Name of the density rho that c0 depends on, if it does: the only one of the scene unless given."""


@dataclass(frozen=True, slots=True)
class Regularization(Table):
    """Regularisation of the curvature, (delta/2) times the integral of |d kappa/d sigma|^2 (THEORY.md, E2)."""

    name: ClassVar[str] = "regularization"

    delta: float
    """Weight delta > 0, in energy times length^3."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Length(Table):
    """Tension sigma |Gamma|, or penalty (beta/2)(|Gamma| - L*)^2 with one of the two targets (THEORY.md, E3)."""

    name: ClassVar[str] = "length"

    tension: float | None = None
    """Line tension sigma of either sign, in energy / length."""
    penalty: float | None = None
    """Strength beta >= 0, in energy / length^2."""
    target: float | None = None
    """L* itself, > 0."""
    target_ratio: float | None = None
    """L* over the initial length, > 0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Area(Table):
    """Pressure -p A, or penalty (beta/2)(A - A*)^2 with one of the two targets (THEORY.md, E6)."""

    name: ClassVar[str] = "area"

    pressure: float | None = None
    """Pressure p inside, of either sign, in energy / area."""
    penalty: float | None = None
    """Strength beta >= 0, in energy / area^2."""
    target: float | None = None
    """A* itself, signed: positive inside a counter-clockwise curve, 0 for a symmetric figure eight."""
    target_ratio: float | None = None
    """A* over the initial area, > 0."""


@dataclass(frozen=True, slots=True)
class Adhesion(Table):
    """Adhesion and repulsion, the double integral of G(|gamma(sigma) - gamma(sigma')|^2) (THEORY.md, E7)."""

    name: ClassVar[str] = "adhesion"

    kernel: Formula
    """Kernel G, an expression of ``q``, the squared distance of two points; in energy / length^2."""
    cutoff: float | None = None
    """Distance > 0 beyond which the kernel is taken as zero; if absent, where it has fallen below rounding."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Agents(Table):
    """Curvature agents with fronts between a low and a high density.

    The integral of (delta/2)|d kappa/d sigma|^2 + f/delta + (epsilon/2)|d rho/d sigma|^2 + F/epsilon with
    f = (kappa - kappa_0(rho))^2 / 2 and F = 4 (rho - rho_-(kappa))^2 (rho - rho_+(kappa))^2 (THEORY.md, E4).
    """

    name: ClassVar[str] = "agents"

    density: str
    """Name of the density rho."""
    epsilon: float
    """Width epsilon > 0 of the fronts between low and high density."""
    delta: float
    """Width delta > 0 of changes of curvature."""
    preferred_curvature: Formula
    """Preferred curvature kappa_0, an expression of ``rho``."""
    low_density: Formula
    """Low density rho_-, an expression of ``kappa``."""
    high_density: Formula
    """High density rho_+, an expression of ``kappa``."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Membrane(Table):
    """Stretching of a membrane, the integral of (rho - 1)^2 / (2 epsilon) (THEORY.md, E8)."""

    name: ClassVar[str] = "membrane"

    density: str
    """Name of the membrane density rho, 1 at rest."""
    epsilon: float
    """Compressibility epsilon > 0, in length / energy."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Packing(Table):
    """Packing of a blend, the integral of (rho^T P rho - 1)^2 / (2 epsilon) over all densities (THEORY.md, E9)."""

    name: ClassVar[str] = "packing"

    matrix: Rows
    """P by rows: symmetric, positive definite, one row and one column for each density in the order of the scene."""
    epsilon: float
    """Compressibility epsilon > 0, in length / energy."""


@dataclass(frozen=True, slots=True)
class Local(Table):
    """Any local energy, the integral of e(kappa, d kappa/d sigma, rho, d rho/d sigma) (THEORY.md, E5)."""

    name: ClassVar[str] = "local"

    expression: Formula
    """Energy per unit arc length: an expression of ``kappa``, ``kappa_sigma``, then ``name`` and ``name_sigma`` of each
    density; ``_sigma`` is the derivative by arc length."""


EnergyTerm: TypeAlias = (
    Bending | Regularization | Length | Area | Adhesion | Agents | Membrane | Packing | Local
)
"""Any term of the energy."""

TERMS: tuple[type[EnergyTerm], ...] = get_args(EnergyTerm)
