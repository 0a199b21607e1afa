"""How exact the answer is to be, and by which methods: table ``[accuracy]``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .schema import default
from .table import CountOrAuto, Table


@dataclass(frozen=True, slots=True, kw_only=True)
class Accuracy(Table):
    """The tolerance, and what follows from it unless it is given."""

    tolerance: float = default("accuracy", "tolerance")
    """The relative error asked for, in time and in space together: in [1e-11, 1e-1]."""
    nodes: CountOrAuto = default("accuracy", "nodes")
    """Number of nodes on the curve, 8 to 65536, or ``auto``: as many as the tolerance needs,
    while the run goes on (THEORY.md, D12)."""
    derivative: Literal["auto", "fourier", "central-2", "central-4", "central-6", "central-8"] = default(
        "accuracy", "derivative"
    )
    """Discrete derivative along the curve: trigonometric, or central differences of order 2 to 8 (THEORY.md, D16). ``auto``:
    trigonometric, but ``central-8`` on graded nodes that follow the solution."""
    linear_solver: Literal["auto", "fourier", "banded", "dense"] = default("accuracy", "linear_solver")
    """Solver of the linear systems of the implicit steps: ``fourier`` (O1) or ``banded`` (O2) preconditioner,
    ``dense`` factorisation (O3), or ``auto``, which starts with exponential steps that solve none (THEORY.md, I10). Naming one
    makes all steps implicit."""
