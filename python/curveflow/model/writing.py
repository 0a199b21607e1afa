"""Objects as TOML."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from typing import Any, TypeVar

from ..errors import SceneError
from .density import Density
from .energy import TERMS, EnergyTerm
from .table import Table, python_number

T = TypeVar("T", bound=Table)


def value(key: str, given: object) -> str:
    """Write the value of a key.

    Raises:
        SceneError: a text has half a character.
        TypeError: there is no such value in TOML.
    """
    given = python_number(given)
    if isinstance(given, str):
        check_characters(key, given)
    if isinstance(given, bool | int | str):
        return json.dumps(given, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(given, float):
        return repr(given)
    if isinstance(given, list | tuple):
        return "[" + ", ".join(value(key, item) for item in given) + "]"
    if isinstance(given, Table):
        return "{ " + ", ".join(_lines(key, given)) + " }"
    if _is_function(given):
        raise TypeError(
            f"{key}: a function cannot be differentiated; write its expression as text, for example \"kappa^2\""
        )
    raise TypeError(f"{key}: {_described(given)} is not a number, text, truth value, table of a scene or list of these")


def check_characters(key: str, text: str) -> None:
    """Refuse what no file can hold: surrogates that stand alone, as in names of files that are not UTF-8.

    Raises:
        SceneError: there is one.
    """
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise half_character(key, error) from None


def half_character(key: str, error: UnicodeEncodeError) -> SceneError:
    """Return what to raise where a text has a surrogate that stands alone."""
    shown = key.encode(errors="backslashreplace").decode()
    half = ascii(error.object[error.start])
    return SceneError(f"scene, {shown}\n  {half} is half a character, which no text can hold; remove it")


def changes(values: Mapping[str, object], table: str = "") -> Iterator[tuple[str, str]]:
    """Write the values of dotted keys, those of nested tables too; nothing for one that is to be removed.

    Raises:
        TypeError: the values are no mapping, a key is no text, or there is no such value in TOML.
    """
    if not isinstance(values, Mapping):
        raise TypeError(f'values is {values!r:.60}, but it must map keys to values: {{"accuracy.tolerance": 1e-4}}')
    for name, given in values.items():
        if not isinstance(name, str):
            raise TypeError(f'the key {name!r:.60} is no text; write keys like "accuracy.tolerance"')
        check_characters(name, name)
        key = table + name
        if isinstance(given, Mapping):
            yield from changes(given, f"{key}.")
        else:
            yield key, "" if given is None else value(key, given)


def table(name: str, given: object, *kinds: type[Table]) -> str:
    """Write a table, of one of the kinds, under its name.

    Raises:
        TypeError: the object is of another kind.
    """
    return "\n".join([f"[{name}]", *_lines(name, _checked(name, given, kinds)), ""])


def density_tables(given: Iterable[Density]) -> str:
    """Write the tables of densities, in order."""
    densities = _listed("density", given, (Density,))
    tables = (_lines(f"density.{index}", density) for index, density in enumerate(densities))
    return "".join("\n".join(["[[density]]", *lines, ""]) for lines in tables)


def energy_tables(given: Iterable[EnergyTerm]) -> str:
    """Write the tables of the terms of the energy, each under its own name.

    Raises:
        SceneError: two terms are of one kind.
    """
    terms = _listed("energy", given, TERMS)
    for name, count in Counter(term.name for term in terms).items():
        if count > 1:
            raise SceneError(
                f"scene, energy.{name}\n  `energy` has {count} terms `{name}`, but at most 1 of each kind is possible; "
                "add them up into one, or write one of them as Local(expression)"
            )
    return "[energy]\n" + "".join(table(f"energy.{term.name}", term, *TERMS) for term in terms)


def _listed(key: str, given: Iterable[T], kinds: tuple[type[T], ...]) -> list[T]:
    if isinstance(given, Table):
        raise TypeError(f"{key}: {_described(given)} stands alone; put it into a list, [{_described(given)}(...)]")
    if not isinstance(given, Iterable):
        names = ", ".join(kind.__name__ for kind in kinds)
        raise TypeError(f"{key}: {_described(given)} is not a list of objects of: {names}")
    return [_checked(f"{key}.{index}", table, kinds) for index, table in enumerate(given)]


def _checked(key: str, given: object, kinds: tuple[type[T], ...]) -> T:
    if not isinstance(given, kinds):
        names = ", ".join(kind.__name__ for kind in kinds)
        raise TypeError(f"{key}: {_described(given)} is not an object of: {names}")
    return given


def _lines(key: str, given: Table) -> Iterator[str]:
    """Write the keys of a table; a key without a value is left out."""
    shape = getattr(given, "shape", None)
    if shape is not None:
        yield f"shape = {value(key, shape)}"
    for field in fields(given):  # type: ignore[arg-type] # every table is a dataclass
        held: Any = getattr(given, field.name)
        if held is not None:
            yield f"{field.name} = {value(f'{key}.{field.name}', held)}"


def _is_function(given: Any) -> bool:
    return callable(given)


def _described(given: object) -> str:
    return f"the class {given.__name__}" if isinstance(given, type) else type(given).__name__
