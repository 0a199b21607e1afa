import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure

import curveflow as cf
from curveflow import plotting
from curveflow.periodic import arc_length_fraction, refined


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
    assert {"$x$", "arc length $\\sigma/|\\Gamma|$", "time $t$"} <= labels
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


@pytest.mark.parametrize("count", [32, 33, 399])
def test_fields_between_few_nodes_are_their_trigonometric_interpolants(count: int):
    def field(nodes: int) -> np.ndarray:
        angle = 2 * np.pi * np.arange(nodes) / nodes
        return np.stack([np.cos(angle) + 0.3 * np.sin(5 * angle), 1e6 + np.sin(15 * angle)], axis=1)

    values = refined(field(count))
    assert len(values) >= 400 and len(values) % count == 0
    np.testing.assert_allclose(values, field(len(values)), atol=1e-8)
    sawtooth = (-1.0) ** np.arange(32)
    np.testing.assert_allclose(refined(sawtooth)[:: len(refined(sawtooth)) // 32], sawtooth, atol=1e-12)


def test_enough_nodes_are_drawn_as_they_are():
    values = np.random.default_rng(1).normal(size=400)
    assert refined(values) is values


def test_a_circle_on_few_nodes_has_no_corners(circle: cf.Scene):
    result = cf.run(circle)
    axes = Figure().subplots()
    plotting.draw_curve(result, axes)
    (colours,) = axes.collections
    points = np.array([segment[0] for segment in colours.get_segments()])
    middle, radius = result.position[-1].mean(axis=0), result.length[-1] / (2 * np.pi)
    assert result.position.shape[1] == 32 and len(points) >= 400
    np.testing.assert_allclose(np.linalg.norm(points - middle, axis=1), radius, rtol=1e-6)
    assert len(axes.lines[0].get_xdata()) >= 400


def test_the_state_is_named_by_its_frame(membrane: cf.Result, circle: cf.Scene):
    count = len(membrane.time)
    for frame, label in ((-1, "final"), (count - 1, "final"), (60, f"$t$ = {membrane.time[60]:.4g}"), (0, "$t$ = 0")):
        axes = Figure().subplots()
        plotting.draw_state(membrane, axes, frame=frame)
        # As in `curveflow plot`: of the densities that one state, so that its axes suit it.
        assert [line.get_label() for line in axes.lines][0] == label
        assert "initial" not in [line.get_label() for line in axes.lines]
        (low, high), rho = axes.get_xlim(), membrane.density["protein"][frame]
        assert high - low == pytest.approx(1.3 * np.ptp(rho))
    axes = Figure().subplots()
    plotting.draw_state(cf.run(circle), axes, frame=1)
    assert [line.get_label() for line in axes.lines] == ["initial", "$t$ = 0.2"]


def test_a_constant_state_is_a_dot_on_axes_wider_than_rounding(circle: cf.Scene):
    density = """
[[density]]
name = "a"
initial = "0.7"
mobility = "diffusion"
"""
    result = cf.run(cf.Scene.parse(circle.text + density))
    axes = Figure().subplots()
    plotting.draw_state(result, axes)
    (dot,) = [line for line in axes.lines if line.get_marker() == "o"]
    at = dot.get_xydata()[0]
    np.testing.assert_allclose(at, [result.density["a"][-1, 0], result.curvature[-1, 0]], rtol=1e-9)
    for (low, high), value in zip((axes.get_xlim(), axes.get_ylim()), at, strict=True):
        assert low < 0.995 * value < 1.005 * value < high


def test_a_shrunk_curve_and_its_curvature_are_seen():
    ellipse, tension = cf.Ellipse(semi_axes=(1.0, 0.9)), cf.Length(tension=1.0)
    result = cf.run(cf.Scene(curve=ellipse, energy=[tension], time=cf.Time(10.0), output=cf.Output(frames=50)))
    assert result.length[-1] < 1e-3 * result.length[0]
    curve, state = Figure().subplots(1, 2)
    plotting.draw_curve(result, curve)
    (dot,) = [line for line in curve.lines if line.get_marker() == "o"]
    np.testing.assert_allclose(dot.get_xydata()[0], result.position[-1].mean(axis=0), atol=1e-6)
    plotting.draw_state(result, state)
    # In units of the length, as in `curveflow plot`: neither of the two curves is a stroke at the edge.
    for line in state.lines:
        assert (line.get_xdata()[0], line.get_xdata()[-1]) == (0.0, 1.0)


def test_arc_length_goes_once_around():
    fraction = arc_length_fraction(np.array([1.0, 3.0, 1.0, 3.0]))
    np.testing.assert_allclose(fraction, [0.0, 0.25, 0.5, 0.75, 1.0])


def two_densities(first: str = "lipid") -> cf.Result:
    densities = [cf.Density(name, f"1 + {part}*cos(2*pi*s)", "diffusion") for name, part in ((first, 0.1), ("protein", 0.4))]
    energy = [cf.Bending(1.0), cf.Local(f"0.5*({first} - 1)^2 + 0.5*(protein - 1)^2")]
    accuracy = cf.Accuracy(tolerance=1e-3, nodes=32)
    return cf.run(cf.Scene(curve=cf.Circle(1.0), density=densities, energy=energy, time=cf.Time(0.01), accuracy=accuracy))


def test_a_density_is_chosen_by_its_name(tmp_path: Path):
    result = two_densities()
    for density, shown in ((None, "lipid"), ("protein", "protein")):
        figure = result.plot(Figure(), density=density)
        labels = [axes.get_xlabel() for axes in figure.axes] + [axes.get_ylabel() for axes in figure.axes]
        assert labels.count(f"{shown} density $\\rho$") == 2
        path = tmp_path / f"{shown}.svg"
        result.picture(path, density=density)
        assert f"{shown} density ρ" in path.read_text()
    for draw in (result.plot, lambda density: result.picture(tmp_path / "none.png", density=density)):
        with pytest.raises(ValueError, match="density = 'lipids': .* it has lipid, protein"):
            draw(density="lipids")
    assert not (tmp_path / "none.png").exists()


def test_long_names_leave_room_for_powers_of_ten():
    figure = two_densities("a_name_that_goes_on_and_on_until_there_is_no_room_left_for_more_").plot(
        Figure(figsize=(11, 6.2), layout="constrained")
    )
    figure.draw_without_rendering()
    (state,) = [axes for axes in figure.axes if axes.get_xlabel().startswith("a_name")]
    assert state.xaxis.label.get_window_extent().width < 0.8 * state.get_window_extent().width
