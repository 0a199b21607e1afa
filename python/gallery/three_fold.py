"""Curvature agents: the three-fold membrane and its sharp fronts, the first two figures of the paper."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

import curveflow as cf
from curveflow.plotting import draw_history, draw_nodal_lines
from style import BLACK, PURPLE, closed, draw_coloured, frame_curves, frame_near, page

DOUBLE_NODES = np.array([[0.19, 1.3], [0.95, -0.7]])
SNAPSHOTS = (3e-3, 5e-2, 3e-1)
EPSILONS = {"three_fold": 0.05, "three_fold_sharp": 0.02}


def three_fold() -> Figure:
    """From the trillium curve to the equilibrium, its trace over the nodal lines, energy and length over time."""
    result = cf.run(cf.Scene.shipped("three_fold"))
    figure = page(10, 6.4)
    above, below = figure.subfigures(2, 1, height_ratios=(1, 1.4), squeeze=False)[:, 0]
    frames = [0, *(frame_near(result, time) for time in SNAPSHOTS), len(result.time) - 1]
    panels = list(above.subplots(1, len(frames), squeeze=False)[0])
    rho = result.density["protein"]
    scale = Normalize(rho[frames].min(), rho[frames].max())
    for axes, frame in zip(panels, frames, strict=True):
        lines = draw_coloured(axes, result.position[frame], rho[frame], scale)
        axes.set_title(f"$t$ = {result.time[frame]:.2g}")
    panels[-1].set_title(f"equilibrium, $t$ = {result.time[-1]:.2g}")
    frame_curves(panels, [result.position[frame] for frame in frames])
    above.colorbar(lines, ax=panels, label="protein density $\\rho$", shrink=0.75, pad=0.01)
    trace, history = below.subplots(1, 2)
    _prepare_trace(result, trace)
    trace.plot(closed(rho[-1]), closed(result.curvature[-1]), color=BLACK, linewidth=2, label="equilibrium")
    trace.legend(loc="lower left", bbox_to_anchor=(0.22, 0.0))
    draw_history(result, history)
    return figure


def three_fold_sharp() -> Figure:
    """Equilibria at two widths of the fronts: the curves, their traces over the nodal lines, density along the curve."""
    results = {epsilon: cf.run(cf.Scene.shipped(name)) for name, epsilon in EPSILONS.items()}
    figure = page(10, 6.2)
    above, below = figure.subfigures(2, 1, height_ratios=(1.15, 1), squeeze=False)[:, 0]
    left, right = above.subfigures(1, 2, width_ratios=(2.1, 1), squeeze=False)[0]
    panels, trace, along = list(left.subplots(1, 2, squeeze=False)[0]), right.subplots(), below.subplots()
    _prepare_trace(results[0.05], trace)
    end = {epsilon: result.density["protein"][-1] for epsilon, result in results.items()}
    scale = Normalize(min(rho.min() for rho in end.values()), max(rho.max() for rho in end.values()))
    marks: dict[float, dict[str, Any]] = {0.05: {"color": BLACK, "linewidth": 2.0}, 0.02: {"color": PURPLE, "linewidth": 1.5}}
    for axes, (epsilon, result) in zip(panels, results.items(), strict=True):
        label = f"$\\epsilon$ = {epsilon}"
        lines = draw_coloured(axes, result.position[-1], end[epsilon], scale)
        axes.set_title(f"{label}, energy {result.energy[-1]:.3f}")
        rho, kappa = closed(end[epsilon]), closed(result.curvature[-1])
        trace.plot(rho, kappa, **marks[epsilon], label=label)
        along.plot(np.linspace(0, 1, len(rho)), rho, **marks[epsilon], label=label)
    frame_curves(panels, [result.position[-1] for result in results.values()])
    left.colorbar(lines, ax=panels, label="protein density $\\rho$", shrink=0.85, pad=0.01)
    trace.legend(loc="lower left", bbox_to_anchor=(0.2, 0.0), fontsize=8)
    along.set(xlabel="fraction of arc length $\\sigma/|\\Gamma|$", ylabel="protein density $\\rho$", xlim=(0, 1))
    along.legend(loc="center", bbox_to_anchor=(0.34, 0.5))
    return figure


def _prepare_trace(result: cf.Result, axes: Axes) -> None:
    """The window of the paper, with the nodal lines of f and F and where they meet."""
    axes.set(xlim=(0, 1.05), ylim=(-1.3, 1.8), xlabel="protein density $\\rho$", ylabel="curvature $\\kappa$")
    draw_nodal_lines(result, axes)
    axes.plot(*DOUBLE_NODES.T, "o", color=BLACK, fillstyle="none", markersize=9, label="double-nodal point")
