"""How long to run: table ``[time]``."""

from __future__ import annotations

from dataclasses import dataclass

from .schema import default
from .table import ABSENT, CountOrNone, Table


@dataclass(frozen=True, slots=True)
class Time(Table):
    """End of the run, in the unit of time of the scene."""

    end: float
    """Simulated time at which the run ends at the latest, > 0."""
    stop_at_equilibrium: bool = default("time", "stop_at_equilibrium")
    """Whether to stop before ``end`` once the flow is at rest (THEORY.md, I7): a metastable state counts if
    its creep, as it is, would lose less than the tolerance until ``end``."""
    equilibrium_tolerance: float | None = None
    """At rest means: the energy still to be lost is at most this fraction of the energy. In (0, 1e-2]; a hundredth of
    the accuracy's tolerance unless given, a tenth with co-moving nodes."""
    max_steps: CountOrNone = ABSENT
    """Accepted steps after which the run stops, at least 1; unlimited unless given."""
