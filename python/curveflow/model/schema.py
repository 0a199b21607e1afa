"""The JSON Schema of a scene, which holds the defaults of the core."""

from __future__ import annotations

import functools
import json
from typing import Any

from .. import _curveflow


def schema() -> dict[str, Any]:
    """Return the JSON Schema (draft 7) of a scene: every key with its meaning, type, range and default.

    Any validator takes it, and so do editors that know TOML. What needs more than one key to be judged is
    left to :class:`curveflow.Scene`.
    """
    document: dict[str, Any] = json.loads(_curveflow.schema())
    return document


def default(table: str, key: str, shape: str | None = None) -> Any:
    """Return the default of a key.

    Args:
        table: dotted name of its table.
        key: its name there.
        shape: the shape of the curve, for a key of a curve.
    """
    found = _schema()
    for name in table.split("."):
        found = found["properties"][name]
    alternatives = (alternative["properties"] for alternative in found.get("anyOf", [found]))
    tables = [keys for keys in alternatives if key in keys]
    if shape is not None:
        tables = [keys for keys in tables if keys["shape"]["const"] == shape]
    return tables[0][key]["default"]


_schema = functools.cache(schema)
