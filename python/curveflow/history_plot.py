"""Energy and length over time with matplotlib, which is imported at the first use only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .extras import need
from .frames import Array, Frames
from .scales import around, fit, from_start, scale_time

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

BLUE, _VERMILION = "#0072B2", "#D55E00"
# Frames that are farther apart, as a part of the axis, are not joined: nothing is known between them.
_CLOSE = 0.05
# Inches from the panel to its legend.
_ABOVE = 0.16


def draw_history(result: Frames, axes: Axes) -> None:
    """Draw energy (left) and length (right) over time, in decades of time where the run spans several.

    The energy is known at every step, the length at the frames alone: where these lie apart there are marks and no line. On a
    logarithmic axis of time the initial values are circles at its left edge.
    """
    need("matplotlib.pyplot", "plotting", "plot")
    from matplotlib.lines import Line2D

    time, energy = energy_history(result)
    right_axes = axes.twinx()
    start = scale_time(axes, time)
    fit(axes, "y", energy)
    right_axes.set_ylim(around(result.length, 0.08))
    (left,) = axes.plot(*from_start(time, energy, start), color=BLUE, label="energy")
    right = _draw_frames(result.time, result.length, start, axes.get_xscale() == "log", right_axes)
    handles = [left, right]
    if axes.get_xscale() == "log":
        mark: dict[str, Any] = {"linestyle": "", "marker": "o", "markerfacecolor": "white", "clip_on": False}
        # One within the other where they meet.
        axes.plot(start, energy[0], color=BLUE, markersize=9, **mark)
        right_axes.plot(start, result.length[0], color=_VERMILION, markersize=5, **mark)
        handles.append(Line2D([], [], color="0.4", label="at $t$ = 0", **mark))
    axes.set(xlabel="time $t$", ylabel="energy")
    right_axes.set_ylabel("length", color=_VERMILION)
    _draw_legend(axes, handles)


def energy_history(result: Frames) -> tuple[Array, Array]:
    """Return time and energy of all steps and frames in the order of time: frames may lie between steps, and steps between frames."""
    steps = result.steps
    time, first = np.unique(np.concatenate([result.time, steps["time"]]), return_index=True)
    return time, np.concatenate([result.energy, steps["energy"]])[first]


def _draw_frames(time: Array, length: Array, start: float, is_logarithmic: bool, axes: Axes) -> Line2D:
    """Draw the lengths of frames: a line through those that are close on the axis, marks for those that have none close.

    Returns what stands for both in a legend.
    """
    from matplotlib.lines import Line2D

    # Those before the axis starts, the initial one among them, have no place on it.
    shown = time >= start
    time, length = time[shown], length[shown]
    place = np.log(time / start) if is_logarithmic else time - start
    joined = np.diff(place) <= _CLOSE * place[-1]
    gaps = np.flatnonzero(~joined) + 1
    style: dict[str, Any] = {"color": _VERMILION, "label": "length"}
    (line,) = axes.plot(np.insert(time, gaps, np.nan), np.insert(length, gaps, np.nan), "--", **style)
    alone = ~(np.append(False, joined) | np.append(joined, False))
    if not alone.any():
        return line
    style |= {"marker": "o", "markersize": 4}
    axes.plot(time[alone], length[alone], linestyle="", clip_on=False, **style)
    return Line2D([], [], linestyle="--" if joined.any() else "", **style)


def _draw_legend(axes: Axes, handles: list[Line2D]) -> None:
    from matplotlib.transforms import ScaledTranslation

    # Above the panel, within which the lines may be anywhere, and above the power of ten that matplotlib puts there.
    above = ScaledTranslation(0, _ABOVE, axes.figure.dpi_scale_trans)
    place: dict[str, Any] = {"bbox_to_anchor": (0, 1), "bbox_transform": axes.transAxes + above, "borderaxespad": 0}
    narrow: dict[str, Any] = {"handlelength": 1.8, "handletextpad": 0.5, "columnspacing": 1.2}
    axes.legend(handles=handles, ncols=len(handles), fontsize="small", frameon=False, loc="lower left", **place, **narrow)
