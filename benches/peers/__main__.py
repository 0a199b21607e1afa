"""Curveflow and its peers on the same systems: time at equal measured error.

    .venv/bin/pip install "scikit-sundae>=1.2" "scipy>=1.11"
    OPENBLAS_NUM_THREADS=1 .venv/bin/python benches/peers

Measures the scenes named (all by default), keeps the figures in a file, and writes the tables of all scenes in that file into
benches/README.md.
"""

import argparse
import json
import statistics
import sys
from pathlib import Path

from cases import CASES
from solvers import ROOT, SOLVERS, integrate
from tables import SUNDIALS, WHOLE, case_table, summary

COLUMNS = [name for solver in SOLVERS for name in ([solver, WHOLE] if solver == SUNDIALS else [solver])]
TOLERANCES = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8]
REPEATS = 3
README = ROOT / "benches" / "README.md"


def main():
    parser = argparse.ArgumentParser(prog="peers", description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", help="shipped scenes (default: all)")
    parser.add_argument("--only", nargs="+", default=list(SOLVERS), choices=list(SOLVERS), help="measure these alone")
    parser.add_argument("--tables", action="store_true", help="measure nothing, write the tables of the figures kept")
    parser.add_argument("--limit", type=float, default=60.0, help="processor seconds after which a run is given up")
    parser.add_argument("--figures", type=Path, default=ROOT / "out" / "peers.json", help="where the figures are kept")
    options = parser.parse_args()
    figures = json.loads(options.figures.read_text()) if options.figures.exists() else {}
    options.figures.parent.mkdir(exist_ok=True)
    for case in CASES:
        if not options.tables and (not options.scenes or case.label in options.scenes):
            measured = measure(case, options.only, options.limit)
            kept = figures.get(case.label, {"runs": []})["runs"]
            measured["runs"] += [run for run in kept if run["solver"] not in options.only]
            measured["runs"].sort(key=lambda run: list(SOLVERS).index(run["solver"]))
            figures[case.label] = measured
            options.figures.write_text(json.dumps(figures))
            print(case_table(figures[case.label]), flush=True)
    results = [figures[case.label] for case in CASES if case.label in figures]
    tables = summary(results, COLUMNS) + "".join(case_table(one) for one in results)
    README.write_text(replaced(README.read_text(), tables))


def measure(case, solvers, limit):
    """All runs of a case; a tighter tolerance is not tried once a looser one has not come to the first time."""
    runs = []
    for name in filter(case.tries, solvers):
        for tolerance in TOLERANCES:
            run = described(name, tolerance, case, median(lambda: integrate(name, case, tolerance, limit), limit))
            print(f"{case.label}: {name} at {tolerance:.0e}: {run['seconds']} {run['failure'] or ''}", file=sys.stderr)
            runs.append(run)
            if not run["seconds"]:
                break
    return {"scene": case.label, "nodes": case.nodes, "times": case.times, "limit": limit, "runs": runs}


def median(solve, limit):
    """The last of some repeats, with the median of their times; runs that take a tenth of the limit are not repeated."""
    runs = [solve()]
    while len(runs) < REPEATS and not runs[0].failure and runs[0].seconds[-1] < 0.1 * limit:
        runs.append(solve())
    last = runs[-1]
    last.seconds = [statistics.median(each) for each in zip(*(run.seconds for run in runs))]
    last.whole_seconds = [statistics.median(each) for each in zip(*(run.whole_seconds for run in runs))]
    return last


def described(name, tolerance, case, run):
    return {
        "solver": name, "tolerance": tolerance, "seconds": run.seconds, "errors": case.errors(run),
        "counts": run.counts, "whole_seconds": run.whole_seconds, "failure": run.failure,
    }


def replaced(document, tables):
    """The document with the text between the markers `peers` replaced."""
    begin, end = "<!-- peers: begin -->", "<!-- peers: end -->"
    before, rest = document.split(begin)
    return f"{before}{begin}\n\n{tables}\n{end}{rest.split(end)[1]}"


if __name__ == "__main__":
    main()
