"""Where the time of a run went, and what limits it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from . import _curveflow
from .read_only import ReadOnlyArrays, ReadOnlyDict


@dataclass(frozen=True, repr=False)
class WhySlow(ReadOnlyArrays):
    """Why a run takes the time that it takes; prints as a sentence, one thing to try, and tables.

    Times are wall time since the run was started or, if it was resumed, since then. Steps are clocked now and then and stand
    for all; parts of the evaluations are measured in a short replay on the final state.
    """

    limit: str
    """What the time goes up with most.

    ``"accuracy"`` (steps as long as the tolerance lets them be), ``"term"`` (the same, and one term of the energy takes most
    of the time), ``"implicit-solves"``, ``"energy-rises"``, ``"not-finite"``, ``"frames"``, ``"output"``, ``"observers"``,
    ``"start"``, or ``"not-measured"``.
    """
    sentence: str
    """One sentence on it."""
    advice: str
    """One thing to try."""
    krylov_iterations_per_solve: float
    """Krylov iterations of a linear solve, in the mean."""
    seconds: Mapping[str, float]
    """Seconds by what they were spent on, largest first; they add up to :attr:`total`.

    - ``start``: from the scene to the first frame;
    - ``right_hand_sides``, ``linearisations``, ``jacobian_products``: evaluations of the flow, at the iterates of Newton's
      method, with second derivatives at the predictor of a step, and in linear solves;
    - ``factorisations``, ``solves``, ``krylov``: the preconditioner, and the rest of the linear solves;
    - ``checks``: closure, energy and dissipation of each finished step;
    - ``step_control``: its error, size and order;
    - ``remaps``: changes of the nodes or of the gauge;
    - ``frames``: frames with all that they hold;
    - ``observers``: progress and callbacks;
    - ``output``: checkpoints, and the result file up to where its bytes leave for the disk.
    """
    evaluation_seconds: Mapping[str, float]
    """Seconds by part of the right-hand sides, linearisations, Jacobian products and checks, which they add up to.

    Terms of the energy by their names, ``normal_mobility``, ``density_mobilities``, and ``flow_map``: gauge, flow map,
    transforms and closure. Largest first.
    """
    _text: str = field(compare=False)

    @classmethod
    def _of(cls, record: _curveflow.Record) -> WhySlow:
        limit, sentence, advice, text, krylov, seconds, parts = record.why_slow()
        return cls(limit, sentence, advice, krylov, ReadOnlyDict(seconds), ReadOnlyDict(parts), text)

    @property
    def total(self) -> float:
        """Seconds of the run."""
        return sum(self.seconds.values())

    def __repr__(self) -> str:
        return self._text
