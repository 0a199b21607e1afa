"""Other energies: a figure eight, a curve that attracts itself, a blend of two lipids."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

import curveflow as cf
from style import BLACK, BLUE, GREEN, PURPLE, VERMILION, closed, draw_coloured, frame_curves, frame_near, page

Array = NDArray[np.float64]

PACKING = np.array([[1.0, 0.1], [0.1, 1.0]])
AMPLITUDES = np.linspace(0, 2 * np.pi, 2000, endpoint=False)


def elliptic_integrals(m: float) -> tuple[float, float]:
    """K and E of the parameter m = k², by the trapezoidal rule, which is exact to rounding here."""
    root = np.sqrt(1 - m * np.sin(AMPLITUDES) ** 2)
    return float((1 / root).mean() * np.pi / 2), float(root.mean() * np.pi / 2)


def parameter() -> float:
    """The parameter m = k² of the elastica that closes after one period: 2E = K."""
    low, high = 0.5, 0.99
    for _ in range(60):
        middle = 0.5 * (low + high)
        first, second = elliptic_integrals(middle)
        low, high = (middle, high) if 2 * second > first else (low, middle)
    return low


def energy_times_length() -> float:
    """(½∫κ² dσ)|Γ| of that elastica, whatever its size: 32 K (E - (1 - m) K), as in docs/physics.md."""
    m = parameter()
    first, second = elliptic_integrals(m)
    return 32 * first * (second - (1 - m) * first)


def elastica(length: float) -> Array:
    """The figure eight among Euler's elastica, along the x axis, shape (node, 2).

    sin(θ/2) = k sin φ with the amplitude φ of the elliptic functions; dσ = dφ/√(1 - k² sin²φ) up to the size.
    """
    m = parameter()
    root = np.sqrt(1 - m * np.sin(AMPLITUDES) ** 2)
    modes = np.fft.rfftfreq(len(root), 1 / len(root))
    spectrum = np.fft.rfft((1 - 2 * m * np.sin(AMPLITUDES) ** 2) / root)
    spectrum[0] = 0.0  # closed: 2E = K
    spectrum[1:] /= 1j * modes[1:]
    across = np.fft.irfft(spectrum, len(root))
    along = -2 * np.sqrt(m) * np.cos(AMPLITUDES)
    curve: Array = np.stack([along, across], axis=1) * length / (4 * elliptic_integrals(m)[0])
    return curve


def figure_eight() -> Figure:
    """From a lemniscate to the elastica of turning number 0."""
    result = cf.run(cf.Scene.shipped("figure_eight"))
    figure = page(10, 3.8)
    shape, history = figure.subplots(1, 2, width_ratios=(1.5, 1))
    frames = [0, frame_near(result, 1e-3), frame_near(result, 1e-2), len(result.time) - 1]
    colours = ["0.7", *plt.get_cmap("viridis")([0.7, 0.45]), BLACK]
    for frame, colour in zip(frames, colours, strict=True):
        shape.plot(*closed(result.position[frame]).T, color=colour, label=f"$t$ = {result.time[frame]:.2g}")
    # By symmetry the scene's figure eight keeps its centre and its axis, x.
    exact = elastica(float(result.length[-1])) + result.position[-1].mean(axis=0)
    shape.plot(*closed(exact).T, ":", color=VERMILION, linewidth=2.5, label="elastica")
    shape.set(xlabel="$x$", ylabel="$y$")
    shape.set_aspect("equal")
    shape.legend(ncols=5, loc="lower center", bbox_to_anchor=(0.5, 1.0), columnspacing=1.2, handlelength=1.5)
    exact_product = energy_times_length()
    product = result.energy_terms["bending"] * result.length
    later = result.time > 0
    history.loglog(result.time[later], np.abs(product / exact_product - 1)[later], color=BLACK)
    history.set(xlabel="time $t$", xlim=(1e-6, 1), ylabel="relative distance from the elastica")
    history.set_title(f"$\\frac{{1}}{{2}}\\int\\kappa^2\\,d\\sigma\\cdot|\\Gamma|$ against {exact_product:.4f}")
    return figure


def adhesion() -> Figure:
    """Three lobes that attract each other at a distance: snapshots, and what each energy does."""
    result = cf.run(cf.Scene.shipped("adhesion"))
    figure = page(10, 5.8)
    above, below = figure.subfigures(2, 1, height_ratios=(1, 1.1), squeeze=False)[:, 0]
    frames = [0, *(frame_near(result, time) for time in (0.01, 0.05)), len(result.time) - 1]
    panels = list(above.subplots(1, len(frames), squeeze=False)[0])
    scale = Normalize(*np.percentile(result.curvature[frames], (0, 100)))
    for axes, frame in zip(panels, frames, strict=True):
        lines = draw_coloured(axes, result.position[frame], result.curvature[frame], scale)
        axes.set_title(f"$t$ = {result.time[frame]:.2g}")
    frame_curves(panels, [result.position[frame] for frame in frames])
    above.colorbar(lines, ax=panels, label="curvature $\\kappa$", shrink=0.8, pad=0.01)
    terms, length = below.subplots(1, 2)
    terms.plot(result.time, result.energy, color=BLACK, linewidth=2, label="energy")
    for (name, term), colour in zip(result.energy_terms.items(), (BLUE, GREEN, PURPLE), strict=True):
        terms.plot(result.time, term, color=colour, label=f"{name} term")
    terms.set(xlabel="time $t$", ylabel="energy", xlim=(0, result.time[-1]))
    terms.legend(ncols=2, loc="center", bbox_to_anchor=(0.5, 0.5))
    length.plot(result.time, result.length / result.length[0], color=VERMILION, label="length")
    length.plot(result.time, result.area / result.area[0], "--", color=BLUE, label="area")
    length.set(xlabel="time $t$", ylabel="relative to the start", xlim=(0, result.time[-1]))
    length.legend()
    return figure


def blend() -> Figure:
    """Two lipids that share a membrane: they part while it is bent unevenly, and mix again as it rounds itself."""
    result = cf.run(cf.Scene.shipped("blend"))
    (name, curved), (other, flat) = result.density.items()
    figure = page(10, 6.2)
    above, below = figure.subfigures(2, 1, height_ratios=(1, 1.1), squeeze=False)[:, 0]
    frames = [0, *(frame_near(result, time) for time in (0.01, 0.1)), len(result.time) - 1]
    panels = list(above.subplots(1, len(frames), squeeze=False)[0])
    scale = Normalize(curved[frames].min(), curved[frames].max())
    for axes, frame in zip(panels, frames, strict=True):
        lines = draw_coloured(axes, result.position[frame], curved[frame], scale)
        axes.set_title(f"$t$ = {result.time[frame]:.2g}")
    frame_curves(panels, [result.position[frame] for frame in frames])
    above.colorbar(lines, ax=panels, label=f"density “{name}”", shrink=0.8, pad=0.01)

    along, trace = below.subplots(1, 2, width_ratios=(1.4, 1))
    s, shades = np.append(result.parameter, 1.0), plt.get_cmap("cividis")(np.linspace(0, 0.85, len(frames)))
    for frame, shade in zip(frames, shades, strict=True):
        along.plot(s, closed(curved[frame]), color=shade)
        along.plot(s, closed(flat[frame]), "--", color=shade)
        label = f"$t$ = {result.time[frame]:.2g}"
        trace.plot(closed(curved[frame]), closed(flat[frame]), ".-", color=shade, linewidth=2, markersize=4, label=label)
    along.set(xlabel="fraction of arc length", ylabel=f"density (solid: {name}, dashed: {other})", xlim=(0, 1))
    angle = np.linspace(0, np.pi / 2, 400)
    ray = np.stack([np.cos(angle), np.sin(angle)])
    # ρᵀPρ = 1 with the matrix P of the scene.
    trace.plot(*(ray / np.sqrt(np.einsum("in,ij,jn->n", ray, PACKING, ray))), color=GREEN, label="$\\rho^T P\\rho$ = 1")
    trace.set(xlabel=f"density “{name}”", ylabel=f"density “{other}”", xlim=(0.44, 0.8), ylim=(0.6, 0.96))
    trace.set_aspect("equal")
    trace.legend(loc="upper right")
    return figure
