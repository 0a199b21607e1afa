"""Densities carried by the curve: tables ``[[density]]``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .table import Formula, Numbers, Table


@dataclass(frozen=True, slots=True)
class Density(Table):
    """One density rho, per unit arc length."""

    name: str
    """An identifier of at most 64 letters, digits and ``_`` that means nothing else in expressions and does not end in
    ``_sigma``: its name in expressions, in results and in the result file."""
    initial: Formula | Numbers
    """Initial value: an expression of ``s`` in [0, 1), the fraction of arc length from the first point; or numbers, one for each
    point of a curve through :class:`Points`, on other curves 4 to 16384 of them at equal distances."""
    mobility: Literal["diffusion", "exchange", "none"]
    """``diffusion``: the mass is conserved (THEORY.md, F5); ``exchange`` with the surroundings, the Allen-Cahn flow:
    it is not (F15); ``none``: every piece of the curve keeps its mass (F16)."""
    weight: Formula | None = None
    """Weight w > 0 of the diffusion, an expression of ``s``; 1 unless given (F14)."""

    def __repr__(self) -> str:
        initial = f"<{len(self.initial)} values>" if isinstance(self.initial, tuple) else repr(self.initial)
        return f"Density({self.name!r}, initial={initial}, mobility={self.mobility!r}, weight={self.weight!r})"
