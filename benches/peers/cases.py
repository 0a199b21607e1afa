"""The shipped scenes on fixed nodes, with the times at which errors are measured."""

from dataclasses import dataclass, field
from functools import cached_property

import curveflow as cf
import numpy as np
from scipy.interpolate import CubicSpline

REFERENCE_TOLERANCE = 1e-11


@dataclass(frozen=True)
class Case:
    """A shipped scene on a number of nodes, a time in its transient, and an end."""

    name: str
    nodes: int
    times: tuple[float, float]
    changed: tuple[tuple[str, object], ...] = ()  # values that differ from the shipped scene
    own: tuple[tuple[str, object], ...] = ()  # values where Curveflow chooses the nodes
    solvers: tuple[str, ...] = ()  # those that are tried; all of them if none is named

    @property
    def label(self):
        return self.name + "".join(f", {key.split('.')[-1]} = {value}" for key, value in self.changed)

    def scene(self, values=()):
        """The scene to the end of the case, with further values; it does not stop at equilibrium."""
        fixed = {
            "time.end": self.times[-1], "time.stop_at_equilibrium": False, "output.frames": 1, "accuracy.nodes": self.nodes,
        }
        return cf.Scene.shipped(self.name).with_values({**fixed, **dict(self.changed), **dict(values)})

    def tries(self, solver):
        """Whether `solver` is tried on it."""
        return not self.solvers or solver in self.solvers

    @cached_property
    def reference(self):
        """Curvature and length at the times on these nodes, at a tight tolerance: without the error of space."""
        return self.tight({})

    @cached_property
    def reference_in_space(self):
        """The same on twice as many nodes."""
        return self.tight({"accuracy.nodes": 2 * self.nodes})

    def tight(self, values):
        simulation = cf.Simulation(self.scene({"accuracy.tolerance": REFERENCE_TOLERANCE, **values}))
        return [shape_at(simulation, time) for time in self.times]

    def errors(self, run):
        """Relative L² error of the curvature, and relative error of the length, at each time that was reached."""
        reference = self.reference_in_space if run.own_nodes else self.reference
        return [
            (relative_difference(kappa, exact), abs(length / exact_length - 1))
            for (kappa, length), (exact, exact_length) in zip(run.shapes, reference)
        ]


@dataclass
class Run:
    """What a solver took to each time, the shape that it had there, and its calls."""

    seconds: list[float] = field(default_factory=list)
    shapes: list[tuple[np.ndarray, float]] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)
    whole_seconds: list[float] = field(default_factory=list)  # CVODE: with its vector operations and the calls through Python
    own_nodes: bool = False  # whether the solver chose the nodes, so that the error of space counts
    failure: str | None = None


CASES = [
    Case("circle", 64, (0.1, 1.0)),
    Case("length_penalty", 256, (0.001, 0.01)),
    Case("incompressible", 256, (0.001, 0.01)),
    Case("membrane_penalty", 256, (0.001, 0.01)),
    Case("figure_eight", 256, (0.01, 100.0)),
    Case("adhesion", 256, (0.02, 0.2)),
    Case("blend", 256, (0.1, 10.0)),
    Case("three_fold", 512, (0.1, 100.0)),
    Case("three_fold_sharp", 1024, (0.1, 100.0)),
    # Nodes that follow the fronts; the dense matrices and ETDRK4 were out of reach with fronts twice as wide.
    Case(
        "three_fold_sharp", 2048, (0.1, 100.0), changed=(("energy.agents.epsilon", 0.01),),
        own=(("flow.gauge", "graded"),), solvers=("Curveflow", "Curveflow, auto nodes", "CVODE", "CVODE, exact products"),
    ),
]


def relative_difference(kappa, exact):
    """In L², of curvatures that may stand on different numbers of equidistant nodes: as trigonometric polynomials."""
    nodes = max(kappa.size, exact.size)
    kappa, exact = (np.fft.irfft(np.fft.rfft(k) / k.size, nodes) for k in (kappa, exact))
    return np.linalg.norm(kappa - exact) / np.linalg.norm(exact)


def shape_at(simulation, time):
    """Curvature and length of a simulation that runs on to `time`."""
    simulation.run(until=time)
    state = simulation.state
    return equidistant(state.curvature, state.metric), state.length


def equidistant(kappa, metric):
    """Curvature at equal distances, from nodes with that metric."""
    nodes = kappa.size
    if np.ptp(metric) <= 1e-12 * metric.max():
        return kappa
    # Splines through sixteen times as many values of the trigonometric polynomials of the parameter.
    fine = 16 * nodes
    padded = [np.fft.irfft(np.fft.rfft(values) / nodes, fine) * fine for values in (kappa, metric / metric.mean())]
    slopes = np.fft.rfft(padded[1])
    slopes[1:] /= 2j * np.pi * np.arange(1, slopes.size)
    slopes[0] = 0.0
    shift = np.fft.irfft(slopes, fine)
    s = np.arange(fine + 1) / fine
    reached = s + np.append(shift, shift[0]) - shift[0]
    parameter = CubicSpline(reached, s)(np.arange(8 * nodes) / (8 * nodes))
    return CubicSpline(s, np.append(padded[0], padded[0][0]), bc_type="periodic")(parameter)


def shape_of(state, blocks):
    """Curvature at the nodes, and length, of a spectral state."""
    coefficients = np.ascontiguousarray(state[blocks[0]]).view(complex)
    nodes = 2 * (coefficients.size - 1)
    return np.fft.irfft(coefficients, nodes) * nodes / state[-1], state[-1]


def bounds(system, tolerance):
    """Absolute tolerances in the program's norm of errors: each block against its own size."""
    start = system.initial
    result = np.empty_like(start)
    for block in system.blocks:
        entries = block.stop - block.start
        share = np.sqrt(start.size / (entries * len(system.blocks)))
        result[block] = tolerance * share * np.linalg.norm(start[block]) / np.sqrt(entries)
    return result
