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
from .result import Result, open
from .running import Progress, run
from .scene import Scene, scenes
from .system import System

__all__ = [
    "BugError",
    "CurveflowError",
    "LadderError",
    "Progress",
    "Reference",
    "Result",
    "Scene",
    "SceneError",
    "Setting",
    "SetupError",
    "StorageError",
    "System",
    "Tradeoff",
    "TradeoffError",
    "open",
    "run",
    "scenes",
    "tradeoff",
]

__version__ = _version("curveflow")
