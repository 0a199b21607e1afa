"""Gradient flows of energies of closed planar curves that carry embedded densities.

>>> import curveflow as cf
>>> result = cf.run(cf.Scene.shipped("circle"))
>>> result.success
True
"""

from ._curveflow import VERSION as _VERSION
from .errors import (
    ArrayError,
    BugError,
    CurveflowError,
    LadderError,
    MissingExtraError,
    SceneError,
    SetupError,
    StorageError,
    TradeoffError,
)
from .ladder import Reference, Setting, Tradeoff, tradeoff
from .model import (
    Accuracy,
    Adhesion,
    Agents,
    Area,
    Bending,
    Circle,
    Density,
    Ellipse,
    FigureEight,
    Flow,
    Length,
    Local,
    Membrane,
    Output,
    Packing,
    Parametric,
    Points,
    Polar,
    Regularization,
    Switch,
    Time,
    Trillium,
    schema,
)
from .operators import (
    Geometry,
    Rates,
    energy,
    flow_map,
    geometry,
    helmholtz,
    incompressibility,
    normal_force,
)
from .provenance import Provenance
from .result import Result, open
from .running import Progress, run
from .scene import Scene, scenes
from .simulation import Simulation
from .state import State
from .system import System
from .why_slow import WhySlow

__all__ = [
    "Accuracy",
    "Adhesion",
    "Agents",
    "Area",
    "ArrayError",
    "Bending",
    "BugError",
    "Circle",
    "CurveflowError",
    "Density",
    "Ellipse",
    "FigureEight",
    "Flow",
    "Geometry",
    "LadderError",
    "Length",
    "Local",
    "Membrane",
    "MissingExtraError",
    "Output",
    "Packing",
    "Parametric",
    "Points",
    "Polar",
    "Progress",
    "Provenance",
    "Rates",
    "Reference",
    "Regularization",
    "Result",
    "Scene",
    "SceneError",
    "Setting",
    "SetupError",
    "Simulation",
    "State",
    "StorageError",
    "Switch",
    "System",
    "Time",
    "Tradeoff",
    "TradeoffError",
    "Trillium",
    "WhySlow",
    "energy",
    "flow_map",
    "geometry",
    "helmholtz",
    "incompressibility",
    "normal_force",
    "open",
    "run",
    "scenes",
    "schema",
    "tradeoff",
]

__version__ = _VERSION
