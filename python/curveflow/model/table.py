"""What all tables of a scene have in common."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import fields
from decimal import Decimal
from numbers import Real
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Formula: TypeAlias = float | str
"""A number, or an expression: + - * / ^, parentheses, pi, exp, ln, sqrt, sin, cos, tan, sinh, cosh, tanh, abs."""

Numbers: TypeAlias = Sequence[float] | NDArray[Any]
"""Numbers in order; kept as a tuple."""

Rows: TypeAlias = Sequence[Sequence[float]] | NDArray[Any]
"""Rows of numbers; kept as a tuple of tuples."""


class Table:
    """A table of a scene: a frozen dataclass whose values can be written as TOML."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type] # every table is a dataclass
            object.__setattr__(self, field.name, _plain(getattr(self, field.name)))


def python_number(value: Any) -> Any:
    """Return a number or an array as Python's own: longer ones, fractions and decimals as floats; another value as it is."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, Real | Decimal) and not isinstance(value, int | float):
        value = float(value)
    return value


def _plain(value: Any) -> Any:
    """Return a value without NumPy and without lists, so that it can be compared and hashed."""
    value = python_number(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, list | tuple):
        return tuple(_plain(item) for item in value)
    return value
