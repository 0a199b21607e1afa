import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import curveflow as cf
from curveflow import plotting
from curveflow.history_plot import energy_history
from curveflow.scales import fit, from_start, logarithmic

CLOSE = 0.05


def drawn(result: cf.Result) -> tuple[Figure, Axes, Axes]:
    """The figure, the axes of the energy and those of the length."""
    figure = Figure(figsize=(5, 3), layout="constrained")
    plotting.draw_history(result, figure.subplots())
    figure.draw_without_rendering()
    left, right = figure.axes
    return figure, left, right


def points(axes: Axes, marker: str, fill: str | None = None) -> np.ndarray:
    """Finite points of all lines with this marker."""
    lines = [line for line in axes.lines if line.get_marker() == marker]
    lines = [line for line in lines if (line.get_markerfacecolor() == "white") == (fill == "white")]
    every = np.concatenate([line.get_xydata() for line in lines] or [np.empty((0, 2))])
    return every[np.isfinite(every).all(axis=1)]


@pytest.fixture(scope="module")
def folded() -> cf.Result:
    """A run with more frames than steps, the first of them long after the first steps."""
    return cf.run(cf.Scene.shipped("incompressible"))


def test_the_energy_is_that_of_all_steps_and_frames(folded: cf.Result):
    assert len(folded.steps["time"]) < len(folded.time) and folded.steps["time"][0] < 0.1 * folded.time[1]
    time, energy = energy_history(folded)
    assert (np.diff(time) > 0).all()
    for known in (folded.steps, {"time": folded.time, "energy": folded.energy}):
        at = np.searchsorted(time, known["time"])
        np.testing.assert_array_equal(time[at], known["time"])
        np.testing.assert_allclose(energy[at], known["energy"], rtol=1e-12)
    _, left, _ = drawn(folded)
    shown = left.lines[0].get_xydata()
    assert shown[0, 1] == folded.energy[0]
    np.testing.assert_array_equal(shown[1:, 0], time[1:])


def test_initial_values_stand_at_the_edge_of_a_logarithmic_axis(folded: cf.Result, circle: cf.Scene):
    for result in (folded, cf.run(circle)):
        _, left, right = drawn(result)
        assert left.get_xscale() == "log"
        edge = left.get_xlim()[0]
        # The first step is told apart from what was before it.
        assert edge < 0.9 * result.steps["time"][0]
        np.testing.assert_allclose(points(left, "o", "white"), [[edge, result.energy[0]]])
        np.testing.assert_allclose(points(right, "o", "white"), [[edge, result.length[0]]])
        for axes, value in ((left, result.energy[0]), (right, result.length[0])):
            low, high = axes.get_ylim()
            assert low < value < high


@pytest.mark.parametrize("frames", [2, 5, 200])
def test_lengths_are_drawn_at_frames_and_joined_only_where_these_are_close(circle: cf.Scene, frames: int):
    result = cf.run(circle.with_values({"output.frames": frames}))
    _, left, right = drawn(result)
    known = dict(zip(result.time, result.length, strict=True))
    start, end = left.get_xlim()
    line = right.lines[0].get_xydata()
    for (first, _), (second, _) in zip(line, line[1:], strict=False):
        if np.isfinite(first + second):
            assert np.log(second / first) <= CLOSE * np.log(end / start)
    marks = points(right, "o")
    shown = np.concatenate([line[np.isfinite(line[:, 0])], marks])
    assert all(known[time] == length for time, length in shown)
    assert set(shown[:, 0]) == set(result.time[1:])
    # A frame that is joined to none would not be seen without a mark.
    assert len(marks) == {2: 2, 5: 5, 200: 3}[frames]


def test_a_short_run_has_a_linear_axis_and_marks_at_few_frames(circle: cf.Scene):
    result = cf.run(circle.with_values({"time.end": 1e-5, "output.frames": 2}))
    figure, left, right = drawn(result)
    assert left.get_xscale() == "linear"
    np.testing.assert_array_equal(points(right, "o"), np.stack([result.time, result.length], axis=1))
    assert not len(points(left, "o", "white"))
    # Numbers that differ in their last digits have the first ones above the axis, where the legend is not.
    offset = left.yaxis.get_offset_text()
    assert offset.get_text()
    assert not left.get_legend().get_window_extent().overlaps(offset.get_window_extent())


def test_a_run_that_has_not_started_can_be_drawn(circle: cf.Scene):
    result = cf.Simulation(circle).result()
    _, _, right = drawn(result)
    np.testing.assert_array_equal(points(right, "o"), [[0.0, result.length[0]]])


def test_the_energy_has_the_axis_of_the_command(membrane: cf.Result, circle: cf.Scene):
    assert drawn(membrane)[1].get_yscale() == "log"
    assert drawn(cf.run(circle))[1].get_yscale() == "linear"
    for values, scale in (([1.0, 19.0], "linear"), ([1.0, 21.0], "log"), ([-1.0, 100.0], "linear"), ([0.0], "linear")):
        axes = Figure().subplots()
        fit(axes, "y", np.array(values))
        assert axes.get_yscale() == scale
        assert axes.get_ylim()[0] < min(values) <= max(values) < axes.get_ylim()[1]


def test_what_is_known_last_before_an_axis_stands_at_its_edge():
    time, values = from_start(np.array([0.0, 1.0, 2.0, 3.0]), np.arange(4.0), 1.5)
    np.testing.assert_array_equal(time, [1.5, 2.0, 3.0])
    np.testing.assert_array_equal(values, [1.0, 2.0, 3.0])


@pytest.mark.parametrize("start", [1e-30, 1e-8, 0.0172, 0.03, 0.5, 7.0, 2e9])
@pytest.mark.parametrize("decades", [0.7, 1.0, 1.25, 1.5, 1.9, 2.0, 2.5, 4.0, 9.0, 25.0])
def test_labels_of_logarithmic_axes_can_be_read(start: float, decades: float):
    figure = Figure(figsize=(3, 2))
    axes = figure.subplots()
    logarithmic(axes, "x", start, start * 10**decades)
    figure.draw_without_rendering()
    low, high = axes.get_xlim()
    both = axes.get_xticklabels(), axes.get_xticklabels(minor=True)
    labels = [text for texts in both for text in texts if text.get_text() and low <= text.get_position()[0] <= high]
    assert 2 <= len(labels)
    boxes = sorted((text.get_window_extent() for text in labels), key=lambda box: box.x0)
    for box, following in zip(boxes, boxes[1:], strict=False):
        assert box.x1 + 2 < following.x0
