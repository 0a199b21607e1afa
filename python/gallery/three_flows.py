"""Three ways to hold the length of a curve: the last figure of the paper."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import curveflow as cf
from alignment import Aligned, align, centred, radius
from style import BLACK, BLUE, GREEN, GREY, VERMILION, closed, page

FLOWS = {
    "length_penalty": ("total length, $\\beta$ = 5", BLACK),
    "membrane_penalty": ("membrane, $\\epsilon$ = 0.01", BLUE),
    "incompressible": ("incompressible", GREEN),
}
ACCURACY = {"accuracy.nodes": 512, "accuracy.tolerance": 1e-7, "output.frames": 1}


def run() -> dict[str, cf.Result]:
    """The three flows to t = 0.01."""
    return {name: cf.run(cf.Scene.shipped(name).with_values(ACCURACY)) for name in FLOWS}


def aligned(results: dict[str, cf.Result]) -> dict[str, Aligned]:
    """Each final curve laid on that of the length penalty."""
    reference = results["length_penalty"].position[-1]
    return {name: align(result.position[-1], reference) for name, result in results.items()}


def three_flows() -> Figure:
    """The three curves laid on top of each other, the gaps between them, and the density of the membrane."""
    results = run()
    curves = aligned(results)
    crossings = curves["incompressible"].crossings
    figure = page(10, 5.4)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.2, 1))
    overlay, gaps, density = (figure.add_subplot(grid[place]) for place in (np.s_[:, 0], np.s_[0, 1], np.s_[1, 1]))

    overlay.plot(*closed(centred(results["incompressible"].position[0])).T, **GREY, label="initial")
    for name, (label, colour) in FLOWS.items():
        position = curves[name].position
        overlay.plot(*closed(position).T, color=colour, label=label)
        overlay.plot(*position[0], "o", color=colour, fillstyle="none", markersize=7)
    rim = radius(curves["length_penalty"].position, crossings)
    overlay.plot(rim * np.cos(crossings), rim * np.sin(crossings), "o", color=VERMILION, markersize=5, label="crossings")
    overlay.set(xlabel="$x$", ylabel="$y$", title="$t$ = 0.01; open circles: $\\gamma(0)$")
    overlay.set_aspect("equal")
    overlay.legend(loc="center", fontsize=8)

    for name in ("membrane_penalty", "incompressible"):
        label, colour = FLOWS[name]
        gaps.plot(np.degrees(curves[name].directions), curves[name].gap, color=colour, label=label)
    gaps.axhline(0, color=BLACK, linewidth=1)
    gaps.plot(np.degrees(crossings), np.zeros_like(crossings), "o", color=VERMILION, markersize=5)
    gaps.set(xlabel="direction from the centre (degrees)", ylabel="radius less that\nof total length")
    gaps.set(xlim=(0, 360), xticks=range(0, 361, 60), ylim=(-0.06, 0.085))
    gaps.legend(loc="upper center", ncols=2, fontsize=8)

    membrane = results["membrane_penalty"]
    s, rho = np.append(membrane.parameter, 1.0), closed(membrane.density["membrane"][-1])
    density.plot(s, rho, color=BLUE, label="$t$ = 0.01")
    concave = closed(membrane.curvature[-1]) < 0
    density.fill_between(s, 0, 1, where=concave.tolist(), color="0.9", transform=density.get_xaxis_transform())
    density.axhline(1, **GREY, label="initial")
    density.set(xlabel="parameter $s$ (grey: concave arcs)", ylabel="membrane density $\\rho_m$", xlim=(0, 1))
    density.legend(loc="upper right", fontsize=8)
    return figure
