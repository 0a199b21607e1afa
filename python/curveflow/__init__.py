"""Gradient flows of energies of closed planar curves that carry embedded densities.

>>> import curveflow as cf
>>> result = cf.run(cf.Scene.shipped("circle"))
>>> result.success
True
"""

from importlib.metadata import version as _version

from .errors import (
    BugError,
    CurveflowError,
    LadderError,
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
from .result import Result, open
from .running import Progress, run
from .scene import Scene, scenes
from .simulation import Simulation, State
from .system import System
from .why_slow import WhySlow

__all__ = [
    "Accuracy",
    "Adhesion",
    "Agents",
    "Area",
    "Bending",
    "BugError",
    "Circle",
    "CurveflowError",
    "Density",
    "Ellipse",
    "FigureEight",
    "Flow",
    "LadderError",
    "Length",
    "Local",
    "Membrane",
    "Output",
    "Packing",
    "Parametric",
    "Points",
    "Polar",
    "Progress",
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
    "open",
    "run",
    "scenes",
    "schema",
    "tradeoff",
]

__version__ = _version("curveflow")
