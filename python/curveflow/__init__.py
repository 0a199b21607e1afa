"""Gradient flows of energies of closed planar curves that carry embedded densities.

>>> import curveflow as cf
>>> result = cf.run(cf.Scene.shipped("circle"))
>>> result.success
True
"""

from importlib.metadata import version as _version

from .errors import BugError, CurveflowError, SceneError, SetupError, StorageError
from .result import Result, open
from .running import Progress, run
from .scene import Scene, scenes
from .simulation import Simulation, State
from .system import System

__all__ = [
    "BugError",
    "CurveflowError",
    "Progress",
    "Result",
    "Scene",
    "SceneError",
    "SetupError",
    "Simulation",
    "State",
    "StorageError",
    "System",
    "open",
    "run",
    "scenes",
]

__version__ = _version("curveflow")
