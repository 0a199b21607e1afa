"""The work-precision figure with matplotlib, which is imported at the first use only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .ladder import Tradeoff
from .plotting import _pyplot, plain
from .scales import logarithmic

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

_COLOURS = ("#222222", "#0072B2", "#009E73", "#D55E00", "#A85088", "#E69F00", "#56B4E9")
_STYLES = ("-", "--", "-.", ":")
# The reference tells nothing about errors below this part of its tolerance.
_RESOLVED = 0.1
# Room beside the outermost runs, for their labels, as a part of the decades; least decades, so that two labels are shown.
_ROOM_TIMES, _LEAST_TIMES = 0.16, 0.7
_ROOM_ERRORS, _LEAST_ERRORS = 0.06, 2.5
_ENDINGS = {"end-time": "end", "equilibrium": "at rest", "contact": "contact"}


def plot(tradeoff: Tradeoff, figure: Figure | None = None) -> Figure:
    """Draw both times into ``figure``, or into a new figure of pyplot, and return it.

    Raises:
        MissingExtraError: matplotlib is missing: ``pip install "curveflow[plot]"``.
    """
    if figure is None:
        figure = _pyplot().figure(figsize=(11, 5), layout="constrained")
    left, right = figure.subplots(1, 2, sharex=True, sharey=True)
    drawn = draw(tradeoff, 0, left)
    draw(tradeoff, 1, right)
    halfway, end = tradeoff.times
    left.set_title(f"half of the energy lost, $t$ = {halfway:.4g}", fontsize="medium")
    right.set_title(f"{_ENDINGS[tradeoff.ending]}, $t$ = {end:.4g}", fontsize="medium")
    _scale(tradeoff, left)
    left.set_ylabel("relative error")
    if marks := [mark for time, axes in enumerate((left, right)) for mark in _mark_smaller(tradeoff, time, axes)]:
        drawn.append(_smaller(marks[0]))
    left.legend(handles=drawn, frameon=False, fontsize="small")
    if tradeoff.title:
        figure.suptitle(plain(tradeoff.title))
    return figure


def draw(tradeoff: Tradeoff, time: int, axes: Axes) -> list[Line2D]:
    """Draw errors against seconds, halfway (``time`` 0) or at the end (1), with the tolerance at each run.

    Returns the lines of what has errors at either time: what the flow keeps to the last digit has none.
    """
    drawn = []
    for number, (name, values) in enumerate(tradeoff.errors.items()):
        # Errors of zero have no place on a logarithmic axis.
        shown = np.where(values[time] > 0, values[time], np.nan)
        style = _STYLES[number % len(_STYLES)]
        colour = _COLOURS[number % len(_COLOURS)]
        (line,) = axes.plot(tradeoff.seconds, shown, style, color=colour, marker="o", markersize=4, label=plain(name))
        if (values > 0).any():
            drawn.append(line)
    tops = np.max([np.nan_to_num(values[time]) for values in tradeoff.errors.values()], axis=0)
    for tolerance, seconds, top in zip(tradeoff.tolerance, tradeoff.seconds, tops, strict=True):
        if top > 0:
            axes.annotate(
                f"{tolerance:g}", (seconds, top), (5, 4), textcoords="offset points", fontsize="small"
            )
    axes.set(xscale="log", yscale="log", xlabel="time of integration [s]")
    axes.grid(color="0.9")
    return drawn


def _mark_smaller(tradeoff: Tradeoff, time: int, axes: Axes) -> list[Line2D]:
    """Mark at the lower edge, one above the other, what lies below it; what the flow keeps to the last digit has no line."""
    low = axes.get_ylim()[0]
    height = np.full(tradeoff.seconds.shape, 0.02)
    marks = []
    for number, values in enumerate(tradeoff.errors.values()):
        below = (values[time] < low) & (values > 0).any()
        place: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "color": _COLOURS[number % len(_COLOURS)]}
        if below.any():
            marks += axes.plot(tradeoff.seconds[below], height[below], "v", markersize=6, **place)
        height[below] += 0.03
    return marks


def _smaller(mark: Line2D) -> Line2D:
    """What stands for the marks in a legend."""
    from matplotlib.lines import Line2D

    return Line2D([], [], color="0.2", marker=mark.get_marker(), linestyle="", markersize=6, label="smaller")


def _scale(tradeoff: Tradeoff, axes: Axes) -> None:
    """Let the axes, which both panels share, show every run at both times, but no errors that the reference does not resolve."""
    errors = np.stack(list(tradeoff.errors.values()))
    for which, values, room, least in (
        ("x", tradeoff.seconds, _ROOM_TIMES, _LEAST_TIMES),
        ("y", np.maximum(errors[errors > 0], _RESOLVED * tradeoff.reference.tolerance), _ROOM_ERRORS, _LEAST_ERRORS),
    ):
        positive = np.log10(values[values > 0])
        if not len(positive):
            continue
        low, high = positive.min(), positive.max()
        pad = max(room * (high - low), 0.5 * (least - (high - low)))
        logarithmic(axes, which, 10 ** (low - pad), 10 ** (high + pad))
