"""Axes that can be read: linear or logarithmic by what they show, with labels that keep apart."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .frames import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Values that differ by less, relative to their size, differ by rounding.
CONSTANT = 1e-6
_MOST_DECADES = 1e-10
# Room at the left edge of a logarithmic axis of time, where the initial values stand, as a part of its decades.
_APART = 0.05
# Positive values that differ by more than this factor get a logarithmic axis.
_LOGARITHMIC_FROM = 20.0
_MARGIN = 0.08


def scale_time(axes: Axes, time: Array) -> float:
    """Make the axis of time logarithmic if the run spans several decades; return where it starts.

    Time 0 has no place on a logarithmic axis: the initial values belong to its left edge. That is earlier than all other times,
    unless these span more decades than can be shown.
    """
    end = float(time[-1])
    first = max(float(np.min(time[time > 0], initial=end)), end * _MOST_DECADES)
    if not end > 10 * first > 0:
        return float(time[0])
    start = float(first * (first / end) ** _APART)
    logarithmic(axes, "x", start, end)
    return start


def from_start(time: Array, values: Array, start: float) -> tuple[Array, Array]:
    """Return the part of a history that an axis from ``start`` on shows: what is known last before stands at its edge."""
    before = max(int(np.searchsorted(time, start, side="right")) - 1, 0)
    return np.maximum(time[before:], start), values[before:]


def fit(axes: Axes, which: str, values: Array) -> None:
    """Fit an axis, ``"x"`` or ``"y"``, to values: logarithmic if they are positive and span decades, as `curveflow plot` does."""
    low, high = _range(values)
    if low > 0 and high >= _LOGARITHMIC_FROM * low:
        room = (high / low) ** _MARGIN
        logarithmic(axes, which, low / room, high * room)
    else:
        axes.set(**{f"{which}lim": around(values, _MARGIN)})


def around(values: Array, margin: float) -> tuple[float, float]:
    """Return limits around values, ``margin`` of their range beside them; those of a constant do not show its rounding."""
    low, high = _range(values)
    size = max(abs(low), abs(high))
    pad = margin * (high - low) if high - low > CONSTANT * size else 0.01 * size or 1.0
    return low - pad, high + pad


def logarithmic(axes: Axes, which: str, low: float, high: float) -> None:
    """Make an axis, ``"x"`` or ``"y"``, logarithmic from ``low`` to ``high``, with two labels at least and few enough to read."""
    from matplotlib.ticker import FuncFormatter, LogFormatterSciNotation, LogLocator, NullFormatter

    axes.set(**{f"{which}scale": "log", f"{which}lim": (low, high)})
    axis: Any = getattr(axes, f"{which}axis")
    axis.set_minor_formatter(NullFormatter())
    decades = np.log10(high / low)
    if decades >= 2:  # matplotlib's own labels are at powers of ten
        return
    axis.set_major_locator(LogLocator(subs=(1, 3) if decades > 1.3 else (1, 2, 5)))
    if low >= 1e-3 and high <= 1e4:
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    else:
        axis.set_major_formatter(LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf)))


def _range(values: Array) -> tuple[float, float]:
    """Smallest and largest finite value; 0 if there is none."""
    finite = values[np.isfinite(values)]
    return (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
