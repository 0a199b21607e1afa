"""Scenes: what to run."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping

import numpy as np

from . import _curveflow
from .errors import SceneError


class Scene:
    """A scene that has been checked: a curve, its densities and energy, how it flows and how accurately.

    Made by :meth:`load`, :meth:`parse` or :meth:`shipped`; never changed afterwards. Scenes are equal if they
    mean the same, and can be pickled.
    """

    __slots__ = ("_native",)
    _native: _curveflow.Scene

    def __init__(self) -> None:
        raise TypeError("use Scene.load(path), Scene.parse(text) or Scene.shipped(name)")

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene from a TOML file.

        Raises:
            SceneError: the file cannot be read or is not a scene; the message names keys and lines.
        """
        return cls._of(_curveflow.Scene.read(os.fspath(path)))

    @classmethod
    def parse(cls, text: str, name: str = "scene") -> Scene:
        """Check the text of a scene.

        Args:
            text: the scene in TOML.
            name: its name in messages; files of points are looked for in the folder of this name.

        Raises:
            SceneError: the text is not a scene; the message names keys and lines.
        """
        return cls._of(_curveflow.Scene.parse(text, name, []))

    @classmethod
    def shipped(cls, name: str) -> Scene:
        """Return a scene that comes with the package; :func:`scenes` lists their names.

        Raises:
            SceneError: there is no such scene.
        """
        texts = dict(_curveflow.shipped())
        if name not in texts:
            known = ", ".join(texts)
            raise SceneError(f"no scene called {name!r} comes with Curveflow; those that do: {known}")
        return cls.parse(texts[name], f"{name}.toml")

    def with_values(self, values: Mapping[str, object]) -> Scene:
        """Return this scene with other values, like ``--set`` on the command line.

        Args:
            values: dotted keys and their values: ``{"accuracy.tolerance": 1e-4, "density.protein.initial": "0.5"}``.
                Numbers, texts (formulas too), truth values, lists and arrays are allowed; missing keys are added.

        Raises:
            SceneError: what the changes make of the scene is not valid.
            TypeError: a value is of another type.
        """
        changes = [(key, _toml(key, value)) for key, value in values.items()]
        return self._of(_curveflow.Scene.parse(self.text, self._native.source_name, changes))

    @property
    def title(self) -> str:
        """Title; empty if the scene gives none."""
        return self._native.title

    @property
    def text(self) -> str:
        """The scene as given, verbatim; after :meth:`with_values`, TOML with the changes and without comments."""
        return self._native.text

    def to_toml(self) -> str:
        """Return the scene as understood: TOML with every default filled in."""
        return self._native.to_toml()

    def __repr__(self) -> str:
        return f"<Scene {self._native.source_name}: {self.title!r}>"

    def __eq__(self, other: object) -> bool:
        return self.to_toml() == other.to_toml() if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __reduce__(self) -> tuple[object, ...]:
        return Scene.parse, (self.text, self._native.source_name)

    @classmethod
    def _of(cls, native: _curveflow.Scene) -> Scene:
        scene = object.__new__(cls)
        scene._native = native
        return scene


def scenes() -> list[str]:
    """Return the names of the scenes that come with the package, for :meth:`Scene.shipped`."""
    return [name for name, _ in _curveflow.shipped()]


def _toml(key: str, value: object) -> str:
    """Write a value as TOML."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, bool | int | str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_toml(key, item) for item in value) + "]"
    raise TypeError(f"{key}: {type(value).__name__} is not a number, text, truth value or list of these")
