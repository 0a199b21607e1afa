"""The system of a scene, for integrators from outside."""

from concurrent.futures import ThreadPoolExecutor

import curveflow as cf
import numpy as np
import pytest


@pytest.fixture
def system():
    return cf.System(cf.Scene.shipped("length_penalty"))


def test_the_rate_of_a_circle_is_known():
    system = cf.System(cf.Scene.shipped("circle"))
    # Bending moves a circle of radius 1 at 1/2.
    assert system.rate(system.initial)[-1] == pytest.approx(np.pi, rel=1e-12)


def test_the_operator_is_linear_and_the_preconditioner_inverts_most_of_it(system):
    y = system.initial.copy()
    assert np.array_equal(system.linearise(y), system.rate(y))
    gamma = 1e-7
    assert system.factorise(gamma)
    smooth = system.rate(y)
    x = smooth - gamma * system.jacobian_product(smooth)
    system.precondition(x)
    assert np.linalg.norm(x - smooth) < 0.1 * np.linalg.norm(smooth)


def test_the_blocks_cover_the_state(system):
    ends = [(block.start, block.stop) for block in system.blocks]
    assert ends[0][0] == 0 and ends[-1][1] == system.initial.size
    assert all(a[1] == b[0] for a, b in zip(ends, ends[1:]))


def test_a_wrong_size_is_refused(system):
    with pytest.raises(ValueError, match="entries"):
        system.rate(np.zeros(3))


def test_arrays_are_used_in_place(system):
    y = system.initial
    assert system.initial is y and not y.flags.writeable
    with pytest.raises(ValueError, match="WRITEABLE"):
        y.flags.writeable = True
    out = np.full_like(y, np.nan)
    assert system.rate(y, out) is out and np.isfinite(out).all()
    with pytest.raises(TypeError, match="contiguous"):
        system.rate(np.stack([y, y], axis=1)[:, 0], out)
    with pytest.raises(TypeError):
        system.rate(y, np.empty(y.size, dtype=np.float32))
    with pytest.raises(TypeError, match="read-only|writeable"):
        system.rate(np.zeros_like(y), y)


def test_calls_on_one_system_do_not_hold_the_interpreter():
    """Threads call one system at once: each gets its own rate, and none waits for ever."""
    system = cf.System(cf.Scene.shipped("three_fold"))
    states = [system.initial * (1 + 1e-9 * k) for k in range(4)]
    expected = [system.rate(y) for y in states]
    with ThreadPoolExecutor(len(states)) as pool:
        found = list(pool.map(lambda y: [system.rate(y) for _ in range(20)][-1], states))
    assert all(np.array_equal(a, b) for a, b in zip(found, expected))


def test_calls_out_of_order_are_refused(system):
    y = system.initial
    with pytest.raises(ValueError, match="linearise first"):
        system.jacobian_product(y)
    with pytest.raises(ValueError, match="linearise first"):
        system.factorise(1e-6)
    system.linearise(y)
    with pytest.raises(ValueError, match="factorise first"):
        system.precondition(y.copy())
    for gamma in (np.nan, np.inf, -1.0):
        with pytest.raises(ValueError, match="gamma"):
            system.factorise(gamma)


def test_an_energy_that_is_not_finite_is_named():
    with pytest.raises(cf.SetupError, match="`local` is not finite"):
        cf.System(cf.Scene.shipped("circle").with_values({"energy.local.expression": "ln(kappa - 10)"}))
