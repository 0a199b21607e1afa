"""Scenes: what to run."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from . import _curveflow
from .errors import SceneError
from .model import Accuracy, Curve, Density, EnergyTerm, Flow, Output, Time, reading, writing
from .model.curve import CURVES, Points

if TYPE_CHECKING:
    from .result import Result


class _Checked:
    """What the core has of a scene: no value of it, so no field of the dataclass."""

    __slots__ = ("_native",)
    _native: _curveflow.Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene(_Checked):
    """A scene that has been checked: a curve, its densities and energy, how it flows and how accurately.

    A scene is made of objects, as below, or by :meth:`load`, :meth:`parse` or :meth:`shipped`. It cannot be changed;
    ``dataclasses.replace`` and :meth:`with_values` make new scenes from it. Scenes are equal if they mean the same, and
    can be pickled. ``dataclasses.asdict`` gives the values, without which shape and which terms have them; all is in
    :meth:`to_toml`. All defaults are filled in:

    >>> import curveflow as cf
    >>> scene = cf.Scene(curve=cf.Circle(1), energy=[cf.Bending(1)], time=cf.Time(2.5))
    >>> scene.accuracy.tolerance
    1e-05
    >>> scene == cf.Scene.parse(scene.to_toml())
    True

    Lengths, times, energies and densities are in units of your choice, the same throughout a scene. All arguments are
    given by name.

    Args:
        title: for pictures and files.
        curve: initial curve: ``Circle``, ``Ellipse``, ``Trillium``, ``FigureEight``, ``Polar``, ``Parametric`` or
            ``Points``.
        density: densities carried by the curve, a list of ``Density``.
        energy: terms of the energy, at most one of each class: ``Bending``, ``Regularization``, ``Length``, ``Area``,
            ``Adhesion``, ``Agents``, ``Membrane``, ``Packing``, ``Local``.
        flow: mobility of the curve and gauge of its nodes.
        time: when to stop.
        accuracy: tolerance and number of nodes.
        output: which states to save.

    Raises:
        SceneError: the objects do not make a valid scene; the message names the keys at fault.
        TypeError: an argument is not an object of its table, or a value is no number, text, truth value or list.
    """

    title: str = ""
    """Title."""
    curve: Curve
    """The initial curve, of one of the shapes."""
    density: Sequence[Density] = ()
    """The densities, in the order of the components; kept as a tuple."""
    energy: Sequence[EnergyTerm]
    """The terms of the energy, at most one of each kind; kept as a tuple, in the order of the reference."""
    flow: Flow = Flow()
    """How the curve may move."""
    time: Time
    """How long to run."""
    accuracy: Accuracy = Accuracy()
    """How exact the answer is to be."""
    output: Output = Output()
    """Which states to save."""

    def __post_init__(self) -> None:
        text = "".join(
            [
                f"title = {writing.value('title', self.title)}\n",
                writing.table("curve", self.curve, *CURVES),
                writing.density_tables(self.density),
                writing.energy_tables(self.energy),
                writing.table("flow", self.flow, Flow),
                writing.table("time", self.time, Time),
                writing.table("accuracy", self.accuracy, Accuracy),
                writing.table("output", self.output, Output),
            ]
        )
        self._hold(_curveflow.Scene.parse_written(text, "scene"))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene from a TOML file.

        Raises:
            SceneError: the file cannot be read or is not a scene; the message names keys and lines.
        """
        return cls._of(_curveflow.Scene.read(path))

    @classmethod
    def parse(cls, text: str, name: str = "scene") -> Scene:
        """Check the text of a scene.

        Args:
            text: the scene in TOML.
            name: its name in messages, as if it were the path of the text: files of points are looked for in that folder.

        Raises:
            SceneError: the text is not a scene; the message names keys and lines.
        """
        try:
            return cls._of(_curveflow.Scene.parse(text, name, []))
        except UnicodeEncodeError as error:
            raise writing.half_character("the text or its name", error) from None

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

    def starting_from(self, result: Result, frame: int = -1) -> Scene:
        """Return this scene with the curve and the densities of a frame of a result for its initial ones.

        >>> import curveflow as cf
        >>> relaxed = cf.run(cf.Scene.shipped("circle").with_values({"time.end": 0.1}))
        >>> stiffer = cf.Scene.shipped("circle").with_values({"energy.bending.rigidity": 2.0})
        >>> cf.run(stiffer.starting_from(relaxed)).length[0] == relaxed.length[-1]
        True

        Densities that the result lacks start as this scene says. Targets that are relative to the initial curve
        (``target_ratio``) are relative to the new one. To go on with the same scene, use :meth:`Simulation.checkpoint`.

        Args:
            result: of any scene whose curve has 8 to 16384 nodes.
            frame: index of the frame; the last one unless given.

        Raises:
            IndexError: there is no such frame.
            SceneError: the frame has more nodes.
            TypeError: ``result`` is no :class:`Result`.
        """
        _check_result(result)
        curve = Points(result.position[frame], turning_number=result.scene.curve.turning_number)
        known = result.density
        density = [replace(one, initial=known[one.name][frame]) if one.name in known else one for one in self.density]
        return replace(self, curve=curve, density=density)

    @classmethod
    def of(cls, result: Result) -> Scene:
        """Return the scene of a result, which makes the same result again; the same as ``result.scene``.

        Raises:
            SceneError: this version cannot read the scene stored in the result file.
            TypeError: ``result`` is no :class:`Result`.
        """
        _check_result(result)
        return result.scene

    def with_values(self, values: Mapping[str, object]) -> Scene:
        """Return a copy of this scene with other values, like ``--set`` on the command line.

        Args:
            values: dotted keys and their values: ``{"accuracy.tolerance": 1e-4, "density.protein.initial": "0.5"}``,
                or nested, ``{"accuracy": {"tolerance": 1e-4}}``, which means the same: other keys of the table stay.
                Numbers (fractions, decimals and those of NumPy too), texts (formulas too), truth values, lists, arrays and
                the objects of whole tables are allowed; missing keys are added, and ``None`` removes a key.

        Raises:
            SceneError: the changed scene is not valid.
            TypeError: ``values`` is no mapping, or a key or value is of another type than those above.
        """
        changes = list(writing.changes(values))
        keys = [key for key, _ in changes]
        # The points of this scene, not what their file holds by now, unless another file is named.
        native = self._native if "curve.file" in keys else self._native.self_contained()
        if "curve.file" in keys and native.holds_points and "curve.points" not in keys:
            changes.insert(0, ("curve.points", ""))
        return self._of(_curveflow.Scene.parse(native.text, native.source_name, changes))

    @property
    def text(self) -> str:
        """The scene as given, verbatim; if it was made of objects or by :meth:`with_values`, TOML without comments.

        After :meth:`with_values`, copying or pickling, it contains the points themselves instead of the name of their file.
        """
        return self._native.text

    def to_toml(self) -> str:
        """Return the scene as understood: TOML with every default filled in."""
        return self._native.to_toml()

    def __reduce__(self) -> tuple[object, ...]:
        native = self._native.self_contained()
        return Scene.parse, (native.text, native.source_name)

    @staticmethod
    def _core(scene: Scene) -> _curveflow.Scene:
        """What the core has of a scene.

        Raises:
            TypeError: it is something else.
        """
        if not isinstance(scene, Scene):
            raise TypeError(
                f"scene is {scene!r:.60}, but it must be a curveflow.Scene: Scene.load(path), Scene.shipped(name), "
                "Scene.parse(text) or Scene(curve=…, energy=…, time=…)"
            )
        return scene._native

    @classmethod
    def _of(cls, native: _curveflow.Scene) -> Scene:
        scene = object.__new__(cls)
        scene._hold(native)
        return scene

    def _hold(self, native: _curveflow.Scene) -> None:
        """Take every field from the core: what was given is there, and all defaults."""
        for key, value in reading.objects(json.loads(native.to_json())).items():
            object.__setattr__(self, key, value)
        object.__setattr__(self, "_native", native)


def scenes() -> list[str]:
    """Return the names of the scenes that come with the package, for :meth:`Scene.shipped`."""
    return [name for name, _ in _curveflow.shipped()]


def _check_result(result: object) -> None:
    """Raise TypeError unless ``result`` is a Result: its path, and that of a scene, are easily taken for it."""
    from .result import Result

    if not isinstance(result, Result):
        raise TypeError(f"result is {result!r:.60}, but it must be a curveflow.Result: curveflow.open(path)")
