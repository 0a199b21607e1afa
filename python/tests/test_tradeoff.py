import copy
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import curveflow as cf
from curveflow import _curveflow, ladder, running

LADDER = [1e-5, 1e-2, 1e-3]

INTERRUPTED = """
import curveflow as cf
scene = cf.Scene.shipped("three_fold_sharp").with_values({"time.stop_at_equilibrium": False, "time.end": 1e6})
print("started", flush=True)
try:
    cf.tradeoff(scene.with_values({"accuracy.tolerance": 1e-9}))
except KeyboardInterrupt as stop:
    print(stop, flush=True)
"""


@pytest.fixture(scope="module")
def measured() -> cf.Tradeoff:
    return cf.tradeoff(cf.Scene.shipped("three_fold").with_values({"accuracy.nodes": 512}), LADDER)


def test_arrays_have_an_entry_per_run(measured: cf.Tradeoff):
    np.testing.assert_array_equal(measured.tolerance, [1e-2, 1e-3, 1e-5])
    assert list(measured.errors) == ["curve", "curvature", "protein", "energy", "length"]
    for array in (measured.tolerance, measured.error, measured.seconds):
        assert array.shape == (3,) and array.dtype == np.float64 and not array.flags.writeable
    for array in (measured.nodes, measured.steps):
        assert array.shape == (3,) and array.dtype == np.uint64
    for name, errors in measured.errors.items():
        assert errors.shape == (2, 3), name
        assert (errors <= measured.error).all(), name
    assert (np.diff(measured.error) < 0).all()
    assert (measured.nodes == 512).all()
    assert measured.failures == [None] * 3
    assert not measured.interrupted and not measured.includes_space
    assert measured.ending == "equilibrium" and 0 < measured.times[0] < measured.times[1]
    assert measured.reference[:3] == (1e-7, False, 512)
    assert repr(measured) == "<Tradeoff 'Three-fold protein membrane': 3 of 3 runs measured>"


def test_errors_are_those_of_single_runs(circle: cf.Scene):
    measured = cf.tradeoff(circle, [1e-3])
    result = cf.run(circle.with_values({"accuracy.tolerance": 1e-3}))
    assert measured.steps[0] == result.stats["steps"]
    true = abs(result.length[-1] / (2 * np.pi * 3**0.25) - 1)
    assert 0.5 < measured.errors["length"][1, 0] / true < 2


def test_the_cheapest_setting_is_named(measured: cf.Tradeoff):
    setting = measured.cheapest(1e-4)
    assert setting is not None
    assert (setting.tolerance, setting.nodes) == (1e-5, 512)
    assert setting.error == measured.error[2] <= 1e-4
    assert measured.cheapest(1e-15) is None


def test_more_nodes_in_the_reference_add_the_error_of_space(circle: cf.Scene):
    measured = cf.tradeoff(circle, (1e-3,), reference_nodes=64)
    assert measured.includes_space and measured.reference.nodes == 64


def test_a_bad_ladder_says_why(circle: cf.Scene):
    with pytest.raises(cf.LadderError, match="1e-12, number 2 of the list, must be between 1e-10") as raised:
        cf.tradeoff(circle, [1e-3, 1e-12])
    assert isinstance(raised.value, ValueError)
    with pytest.raises(cf.LadderError, match="the reference has 16 nodes, but a run that it measures 32"):
        cf.tradeoff(circle, [1e-3], reference_nodes=16)
    for nodes in (-1, 7, 2**70):
        with pytest.raises(cf.LadderError, match=f"the reference cannot have {nodes} nodes"):
            cf.tradeoff(circle, [1e-3], reference_nodes=nodes)
    for wrong in ("x", None):
        with pytest.raises(cf.LadderError, match=f"tolerance {wrong!r} is no number"):
            cf.tradeoff(circle, [1e-2, wrong])  # type: ignore[list-item]
    with pytest.raises(cf.TradeoffError, match=r"(?s)its own tolerance 1e-4.*time\.max_steps"):
        cf.tradeoff(circle.with_values({"time.max_steps": 3}))
    with pytest.raises(cf.SetupError, match="initial"):
        cf.tradeoff(cf.Scene.shipped("three_fold").with_values({"density.protein.initial": "ln(s)"}))


def test_the_figure_has_both_times(measured: cf.Tradeoff):
    figure = measured.plot(Figure())
    assert len(figure.axes) == 2
    for axes in figure.axes:
        assert [line.get_label() for line in axes.lines if line.get_marker() == "o"] == list(measured.errors)
        assert [text.get_text() for text in axes.texts] == ["0.01", "0.001", "1e-05"]
    figure.draw_without_rendering()


@pytest.mark.parametrize("tolerances", [[1e-3, 1e-5], [1e-3]])
def test_the_figure_shows_every_run_at_both_times(tolerances: list[float]):
    measured = cf.tradeoff(cf.Scene.shipped("three_fold").with_values({"accuracy.nodes": 512}), tolerances)
    figure = measured.plot(Figure(figsize=(11, 5), layout="constrained"))
    figure.draw_without_rendering()
    assert [axes.get_title()[:8] for axes in figure.axes] == ["half of ", "at rest,"]
    for time, axes in enumerate(figure.axes):
        (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
        worst = max(errors[time].max() for errors in measured.errors.values())
        assert bottom < worst < top
        assert left < measured.seconds.min() <= measured.seconds.max() < right
        frame = axes.get_window_extent()
        for text in axes.texts:
            box = text.get_window_extent()
            assert frame.x0 < box.x0 and box.x1 < frame.x1 and frame.y0 < box.y0 and box.y1 < frame.y1
        labels = [label for label in axes.get_xticklabels() + axes.get_xticklabels(minor=True) if label.get_text()]
        shown = [label for label in labels if left <= label.get_position()[0] <= right]
        boxes = sorted((label.get_window_extent() for label in shown), key=lambda box: box.x0)
        assert len(boxes) >= 2
        assert all(box.x1 < following.x0 for box, following in zip(boxes, boxes[1:], strict=False))


def test_what_the_flow_keeps_has_no_key(circle: cf.Scene):
    measured = cf.tradeoff(circle, [1e-3, 1e-4])
    zero = {name for name, errors in measured.errors.items() if not (errors > 0).any()}
    legend = measured.plot(Figure()).axes[0].get_legend()
    assert legend is not None
    assert {text.get_text() for text in legend.get_texts()} == set(measured.errors) - zero


def test_ladders_can_be_kept(measured: cf.Tradeoff, circle: cf.Scene):
    def interrupt(name: str, tolerance: float, number: int, count: int) -> None:
        if number == 2:
            signal.raise_signal(signal.SIGINT)

    native = _curveflow.tradeoff(circle._native, [1e-2, 1e-3, 1e-4], None, interrupt, None, 0.0)
    for ladder in (measured, cf.Tradeoff(native)):
        assert ladder.error.shape == (3,)
        for again in (pickle.loads(pickle.dumps(ladder)), copy.copy(ladder), copy.deepcopy(ladder)):
            assert repr(again) == repr(ladder)
            for name in ("tolerance", "error", "nodes", "steps", "seconds"):
                np.testing.assert_array_equal(getattr(again, name), getattr(ladder, name))
                assert not getattr(again, name).flags.writeable
            assert list(again.errors) == list(ladder.errors)
            for name, errors in ladder.errors.items():
                np.testing.assert_array_equal(again.errors[name], errors)
            for name in ("title", "times", "ending", "reference", "includes_space", "interrupted", "failures"):
                assert getattr(again, name) == getattr(ladder, name), name
            assert again.cheapest(1e-2) == ladder.cheapest(1e-2)
    assert cf.Tradeoff(native).failures[1:] == ["interrupted before the run was complete"] * 2


def test_parts_of_no_ladder_are_refused(measured: cf.Tradeoff):
    parts = list(measured._native.__getnewargs__())
    assert _curveflow.Tradeoff(*parts).title == measured.title
    with pytest.raises(ValueError, match='no ladder ends at "never"'):
        _curveflow.Tradeoff(*parts[:2], (0.5, 1.0, "never"), *parts[3:])
    with pytest.raises(ValueError, match="1 errors: a run has 4, and one per density"):
        _curveflow.Tradeoff(*parts[:4], [(1e-3, 32, 9, 1.0, [[0.1], [0.1]])], *parts[5:])


def test_the_figure_of_the_command_can_be_written(measured: cf.Tradeoff, tmp_path: Path):
    path = tmp_path / "ladder.png"
    measured.picture(path)
    assert path.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(cf.StorageError, match=r"ladder\.png: already exists"):
        measured.picture(path)
    pickle.loads(pickle.dumps(measured)).picture(path, replace=True)
    measured.picture(tmp_path / "ladder.svg")
    assert "Three-fold protein membrane" in (tmp_path / "ladder.svg").read_text(encoding="utf-8")
    with pytest.raises(cf.StorageError, match=r"ends in \.png or \.svg"):
        measured.picture(tmp_path / "ladder.pdf")


def test_progress_names_the_run(circle: cf.Scene, monkeypatch: pytest.MonkeyPatch):
    heads: list[str] = []

    class Recorder(running.Line):
        def __setattr__(self, name: str, value: object) -> None:
            if name == "head" and value:
                heads.append(str(value))
            super().__setattr__(name, value)

    monkeypatch.setattr(ladder, "Line", Recorder)
    cf.tradeoff(circle, [1e-2], progress=True)
    assert "the scout, tolerance 0.0001: " in heads
    assert "the reference, tolerance 0.0001: " in heads
    assert "run 1 of 1, tolerance 0.01: " in heads


def test_ctrl_c_keeps_the_complete_runs(circle: cf.Scene):
    def interrupt(name: str, tolerance: float, number: int, count: int) -> None:
        if number == 2:
            signal.raise_signal(signal.SIGINT)

    native = _curveflow.tradeoff(circle._native, [1e-2, 1e-3, 1e-4], None, interrupt, None, 0.0)
    measured = cf.Tradeoff(native)
    assert measured.interrupted
    np.testing.assert_array_equal(np.isnan(measured.error), [False, True, True])
    np.testing.assert_array_equal(np.isnan(measured.errors["curve"][1]), [False, True, True])
    assert measured.failures[0] is None and "interrupted" in str(measured.failures[1])
    assert measured.cheapest(1.0) is not None
    assert len(measured.plot(Figure()).axes) == 2


def test_errors_of_a_callback_are_passed_on(circle: cf.Scene):
    def fail(*_: object) -> None:
        raise ZeroDivisionError("mine")

    for before_run, callback in ((fail, None), (None, fail)):
        with pytest.raises(ZeroDivisionError, match="mine"):
            _curveflow.tradeoff(circle._native, [1e-2], None, before_run, callback, 0.0)


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no SIGINT to a single process")
def test_ctrl_c_before_the_reference_is_complete_raises():
    command = [sys.executable, "-c", INTERRUPTED]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout and process.stdout.readline() == "started\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=30)
    assert process.returncode == 0, stderr
    assert "nothing is measured yet" in stdout


def test_ladders_in_threads_agree():
    results: list[cf.Tradeoff] = []
    scene = cf.Scene.shipped("three_fold")
    threads = [threading.Thread(target=lambda: results.append(cf.tradeoff(scene, [1e-3]))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    first, second = results
    np.testing.assert_array_equal(first.error, second.error)


def test_errors_below_the_axis_are_marked(circle: cf.Scene):
    measured = cf.tradeoff(circle, [1e-2])
    least = 1e-3 * measured.reference.tolerance
    measured.__dict__["errors"] = {
        name: least * np.array([[number], [2.0]]) for number, name in enumerate(measured.errors, start=1)
    }
    figure = measured.plot(Figure())
    figure.draw_without_rendering()
    for axes in figure.axes:
        marks = [line for line in axes.lines if line.get_marker() == "v"]
        assert len(marks) == 4 and len({float(mark.get_ydata()[0]) for mark in marks}) == 4
    legend = figure.axes[0].get_legend()
    assert legend is not None and "smaller" in [text.get_text() for text in legend.get_texts()]
