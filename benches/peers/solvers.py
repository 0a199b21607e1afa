"""Curveflow and its peers, each integrating a case at a tolerance."""

import json
import subprocess
from functools import partial
from pathlib import Path

import curveflow as cf
import numpy as np
import scipy.integrate
from cases import Run, bounds, shape_at, shape_of
from clock import Clock, OutOfTime
from sksundae.cvode import CVODE, CVODEJacTimes, CVODEPrecond

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "target" / "release"
MOST_STEPS = 10_000_000
REPEATED = 0.2  # seconds of runs of which the mean is taken, as in the program `rival`


def integrate(name, case, tolerance, limit):
    """One run of a solver, by its name; given up after `limit` seconds of processor time."""
    run, clock = Run(), Clock(limit)
    try:
        SOLVERS[name](case, tolerance, clock, run)
    except OutOfTime:
        run.failure = f"more than {limit:g} s"
    except SolverFailed as failure:
        run.failure = f"failed: {failure}"
    run.counts = run.counts or clock.calls
    return run


class SolverFailed(Exception):
    """A solver gave up."""


def curveflow(case, tolerance, clock, run, own_nodes=False):
    """The integration, with energy law, closure, balance and log; without the building of the system.

    Each time from a run of its own, repeated while it is short, as those of the rival are: a single run of a tenth of a
    millisecond would be a measurement of cold caches.
    """
    run.own_nodes = own_nodes
    nodes = {"accuracy.nodes": "auto", **dict(case.own)} if own_nodes else {}
    scene = case.scene({"accuracy.tolerance": tolerance, **nodes})
    for time in case.times:
        seconds = []
        while sum(seconds) < REPEATED:
            simulation = cf.Simulation(scene)
            start = clock.whole()
            simulation.run(until=time)
            seconds.append(clock.whole() - start)
        run.seconds.append(sum(seconds) / len(seconds))
        run.shapes.append(shape_at(simulation, time))
    stats = simulation.result().stats
    run.counts = {name: stats[key] for name, key in CURVEFLOW_COUNTS.items()}


CURVEFLOW_COUNTS = {
    "steps": "steps", "right-hand sides": "right_hand_sides", "products": "jacobian_products", "solves": "solves",
}


def system_of(case):
    return cf.System(case.scene({"accuracy.linear_solver": "fourier"}))


def cvode(case, tolerance, clock, run, exact_products):
    """CVODE: BDF of order 1 to 5, GMRES, this program's Fourier preconditioner; its time is that inside our functions."""
    system = system_of(case)
    scratch = np.empty_like(system.initial)

    def rate(t, y, out):
        clock.check()
        clock("right-hand sides", system.rate, y, out)

    def prepare(t, y, rate_at_y, usable, renewed, gamma):
        renewed[0] = 0 if usable else 1
        if not usable:
            clock("linearisations", system.linearise, y, scratch)
        clock("factorisations", system.factorise, gamma)

    def solve(t, y, rate_at_y, r, z, gamma, delta, side):
        z[:] = r
        clock("solves", system.precondition, z)

    def product(t, y, rate_at_y, v, out):
        clock("products", system.jacobian_product, v, out)

    def freeze(t, y, rate_at_y):
        clock("linearisations", system.linearise, y, scratch)

    clock.restart()
    extra = {"jactimes": CVODEJacTimes(freeze, product)} if exact_products else {}
    solver = CVODE(rate, method="BDF", rtol=1e-15, atol=bounds(system, tolerance), linsolver="gmres", krylov_dim=20,
                   precond=CVODEPrecond(prepare, solve, "left"), max_num_steps=MOST_STEPS, **extra)
    solver.init_step(0.0, system.initial.copy())
    for time in case.times:
        solved = solver.step(time)
        if not solved.success:
            raise SolverFailed(solved.message)
        run.seconds.append(clock.inside)
        run.whole_seconds.append(clock.whole())
        run.shapes.append(shape_of(solved.y, system.blocks))


def scipy_solver(name, case, tolerance, clock, run):
    """SciPy's solver of that name with J as a matrix, each column one product: the time of the whole call."""
    system = system_of(case)
    units = np.eye(system.initial.size)

    def rate(t, y):
        clock.check()
        clock.count("right-hand sides")
        return system.rate(y)

    def matrix(t, y):
        clock.check()
        system.linearise(y)
        clock.count("products", len(units))
        return np.array([system.jacobian_product(unit) for unit in units]).T

    method, end = getattr(scipy.integrate, name), case.times[-1]
    clock.restart()
    # LSODA starts with a method that is not stiff, and finds no first step by itself.
    extra = {"first_step": 1e-12 * end} if name == "LSODA" else {}
    solver = method(rate, 0.0, system.initial.copy(), end, rtol=3e-14, atol=bounds(system, tolerance), jac=matrix, **extra)
    for time in case.times:
        while solver.t < time:
            message = solver.step()
            clock.count("steps")
            if solver.status == "failed":
                clock.check()  # LSODA turns what its functions raise into a failure of its own
                raise SolverFailed(f"{message} (t = {solver.t:.1e})")
        run.seconds.append(clock.whole())
        run.shapes.append(shape_of(solver.dense_output()(time), system.blocks))


def program(path, leading, case, tolerance, clock, run):
    """A solver in a program of its own, which measures itself: the time of the whole solve."""
    if not path.exists():
        raise FileNotFoundError(f"{path}: build it with the commands in benches/README.md")
    arguments = [*leading, case.name, case.nodes, tolerance, clock.limit, *case.times]
    finished = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True)
    if finished.returncode != 0:
        raise SolverFailed(finished.stderr.strip())
    report, blocks = json.loads(finished.stdout), system_of(case).blocks
    run.seconds = report["seconds"]
    run.shapes = [shape_of(np.array(state), blocks) for state in report["states"]]
    if "reached" in report:
        raise OutOfTime
    run.counts = report["counts"]


SOLVERS = {
    "Curveflow": curveflow,
    "Curveflow, auto nodes": partial(curveflow, own_nodes=True),
    "CVODE": partial(cvode, exact_products=False),
    "CVODE, exact products": partial(cvode, exact_products=True),
    "SciPy BDF": partial(scipy_solver, "BDF"),
    "SciPy Radau": partial(scipy_solver, "Radau"),
    "SciPy LSODA": partial(scipy_solver, "LSODA"),
    "diffsol BDF": partial(program, PROGRAMS / "curveflow-diffsol", []),
    "ETDRK4(3)": partial(program, PROGRAMS / "rival", ["ETDRK4(3)"]),
}
