"""The system of ordinary differential equations of a scene, for integrators from outside."""

import numpy as np
from numpy.typing import NDArray

from . import _curveflow
from .scene import Scene


class System:
    """dy/dt = f(y) of a scene, with its implicit operator J and a preconditioner of I - gamma J.

    J = -K Hess F is what the implicit steps of Curveflow take for the Jacobian: the derivative of f without the terms that vanish
    where the force does (F7). It is the Jacobian at rest; elsewhere Newton's method with it converges linearly, and fast.

    For those who bring their own integrator; :func:`curveflow.run` needs none of this. The state ``y`` holds the Fourier
    coefficients of curvature and densities per unit parameter (real and imaginary parts in turn), then the length.

    Arrays are read and written in place, without the interpreter lock: other threads go on, and must not write to them
    meanwhile. Calls on one system wait for each other.

    >>> import curveflow as cf
    >>> system = cf.System(cf.Scene.shipped("circle"))
    >>> rate = system.rate(system.initial)
    >>> bool(rate[-1] > 0)                      # bending makes a circle grow
    True
    """

    def __init__(self, scene: Scene) -> None:
        self._native = _curveflow.System(Scene._core(scene))

    @property
    def initial(self) -> NDArray[np.float64]:
        """Initial state, closed to rounding. Shape (size,), read-only; the same array at each use."""
        return self._native.initial

    @property
    def blocks(self) -> list[slice]:
        """Where curvature, each density and the length stand in the state."""
        return [slice(start, end) for start, end in self._native.blocks]

    def rate(self, y: NDArray[np.float64], out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """f(y), into ``out`` if given (contiguous float64, shape (size,))."""
        out = np.empty_like(y) if out is None else out
        self._native.rate(y, out)
        return out

    def linearise(self, y: NDArray[np.float64], out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Freeze the implicit operator J at ``y``; returns f(y)."""
        out = np.empty_like(y) if out is None else out
        self._native.linearise(y, out)
        return out

    def jacobian_product(
        self, v: NDArray[np.float64], out: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """J v at the state of the last :meth:`linearise`; J leaves out of f's derivative what vanishes with the force (F7).

        Raises:
            ValueError: there was no :meth:`linearise` yet.
        """
        out = np.empty_like(v) if out is None else out
        self._native.jacobian_product(v, out)
        return out

    def factorise(self, gamma: float) -> bool:
        """Prepare the preconditioner of I - ``gamma`` J at the state of the last :meth:`linearise`; false if that fails.

        Raises:
            ValueError: ``gamma`` is negative or not finite, or there was no :meth:`linearise` yet.
        """
        return self._native.factorise(gamma)

    def precondition(self, r: NDArray[np.float64]) -> None:
        """Overwrite ``r`` by the approximate solution of (I - gamma J) x = r.

        Raises:
            ValueError: there was no :meth:`factorise` yet that succeeded.
        """
        self._native.precondition(r)
