"""Scenes of objects, between them with every table, every key and every name of a value."""

from collections.abc import Iterator
from dataclasses import fields, replace
from typing import Any, get_args, get_origin, get_type_hints

import numpy as np

import curveflow as cf
from curveflow.model.table import Taken


def choices(table: type, key: str) -> tuple[str, ...]:
    """Return the names that a key of a table may have as its value or in it, by its annotation."""

    def names(annotation: Any) -> tuple[str, ...]:
        inner = get_args(annotation)
        if get_origin(annotation) is Taken:
            inner = inner[:1]  # as it is given
        return tuple(name for arg in inner for name in ((arg,) if isinstance(arg, str) else names(arg)))

    return names(get_type_hints(table)[key])


def fields_of(scene: cf.Scene) -> dict[str, Any]:
    """Return what a scene can be made of again."""
    return {field.name: getattr(scene, field.name) for field in fields(scene) if field.init}


ANGLES = np.linspace(0, 2 * np.pi, 16, endpoint=False)
BASE = cf.Scene(curve=cf.Circle(1.0), energy=[cf.Bending(1.0)], time=cf.Time(1.0))
PROTEIN = cf.Density("protein", "0.5 + 0.1*cos(2*pi*s)", "diffusion")
LIPID = cf.Density("lipid", 0.25, "none")

CURVES = {
    "circle": cf.Circle(radius=2.5),
    "ellipse": cf.Ellipse((2.0, 1.0)),
    "trillium": cf.Trillium(),
    "polar": cf.Polar("1 + 0.35*cos(3*phi)"),
    "polar of two turns": cf.Polar(r="0.5 + cos(phi)", turning_number=2),
    "polar of a number": cf.Polar(1),
    "parametric": cf.Parametric(x="2*cos(phi)", y="sin(phi)"),
    "points": cf.Points(np.stack([np.cos(ANGLES), 2 * np.sin(ANGLES)], axis=1)),
    "figure eight": cf.FigureEight(),
    "large figure eight": cf.FigureEight(size=2.0),
}

ENERGIES: dict[str, cf.model.EnergyTerm] = {
    "bending": cf.Bending(rigidity=0.5),
    "bending towards a number": cf.Bending(1, 0.25),
    "bending by a density": cf.Bending(1.0, preferred_curvature="0.5*rho", density="lipid"),
    "regularization": cf.Regularization(0.2),
    "tension": cf.Length(tension=-0.1),
    "length": cf.Length(penalty=3.0, target=6.3),
    "relative length": cf.Length(penalty=3.0, target_ratio=1.8),
    "pressure": cf.Area(pressure=1.0),
    "area": cf.Area(penalty=10.0, target=-0.5),
    "relative area": cf.Area(penalty=10.0, target_ratio=0.5),
    "adhesion": cf.Adhesion("10*(1 - q/0.25)*exp(-q/0.25)"),
    "adhesion with a cut-off": cf.Adhesion("exp(-q)", cutoff=2.0),
    "agents": cf.Agents(
        density="protein",
        epsilon=0.05,
        delta=0.2,
        preferred_curvature="1.3 - 2*rho",
        low_density=0.1,
        high_density="0.8 + 0.1*exp(-kappa^2)",
    ),
    "membrane": cf.Membrane(density="lipid", epsilon=0.01),
    "packing": cf.Packing(matrix=np.array([[1.0, 0.1], [0.1, 1.0]]), epsilon=0.1),
    "local": cf.Local("0.02*(protein_sigma^2 + lipid_sigma^2) + kappa^4"),
}

FLOWS = {
    "graded": cf.Flow(gauge="graded", grading="1 + 0.6*cos(4*pi*s)"),
    "contact": cf.Flow(stop_on_contact=True),
    "switch": cf.Flow(
        switch=[
            cf.Switch(time=0.0, gauge="graded", grading=1),
            cf.Switch(time=np.float32(0.5), gauge="scaled-arc-length"),
        ]
    ),
    **{name: cf.Flow(normal_mobility=name) for name in choices(cf.Flow, "normal_mobility")},
}

TIMES = {
    "end": cf.Time(end=2),
    "every key": cf.Time(1e-3, stop_at_equilibrium=False, equilibrium_tolerance=1e-6, max_steps=10**12),
}

ACCURACIES = {
    "every key": cf.Accuracy(tolerance=1e-7, nodes=128, derivative="central-4", linear_solver="dense"),
    **{name: cf.Accuracy(derivative=name) for name in choices(cf.Accuracy, "derivative")},
    **{name: cf.Accuracy(linear_solver=name) for name in choices(cf.Accuracy, "linear_solver")},
}

OUTPUTS = {
    "spaced": cf.Output(frames=7, spacing="log"),
    "times": cf.Output(times=np.linspace(0.0, 1.0, 5)),
    "fields": cf.Output(fields=choices(cf.Output, "fields")),
}

DENSITIES = {
    "weight": replace(PROTEIN, weight="1 + 0.5*s"),
    **{name: cf.Density("protein", np.float64(0.1), name) for name in choices(cf.Density, "mobility")},
}


def family() -> Iterator[tuple[str, cf.Scene]]:
    """Yield every object above in a scene that is otherwise small, by name."""
    for name, curve in CURVES.items():
        yield f"curve: {name}", replace(BASE, curve=curve, title=f'A "{name}" κ\n\t\\')
    for name, term in ENERGIES.items():
        yield f"energy: {name}", replace(BASE, energy=[term], density=[PROTEIN, LIPID])
    yield "energy: many", replace(
        BASE, energy=[ENERGIES[name] for name in ("local", "length", "area", "bending")], density=[PROTEIN, LIPID]
    )
    for key, objects in (("flow", FLOWS), ("time", TIMES), ("accuracy", ACCURACIES), ("output", OUTPUTS)):
        for name, table in objects.items():
            yield f"{key}: {name}", replace(BASE, **{key: table})
    for name, density in DENSITIES.items():
        yield f"density: {name}", replace(BASE, density=[density])


FAMILY = dict(family()) | {f"shipped: {name}": cf.Scene.shipped(name) for name in cf.scenes()}
