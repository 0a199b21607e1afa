"""How much longer steps may be in the logarithm of the time: what polynomials through past states miss, on computed runs.

    .venv/bin/python benches/stretched_time.py

States at times in the ratio 1.2; the polynomial of degree k through k + 1 of them, in t and in ln t, is held against the next one.
Where the two miss by a and b, a step of order k may be (a/b)^(1/(k + 1)) times as long: geometric means over the run.
"""

import numpy as np

import curveflow as cf

RATIO = 1.2
TOLERANCE = 1e-10
DEGREES = (2, 3, 4, 5)
# Scene, nodes, and the times between which it is looked at.
CASES = (
    ("length_penalty", 256, 1e-7, 1e-2),
    ("incompressible", 256, 1e-7, 1e-2),
    ("figure_eight", 256, 1e-6, 1e-1),
    ("adhesion", 256, 1e-6, 1e-2),
    ("blend", 96, 1e-5, 1.0),
    ("three_fold", 512, 1e-8, 1.0),
    ("three_fold_sharp", 1024, 1e-8, 1e-1),
)


def states(name, nodes, first, last):
    """Times, and the fields at them, each field over its norm."""
    values = {"accuracy.nodes": nodes, "accuracy.tolerance": TOLERANCE, "time.end": 1.01 * last}
    simulation = cf.Simulation(cf.Scene.shipped(name).with_values(values | {"time.stop_at_equilibrium": False}))
    times = first * RATIO ** np.arange(int(np.log(last / first) / np.log(RATIO)))
    rows = []
    for time in times:
        simulation.run(until=time)
        fields = [simulation.state.curvature, *simulation.state.density.values()]
        rows.append(np.concatenate([field / np.linalg.norm(field) for field in fields]))
    return times, np.array(rows)


def missed(points, rows):
    """By how much the polynomial through all but the last of `rows` misses that one."""
    known, last = points[:-1], points[-1]
    weights = [np.prod([(last - q) / (p - q) for q in known if q != p]) for p in known]
    return np.linalg.norm(weights @ rows[:-1] - rows[-1])


def gain(times, rows, degree):
    """How many times as long steps of order `degree` may be in ln t."""
    windows = [slice(i, i + degree + 2) for i in range(len(times) - degree - 1)]
    ratios = [missed(times[w], rows[w]) / missed(np.log(times[w]), rows[w]) for w in windows]
    return np.exp(np.mean(np.log(ratios)) / (degree + 1))


def main():
    print("| scene | times |", " | ".join(f"k = {degree}" for degree in DEGREES), "|")
    print("| --- | --- |", " | ".join("---:" for _ in DEGREES), "|")
    for name, nodes, first, last in CASES:
        times, rows = states(name, nodes, first, last)
        gains = " | ".join(f"{gain(times, rows, degree):.2f}" for degree in DEGREES)
        print(f"| {name} | {first:g} … {last:g} | {gains} |", flush=True)


if __name__ == "__main__":
    main()
