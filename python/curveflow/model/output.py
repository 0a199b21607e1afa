"""Which states to save: table ``[output]``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from .schema import default
from .table import ABSENT, CountOrNone, Numbers, Table


@dataclass(frozen=True, slots=True, kw_only=True)
class Output(Table):
    """The frames of the result: ``frames`` with ``spacing``, or ``times``. First and last state are always saved."""

    frames: CountOrNone = ABSENT
    """Number of frames over the whole run, at least 1; has its default unless ``times`` are given."""
    spacing: Literal["linear", "log"] | None = None
    """``linear``: at equal distances of time; ``log``: at equal ratios, so that early changes are seen too."""
    times: Numbers | None = None
    """Increasing times, each in [0, end]; kept as a tuple."""
    fields: Sequence[
        Literal[
            "normal-force",
            "tangential-velocity",
            "excess-density",
            "membrane-flux",
            "energy-density",
            "energy-densities",
            "normal-velocities",
        ]
    ] = ()
    """Fields to save besides those that every frame holds; kept as a tuple. ``normal-force``, ``tangential-velocity``,
    ``excess-density`` and ``membrane-flux`` of the membrane that an incompressible curve stands for (THEORY.md, F11),
    ``energy-density`` of the local terms, ``energy-densities`` of each of them, ``normal-velocities`` of each term."""

    def __post_init__(self) -> None:
        Table.__post_init__(self)
        if self.times is None:
            for key in ("frames", "spacing"):
                if getattr(self, key) is None:
                    object.__setattr__(self, key, default("output", key))
