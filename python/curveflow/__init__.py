"""Gradient flows of energies of closed planar curves that carry embedded densities.

>>> import curveflow as cf
>>> result = cf.run(cf.Scene.shipped("circle"))
>>> result.success
True
"""

from importlib.metadata import version as _version

from .errors import BugError, CurveflowError, SceneError, SetupError, StorageError
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
    "Length",
    "Local",
    "Membrane",
    "Output",
    "Packing",
    "Parametric",
    "Points",
    "Polar",
    "Progress",
    "Regularization",
    "Result",
    "Scene",
    "SceneError",
    "SetupError",
    "Simulation",
    "State",
    "StorageError",
    "Switch",
    "System",
    "Time",
    "Trillium",
    "open",
    "run",
    "scenes",
    "schema",
]

__version__ = _version("curveflow")
