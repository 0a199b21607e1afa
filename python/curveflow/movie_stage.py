"""One image of a movie: the curve, coloured by a field, beside the energy; needs matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize, SymLogNorm
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from .frames import Array
from .movie_file import Image
from .history_plot import BLUE, energy_history
from .periodic import closed, refined
from .plotting import is_dot, plain
from .scales import fit, from_start, scale_time

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .result import Result

_DPI = 100
# Width and height in pixels of the least page; what is smaller is a smaller image of it, down to letters of 9 pixels.
_PAGE = (640, 360)
# Percent of the values at either end that may lie outside the scale of colours, where they would take most of it.
_OUTLIERS = 0.5
# Range of a usual image, as a part of that of all, below which the scale is logarithmic down to the least part of its ends.
_FADES, _LEAST = 0.05, 1e-4
_GREY = "0.75"


class Stage:
    """A figure on which only what moves is changed from image to image; scales are those of the whole movie."""

    def __init__(
        self, result: Result, label: str, values: Array, shown: list[int], size: tuple[int, int]
    ) -> None:
        self._result, self._values = result, values
        dpi = _DPI * min(1.0, *(pixels / least for pixels, least in zip(size, _PAGE, strict=True)))
        width, height = (pixels / dpi for pixels in size)
        layout = ConstrainedLayoutEngine(w_pad=0.1, h_pad=0.1)
        self._figure = Figure(figsize=(width, height), dpi=dpi, layout=layout)
        self._canvas = FigureCanvasAgg(self._figure)
        left, right = self._figure.subplots(1, 2, width_ratios=(1.35, 1))
        self._curve = self._set_curve(left, label, shown, height)
        self._time = left.set_title(" ", loc="left")
        self._set_history(right)
        if result.title:
            self._figure.suptitle(plain(result.title))
        # Laid out once: labels that come and go must not move the panels.
        self._move(shown[-1])
        self._figure.draw_without_rendering()
        self._figure.set_layout_engine("none")

    def image(self, frame: int) -> Image:
        """Draw a frame; shape (height, width, 3)."""
        self._move(frame)
        self._canvas.draw()  # type: ignore[no-untyped-call] # as of matplotlib 3.10
        image = np.asarray(self._canvas.buffer_rgba())  # type: ignore[no-untyped-call]
        return image[:, :, :3].copy()

    def _move(self, frame: int) -> None:
        points, value = (closed(refined(values[frame])) for values in (self._result.position, self._values))
        self._curve.set_segments(list(np.stack([points[:-1], points[1:]], axis=1)))
        self._curve.set_array(0.5 * (value[:-1] + value[1:]))
        time = float(self._result.time[frame])
        self._time.set_text(f"$t$ = {time:.4g}")
        shrunk = is_dot(points, self._result.position[0])
        self._dot.set_data(*(points.mean(axis=0)[:, None] if shrunk else ([], [])))
        past = self._history[0] <= max(time, self._first)
        self._past.set_data(self._history[0][past], self._history[1][past])
        self._now.set_data([max(time, self._first)], [self._result.energy[frame]])

    def _set_curve(self, axes: Axes, label: str, shown: list[int], height: float) -> LineCollection:
        axes.plot(*closed(refined(self._result.position[0])).T, color="0.6", linewidth=1, linestyle="--")
        axes.set_title("dashed: initial", loc="right", fontsize="small", color="0.4")
        values = self._values[shown]
        scale, extend = _scale(values)
        lines = LineCollection([], linewidths=height * _DPI / 130, capstyle="round", cmap="viridis", norm=scale)
        axes.add_collection(lines, autolim=False)
        (self._dot,) = axes.plot([], [], "ko", markersize=4)
        points = self._result.position[[0, *shown]].reshape(-1, 2)
        middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        reach = 0.55 * float(np.ptp(points, axis=0).max())
        axes.set_xlim(middle[0] - reach, middle[0] + reach)
        axes.set_ylim(middle[1] - reach, middle[1] + reach)
        axes.set_aspect("equal", adjustable="box")
        axes.set(xlabel="$x$", ylabel="$y$")
        self._figure.colorbar(lines, ax=axes, label=label, shrink=0.85, extend=extend)
        return lines

    def _set_history(self, axes: Axes) -> None:
        time, energy = energy_history(self._result)
        self._first = scale_time(axes, time)
        fit(axes, "y", energy)
        self._history = from_start(time, energy, self._first)
        axes.plot(*self._history, color=_GREY, linewidth=1.5)
        (self._past,) = axes.plot([], [], color=BLUE, linewidth=2)
        (self._now,) = axes.plot([], [], "o", color=BLUE, clip_on=False)
        axes.set(xlabel="time $t$", ylabel="energy")


def _scale(values: Array) -> tuple[Normalize, str]:
    """Return the scale of colours for values (frame, node), and at which ends values lie outside it."""
    lowest, highest = float(values.min()), float(values.max())
    low, high = (float(end) for end in np.percentile(values, [_OUTLIERS, 100 - _OUTLIERS]))
    if high - low > 0.5 * (highest - lowest):
        low, high = lowest, highest
    size = max(abs(low), abs(high))
    if high - low <= 1e-6 * size:  # colours would show nothing but rounding
        margin = 0.01 * size or 1.0
        return Normalize(low - margin, high + margin), "neither"
    ends = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
    extend = ends[lowest < low, highest > high]
    usual = float(np.median(np.ptp(values, axis=1)))
    if low < 0 < high and usual < _FADES * (high - low):
        # Velocities fade by decades: on a linear scale most images would show one colour.
        return SymLogNorm(max(usual, _LEAST * size), vmin=-size, vmax=size), extend
    return Normalize(low, high), extend
