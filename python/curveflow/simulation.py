"""Simulations: runs that are driven from outside."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from operator import index
from typing import NoReturn, SupportsFloat, SupportsIndex

from . import _curveflow
from .read_only import ReadOnlyDict
from .result import Result
from .running import Progress, watching
from .scene import Scene
from .state import State

_ALL_STEPS = 2**63


@dataclass(slots=True)
class _Scheduled:
    """A callback, and how many of its multiples are behind."""

    callback: Callable[[Simulation], object]
    interval: float | None
    steps: int | None
    passed: int = 0

    def number(self, time: float, steps: int) -> int:
        """How many multiples there are up to now, but for rounding."""
        if self.steps is not None:
            return steps // self.steps
        assert self.interval is not None
        if self.interval <= _rounding(time, 0.0):
            raise ValueError(f"interval = {self.interval} is below the rounding of the time {time}")
        return math.floor((time + _rounding(time, self.interval)) / self.interval)

    def pass_by(self, time: float, steps: int) -> bool:
        """Leave the multiples up to now behind; returns whether there were any."""
        before, self.passed = self.passed, self.number(time, steps)
        return self.passed > before


def _rounding(time: float, interval: float) -> float:
    """Times that differ by less are the same multiple of ``interval``."""
    return max(1e-9 * interval, 64 * math.ulp(time))  # more than what counts as reached


class Simulation:
    """A run that you drive yourself, step by step or from time to time.

    >>> import curveflow as cf
    >>> simulation = cf.Simulation(cf.Scene.shipped("circle"))
    >>> simulation.run(until=0.1)
    True
    >>> simulation.time
    0.1
    >>> simulation.step()
    True

    Args:
        scene: what to simulate.

    Raises:
        SetupError: no initial state can be made from the scene.
        TypeError: ``scene`` is no :class:`Scene`.
    """

    def __init__(self, scene: Scene) -> None:
        self._native = _curveflow.Simulation(Scene._core(scene))
        self._scene: Scene | None = scene
        self._scheduled: list[_Scheduled] = []

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a simulation cannot be copied or pickled: save it with checkpoint(), and read that with Simulation.resume()")

    @classmethod
    def resume(cls, path: str | os.PathLike[str]) -> Simulation:
        """Continue from a file of :meth:`checkpoint`, with the same bits as if the simulation had not stopped.

        Callbacks are not in the file: add them again. A simulation that had ended, or failed, has still done so.

        Raises:
            StorageError: the file is no checkpoint of this version, or is damaged.
        """
        simulation = cls.__new__(cls)
        simulation._native = _curveflow.Simulation.resume(path)
        simulation._scene = None
        simulation._scheduled = []
        return simulation

    @property
    def scene(self) -> Scene:
        """The scene."""
        if self._scene is None:
            self._scene = Scene._of(_curveflow.Scene.of_record(self._native.snapshot()))
        return self._scene

    @property
    def time(self) -> float:
        """Simulated time."""
        return self._native.time

    @property
    def steps(self) -> int:
        """Accepted steps so far."""
        return self._native.steps

    @property
    def status(self) -> str | None:
        """Why the simulation ended, as :attr:`Result.status`; ``None`` while it can go on.

        Until then :meth:`result` has the status ``"interrupted"``.
        """
        return self._native.status

    @property
    def done(self) -> bool:
        """Whether there is nothing more to do."""
        return self.status is not None

    @property
    def state(self) -> State:
        """The state at this time: curve, densities, energy and velocity, as a :class:`State`.

        It is computed at each use: keep it in a variable if you need it more than once. Later steps do not change it.
        """
        (time, energy, dissipation, length, area), position, nodal, density = self._native.state()
        curvature, metric, normal_velocity = nodal
        return State(
            time=time,
            energy=energy,
            dissipation=dissipation,
            length=length,
            area=area,
            position=position,
            curvature=curvature,
            metric=metric,
            normal_velocity=normal_velocity,
            density=ReadOnlyDict(density),
        )

    def add_callback(
        self,
        callback: Callable[[Simulation], object],
        *,
        interval: SupportsFloat | None = None,
        steps: SupportsIndex | None = None,
    ) -> None:
        """Call ``callback`` with this simulation on a schedule: :meth:`run` does so, :meth:`step` does not.

        It may look at everything, and stop the run by raising ``StopIteration``; other callbacks that are due are called
        first. Other exceptions are passed on. The simulation can go on after either.

        Args:
            callback: what to call.
            interval: simulated time between calls, at its multiples; a step ends at each of them, but for rounding.
            steps: accepted steps between calls. Give either this or ``interval``.

        Raises:
            TypeError: ``callback`` cannot be called, or ``steps`` is no integer.
            ValueError: both ``interval`` and ``steps`` are given, or neither, or the value is not positive.
        """
        if not callable(callback):
            raise TypeError(f"callback is {callback!r:.60}, which cannot be called")
        if (interval is None) == (steps is None):
            raise ValueError("give either interval or steps")
        if interval is not None and not (math.isfinite(interval) and float(interval) > 0):
            raise ValueError(f"interval = {interval} must be positive and finite")
        if steps is not None and index(steps) < 1:
            raise ValueError(f"steps = {steps} must be at least 1")
        scheduled = _Scheduled(
            callback, None if interval is None else float(interval), None if steps is None else index(steps)
        )
        scheduled.pass_by(self.time, self.steps)
        self._scheduled.append(scheduled)

    def step(self) -> bool:
        """Take one accepted step; does nothing once the simulation is :attr:`done`. Returns whether there is more to do.

        Raises:
            KeyboardInterrupt: on Ctrl-C, after the step; the simulation can go on.
        """
        try:
            return self._native.run_until(math.inf, 1, None, 0.0)
        finally:
            for scheduled in self._scheduled:
                scheduled.pass_by(self.time, self.steps)

    def run(
        self,
        until: SupportsFloat = math.inf,
        *,
        progress: bool = False,
        callback: Callable[[Progress], object] | None = None,
    ) -> bool:
        """Run until a time, or to the end of the scene; returns whether there is more to do.

        Callbacks of :meth:`add_callback` that were due when a run was stopped are called first. A failure of the integration
        raises nothing: check :attr:`status`.

        Args:
            until: simulated time, at which the last step ends exactly; to the end of the scene unless given. A time within
                rounding of the present one counts as reached: ``0.1 * 3`` once the run is at 0.3.
            progress: show where the run stands on standard error.
            callback: called with a :class:`Progress` after every accepted step; it cannot use the simulation, which
                callbacks of :meth:`add_callback` can. It stops the run by raising ``StopIteration``; other exceptions are
                passed on.

        Raises:
            KeyboardInterrupt: on Ctrl-C, after the step at hand; the simulation can go on.
            ValueError: ``until`` is NaN.
        """
        if math.isnan(until):
            raise ValueError("until = nan must be a time")
        until = float(until)
        native, goes_on = self._native, self._call_due()
        with watching(progress, callback) as (watch, interval):
            while goes_on:
                goes_on = native.run_until(*self._next_call(until), watch, interval)
                goes_on = self._call_due() and goes_on and not native.has_reached(until)
        return not self.done

    def _next_call(self, until: float) -> tuple[float, int]:
        time, steps = until, _ALL_STEPS
        if not self._scheduled:
            return time, steps
        end = min(until, self._native.end)
        for scheduled in self._scheduled:
            if scheduled.steps is not None:
                steps = min(steps, (scheduled.passed + 1) * scheduled.steps - self.steps)
            elif scheduled.interval is not None:
                next_time = (scheduled.passed + 1) * scheduled.interval
                # Where a run ends within rounding of a multiple, there is no other step for that.
                if next_time < end - _rounding(end, scheduled.interval):
                    time = min(time, next_time)
        return time, steps

    def _call_due(self) -> bool:
        """Call what is due; returns whether the run goes on."""
        goes_on = True
        for scheduled in self._scheduled:
            if scheduled.pass_by(self.time, self.steps):
                try:
                    scheduled.callback(self)
                except StopIteration:
                    goes_on = False
        return goes_on

    def result(self) -> Result:
        """What was computed so far, as :func:`run` returns it."""
        return Result(self._native.record(), self._scene)

    def checkpoint(self, path: str | os.PathLike[str], *, replace: bool = False) -> None:
        """Write a file from which :meth:`resume` can continue. An existing checkpoint is replaced once the new one is whole.

        Args:
            path: its name.
            replace: whether an existing file that is no checkpoint may be replaced too.

        Raises:
            StorageError: the file exists and is no checkpoint, or cannot be written; an existing file is then as it was.
        """
        self._native.checkpoint(path, replace)
