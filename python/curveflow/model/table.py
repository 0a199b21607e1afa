"""What all tables of a scene have in common."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import fields
from decimal import Decimal
from numbers import Real
from operator import index
from typing import Any, Generic, Literal, SupportsIndex, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Formula: TypeAlias = float | str
"""A number, or an expression: + - * / ^, parentheses, pi, exp, ln, sqrt, sin, cos, tan, sinh, cosh, tanh, abs."""

Numbers: TypeAlias = Sequence[float] | NDArray[Any]
"""Numbers in order; kept as a tuple."""

Rows: TypeAlias = Sequence[Sequence[float]] | NDArray[Any]
"""Rows of numbers; kept as a tuple of tuples."""

Given = TypeVar("Given", contravariant=True)
Kept = TypeVar("Kept", covariant=True)


class Taken(Generic[Given, Kept]):
    """The type of a value that is given as one thing and kept as another.

    No value is one: to type checkers a field of a dataclass takes what ``__set__`` takes, and is what ``__get__`` returns.
    """

    def __get__(self, table: object, owner: type | None = None) -> Kept:
        """Return what is kept."""
        raise NotImplementedError

    def __set__(self, table: object, value: Given) -> None:
        """Take what is given."""
        raise NotImplementedError


Count: TypeAlias = Taken[SupportsIndex, int]
"""An integer, those of NumPy too; kept as an ``int``."""

CountOrNone: TypeAlias = Taken[SupportsIndex | None, int | None]
"""The same, or nothing."""

CountOrAuto: TypeAlias = Taken[SupportsIndex | Literal["auto"], int | Literal["auto"]]
"""The same, or a choice left to the program."""

ABSENT: Any = None
"""No value, of any type."""


class Table:
    """A table of a scene: a frozen dataclass whose values can be written as TOML."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type] # every table is a dataclass
            object.__setattr__(self, field.name, _plain(getattr(self, field.name)))


def python_number(value: Any) -> Any:
    """Return a number or an array as Python's own: integers of any kind as such, longer floats, fractions and decimals as floats;
    another value as it is."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, SupportsIndex) and not isinstance(value, int):
        value = index(value)
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
