"""Figures of results with matplotlib, which is imported at the first use only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .extras import need
from .frames import Array
from .history_plot import BLUE, draw_history
from .periodic import arc_length_fraction, closed, refined
from .result import Result
from .scales import CONSTANT, around

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_curve", "draw_history", "draw_nodal_lines", "draw_state", "plot"]

_GREEN, _VERMILION = "#009E73", "#D55E00"
_INITIAL: dict[str, Any] = {"color": "0.5", "linewidth": 1.2, "linestyle": "--"}
# A curve that is smaller than this part of the initial one is marked by a dot.
_DOT = 0.01
# Letters of the name of a density at a bar of colours, and at an axis, beside which matplotlib may write a power of ten.
_AT_BAR, _AT_AXIS = 40, 20


def plot(result: Result, figure: Figure | None = None, density: str | None = None) -> Figure:
    """Draw the three panels into ``figure``, or into a new figure of pyplot, and return it.

    Raises:
        MissingExtraError: matplotlib is missing: ``pip install "curveflow[plot]"``.
        ValueError: there is no such density.
    """
    result._known(density)
    if figure is None:
        figure = _pyplot().figure(figsize=(11, 6.2), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1))
    draw_curve(result, figure.add_subplot(grid[:, 0]), density=density)
    draw_state(result, figure.add_subplot(grid[0, 1]), density=density)
    draw_history(result, figure.add_subplot(grid[1, 1]))
    if result.title:
        figure.suptitle(plain(result.title))
    return figure


def draw_curve(result: Result, axes: Axes, frame: int = -1, density: str | None = None) -> None:
    """Draw the curve of one frame, coloured by a density, the first if none is named (or curvature), over the initial curve."""
    _pyplot()
    from matplotlib.collections import LineCollection

    name, values = _chosen(result, density) or ("curvature", result.curvature)
    initial, curve = (closed(refined(result.position[which])) for which in (0, frame))
    value = closed(refined(values[frame]))
    axes.plot(*initial.T, **_INITIAL, label="initial")
    lines = LineCollection(
        list(np.stack([curve[:-1], curve[1:]], axis=1)), linewidths=4, capstyle="round", cmap="viridis"
    )
    lines.set_array(0.5 * (value[:-1] + value[1:]))
    if np.ptp(value) < CONSTANT * np.abs(value).max():  # colours would show nothing but rounding
        lines.set_clim(*around(value, 0.0))
    axes.add_collection(lines)
    if is_dot(curve, initial):
        axes.plot(*curve.mean(axis=0), "ko", markersize=4)
    axes.set(xlabel="$x$", ylabel="$y$", title=f"$t$ = {result.time[frame]:.4g}")
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale_view()
    label = "curvature $\\kappa$" if name == "curvature" else _label(name, _AT_BAR)
    axes.figure.colorbar(lines, ax=axes, label=label, shrink=0.8)
    axes.legend(loc="upper right", frameon=False)


def is_dot(curve: Array, initial: Array) -> bool:
    """Whether a curve has shrunk to what only a dot shows beside the initial one; both of shape (points, 2)."""
    return bool(np.ptp(curve, axis=0).max() < _DOT * np.ptp(initial, axis=0).max())


def draw_state(result: Result, axes: Axes, frame: int = -1, density: str | None = None) -> None:
    """Draw curvature against a density, the first if none is named, with the nodal lines of the energy, of one frame.

    Without a density, draw curvature against the fraction of the arc length, over that of the initial curve.
    """
    _pyplot()
    last = frame in (-1, len(result.time) - 1)
    label = "final" if last else f"$t$ = {result.time[frame]:.4g}"
    kappa = refined(result.curvature[frame])
    if chosen := _chosen(result, density):
        name, densities = chosen
        rho = refined(densities[frame])
        axes.plot(closed(rho), closed(kappa), "k", linewidth=2, label=label)
        if all(np.ptp(values) <= CONSTANT * np.abs(values).max() for values in (rho, kappa)):
            axes.plot(rho.mean(), kappa.mean(), "ko")
        # Room for the nodal lines around the state, which ends on them.
        axes.set(xlim=around(rho, 0.15), ylim=around(kappa, 0.15))
        axes.locator_params(axis="x", nbins=6)
        draw_nodal_lines(result, axes, name)
        axes.set(xlabel=_label(name, _AT_AXIS), ylabel="curvature $\\kappa$")
    else:
        initial = refined(result.curvature[0])
        axes.plot(arc_length_fraction(refined(result.metric[0])), closed(initial), **_INITIAL, label="initial")
        axes.plot(arc_length_fraction(refined(result.metric[frame])), closed(kappa), "k", linewidth=2, label=label)
        axes.set(xlim=(0, 1), ylim=around(np.concatenate([initial, kappa]), 0.1))
        axes.set(xlabel="arc length $\\sigma/|\\Gamma|$", ylabel="curvature $\\kappa$")
    axes.legend(fontsize="small", frameon=False)


def draw_nodal_lines(result: Result, axes: Axes, density: str | None = None) -> None:
    """Draw where the energy of the agents vanishes, within the limits of density (x) and curvature (y) of ``axes``.

    Draws nothing if the energy has no agents, or not of the density, the first if none is named.
    """
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    rho, kappa = np.linspace(left, right, 400), np.linspace(bottom, top, 400)
    lines = result.scene._native.nodal_lines(rho, kappa)
    if lines is None or lines[0] != (density or next(iter(result.density))):
        return
    _, preferred, low, high = lines
    axes.plot(rho, preferred, color=_VERMILION, label="$\\kappa_0(\\rho)$")
    axes.plot(low, kappa, "--", color=BLUE, label="$\\rho_-(\\kappa)$")
    axes.plot(high, kappa, ":", color=_GREEN, label="$\\rho_+(\\kappa)$")
    axes.set(xlim=(left, right), ylim=(bottom, top))


def _chosen(result: Result, density: str | None) -> tuple[str, Array] | None:
    """The density of this name, or the first, with its name; none if there is none."""
    name = result._known(density) or next(iter(result.density), None)
    return None if name is None else (name, result.density[name])


def _label(density: str, most: int) -> str:
    """What an axis of a density is called, by at most so many letters of its name."""
    name = density if len(density) <= most else f"{density[: most - 1]}…"
    return f"{plain(name)} density $\\rho$"


def _pyplot() -> Any:
    return need("matplotlib.pyplot", "plotting", "plot")


def plain(text: str) -> str:
    """A text in which matplotlib finds no formula."""
    return text.replace("$", r"\$")
