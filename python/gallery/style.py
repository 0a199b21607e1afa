"""What the figures of the gallery share: colours, curves, small panels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

import curveflow as cf

Array = NDArray[np.float64]

BLACK, BLUE, GREEN, VERMILION, PURPLE = "black", "#0072B2", "#009E73", "#D55E00", "#A85088"
GREY: dict[str, Any] = {"color": "0.55", "linewidth": 1.0, "linestyle": "--"}

SETTINGS: Any = {
    "figure.dpi": 100,
    "savefig.dpi": 110,
    "figure.constrained_layout.use": True,
    "font.size": 10,
    "axes.titlesize": 10,
    "legend.fontsize": 9,
    "legend.frameon": False,
}


def page(width: float, height: float) -> Figure:
    """An empty figure, its size in inches."""
    return plt.figure(figsize=(width, height))


def closed(values: Array) -> Array:
    """Nodal values with the first one again at the end."""
    return np.concatenate([values, values[:1]])


def draw_coloured(axes: Axes, position: Array, values: Array, scale: Normalize) -> LineCollection:
    """A closed curve in the colours of its nodal values."""
    curve, value = closed(position), closed(values)
    lines = LineCollection(list(np.stack([curve[:-1], curve[1:]], axis=1)), linewidths=3.5, capstyle="round")
    lines.set(cmap="viridis", norm=scale, array=0.5 * (value[:-1] + value[1:]))
    axes.add_collection(lines)
    axes.autoscale_view()
    return lines


def frame_curves(panels: Sequence[Axes], curves: Sequence[Array]) -> None:
    """The same square window for all panels, about all curves, with equal axes."""
    points = np.concatenate([curve.reshape(-1, 2) for curve in curves])
    centre = 0.5 * (points.max(axis=0) + points.min(axis=0))
    half = 0.55 * float(np.ptp(points, axis=0).max())
    for axes in panels:
        axes.set(xlim=(centre[0] - half, centre[0] + half), ylim=(centre[1] - half, centre[1] + half), xlabel="$x$")
        axes.set_aspect("equal")
    panels[0].set_ylabel("$y$")
    for axes in panels[1:]:
        axes.tick_params(labelleft=False)


def frame_near(result: cf.Result, time: float) -> int:
    """The frame whose time is nearest to ``time``, in ratio."""
    positive = np.maximum(result.time, np.finfo(float).tiny)
    return int(np.argmin(np.abs(np.log(positive / time))))
