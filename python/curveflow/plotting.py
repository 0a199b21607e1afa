"""Figures of results with matplotlib, which is imported at the first use only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .extras import need
from .result import Array, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_BLUE, _GREEN, _PURPLE, _VERMILION = "#0072B2", "#009E73", "#A85088", "#D55E00"
_INITIAL: dict[str, Any] = {"color": "0.5", "linewidth": 1.2, "linestyle": "--"}
_MOST_DECADES = 1e-10
_CONSTANT = 1e-6


def plot(result: Result, figure: Figure | None = None) -> Figure:
    """Draw the three panels into ``figure``, or into a new figure of pyplot, and return it.

    Raises:
        MissingExtraError: matplotlib is missing: ``pip install "curveflow[plot]"``.
    """
    if figure is None:
        figure = _pyplot().figure(figsize=(11, 6.2), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1))
    draw_curve(result, figure.add_subplot(grid[:, 0]))
    draw_state(result, figure.add_subplot(grid[0, 1]))
    draw_history(result, figure.add_subplot(grid[1, 1]))
    if result.title:
        figure.suptitle(plain(result.title))
    return figure


def draw_curve(result: Result, axes: Axes, frame: int = -1) -> None:
    """Draw the curve of one frame, coloured by its first density (or curvature), over the initial curve."""
    _pyplot()
    from matplotlib.collections import LineCollection

    name, values = next(iter(result.density.items()), ("curvature", result.curvature))
    curve, value = closed(result.position[frame]), closed(values[frame])
    axes.plot(*closed(result.position[0]).T, **_INITIAL, label="initial")
    lines = LineCollection(
        list(np.stack([curve[:-1], curve[1:]], axis=1)), linewidths=4, capstyle="round", cmap="viridis"
    )
    lines.set_array(0.5 * (value[:-1] + value[1:]))
    if np.ptp(value) < _CONSTANT * np.abs(value).max():  # colours would show nothing but rounding
        margin = 0.01 * np.abs(value).max()
        lines.set_clim(value.min() - margin, value.max() + margin)
    axes.add_collection(lines)
    axes.set(xlabel="$x$", ylabel="$y$", title=f"$t$ = {result.time[frame]:.4g}")
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale_view()
    label = "curvature $\\kappa$" if name == "curvature" else f"{plain(name)} density $\\rho$"
    axes.figure.colorbar(lines, ax=axes, label=label, shrink=0.8)
    axes.legend(loc="upper right", frameon=False)


def draw_state(result: Result, axes: Axes, frame: int = -1) -> None:
    """Draw curvature against density with the nodal lines of the energy; without a density, against arc length."""
    _pyplot()
    kappa = result.curvature
    if result.density:
        name, rho = next(iter(result.density.items()))
        axes.plot(closed(rho[0]), closed(kappa[0]), **_INITIAL, label="initial")
        axes.plot(closed(rho[frame]), closed(kappa[frame]), "k", linewidth=2, label="final")
        draw_nodal_lines(result, axes)
        axes.set(xlabel=f"{plain(name)} density $\\rho$", ylabel="curvature $\\kappa$")
    else:
        axes.plot(_arc_length(result.metric[0]), closed(kappa[0]), **_INITIAL, label="initial")
        axes.plot(_arc_length(result.metric[frame]), closed(kappa[frame]), _PURPLE, label="final")
        axes.set(xlabel="arc length $\\sigma$", ylabel="curvature $\\kappa$")
    axes.legend(fontsize="small", frameon=False)


def draw_history(result: Result, axes: Axes) -> None:
    """Draw energy (left) and length (right) over time, in decades of time where the run spans several."""
    _pyplot()
    time, energy = history(result)
    (left,) = axes.plot(time, energy, color=_BLUE, label="energy")
    right_axes = axes.twinx()
    (right,) = right_axes.plot(result.time, result.length, "--", color=_VERMILION, label="length")
    scale_time(axes, time)
    axes.set(xlabel="time $t$", ylabel="energy")
    right_axes.set_ylabel("length", color=_VERMILION)
    # Above the panel: within it the lines may be anywhere.
    place = (0.0, 1.0)
    axes.legend(handles=[left, right], ncols=2, fontsize="small", frameon=False, loc="lower left", bbox_to_anchor=place)


def history(result: Result) -> tuple[Array, Array]:
    """Return time and energy of every step, or of the frames where these are more."""
    steps = result.steps
    if len(steps["time"]) < len(result.time):
        return result.time, result.energy
    time = np.append(result.time[0], steps["time"])
    return time, np.append(result.energy[0], steps["energy"])


def scale_time(axes: Axes, time: Array) -> float:
    """Make the axis of time logarithmic if the run spans several decades; return where it starts."""
    end = float(time[-1])
    start = max(float(np.min(time[time > 0], initial=end)), end * _MOST_DECADES)
    if end > 10 * start > 0:
        axes.set_xscale("log")
        axes.set_xlim(start, end)
        return start
    return float(time[0])


def draw_nodal_lines(result: Result, axes: Axes) -> None:
    """Draw where the energy of the agents vanishes, within the limits of density (x) and curvature (y) of ``axes``.

    Draws nothing if the energy has no agents, or not of the first density.
    """
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    rho, kappa = np.linspace(left, right, 400), np.linspace(bottom, top, 400)
    lines = result.scene._native.nodal_lines(rho, kappa)
    if lines is None or lines[0] != next(iter(result.density)):
        return
    _, preferred, low, high = lines
    axes.plot(rho, preferred, color=_VERMILION, label="$\\kappa_0(\\rho)$")
    axes.plot(low, kappa, "--", color=_BLUE, label="$\\rho_-(\\kappa)$")
    axes.plot(high, kappa, ":", color=_GREEN, label="$\\rho_+(\\kappa)$")
    axes.set(xlim=(left, right), ylim=(bottom, top))


def _pyplot() -> Any:
    return need("matplotlib.pyplot", "plotting", "plot")


def closed(values: Array) -> Array:
    """Nodal values with the first one repeated at the end."""
    return np.concatenate([values, values[:1]])


def _arc_length(metric: Array) -> Array:
    """Arc length of the nodes from the first one, once around."""
    around = closed(metric)
    return np.append(0.0, np.cumsum(0.5 * (around[:-1] + around[1:]) / len(metric)))


def plain(text: str) -> str:
    """A text in which matplotlib finds no formula."""
    return text.replace("$", r"\$")
