"""What results are given out as: mappings and arrays that nobody can change, and that stay so in copies and pickles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any, NoReturn, TypeVar

import numpy as np

Value = TypeVar("Value")
Key = TypeVar("Key")


def _refuse(_: object, *_arguments: Any, **_keywords: Any) -> NoReturn:
    raise TypeError("this mapping is read-only: change a copy of it, dict(mapping)")


class ReadOnlyDict(dict[Key, Value]):
    """A dict that refuses changes: for pandas, json and everything else that asks for a dict it is one."""

    __slots__ = ()

    __setitem__: Callable[..., NoReturn] = _refuse
    __delitem__: Callable[..., NoReturn] = _refuse
    __ior__: Callable[..., NoReturn] = _refuse
    clear: Callable[..., NoReturn] = _refuse
    pop: Callable[..., NoReturn] = _refuse
    popitem: Callable[..., NoReturn] = _refuse
    setdefault: Callable[..., NoReturn] = _refuse
    update: Callable[..., NoReturn] = _refuse

    def __reduce__(self) -> tuple[object, ...]:
        return _mapping, (dict(self),)


class ReadOnlyArrays:
    """Base of frozen dataclasses whose arrays cannot be written to, neither those of their mappings."""

    __slots__ = ()

    def __reduce__(self) -> tuple[object, ...]:
        values = {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]
        return _object, (type(self), values)


def _locked(value: Value) -> Value:
    """``value``, no longer to be written to if it is an array: NumPy makes copies and pickles that can be."""
    if isinstance(value, np.ndarray):
        value.flags.writeable = False
    return value


def _mapping(values: dict[Key, Value]) -> ReadOnlyDict[Key, Value]:
    return ReadOnlyDict({key: _locked(value) for key, value in values.items()})


def _object(kind: type[Value], values: dict[str, Any]) -> Value:
    return kind(**{name: _locked(value) for name, value in values.items()})
