"""The system of a scene, for integrators from outside."""

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
