"""What the frames of a run hold, as arrays."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _curveflow
from .read_only import ReadOnlyDict

Array = NDArray[np.float64]


class Frames:
    """The saved frames and the log of steps of a run.

    All arrays are read-only NumPy arrays of ``float64``, made at first use: one entry per saved frame (the first is
    the initial state, the last the final one), and per node of the curve. Units are those of the scene; numbers in
    parentheses are equations of ``THEORY.md``.

    A run saves its frames one by one, so an array over all frames is written once, at its first use, into the memory that
    NumPy then owns; a frame of it, ``result.curvature[-1]``, is a view.
    """

    _record: _curveflow.Record

    @cached_property
    def time(self) -> Array:
        """Simulated time, shape (frame,), in units of time."""
        return self._record.values("time")

    @cached_property
    def energy(self) -> Array:
        """Energy, the sum of ``energy_terms``, shape (frame,), in units of energy (D3)."""
        return self._record.values("energy")

    @cached_property
    def energy_terms(self) -> Mapping[str, Array]:
        """Energy of each term by its name in the scene, shape (frame,), in units of energy (E1)-(E9)."""
        names = self._record.energy_terms
        return ReadOnlyDict({name: self._record.energy_term(i) for i, name in enumerate(names)})

    @cached_property
    def dissipation(self) -> Array:
        """Dissipation, minus the rate of change of the energy, shape (frame,), in energy / time (F6).

        Like :attr:`normal_velocity` it is computed from the state, and not controlled by the tolerance.
        """
        return self._record.values("dissipation")

    @cached_property
    def energy_balance(self) -> Array:
        """Energy - initial energy + dissipation integrated over time, shape (frame,), in units of energy.

        Zero up to the error of the integration.
        """
        return self._record.values("energy_balance")

    @cached_property
    def remap_error(self) -> Array:
        """Energy that changes of the nodes or of the gauge have added so far, shape (frame,), in units of energy."""
        return self._record.values("remap_error")

    @cached_property
    def length(self) -> Array:
        """Length of the curve, shape (frame,), in units of length."""
        return self._record.values("length")

    @cached_property
    def area(self) -> Array:
        """Enclosed area, positive for a counter-clockwise curve, shape (frame,), in length² (G6)."""
        return self._record.values("area")

    @cached_property
    def mass(self) -> Mapping[str, Array]:
        """Mass of each density by name, its integral over arc length, shape (frame,), in density × length."""
        names = self._record.densities
        return ReadOnlyDict({name: self._record.mass(i) for i, name in enumerate(names)})

    @cached_property
    def closure_defect(self) -> Array:
        """Gap between the ends of the curve before projection, shape (frame,), in units of length (G5)."""
        return self._record.values("closure_defect")

    @cached_property
    def crossings(self) -> Array:
        """Number of self-crossings of the curve, a whole number, shape (frame,) (G7)."""
        return self._record.values("crossings")

    @cached_property
    def curvature(self) -> Array:
        """Curvature κ, positive on a circle, shape (frame, node), in 1 / length (G2)."""
        return self._record.field("curvature")

    @cached_property
    def parameter(self) -> Array:
        """Parameter s = i/n of node i out of n, in [0, 1), shape (node,)."""
        _, nodes = self._record.shape
        parameter = np.arange(nodes) / nodes
        parameter.flags.writeable = False
        return parameter

    @cached_property
    def metric(self) -> Array:
        """Metric g, the arc length per unit of :attr:`parameter`, shape (frame, node), in units of length."""
        return self._record.field("metric")

    @cached_property
    def position(self) -> Array:
        """Position (x, y) of the nodes, counter-clockwise, shape (frame, node, 2), in units of length (G4)."""
        return self._record.position()

    @cached_property
    def normal_velocity(self) -> Array:
        """Velocity V along the outward normal, shape (frame, node), in length / time (F4).

        The tolerance controls the state, not V, whose further derivatives amplify the error in the shortest waves. The
        error is largest in frames between two steps, which are interpolated. Where V matters late in a run, take it from
        :attr:`Simulation.state` after ``run(until=…)``, or ask for a tolerance a hundred to a thousand times tighter.
        """
        return self._record.field("normal_velocity")

    @cached_property
    def density(self) -> Mapping[str, Array]:
        """Each density by name, per unit of arc length, shape (frame, node), in units of density."""
        names = self._record.densities
        return ReadOnlyDict({name: self._record.density(i) for i, name in enumerate(names)})

    @cached_property
    def fields(self) -> Mapping[str, Array]:
        """Fields that the scene asks for in ``output.fields``, by name, shape (frame, node); none unless it asks.

        - ``normal_force``: force f on the normal motion, before the mobility, in energy / length² (F3);
        - ``tangential_velocity``: velocity W of the gauge along the tangent, in length / time (F1);
        - ``excess_density``: ρ̄ = -H⁻¹(κf) with the force f of all terms but the membrane's (F11): a membrane of
          compressibility ε that is nearly incompressible has the density 1 + ερ̄; in density / unit of ε;
        - ``membrane_flux``: flux -∇ρ̄ of that membrane along the tangent, in density / unit of ε / length (F11);
        - ``energy_density``: energy per length of the local terms, in energy / length (D3).
        - ``energy_density_bending``, …: the same of each local term (``energy-densities``).
        - ``normal_velocity_bending``, …: what each term adds to the normal velocity (``normal-velocities``).
        """
        names = self._record.fields
        return ReadOnlyDict({name: self._record.requested_field(i) for i, name in enumerate(names)})

    @cached_property
    def diagnostics(self) -> Mapping[str, Array]:
        """How far the curve is from an incompressible one, by name, shape (frame,).

        There are two of them if the scene has an ``energy.membrane`` of a density ρ that diffuses, and the normal mobility
        ``identity``; otherwise none. Each is the L² norm over arc length of a difference, with ρ̄ of (F11) and 𝓘 of (F8):

        - ``incompressible_distance``: of ρ - 1 - ερ̄, in density × length^½;
        - ``velocity_residual``: of V - 𝓘f, the normal velocity less that of the incompressible flow without the
          membrane term, in velocity × length^½.
        """
        names = self._record.diagnostics
        return ReadOnlyDict({name: self._record.diagnostic(i) for i, name in enumerate(names)})

    @cached_property
    def steps(self) -> Mapping[str, NDArray[Any]]:
        """The log of accepted steps by name, arrays of shape (step,).

        ``time``, ``energy`` and ``dissipation`` at the end of the step, its ``size``, the ``order`` of the method, the
        number of ``nodes``, and the attempts rejected before it by cause: ``rejections_error``, ``rejections_solver``,
        ``rejections_energy_rise`` and ``rejections_not_finite``.
        """
        return ReadOnlyDict(self._record.steps())
