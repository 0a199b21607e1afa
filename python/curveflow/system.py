"""The system of ordinary differential equations of a scene, for integrators from outside."""

from typing import NoReturn, SupportsFloat, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from . import _curveflow
from .scene import Scene


class System:
    """The ordinary differential equations dy/dt = f(y) of a scene, for an integrator of your own.

    :func:`curveflow.run` needs none of this. The state ``y`` has the shape (size,), with ``size = initial.size``. It holds
    the Fourier coefficients of curvature × metric and of each density × metric, with the co-moving gauge those of the metric
    too, and last the length; :attr:`blocks` says where. Those of a field ``u`` are ``numpy.fft.rfft(u) / node count``, as
    real and imaginary parts in turn.

    For implicit methods there are an operator J and a preconditioner of I - gamma J. J (F20) is what Curveflow's own implicit
    steps use as the Jacobian: -K Hess F, and what the tension of the curve does to a change of the curvature. It is the
    Jacobian where the gradient of F is a combination of those of turning number and masses; at a rest that the closure of the
    curve holds, it is not (F7). Newton's method with it converges linearly, and fast.

    Arrays are contiguous ``float64`` of shape (size,), read and written in place. The interpreter lock is released during a
    call: other threads must not write to its arrays meanwhile. Calls on one system wait for each other. The number of nodes
    is fixed, also with ``accuracy.nodes = "auto"``.

    Args:
        scene: whose equations.

    Raises:
        SetupError: no initial state can be made from the scene.
        TypeError: ``scene`` is no :class:`Scene`; in the methods, an array of another type or layout.
        ValueError: in the methods, an array of another size.

    >>> import curveflow as cf
    >>> system = cf.System(cf.Scene.shipped("circle"))
    >>> rate = system.rate(system.initial)
    >>> bool(rate[-1] > 0)                      # bending makes a circle grow
    True
    """

    def __init__(self, scene: Scene) -> None:
        self._native = _curveflow.System(Scene._core(scene))

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a system cannot be copied or pickled: make a new one of its scene")

    @property
    def initial(self) -> NDArray[np.float64]:
        """Initial state, of a curve that is closed to rounding; shape (size,), read-only, the same array at each use."""
        return self._native.initial

    @property
    def blocks(self) -> list[slice]:
        """Slices of the state: curvature, each density, with the co-moving gauge the metric, the length."""
        return [slice(start, end) for start, end in self._native.blocks]

    def rate(self, y: NDArray[np.float64], out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Return f(y), in ``out`` if that is given, shape (size,)."""
        out = np.empty_like(y) if out is None else out
        self._native.rate(y, out)
        return out

    def linearise(self, y: NDArray[np.float64], out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Evaluate J at ``y``, for the methods below, and return f(y), in ``out`` if that is given."""
        out = np.empty_like(y) if out is None else out
        self._native.linearise(y, out)
        return out

    def jacobian_product(
        self, v: NDArray[np.float64], out: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Return J v, with J of the last :meth:`linearise`, in ``out`` if that is given.

        Raises:
            ValueError: there was no :meth:`linearise` yet.
        """
        out = np.empty_like(v) if out is None else out
        self._native.jacobian_product(v, out)
        return out

    def factorise(self, gamma: SupportsFloat) -> bool:
        """Prepare the preconditioner of I - ``gamma`` J, with J of the last :meth:`linearise`.

        Args:
            gamma: factor of J, in units of time, at least 0.

        Returns:
            Whether the factorisation succeeded.

        Raises:
            ValueError: ``gamma`` is negative or not finite, or there was no :meth:`linearise` yet.
        """
        return self._native.factorise(gamma)

    def precondition(self, r: NDArray[np.float64]) -> None:
        """Overwrite ``r`` by an approximate solution x of (I - gamma J) x = r, with gamma of the last :meth:`factorise`.

        Raises:
            ValueError: no :meth:`factorise` has succeeded yet.
        """
        self._native.precondition(r)
