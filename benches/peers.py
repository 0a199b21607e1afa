"""Curveflow and SUNDIALS' CVODE on the same system, in Markdown.

    .venv/bin/pip install "scikit-sundae>=1.2"
    .venv/bin/python benches/peers.py

CVODE (BDF, order 1-5, GMRES) gets the right-hand side, the exact Jacobian products and the Fourier-symbol preconditioner
of this crate, and tolerances in the same norm. Its time counts what is spent inside these functions only, not its own
vector operations and not the calls through Python: a lower bound of what it takes.
"""

import time

import curveflow as cf
import numpy as np
from sksundae.cvode import CVODE, CVODEJacTimes, CVODEPrecond

CASES = [("length_penalty", 256, [0.01]), ("three_fold", 512, [0.1, 100.0]), ("three_fold_sharp", 1024, [0.1, 100.0])]
TOLERANCES = [1e-3, 1e-5]
REFERENCE = 1e-10
REPEATS = 3
MOST_SECONDS = 20.0


class Timed:
    """Counts the calls of functions and the time inside them."""

    def __init__(self):
        self.seconds, self.calls = 0.0, {}

    def __call__(self, name, function, *arguments):
        start = time.perf_counter()
        result = function(*arguments)
        self.seconds += time.perf_counter() - start
        self.calls[name] = self.calls.get(name, 0) + 1
        return result


def cvode(scene, end, tolerance, exact_products):
    """End state, time inside the functions, and their calls."""
    system, timed = cf.System(scene.with_values({"accuracy.linear_solver": "fourier"})), Timed()
    start = system.initial.copy()
    bounds = np.empty_like(start)
    for block in system.blocks:  # the error norm of the run: each block against its own size
        entries = block.stop - block.start
        share = np.sqrt(start.size / (entries * len(system.blocks)))
        bounds[block] = tolerance * share * np.linalg.norm(start[block]) / np.sqrt(entries)

    def rate(t, y, out):
        timed("right-hand sides", system.rate, y, out)

    def prepare(t, y, rate_at_y, usable, renewed, gamma):
        renewed[0] = 0 if usable else 1
        if not usable:
            timed("linearisations", system.linearise, y, scratch)
        timed("factorisations", system.factorise, gamma)

    def solve(t, y, rate_at_y, r, z, gamma, delta, side):
        z[:] = r
        timed("solves", system.precondition, z)

    def product(t, y, rate_at_y, v, out):
        timed("products", system.jacobian_product, v, out)

    def freeze(t, y, rate_at_y):
        timed("linearisations", system.linearise, y, scratch)

    scratch = np.empty_like(start)
    extra = {"jactimes": CVODEJacTimes(freeze, product)} if exact_products else {}
    preconditioner = CVODEPrecond(prepare, solve, "left")
    solver = CVODE(rate, method="BDF", rtol=1e-15, atol=bounds, linsolver="gmres", krylov_dim=20,
                   precond=preconditioner, max_num_steps=1_000_000, **extra)
    solved = solver.solve(np.array([0.0, end]), start)
    return solved.y[-1], timed.seconds, timed.calls, system.blocks


def curveflow(scene, end, tolerance):
    """Final frame, time of integration, and counters."""
    result = cf.run(scene.with_values({"accuracy.tolerance": tolerance}))
    return result, result.stats["integration_seconds"], result.stats


def curvature(state, blocks):
    """Curvature at the nodes, and length, of a spectral state."""
    coefficients = state[blocks[0]].view(complex)
    nodes = 2 * (coefficients.size - 1)
    return np.fft.irfft(coefficients, nodes) * nodes / state[-1], state[-1]


def error(kappa, length, exact):
    return np.linalg.norm(kappa - exact[0]) / np.linalg.norm(exact[0]), abs(length / exact[1] - 1)


def best(run):
    """The fastest of some repeats."""
    runs, start = [run()], time.perf_counter()
    while len(runs) < REPEATS and time.perf_counter() - start < MOST_SECONDS:
        runs.append(run())
    return min(runs, key=lambda one: one[1])


def main():
    for name, nodes, ends in CASES:
        for end in ends:
            fixed = {"accuracy.nodes": nodes, "time.end": end, "output.frames": 1}
            scene = cf.Scene.shipped(name).with_values(fixed)
            compare = end < 1.0  # late states creep: their errors say little
            reference, *_ = curveflow(scene, end, REFERENCE) if compare else (None,)
            exact = (reference.curvature[-1], reference.length[-1]) if compare else None
            print(f"\n### {name}, N = {nodes}, to t = {end}\n")
            print("| | tolerance | ms | right-hand sides | products | solves | κ error | L error |")
            print("| --- | --- | ---: | ---: | ---: | ---: | --- | --- |")
            for tolerance in TOLERANCES:
                result, seconds, stats = best(lambda: curveflow(scene, end, tolerance))
                errors = error(result.curvature[-1], result.length[-1], exact) if compare else None
                counts = [stats[key] for key in ("right_hand_sides", "jacobian_products", "solves")]
                line("Curveflow", tolerance, seconds, counts, errors)
                for exact_products in (False, True):
                    state, seconds, calls, blocks = best(lambda: cvode(scene, end, tolerance, exact_products))
                    errors = error(*curvature(state, blocks), exact) if compare else None
                    counts = [calls.get(key, 0) for key in ("right-hand sides", "products", "solves")]
                    line("CVODE, exact products" if exact_products else "CVODE", tolerance, seconds, counts, errors)


def line(who, tolerance, seconds, counts, errors):
    shown = [f"{value:.0e}" for value in errors] if errors else ["", ""]
    cells = [who, f"{tolerance:.0e}", f"{1e3 * seconds:.3g}", *map(str, counts), *shown]
    print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
