"""Movies of results with matplotlib, which is imported at the first use only."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from operator import index
from typing import TYPE_CHECKING

import numpy as np

from . import movie_file
from .extras import need
from .frames import Array

if TYPE_CHECKING:
    from .result import Result

# Smaller letters are not to be read, larger images fill the memory.
_LEAST, _MOST = (400, 240), 4096


def animate(
    result: Result,
    path: str | os.PathLike[str],
    field: str | None,
    frames: int | Sequence[int] | None,
    fps: float,
    size: tuple[int, int],
    replace: bool,
) -> None:
    """Write a movie; see :meth:`curveflow.Result.animate`."""
    with movie_file.target(path, replace) as target:
        write = movie_file.writer(target, fps)
        label, values = coloured(result, field)
        shown = chosen(frames, len(result.time))
        write(_images(result, label, values, shown, checked(size)), len(shown))


def _images(
    result: Result, label: str, values: Array, shown: list[int], size: tuple[int, int]
) -> Iterator[movie_file.Image]:
    need("matplotlib.figure", "a movie", "movie")
    from .movie_stage import Stage

    stage = Stage(result, label, values, shown, size)
    for frame in shown:
        yield stage.image(frame)


def coloured(result: Result, field: str | None) -> tuple[str, Array]:
    """Return what a field is called on a figure, and its values.

    Raises:
        ValueError: there is no such field; the message lists those there are.
    """
    if field is None:
        field = next(iter(result.density), "curvature")
    if field in result.density:
        return f"{field} density $\\rho$", result.density[field]
    if field in result.fields:
        return field.replace("_", " "), result.fields[field]
    own = {
        "curvature": "curvature $\\kappa$",
        "metric": "metric $g$",
        "normal_velocity": "normal velocity $V$",
    }
    if field not in own:
        there = ", ".join([*own, *result.density, *result.fields])
        raise ValueError(f"field = {field!r}: the result has no such field; it has {there} (output.fields asks for more)")
    values: Array = getattr(result, field)
    return own[field], values


def chosen(frames: int | Sequence[int] | None, count: int) -> list[int]:
    """Return the indices of the frames to show out of ``count``.

    Raises:
        ValueError: there are none, or no such frames.
    """
    if frames is None:
        return list(range(count))
    if isinstance(frames, int | np.integer):
        if frames < 1:
            raise ValueError(f"frames = {frames}: a movie has at least 1 frame")
        return sorted({round(place) for place in np.linspace(0, count - 1, min(int(frames), count))})
    shown = [index(frame) for frame in frames]
    if not shown:
        raise ValueError("frames is empty: a movie has at least 1 frame")
    for frame in shown:
        if not -count <= frame < count:
            raise ValueError(f"frames: there is no frame {frame}, the result has {count}, numbered from 0")
    return [frame % count for frame in shown]


def checked(size: tuple[int, int]) -> tuple[int, int]:
    """Return a size that a movie can have.

    Raises:
        TypeError: it is not a width and a height.
        ValueError: it is out of range, or odd.
    """
    try:
        width, height = (index(pixels) for pixels in size)
    except (TypeError, ValueError):
        raise TypeError(f"size = {size!r:.60}: it must be a width and a height in whole pixels, such as (960, 540)") from None
    for name, pixels, least in zip(("width", "height"), (width, height), _LEAST, strict=True):
        if not least <= pixels <= _MOST or pixels % 2:
            raise ValueError(f"size = {size}: the {name} must be an even number of pixels from {least} to {_MOST}")
    return width, height
