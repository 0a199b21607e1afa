import signal

import matplotlib
import pytest

import curveflow as cf

matplotlib.use("Agg")
# A shell starts background jobs with SIGINT ignored, and so would be Ctrl-C here and in the processes of the tests.
signal.signal(signal.SIGINT, signal.default_int_handler)

CIRCLE = """
title = "Circle"
curve = { shape = "circle", radius = 1.0 }
energy.bending = { rigidity = 1.0 }
time = { end = 1.0, stop_at_equilibrium = false }
accuracy = { tolerance = 1e-4, nodes = 32 }
output.frames = 5
"""


@pytest.fixture
def circle() -> cf.Scene:
    return cf.Scene.parse(CIRCLE)


@pytest.fixture(scope="session")
def membrane() -> cf.Result:
    """The three-fold membrane at its equilibrium."""
    return cf.run(cf.Scene.shipped("three_fold"))


@pytest.fixture
def endless() -> cf.Scene:
    """A scene that runs for longer than any test, in short steps."""
    scene = cf.Scene.shipped("three_fold_sharp")
    return scene.with_values(
        {
            "accuracy.tolerance": 1e-10,
            "accuracy.nodes": 8192,
            "time.stop_at_equilibrium": False,
            "time.end": 1e6,
        }
    )
