"""A checked scene as objects."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .accuracy import Accuracy
from .curve import CURVES, Curve
from .density import Density
from .energy import TERMS
from .flow import Flow, Switch
from .output import Output
from .time import Time


def objects(resolved: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a scene, from the scene as the core has understood it."""
    terms = resolved["energy"]
    return {
        "title": resolved["title"],
        "curve": _curve(**resolved["curve"]),
        "density": tuple(Density(**keys) for keys in resolved.get("density", ())),
        "energy": tuple(term(**terms[term.name]) for term in TERMS if term.name in terms),
        "flow": _flow(**resolved["flow"]),
        "time": Time(**resolved["time"]),
        "accuracy": Accuracy(**resolved["accuracy"]),
        "output": Output(**resolved["output"]),
    }


def _curve(shape: str, **keys: Any) -> Curve:
    (curve,) = (curve for curve in CURVES if curve.shape == shape)
    return curve(**keys)


def _flow(switch: Sequence[Mapping[str, Any]] = (), **keys: Any) -> Flow:
    return Flow(switch=tuple(Switch(**change) for change in switch), **keys)
