"""The tables of a scene as objects: the same names as in a scene file, each value frozen.

Numbers may be given as NumPy scalars, lists as NumPy arrays, expressions as texts or numbers; they are kept as plain
numbers, tuples and texts. What is left out has the default of the core, which also does all checking, once a
:class:`curveflow.Scene` is made: until then an object holds whatever it was given.
"""

from .accuracy import Accuracy
from .curve import Circle, Curve, Ellipse, FigureEight, Parametric, Points, Polar, Trillium
from .density import Density
from .energy import (
    Adhesion,
    Agents,
    Area,
    Bending,
    EnergyTerm,
    Length,
    Local,
    Membrane,
    Packing,
    Regularization,
)
from .flow import Flow, Switch
from .output import Output
from .schema import schema
from .time import Time

__all__ = [
    "Accuracy",
    "Adhesion",
    "Agents",
    "Area",
    "Bending",
    "Circle",
    "Curve",
    "Density",
    "Ellipse",
    "EnergyTerm",
    "FigureEight",
    "Flow",
    "Length",
    "Local",
    "Membrane",
    "Output",
    "Packing",
    "Parametric",
    "Points",
    "Polar",
    "Regularization",
    "Switch",
    "Time",
    "Trillium",
    "schema",
]
