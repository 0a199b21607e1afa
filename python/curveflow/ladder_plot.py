"""The work-precision figure with matplotlib, which is imported at the first use only."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .ladder import Tradeoff
from .plotting import plain, _pyplot

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLOURS = ("#222222", "#0072B2", "#009E73", "#D55E00", "#A85088", "#E69F00", "#56B4E9")
_STYLES = ("-", "--", "-.", ":")
# The reference tells nothing about errors below this part of its tolerance.
_RESOLVED = 0.1


def plot(tradeoff: Tradeoff, figure: Figure | None = None) -> Figure:
    """Draw both times into ``figure``, or into a new figure of pyplot, and return it.

    Raises:
        MissingExtraError: matplotlib is missing: ``pip install "curveflow[plot]"``.
    """
    if figure is None:
        figure = _pyplot().figure(figsize=(11, 5), layout="constrained")
    left, right = figure.subplots(1, 2, sharex=True, sharey=True)
    draw(tradeoff, 0, left)
    draw(tradeoff, 1, right)
    left.set_ylabel("relative error")
    left.legend(frameon=False, fontsize="small")
    if tradeoff.title:
        figure.suptitle(plain(tradeoff.title))
    return figure


def draw(tradeoff: Tradeoff, time: int, axes: Axes) -> None:
    """Draw errors against seconds, halfway (``time`` 0) or at the end (1), with the tolerance at each run."""
    errors = {name: values[time] for name, values in tradeoff.errors.items()}
    for number, (name, values) in enumerate(errors.items()):
        # Errors of zero have no place on a logarithmic axis.
        shown = np.where(values > 0, values, np.nan)
        style = _STYLES[number % len(_STYLES)]
        colour = _COLOURS[number % len(_COLOURS)]
        axes.plot(tradeoff.seconds, shown, style, color=colour, marker="o", markersize=4, label=plain(name))
    tops = np.max(np.nan_to_num(list(errors.values())), axis=0)
    for tolerance, seconds, top in zip(tradeoff.tolerance, tradeoff.seconds, tops, strict=True):
        if top > 0:
            axes.annotate(
                f"{tolerance:g}", (seconds, top), (5, 4), textcoords="offset points", fontsize="small"
            )
    axes.set(xscale="log", yscale="log", xlabel="time of integration [s]")
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, _RESOLVED * tradeoff.reference.tolerance), high)
    axes.set_title(f"$t$ = {tradeoff.times[time]:.4g}", fontsize="medium")
    axes.grid(color="0.9")
