"""Runs: from a scene to a result."""

from __future__ import annotations

import io
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from typing import Any, NamedTuple

from . import _curveflow
from .result import Result
from .scene import Scene


class Progress(NamedTuple):
    """Where a run stands after an accepted step, in the units of the scene."""

    time: float
    """Simulated time."""
    end: float
    """Simulated time at which the run ends at the latest."""
    steps: int
    """Accepted steps so far."""
    step_size: float
    """Size of the last step."""
    energy: float
    """Energy after the step."""
    dissipation: float
    """Dissipation, minus the rate of change of the energy, after the step."""
    length: float
    """Length of the curve after the step."""


def run(
    scene: Scene, *, progress: bool = False, callback: Callable[[Progress], object] | None = None
) -> Result:
    """Run a scene to its equilibrium or end time.

    The interpreter lock is released during the run, so threads can run scenes at the same time.

    A run that is stopped or fails raises no exception: check ``result.success``. Ctrl-C (in the main thread) stops it after
    the current step, within a second unless a single step takes longer (as with the dense solver on a thousand nodes);
    ``result.status`` is then ``"interrupted"``. If the integration fails, it is ``"failed"``. In both cases the result
    holds what was computed up to then.

    Args:
        scene: what to run.
        progress: show on standard error how far the run has come: a line that is kept up to date on a terminal, a line
            every 30 s elsewhere; in the end how it ended, and its ``result.warnings``. Where standard error cannot be
            written to, nothing is shown.
        callback: called with a :class:`Progress` after every accepted step. By raising ``StopIteration`` it stops the run
            as Ctrl-C does; any other exception is passed on, and the run is lost.

    Returns:
        The frames, the log of steps, and how the run ended.

    Raises:
        SetupError: no initial state can be made from the scene: its curve is open, its nodes are too few, ….
        TypeError: ``scene`` is no :class:`Scene`.
    """
    with watching(progress, callback) as (watch, interval):
        result = Result(_curveflow.run(Scene._core(scene), watch, interval), scene)
    if progress:
        line = Line()
        line.end(f"{result.message} (t = {result.time[-1]:.6g}, {result.stats['steps']} steps)")
        for warning in result.warnings:
            line.end(f"warning: {warning}")
    return result


_Watch = tuple[Callable[..., None] | None, float]
_UNWATCHED = nullcontext[_Watch]((None, 0.0))


def watching(progress: bool, callback: Callable[[Progress], object] | None) -> AbstractContextManager[_Watch]:
    """What the extension calls during a run, and how often; takes the line of progress away afterwards."""
    # Small runs, of some microseconds, feel a context of their own.
    return _watched(progress, callback) if progress or callback is not None else _UNWATCHED


@contextmanager
def _watched(progress: bool, callback: Callable[[Progress], object] | None) -> Iterator[_Watch]:
    line = Line() if progress else None
    watch, interval = None, 0.0
    if callback is not None:
        watch = _both(callback, line) if line else callback
    elif line:
        watch, interval = line.show, 0.1
    try:
        yield (with_progress(watch) if watch else None), interval
    finally:
        if line:
            line.end("")


def with_progress(watch: Callable[[Progress], object]) -> Callable[..., None]:
    """Turn a callback for :class:`Progress` into one for its fields."""

    def call(*values: Any) -> None:
        watch(Progress(*values))

    return call


def _both(callback: Callable[[Progress], object], line: Line) -> Callable[[Progress], object]:
    def watch(progress: Progress) -> None:
        line.show(progress)
        callback(progress)

    return watch


# The reader of the stream has gone, or it is closed.
_NOT_SHOWN = (OSError, ValueError)


class Line:
    """The line that shows the progress; a run does not end because it cannot be shown."""

    def __init__(self) -> None:
        self.stream = sys.stderr or io.StringIO()  # there is none without a console
        self.rewrites = False
        with suppress(*_NOT_SHOWN):
            self.rewrites = self.stream.isatty()
        self.interval = 0.1 if self.rewrites else 30.0
        self.shown = time.monotonic()
        self.head = ""

    def show(self, progress: Progress) -> None:
        now = time.monotonic()
        if now - self.shown >= self.interval:
            self.shown = now
            self.write(
                f"{self.head}t = {progress.time:.4g} of at most {progress.end:.4g}, step {progress.steps}, "
                f"energy {progress.energy:.6g}, dissipation {progress.dissipation:.2e}"
            )

    def write(self, text: str) -> None:
        with suppress(*_NOT_SHOWN):
            self.stream.write(f"\r\x1b[K{text}" if self.rewrites else f"{text}\n")
            self.stream.flush()

    def end(self, text: str) -> None:
        """Replace the line by ``text``, if there is one."""
        if text or self.rewrites:
            self.write(f"{text}\n" if text and self.rewrites else text)
