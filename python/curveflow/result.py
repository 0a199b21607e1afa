"""Results: what a run leaves behind."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from . import _curveflow
from .frames import Array, Frames
from .provenance import Provenance
from .read_only import ReadOnlyDict
from .scene import Scene
from .why_slow import WhySlow

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

__all__ = ["Array", "Result", "open"]


class Result(Frames):
    """A finished, interrupted or failed run: its saved frames, how it ended and what it cost.

    Arrays are read-only NumPy arrays of ``float64``, made when they are first used. They have one entry per saved frame
    (the first is the initial state, the last the final one), and one per node of the curve where their shape says so.
    Units are those of the scene. Numbers in parentheses are equations of ``THEORY.md``.

    Results come from :func:`curveflow.run`, :meth:`Simulation.result` and :func:`curveflow.open`. They can be pickled.
    """

    def __init__(self, record: _curveflow.Record, scene: Scene | None = None) -> None:
        self._record = record
        self._scene = scene

    @property
    def success(self) -> bool:
        """Whether the run reached its equilibrium, its end time, or the contact that it was to stop at."""
        return self.status in ("equilibrium", "end-time", "contact")

    @property
    def status(self) -> str:
        """Why the run stopped: ``"equilibrium"``, ``"end-time"``, ``"contact"``, ``"interrupted"`` or ``"failed"``."""
        return self._record.status

    @property
    def message(self) -> str:
        """One sentence on why the run stopped."""
        return self._record.message

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        """Reasons to doubt the result although the run came to its end, a sentence each; empty if there are none.

        They are nodes that did not resolve most of the steps, and energy that was neither kept nor dissipated.
        """
        return tuple(self._record.warnings)

    @property
    def title(self) -> str:
        """Title of the scene."""
        return self._record.title

    @cached_property
    def scene(self) -> Scene:
        """The scene of the run. It reproduces the run: ``cf.run(result.scene)`` gives the same bits on the same machine.

        It is as given, except that it contains points that were read from a file: no other file is needed.

        Energy terms that a program in Rust added to a run (``Simulation::with_terms``) are not in its scene, which makes another run
        without them: a ``UserWarning`` names them.

        Raises:
            SceneError: this version cannot read the scene stored in the result file.
        """
        if own := self._record.own_terms:
            warnings.warn(
                f"the run had energy terms from outside its scene ({', '.join(own)}): the scene alone is another run",
                stacklevel=2,
            )
        return self._scene or Scene._of(_curveflow.Scene.of_record(self._record))

    @cached_property
    def provenance(self) -> Provenance:
        """What made the result: version, commit, machine, seconds, and what to cite; kept by files."""
        return Provenance(*_curveflow.provenance(self._record))

    @property
    def resolved_scene(self) -> str:
        """The scene in TOML with every default and automatic choice filled in."""
        return self._record.resolved_scene

    @cached_property
    def stats(self) -> Mapping[str, int | float]:
        """Counters of work by name (steps, rejections by cause, right-hand sides, …), and seconds of wall time.

        ``integration_seconds`` are those of all steps, also before a restart; ``seconds_start``, ``seconds_solves``, … are
        :attr:`WhySlow.seconds`, by what they were spent on.
        """
        return ReadOnlyDict(self._record.counters())

    def why_slow(self) -> WhySlow:
        """Where the time went, what limits the run, and one thing to try; print it to read it."""
        return WhySlow._of(self._record)

    def plot(self, figure: Figure | None = None, *, density: str | None = None) -> Figure:
        """Draw the final curve, its state, and energy and length over time: the panels of ``curveflow plot``.

        Args:
            figure: where to draw; a new figure of pyplot if none is given. The panels alone, for axes of your own,
                are the functions of :mod:`curveflow.plotting`.
            density: name of the one that colours the curve and is drawn against its curvature; the first if none is given.

        Raises:
            MissingExtraError: matplotlib is missing: ``pip install "curveflow[plot]"``.
            ValueError: there is no such density.
        """
        from . import plotting

        return plotting.plot(self, figure, density)

    def save(self, path: str | os.PathLike[str], replace: bool = False) -> None:
        """Write a result file (HDF5), which :func:`curveflow.open`, h5py and xarray read.

        Args:
            path: its name.
            replace: whether an existing file may be replaced.

        Raises:
            StorageError: the file exists or cannot be written; an existing file is then as it was.
        """
        self._record.save(path, replace)

    def picture(
        self, path: str | os.PathLike[str], replace: bool = False, *, density: str | None = None
    ) -> None:
        """Write the figure of :meth:`plot` as a PNG or SVG file, as ``curveflow plot`` does; needs no matplotlib.

        Args:
            path: its name, which ends in ``.png`` or ``.svg``.
            replace: whether an existing file may be replaced.
            density: as in :meth:`plot`.

        Raises:
            StorageError: the file exists, has another ending, or cannot be written; an existing one is then as it was.
            ValueError: there is no such density.
        """
        _curveflow.picture(self._record, path, self._known(density), replace)

    def animate(
        self,
        path: str | os.PathLike[str],
        *,
        field: str | None = None,
        frames: int | Sequence[int] | None = None,
        fps: float = 20.0,
        size: tuple[int, int] = (960, 540),
        replace: bool = False,
    ) -> None:
        """Write a movie, GIF or MP4: the curve moves, coloured by a field, beside its energy over time.

        Args:
            path: its name, which ends in ``.gif`` or ``.mp4``.
            field: what colours the curve: ``"curvature"``, ``"metric"``, ``"normal_velocity"``, a density or one of
                :attr:`fields` by its name; the first density, or else the curvature, if none is given.
            frames: which saved frames to show: how many, spread evenly over them, or their indices; all if absent.
            fps: frames per second.
            size: width and height in pixels, even numbers, from 400 × 240 on.
            replace: whether an existing file may be replaced.

        Raises:
            MissingExtraError: matplotlib, or for MP4 ffmpeg, is missing: ``pip install "curveflow[movie]"``.
            StorageError: the file exists, has another ending, or cannot be written; an existing one is then as it was.
            ValueError: there is no such field or frame, or the size or the rate is out of range.
        """
        from . import movie

        movie.animate(self, path, field, frames, fps, size, replace)

    def to_xarray(self) -> xarray.Dataset:
        """Return everything that a result file holds as one dataset.

        Dimensions are ``frame``, ``node``, ``step`` and ``component``; ``time``, ``parameter`` and ``steps_time`` are
        coordinates. Names, values, units and attributes are those of the file: what stands in a group there has the name
        of the group before its own, so ``density/protein`` is ``density_protein``. The arrays are copies.

        Raises:
            MissingExtraError: xarray or h5netcdf is missing: ``pip install "curveflow[data]"``.
        """
        from . import dataset

        return dataset.of_record(self._record)

    def view(self, path: str | os.PathLike[str], replace: bool = False) -> None:
        """Write a page (HTML) that shows the run moving in any browser, as ``curveflow view`` does.

        Args:
            path: its name. The page is one file and needs no network.
            replace: whether an existing file may be replaced.

        Raises:
            StorageError: the file exists or cannot be written; an existing file is then as it was.
        """
        self._record.view(path, replace)

    def _known(self, density: str | None) -> str | None:
        """Return the name of a density that is there, or none.

        Raises:
            ValueError: there is no such density; the message lists those there are.
        """
        if density is None or density in self.density:
            return density
        there = f"it has {', '.join(self.density)}" if self.density else "it has none"
        raise ValueError(f"density = {density!r:.60}: the result has no such density; {there}")

    def __reduce__(self) -> tuple[object, ...]:
        return _of_bytes, (_curveflow.file_bytes(self._record),)

    def __repr__(self) -> str:
        frames, nodes = self._record.shape
        size = f"{frames} frames, {nodes} nodes"
        return f"<Result {self.title!r}: {self.status} at t = {self.time[-1]:.6g}, {size}{self._doubtful()}>"

    def _doubtful(self) -> str:
        """How many warnings there are and where; nothing if there are none."""
        count = len(self.warnings)
        return f"; {count} warning{'s' if count > 1 else ''}, see result.warnings" if count else ""

    def _repr_html_(self) -> str:
        """The run at a glance, for notebooks: final curve, how it ended, the laws kept, its cost."""
        return self._record.card()


def _of_bytes(data: bytes) -> Result:
    """The result whose file holds ``data``: results travel between processes as files do."""
    with tempfile.TemporaryDirectory(prefix="curveflow-") as folder:
        path = Path(folder) / "result.h5"
        path.write_bytes(data)
        return open(path)


def open(path: str | os.PathLike[str]) -> Result:
    """Read a result file, written by :meth:`Result.save` or by the command ``curveflow run``.

    While a run to that file goes on, or after it was killed, there is none yet, or one of where it was stopped before: then this is
    what its newest checkpoint holds, with the status ``"interrupted"``. A result that another run is to replace is that result.

    Raises:
        StorageError: the file cannot be read, is none of ours, or is damaged.
    """
    return Result(_curveflow.read(path))
