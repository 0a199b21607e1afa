"""The operators of the flow on arrays: one curve at its nodes, s = i/n for node i of n.

Arrays have one value per node, shape (node,), and are taken as contiguous ``float64``: those that are so already, as the
arrays of a result are, are not copied. Do not write to an array while a call runs: the interpreter lock is released. Units
are those of whoever calls; numbers in parentheses are equations of ``THEORY.md``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _curveflow
from .errors import ArrayError
from .frames import Array
from .read_only import ReadOnlyArrays, ReadOnlyDict
from .scene import Scene


@dataclass(frozen=True, slots=True, eq=False)
class Geometry(ReadOnlyArrays):
    """Geometry of a closed curve at its nodes; arrays are read-only."""

    curvature: Array
    """Curvature, positive on a counter-clockwise circle, shape (node,), in 1 / length (G2)."""
    metric: Array
    """Arc length per unit of the parameter, shape (node,), in units of length."""
    tangent_angle: Array
    """Angle of the tangent from the x axis, continued from node to node, shape (node,) (G1)."""
    tangent: Array
    """Unit tangent, shape (node, 2) (G1)."""
    normal: Array
    """Unit normal, outward on a counter-clockwise curve, shape (node, 2) (G1)."""
    length: float
    """Length of the curve."""
    area: float
    """Enclosed area, positive for a counter-clockwise curve, in length² (G6)."""
    turning_number: int
    """Turns of the tangent along the curve: 1 for a simple counter-clockwise curve (G5)."""
    closure_defect: float
    """Gap between the ends of the curve that curvature and metric make, in units of length (G3)-(G5).

    The positions close by themselves: the gap tells how far the nodes are from resolving the curve.
    """


@dataclass(frozen=True, slots=True, eq=False)
class Rates(ReadOnlyArrays):
    """Rates of change at fixed parameter; arrays of shape (node,), read-only."""

    curvature: Array
    """Rate of the curvature, in 1 / (length × time)."""
    metric: Array
    """Rate of the metric, in length / time."""
    density: Mapping[str, Array]
    """Rate of each density by name, in density / time."""
    tangential_velocity: Array
    """Velocity of the nodes along the tangent, in length / time (F1)."""


def geometry(position: ArrayLike) -> Geometry:
    """Geometry of the closed curve through given points, by trigonometric interpolation in their index.

    >>> import numpy as np, curveflow as cf
    >>> phi = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    >>> circle = cf.geometry(np.stack([2 * np.cos(phi), 2 * np.sin(phi)], axis=1))
    >>> bool(np.allclose(circle.curvature, 0.5)), circle.turning_number
    (True, 1)

    Curvatures are second derivatives of positions: rounding grows like the square of the number of nodes.

    Args:
        position: points in their order along the curve, at any distances, shape (node, 2), at least 8; the first is not
            repeated at the end.

    Raises:
        ArrayError: the points are too few, not finite, or the curve stops somewhere.
    """
    points = _contiguous("position", position)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ArrayError(f"`position` has the shape {points.shape}, but it must be (node, 2){_one_frame(points, 3)}")
    return Geometry(*_curveflow.geometry(points))


def flow_map(
    curvature: ArrayLike,
    metric: ArrayLike,
    normal_velocity: ArrayLike,
    density: Mapping[str, ArrayLike] | None = None,
    *,
    gauge: Literal["scaled-arc-length", "graded", "co-moving"] = "scaled-arc-length",
    derivative: Literal["fourier", "central-2", "central-4", "central-6", "central-8"] = "fourier",
) -> Rates:
    """How a curve and its densities change under a normal velocity, the gauge included (F1), (F2), (F19).

    Densities are carried: every labelled piece keeps its mass. The map is the one of the discrete flow; minus its exact
    transpose takes the gradient of an energy to the :func:`normal_force`, but for one exception named there.

    Args:
        curvature: curvature, shape (node,), in 1 / length.
        metric: arc length per unit of the parameter, shape (node,).
        normal_velocity: velocity along the outward normal, shape (node,), in length / time.
        density: densities by name, shape (node,) each.
        gauge: what the nodes do along the curve: keep equal distances (the metric must be uniform), keep their fractions of
            the arc length (any metric), or move along the normal alone.
        derivative: family of discrete derivatives.

    Raises:
        ArrayError: arrays differ in length, are not finite, or the metric does not fit the gauge.
        ValueError: there is no such gauge or derivative.
    """
    names, values = _densities(density)
    kappa, g, v = _nodal(curvature=curvature, metric=metric, normal_velocity=normal_velocity)
    kappa_t, g_t, density_t, w = _curveflow.flow_map(kappa, g, v, values, gauge, derivative)
    return Rates(kappa_t, g_t, ReadOnlyDict(dict(zip(names, density_t, strict=True))), w)


def helmholtz(
    curvature: ArrayLike,
    metric: ArrayLike,
    right_hand_side: ArrayLike,
    *,
    derivative: Literal["fourier", "central-2", "central-4", "central-6", "central-8"] = "fourier",
) -> Array:
    """Solve H u = f, H the Laplacian by arc length with a minus sign plus the square of the curvature (O5), (O7).

    In time proportional to the number of nodes. With ``"fourier"``, H has a difference of order 8; with the others it is
    theirs.

    Args:
        curvature: curvature of a closed curve, shape (node,), in 1 / length.
        metric: arc length per unit of the parameter, shape (node,).
        right_hand_side: f, shape (node,).
        derivative: family of discrete derivatives.

    Returns:
        u, shape (node,), in the unit of f times length².

    Raises:
        ArrayError: arrays differ in length, are not finite, or H is singular.
        ValueError: there is no such derivative.
    """
    kappa, g, f = _nodal(curvature=curvature, metric=metric, right_hand_side=right_hand_side)
    return _curveflow.helmholtz(kappa, g, f, derivative)


def incompressibility(
    curvature: ArrayLike,
    metric: ArrayLike,
    force: ArrayLike,
    *,
    derivative: Literal["fourier", "central-2", "central-4", "central-6", "central-8"] = "fourier",
) -> Array:
    """Apply the incompressibility operator: the normal velocity that a force makes where every piece keeps its length (F8).

    The operator is self-adjoint in the arc length, between 0 and 1, and zero on the curvature only.

    Args:
        curvature: curvature of a closed curve, shape (node,), in 1 / length.
        metric: arc length per unit of the parameter, shape (node,).
        force: normal force, or any velocity, shape (node,).
        derivative: family of discrete derivatives.

    Returns:
        Its image, shape (node,), in the same unit.

    Raises:
        ArrayError: arrays differ in length, are not finite, or H of :func:`helmholtz` is singular.
        ValueError: there is no such derivative.
    """
    kappa, g, f = _nodal(curvature=curvature, metric=metric, force=force)
    return _curveflow.incompressibility(kappa, g, f, derivative)


def energy(
    scene: Scene, curvature: ArrayLike, metric: ArrayLike, density: Mapping[str, ArrayLike] | None = None
) -> float:
    """Energy of a scene on a curve with its densities (D3): on a frame of a run, the energy of that frame.

    >>> import curveflow as cf
    >>> result = cf.run(cf.Scene.shipped("circle"))
    >>> energy = cf.energy(result.scene, result.curvature[-1], result.metric[-1])
    >>> abs(energy - float(result.energy[-1])) < 1e-12
    True

    Targets relative to the initial curve are relative to that of the scene. The number of nodes is that of the arrays.

    Args:
        scene: whose energy, with whose derivative and gauge.
        curvature: curvature, shape (node,), in 1 / length.
        metric: arc length per unit of the parameter, shape (node,).
        density: all densities of the scene by name, shape (node,) each.

    Returns:
        The energy, in units of energy; NaN where an expression of the scene is.

    Raises:
        ArrayError: arrays differ in length, are not finite, or a density is missing.
        SetupError: the initial curve of the scene cannot be used on so many nodes.
    """
    kappa, g = _nodal(curvature=curvature, metric=metric)
    return _curveflow.energy(Scene._core(scene), kappa, g, _of_scene(scene, density))


def normal_force(
    scene: Scene, curvature: ArrayLike, metric: ArrayLike, density: Mapping[str, ArrayLike] | None = None
) -> Array:
    """Force of the energy of a scene on the normal motion of a curve, before any mobility (F3), (F19).

    Exactly minus the transpose of :func:`flow_map` on the gradient of :func:`energy`: under a normal velocity V, with the
    densities carried, the energy changes at the rate of minus the integral of force times V over the arc length. One exception:
    with the Fourier derivative on equidistant nodes and slopes in ``energy.local``, the whole flow of the scene uses the
    midpoints of the nodes (D6), which :func:`flow_map` does not; the two then agree to the error of the derivative.

    Args:
        scene: whose energy, with whose derivative and gauge.
        curvature: curvature, shape (node,), in 1 / length.
        metric: arc length per unit of the parameter, shape (node,).
        density: all densities of the scene by name, shape (node,) each.

    Returns:
        The force, shape (node,), in energy / length².

    Raises:
        ArrayError: arrays differ in length, are not finite, or a density is missing.
        SetupError: the initial curve of the scene cannot be used on so many nodes.
    """
    kappa, g = _nodal(curvature=curvature, metric=metric)
    return _curveflow.normal_force(Scene._core(scene), kappa, g, _of_scene(scene, density))


# What arrays of objects may hold and NumPy would convert.
_NOT_REAL = (str, bytes, complex, np.complexfloating, np.datetime64, np.timedelta64)


def _contiguous(name: str, given: ArrayLike) -> Array:
    if isinstance(given, np.ma.MaskedArray) and np.ma.is_masked(given):
        raise ArrayError(f"`{name}` has masked values; give it without them, or filled")
    try:
        array = np.asarray(given)
        if _is_real(array):
            return np.ascontiguousarray(array, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ArrayError(f"`{name}` is no array of numbers: {error}") from error
    raise ArrayError(f"`{name}` is no array of numbers: it holds {array.dtype.name}, but it must hold real numbers")


def _is_real(array: NDArray[Any]) -> bool:
    """Whether NumPy takes all of it over: of imaginary parts, dates and texts it would make other numbers."""
    if array.dtype.kind == "O":
        return not any(isinstance(value, _NOT_REAL) for value in array.flat)
    return array.dtype.kind in "biuf"


def _one_frame(array: Array, dimensions: int) -> str:
    return "; give one frame, array[-1] is the last" if array.ndim == dimensions else ""


def _vector(name: str, given: ArrayLike) -> Array:
    array = _contiguous(name, given)
    # A scalar has become an array of one value.
    if array.ndim != 1 or np.ndim(given) == 0:
        raise ArrayError(f"`{name}` has the shape {np.shape(given)}, but it must be (node,){_one_frame(array, 2)}")
    return array


def _nodal(**given: ArrayLike) -> list[Array]:
    return [_vector(name, array) for name, array in given.items()]


def _densities(given: Mapping[str, ArrayLike] | None) -> tuple[list[str], list[Array]]:
    if given is None:
        return [], []
    if not isinstance(given, Mapping):
        raise ArrayError(f"`density` is a {type(given).__name__}, but it must be a mapping from names to arrays")
    return list(given), [_vector(f"density[{name!r}]", array) for name, array in given.items()]


def _of_scene(scene: Scene, given: Mapping[str, ArrayLike] | None) -> list[Array]:
    """The densities in the order of the scene."""
    names, arrays = _densities(given)
    expected = [density.name for density in scene.density]
    if sorted(names) != sorted(expected):
        listed = ", ".join(map(repr, expected)) or "none"
        raise ArrayError(f"`density` has the names {names}, but the scene has the densities: {listed}")
    by_name = dict(zip(names, arrays, strict=True))
    return [by_name[name] for name in expected]
