"""The measurements as Markdown."""

import math

SUNDIALS = "CVODE"
WHOLE = f"{SUNDIALS}, whole call"
LEVELS = [1e-3, 1e-5, 1e-7]  # errors at which times are compared
LISTED = [1e-3, 1e-5, 1e-7]  # tolerances of which the runs are listed
REFERENCE = "Curveflow"
COUNTS = ["steps", "right-hand sides", "products", "solves"]


def case_table(measured):
    """The runs of one scene at the tolerances `LISTED`."""
    times, nodes = measured["times"], measured["nodes"]
    text = f"\n### {measured['scene']}, N = {nodes}, to t = {times[-1]:g}\n\n"
    text += "| | tolerance |" + "".join(f" ms to t = {time:g} | κ, L error there |" for time in times)
    text += " whole call to the end, ms | " + " | ".join(COUNTS) + " |\n"
    text += "| --- | --- |" + " ---: | --- |" * len(times) + " ---: |" * (1 + len(COUNTS)) + "\n"
    for run in measured["runs"]:
        if run["tolerance"] in LISTED:
            text += run_line(run, len(times))
    return text


def run_line(run, times):
    cells = [run["solver"], f"{run['tolerance']:.0e}"]
    for index in range(times):
        if index < len(run["seconds"]):
            cells += [milliseconds(run["seconds"][index]), ", ".join(f"{error:.0e}" for error in run["errors"][index])]
        else:
            cells += [run["failure"] if index == len(run["seconds"]) else "", ""]
    whole = run["whole_seconds"]
    cells += [milliseconds(whole[-1]) if whole else ""]
    cells += [str(run["counts"].get(name, "")) for name in COUNTS]
    return "| " + " | ".join(cells) + " |\n"


def summary(results, solvers):
    """Time at equal error of each solver, and how far the best peer is behind."""
    text = "| scene | t | error | " + " | ".join(solvers) + " | best peer / Curveflow |\n"
    text += "| --- | ---: | ---: |" + " ---: |" * (len(solvers) + 1) + "\n"
    for measured in results:
        for index, time in enumerate(measured["times"]):
            for level in LEVELS:
                text += summary_line(measured, index, time, level, solvers)
    return text


def summary_line(measured, index, time, level, solvers):
    found = {solver: time_at(measured, solver, index, level) for solver in solvers}
    base = found[REFERENCE]
    cells = [measured["scene"], f"{time:g}", f"{level:.0e}"]
    cells += [shown(found[solver], base if solver != REFERENCE else None) for solver in solvers]
    return "| " + " | ".join(cells) + f" | {lead(measured, index, level)} |\n"


def lead(measured, index, level):
    """The whole call of the best peer over the better of both runs of Curveflow: on fixed nodes, and on its own."""
    own, peers = [], []
    for solver in dict.fromkeys(run["solver"] for run in measured["runs"]):
        key = "whole_seconds" if solver.startswith(SUNDIALS) else "seconds"
        found = time_at(measured, solver, index, level, key)
        if found:
            (own if solver.startswith(REFERENCE) else peers).append(found[0])
    if not own:
        return "not reached"
    if not peers:
        return "no peer there"
    ratio = significant(min(peers) / min(own), 2)
    return f"**{ratio}**" if float(ratio) < 3 else ratio


def shown(found, base):
    if found is None:
        return "–"
    seconds, bound = found
    ratio = f" ({significant(seconds / base[0], 2)})" if base else ""
    return f"{'≤ ' if bound else ''}{milliseconds(seconds)}{ratio}"


def time_at(measured, solver, index, level, key="seconds"):
    """Seconds at which the larger of both errors is `level`, on a straight line in logarithms between two tolerances.

    The second value tells that the loosest tolerance was better already: a bound. None if `level` was not reached.
    """
    if solver == WHOLE:
        solver, key = SUNDIALS, "whole_seconds"
    points = [(run[key][index], max(max(run["errors"][index]), 1e-16))
              for run in measured["runs"] if run["solver"] == solver and index < len(run[key])]
    if points and points[0][1] <= level:
        return points[0][0], True
    for (seconds, error), (next_seconds, next_error) in zip(points, points[1:]):
        if next_error <= level:
            share = math.log(error / level) / math.log(error / next_error)
            return math.exp((1 - share) * math.log(seconds) + share * math.log(next_seconds)), False
    return None


def milliseconds(seconds):
    return significant(1e3 * seconds, 3)


def significant(value, digits):
    """With so many digits, and never with an exponent."""
    return f"{value:.{digits}g}" if value < 10**digits else f"{value:.0f}"
