import subprocess
import sys

import matplotlib.pyplot as plt
import pytest
from matplotlib.figure import Figure

import curveflow as cf


def test_the_figure_has_three_panels(membrane: cf.Result):
    figure = membrane.plot()
    labels = {axes.get_xlabel() for axes in figure.axes}
    assert {"$x$", "protein density $\\rho$", "time $t$"} <= labels
    assert figure.get_suptitle() == membrane.title
    figure.draw_without_rendering()
    plt.close(figure)


def test_a_curve_without_density_is_coloured_by_its_curvature(circle: cf.Scene):
    figure = cf.run(circle).plot(Figure())
    labels = {axes.get_xlabel() for axes in figure.axes}
    assert {"$x$", "arc length $\\sigma$", "time $t$"} <= labels
    figure.draw_without_rendering()


def test_matplotlib_is_imported_late_and_missed_clearly():
    code = """
import sys
import curveflow as cf
assert "matplotlib" not in sys.modules
sys.modules["matplotlib"] = None
scene = cf.Scene.shipped("circle").with_values({"accuracy.tolerance": 1e-3})
try:
    cf.run(scene).plot()
except ImportError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert 'pip install "curveflow[plot]"' in done.stdout


@pytest.mark.parametrize("title", ["costs $5", "a $ b $ c"])
def test_dollars_in_titles_are_no_formulas(circle: cf.Scene, title: str):
    cf.run(circle.with_values({"title": title})).plot(Figure()).draw_without_rendering()
