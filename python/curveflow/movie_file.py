"""The files of movies: GIF by Pillow, MP4 by ffmpeg; the ending of the name says which."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from itertools import chain
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from . import _curveflow
from .errors import StorageError
from .extras import need

Image: TypeAlias = NDArray[np.uint8]
"""An image in red, green and blue, shape (height, width, 3)."""

# A GIF counts hundredths of a second, and browsers take two of them for the least.
_FASTEST_GIF = 50.0
# How long a GIF rests at its end before it starts again, in milliseconds.
_REST = 1000
_NEARLY_WHITE = 245


@contextmanager
def target(path: str | os.PathLike[str], replace: bool) -> Iterator[Path]:
    """Where to write what becomes ``path`` once all is written, by the rules of all files of ours.

    Raises:
        StorageError: the file exists, has another ending, or cannot be written.
    """
    final = Path(path)
    if final.suffix.lower() not in (".gif", ".mp4"):
        raise StorageError(f"{final}: the name of a movie ends in .gif or .mp4")
    _curveflow.check_writable(final, replace)
    try:
        with tempfile.TemporaryDirectory(prefix="curveflow-") as folder:
            partial = Path(folder) / f"movie{final.suffix}"
            yield partial
            _curveflow.write_file(final, partial.read_bytes(), replace)
    except StorageError:
        raise
    except OSError as error:
        raise StorageError(f"{final}: cannot be written: {error}") from error


def writer(path: Path, fps: float) -> Callable[[Iterator[Image], int], None]:
    """Return what writes images, and their number, to ``path``.

    Raises:
        MissingExtraError: what writes such a file is not installed.
        ValueError: there is no such rate.
    """
    if path.suffix.lower() == ".mp4":
        if not 0 < fps <= 240:
            raise ValueError(f"fps = {fps}: the rate must be greater than 0 and at most 240 frames per second")
        ffmpeg = need("imageio_ffmpeg", "an MP4 movie", "movie")
        return lambda images, _: _mp4(ffmpeg, path, images, fps)
    if not 0 < fps <= _FASTEST_GIF:
        raise ValueError(f"fps = {fps}: the rate of a GIF must be greater than 0 and at most 50 frames per second")
    pillow = need("PIL.Image", "a GIF movie", "movie")
    return lambda images, count: _gif(pillow, path, images, count, fps)


def _gif(pillow: Any, path: Path, images: Iterator[Image], count: int, fps: float) -> None:
    first = next(images)
    # One palette for all, so that colours do not flicker: every image shows the whole scale of colours.
    palette = _with_white(pillow.fromarray(first).quantize(256))
    plain = pillow.Dither.NONE
    drawn = (pillow.fromarray(image).quantize(palette=palette, dither=plain) for image in chain([first], images))
    durations = [round(100 / fps) * 10] * (count - 1) + [_REST]
    next(drawn).save(
        path, format="GIF", save_all=True, append_images=drawn, duration=durations if count > 1 else _REST, loop=0
    )


def _with_white(image: Any) -> Any:
    """Make the palette's means of nearly white colours white."""
    colours = np.array(image.getpalette()).reshape(-1, 3)
    colours[colours.min(axis=1) >= _NEARLY_WHITE] = 255
    image.putpalette(colours.ravel().tolist())
    return image


def _mp4(ffmpeg: Any, path: Path, images: Iterable[Image], fps: float) -> None:
    output = None
    try:
        for image in images:
            if output is None:
                size = (image.shape[1], image.shape[0])
                output = ffmpeg.write_frames(
                    str(path), size, fps=fps, quality=8, macro_block_size=2, ffmpeg_log_level="error"
                )
                output.send(None)
            output.send(np.ascontiguousarray(image))
    finally:
        if output is not None:
            output.close()
