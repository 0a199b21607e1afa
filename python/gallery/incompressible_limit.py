"""Theorem 5 of the paper: a membrane that resists stretching becomes incompressible as its ε goes to 0."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import curveflow as cf
from style import BLACK, BLUE, GREEN, VERMILION, page

Array = NDArray[np.float64]

SCENE = """
curve = { shape = "ellipse", semi_axes = [1.6, 0.8] }
density = [{ name = "membrane", initial = 0.9, mobility = "diffusion" }]
energy.bending.rigidity = 1.0
energy.membrane = { density = "membrane", epsilon = 0.1 }
time = { end = 0.4, stop_at_equilibrium = false }
accuracy = { tolerance = 1e-8, nodes = 128 }
"""
EPSILONS = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
LARGEST_FITTED = 1e-2
END = 0.4
# The window of the decay, in ε, and how far above its floor: earlier the faster modes are still there.
DECAY = (4.0, 12.0)
ABOVE_THE_FLOOR = 50.0


@dataclass(frozen=True)
class Slope:
    """Slope of the straight line of least squares, and its standard error."""

    value: float
    error: float

    @classmethod
    def of(cls, x: Array, y: Array) -> Slope:
        """Through three points at least."""
        x, y = x - x.mean(), y - y.mean()
        value = (x @ y) / (x @ x)
        scatter = ((y - value * x) ** 2).sum() / (len(x) - 2)
        return cls(float(value), float(np.sqrt(scatter / (x @ x))))

    def __str__(self) -> str:
        return f"{self.value:.3f} ± {self.error:.3f}"


def run() -> dict[float, cf.Result]:
    """The ellipse with a stretched membrane, for every ε."""
    scene = cf.Scene.parse(SCENE)
    results = {}
    for epsilon in EPSILONS:
        fast = np.arange(1, 2 * DECAY[1] + 1) * epsilon / 2
        times = np.union1d(fast[fast < END], np.geomspace(13 * min(EPSILONS), END, 150))
        changes = {"energy.membrane.epsilon": epsilon, "output.times": times}
        results[epsilon] = cf.run(scene.with_values(changes))
    return results


def exponents(results: dict[float, cf.Result]) -> dict[str, tuple[Array, Slope]]:
    """Distance, velocity residual and length deficit at the end, with their exponents of ε, fitted for small ε."""
    epsilon = np.array(list(results))
    fitted = epsilon <= LARGEST_FITTED
    values = {
        "distance": [result.diagnostics["incompressible_distance"][-1] for result in results.values()],
        "velocity residual": [result.diagnostics["velocity_residual"][-1] / speed(result) for result in results.values()],
        "length deficit": [abs(1 - result.length[-1] / result.mass["membrane"][-1]) for result in results.values()],
    }
    arrays = {name: np.array(value) for name, value in values.items()}
    return {
        name: (value, Slope.of(np.log(epsilon[fitted]), np.log(value[fitted]))) for name, value in arrays.items()
    }


def decay(result: cf.Result, epsilon: float) -> Slope:
    """Rate ν of the distance, e^(-νt/ε)."""
    time, distance = result.time / epsilon, result.diagnostics["incompressible_distance"]
    halves = np.isclose(2 * time, np.round(2 * time), atol=1e-6)
    window = halves & (time >= DECAY[0] * 0.999) & (time <= DECAY[1] * 1.001)
    window &= distance > ABOVE_THE_FLOOR * distance[-1]
    return Slope.of(-time[window], np.log(distance[window]))


def speed(result: cf.Result) -> float:
    """Normal velocity at the end, in the square mean over arc length times the root of the length."""
    return float(np.sqrt((result.normal_velocity[-1] ** 2 * result.metric[-1]).mean()))


def incompressible_limit() -> Figure:
    """Distance from the incompressible manifold over time for a ladder of ε, and how it ends."""
    results = run()
    figure = page(10, 4.4)
    over_time, at_the_end = figure.subplots(1, 2)
    colours = plt.get_cmap("viridis")(np.linspace(0, 0.92, len(results)))
    for (epsilon, result), colour in zip(results.items(), colours, strict=True):
        later = result.time > 0
        distance = result.diagnostics["incompressible_distance"]
        over_time.loglog(result.time[later], distance[later], color=colour, label=f"$\\epsilon$ = {epsilon:.0e}")
    smallest = min(results)
    rate = decay(results[smallest], smallest)
    time = np.array(DECAY) * smallest
    start = np.interp(time[0], results[smallest].time, results[smallest].diagnostics["incompressible_distance"])
    fine = np.geomspace(time[0], time[1], 50)
    label = f"$e^{{-\\nu t/\\epsilon}}$, $\\nu$ = {rate}"
    over_time.plot(fine, start * np.exp(-rate.value * (fine - fine[0]) / smallest), "--", color=VERMILION, label=label)
    over_time.set(xlabel="time $t$", ylabel="$\\Vert\\rho - 1 - \\epsilon\\bar\\rho\\,\\Vert$ in $L^2(d\\sigma)$")
    over_time.legend(fontsize=8, loc="lower left")

    fitted = np.array([LARGEST_FITTED, min(EPSILONS)])
    for (name, (value, slope)), colour, mark in zip(
        exponents(results).items(), (BLACK, BLUE, GREEN), "os^", strict=True
    ):
        line = value[-1] * (fitted / EPSILONS[-1]) ** slope.value
        at_the_end.loglog(EPSILONS, value, mark, color=colour, label=f"{name}: $\\epsilon^{{p}}$, $p$ = {slope}")
        at_the_end.loglog(fitted, line, color=colour, linewidth=1)
    at_the_end.set(xlabel="$\\epsilon$", ylabel=f"value at $t$ = {END}")
    at_the_end.legend(fontsize=8, loc="upper left")
    return figure
