"""The measured trade of accuracy for time: a ladder of tolerances, each run against a tighter one."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from functools import cached_property
from operator import index
from typing import TYPE_CHECKING, NamedTuple, SupportsFloat, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from . import _curveflow
from .errors import LadderError
from .read_only import ReadOnlyDict
from .result import Array
from .running import Line, with_progress
from .scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Reference(NamedTuple):
    """The run that stands for the truth."""

    tolerance: float
    """Its tolerance."""
    at_rounding: bool
    """Whether rounding kept the tolerance from being a hundredth of the tightest run's."""
    nodes: int
    """Its number of nodes."""
    steps: int
    """Its accepted steps."""
    seconds: float
    """Seconds of its integration."""


class Setting(NamedTuple):
    """A run of the ladder."""

    tolerance: float
    """The tolerance asked for."""
    error: float
    """The largest of its measured errors."""
    nodes: int
    """Its number of nodes."""
    steps: int
    """Its accepted steps."""
    seconds: float
    """Seconds of its integration."""


class Tradeoff:
    """A measured ladder of tolerances.

    All arrays are read-only and have one entry per run, the loosest tolerance first. A run that failed has NaN as
    errors and seconds, and 0 nodes and steps; :attr:`failures` tells why.

    Made by :func:`curveflow.tradeoff`. It can be copied and pickled, which keeps it.
    """

    def __init__(self, native: _curveflow.Tradeoff) -> None:
        self._native = native

    @property
    def title(self) -> str:
        """Title of the scene."""
        return self._native.title

    @property
    def times(self) -> tuple[float, float]:
        """When the runs are compared: where half of the energy is lost that is lost until the end, and the end."""
        halfway, end, _ = self._native.span
        return halfway, end

    @property
    def ending(self) -> str:
        """Why the end is there: ``"end-time"``, ``"equilibrium"`` or ``"contact"``, as the scene has it."""
        return self._native.span[2]

    @property
    def reference(self) -> Reference:
        """What the runs are compared with."""
        return Reference(*self._native.reference)

    @property
    def includes_space(self) -> bool:
        """Whether the reference has more nodes than every run, so that all errors hold those of the nodes.

        Those of a single run do where ``nodes < reference.nodes``.
        """
        return self._native.includes_space

    @property
    def interrupted(self) -> bool:
        """Whether the ladder was stopped; the runs that were not complete then have no result."""
        return self._native.interrupted

    @cached_property
    def failures(self) -> list[str | None]:
        """Why each run has no result; none for those that have one."""
        return self._native.failures

    @cached_property
    def tolerance(self) -> Array:
        """The tolerance asked for, shape (run,)."""
        return self._native.values("tolerance")

    @cached_property
    def error(self) -> Array:
        """The largest of all errors of a run: what the tolerance was to bound. Shape (run,)."""
        return self._native.values("error")

    @cached_property
    def errors(self) -> Mapping[str, Array]:
        """Relative errors at :attr:`times`, shape (2, run), by name: curve, curvature, each density, energy, length.

        The curve by its largest distance per length, after the best rigid motion; curvature and densities in the
        square mean.
        """
        names = self._native.names
        return ReadOnlyDict({name: self._native.errors(number) for number, name in enumerate(names)})

    @cached_property
    def nodes(self) -> NDArray[np.uint64]:
        """Number of nodes, shape (run,)."""
        return self._native.counts("nodes")

    @cached_property
    def steps(self) -> NDArray[np.uint64]:
        """Accepted steps, shape (run,)."""
        return self._native.counts("steps")

    @cached_property
    def seconds(self) -> Array:
        """Seconds of integration, the median of several runs if they are short, shape (run,)."""
        return self._native.values("seconds")

    def cheapest(self, error: SupportsFloat) -> Setting | None:
        """Return the quickest run whose errors are all at most ``error``; none if there is none."""
        run = self._native.cheapest(error)
        if run is None:
            return None
        counts = int(self.nodes[run]), int(self.steps[run])
        return Setting(float(self.tolerance[run]), float(self.error[run]), *counts, float(self.seconds[run]))

    def plot(self, figure: Figure | None = None) -> Figure:
        """Draw errors against seconds at both times: the panels of ``curveflow tradeoff``.

        Args:
            figure: where to draw; a new figure of pyplot if none is given.

        Raises:
            MissingExtraError: matplotlib is missing: ``pip install "curveflow[plot]"``.
        """
        from . import ladder_plot

        return ladder_plot.plot(self, figure)

    def picture(self, path: str | os.PathLike[str], replace: bool = False) -> None:
        """Write the figure of ``curveflow tradeoff``, that of :meth:`plot`, as a PNG or SVG file; needs no matplotlib.

        Args:
            path: its name, which ends in ``.png`` or ``.svg``.
            replace: whether an existing file may be replaced.

        Raises:
            StorageError: no run was measured, or the file exists, has another ending, or cannot be written; an existing
                one is then as it was.
        """
        self._native.picture(path, replace)

    def __reduce__(self) -> tuple[object, ...]:
        return Tradeoff, (self._native,)

    def __repr__(self) -> str:
        measured = sum(failure is None for failure in self.failures)
        return f"<Tradeoff {self.title!r}: {measured} of {len(self.failures)} runs measured>"


def tradeoff(
    scene: Scene,
    tolerances: Iterable[SupportsFloat] | None = None,
    *,
    reference_nodes: SupportsIndex | None = None,
    progress: bool = False,
) -> Tradeoff:
    """Run a scene at a ladder of tolerances and measure each run against a tighter one.

    All runs go to where the scene itself ends, past any rest of their own. The interpreter lock is released meanwhile.
    Ctrl-C (in the main thread) stops the ladder within a second and keeps the runs that are complete; before the
    reference is complete there is nothing to keep, and ``KeyboardInterrupt`` is raised.

    >>> import curveflow as cf
    >>> measured = cf.tradeoff(cf.Scene.shipped("circle"), [1e-3, 1e-6])
    >>> measured.cheapest(1e-4).tolerance
    1e-06

    Args:
        scene: what to run.
        tolerances: the ladder, in any order, each from 1e-10 to 0.1; 1e-2, 1e-3 … 1e-8 if none is given.
        reference_nodes: number of nodes of the reference. Without, it has those of the scene, and the errors are those
            of the time integration alone; or, where the scene says ``"auto"``, as many as its tolerance needs.
        progress: show where the runs stand on standard error, as :func:`run` does.

    Raises:
        LadderError: a tolerance is no number, it or the number of nodes is out of range, or a tolerance is given twice.
        SetupError: the scene makes no initial state.
        TradeoffError: the scene itself or the reference failed.
        TypeError: ``scene`` is no :class:`Scene`, ``tolerances`` no list, or ``reference_nodes`` no integer.
    """
    ladder = None if tolerances is None else [_number(tolerance) for tolerance in tolerances]
    nodes = None if reference_nodes is None else _count(reference_nodes)
    line = Line() if progress else None

    def begin(name: str, tolerance: float, number: int, count: int) -> None:
        if line:
            line.head = f"run {number} of {count}" if number else f"the {name}"
            line.head += f", tolerance {tolerance:g}: "

    callback = with_progress(line.show) if line else None
    try:
        native = _curveflow.tradeoff(Scene._core(scene), ladder, nodes, begin, callback, 0.1)
    finally:
        if line:
            line.end("")
    return Tradeoff(native)


def _number(tolerance: SupportsFloat) -> float:
    try:
        return float(tolerance)
    except (TypeError, ValueError):
        raise LadderError(f"tolerance {tolerance!r:.60} is no number; try 1e-5") from None


def _count(nodes: SupportsIndex) -> int:
    """Refuse the integers that the extension has no type for; of the others it says what is allowed."""
    count = index(nodes)
    if not 0 <= count < 2**32:
        raise LadderError(f"the reference cannot have {count} nodes; try twice those of the scene")
    return count
