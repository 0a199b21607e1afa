import io
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import curveflow as cf
from curveflow.running import Line

INTERRUPTED = """
import sys
import curveflow as cf
scene = cf.Scene.load(sys.argv[1])
def started(progress):
    if progress.steps == 1:
        print("started", flush=True)
result = cf.run(scene, callback=started, progress=True)
assert not result.success
result.save(sys.argv[2])
print(result.status, flush=True)
"""


def test_the_circle_follows_its_radius_law(circle: cf.Scene):
    result = cf.run(circle)
    assert (result.success, result.status) == (True, "end-time")
    np.testing.assert_allclose(result.length, 2 * np.pi * (1 + 2 * result.time) ** 0.25, rtol=1e-3)
    assert result.scene is circle
    assert not result.density


def test_a_callback_sees_every_step(circle: cf.Scene):
    seen: list[cf.Progress] = []
    result = cf.run(circle, callback=seen.append)
    np.testing.assert_array_equal([progress.time for progress in seen], result.steps["time"])
    np.testing.assert_array_equal([progress.energy for progress in seen], result.steps["energy"])
    assert [progress.steps for progress in seen] == list(range(1, len(seen) + 1))


def test_a_callback_can_stop_the_run(circle: cf.Scene):
    def stop(progress: cf.Progress) -> None:
        if progress.steps == 3:
            raise StopIteration

    result = cf.run(circle, callback=stop)
    assert (result.success, result.status) == (False, "interrupted")
    assert result.stats["steps"] == 3
    assert result.time[-1] == result.steps["time"][-1] < 1.0


def test_errors_of_a_callback_are_passed_on(circle: cf.Scene):
    def fail(_: cf.Progress) -> None:
        raise ZeroDivisionError("mine")

    with pytest.raises(ZeroDivisionError, match="mine"):
        cf.run(circle, callback=fail)


def test_a_signal_keeps_the_partial_result(endless: cf.Scene):
    raised_at = 0.0

    def interrupt() -> None:
        nonlocal raised_at
        time.sleep(0.5)
        raised_at = time.monotonic()
        signal.raise_signal(signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    result = cf.run(endless)
    stopped_at = time.monotonic()
    thread.join()
    assert result.status == "interrupted"
    assert stopped_at - raised_at < 1.0
    assert len(result.time) >= 2
    assert result.time[-1] == result.steps["time"][-1]


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no SIGINT to a single process")
def test_ctrl_c_keeps_the_partial_result(endless: cf.Scene, tmp_path: Path):
    scene, out = tmp_path / "scene.toml", tmp_path / "out.h5"
    scene.write_text(endless.text)
    command = [sys.executable, "-c", INTERRUPTED, str(scene), str(out)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout and process.stdout.readline() == "started\n"
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=30)
    assert (process.returncode, stdout) == (0, "interrupted\n"), stderr
    assert "Traceback" not in stderr
    assert cf.open(out).status == "interrupted"


def test_other_threads_go_on(endless: cf.Scene):
    ticks = 0
    running = True

    def count() -> None:
        nonlocal ticks
        while running:
            time.sleep(0.01)
            ticks += 1

    def stop(progress: cf.Progress) -> None:
        if time.monotonic() > end:
            raise StopIteration

    thread = threading.Thread(target=count)
    thread.start()
    end = time.monotonic() + 0.5
    cf.run(endless, callback=stop)
    running = False
    thread.join()
    assert ticks >= 10


def test_runs_in_threads_agree(circle: cf.Scene):
    results: list[cf.Result] = []
    threads = [threading.Thread(target=lambda: results.append(cf.run(circle))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 4
    for result in results:
        np.testing.assert_array_equal(result.energy, results[0].energy)


def test_progress_ends_with_the_outcome(circle: cf.Scene, capsys: pytest.CaptureFixture[str]):
    result = cf.run(circle, progress=True)
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err == f"{result.message} (t = 1, {result.stats['steps']} steps)\n"


@pytest.fixture(scope="module")
def coarse() -> cf.Scene:
    """A scene whose nodes are too few for its fronts: it comes to its end, and means little."""
    return cf.Scene.shipped("three_fold_sharp").with_values({"accuracy.nodes": 64, "accuracy.tolerance": 1e-3})


def test_a_doubtful_result_looks_doubtful(coarse: cf.Scene, circle: cf.Scene, capsys: pytest.CaptureFixture[str]):
    result = cf.run(coarse, progress=True)
    (warning,) = result.warnings
    assert result.success and "were not resolved by their nodes" in warning
    assert capsys.readouterr().err.splitlines()[1:] == [f"warning: {warning}"]
    assert repr(result).endswith("64 nodes; 1 warning, see result.warnings>")
    assert f"warning: {warning.split(',')[0]}" in result._repr_html_()
    why = result.why_slow()
    assert "a larger accuracy.tolerance" not in why.advice
    good = cf.run(circle)
    assert "warning" not in repr(good) + good._repr_html_()


class Broken(io.StringIO):
    """A terminal whose reader has gone."""

    def isatty(self) -> bool:
        return True

    def write(self, _: str) -> int:
        raise BrokenPipeError(32, "Broken pipe")


def closed() -> io.StringIO:
    stream = io.StringIO()
    stream.close()
    return stream


@pytest.mark.parametrize("stream", [Broken(), closed(), None], ids=["broken", "closed", "none"])
def test_progress_that_cannot_be_shown_is_dropped(
    circle: cf.Scene, stream: io.StringIO | None, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(Line, "show", lambda line, progress: line.write(str(progress)))
    assert cf.run(circle, progress=True).success
    assert cf.run(circle, progress=True, callback=lambda _: None).success
    simulation = cf.Simulation(circle)
    assert not simulation.run(progress=True) and simulation.status == "end-time"
    assert cf.tradeoff(circle, [1e-2], progress=True).failures == [None]
