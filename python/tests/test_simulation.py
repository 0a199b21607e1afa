import copy
import math
import pickle
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import curveflow as cf


@pytest.fixture
def scene() -> cf.Scene:
    return cf.Scene.shipped("three_fold").with_values({"accuracy.nodes": 128, "time.end": 0.05})


def raising(error: type[BaseException], step: int) -> Callable[[cf.Progress | cf.Simulation], None]:
    def callback(now: cf.Progress | cf.Simulation) -> None:
        if now.steps == step:
            raise error

    return callback


def test_steps_make_the_run(scene: cf.Scene):
    whole = cf.run(scene)
    simulation = cf.Simulation(scene)
    assert (simulation.time, simulation.steps, simulation.done, simulation.status) == (0.0, 0, False, None)
    while simulation.step():
        pass
    assert simulation.done and simulation.status == "end-time"
    assert not simulation.step()
    result = simulation.result()
    np.testing.assert_array_equal(result.energy, whole.energy)
    np.testing.assert_array_equal(result.position, whole.position)
    assert (result.status, result.stats["steps"]) == ("end-time", whole.stats["steps"])
    assert result.scene is simulation.scene is scene


def test_it_stops_where_it_is_asked_to(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    assert simulation.run(until=0.01)
    assert simulation.time == 0.01
    state = simulation.state
    assert state.time == 0.01
    assert state.position.shape == (128, 2) and state.density["protein"].shape == (128,)
    assert state.length == pytest.approx(state.metric.mean())
    partial = simulation.result()
    assert (partial.status, partial.time[-1], partial.energy[-1]) == ("interrupted", 0.01, state.energy)
    assert not simulation.run()
    assert simulation.time == 0.05
    assert cf.run(scene).energy[-1] == pytest.approx(simulation.state.energy, rel=1e-5)


@pytest.mark.parametrize("content", [b"", b"[curve]\nshape = 'circle'\n", b"\x89HDF\r\n\x1a\n"])
def test_a_checkpoint_replaces_checkpoints_only(scene: cf.Scene, tmp_path: Path, content: bytes):
    simulation, path = cf.Simulation(scene), tmp_path / "file"
    path.write_bytes(content)
    with pytest.raises(cf.StorageError, match="already exists.*replace=True"):
        simulation.checkpoint(path)
    assert path.read_bytes() == content
    simulation.checkpoint(path, replace=True)
    assert cf.Simulation.resume(path).steps == 0


def test_a_checkpoint_goes_on_to_the_same_bits(scene: cf.Scene, tmp_path: Path):
    whole = cf.run(scene)
    simulation = cf.Simulation(scene)
    for _ in range(17):
        simulation.step()
    path = tmp_path / "checkpoint"
    simulation.checkpoint(path)
    resumed = cf.Simulation.resume(path)
    assert resumed.steps == 17 and resumed.scene.text == scene.text
    assert not resumed.run()
    np.testing.assert_array_equal(resumed.result().position, whole.position)
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(cf.StorageError, match="damaged"):
        cf.Simulation.resume(path)
    simulation.checkpoint(path)  # one that is damaged, too, is replaced
    assert cf.Simulation.resume(path).steps == 17
    with pytest.raises(cf.StorageError, match="cannot read"):
        cf.Simulation.resume(tmp_path / "none")


def test_callbacks_come_at_their_times(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    times: list[float] = []
    steps: list[int] = []
    simulation.add_callback(lambda now: times.append(now.time), interval=0.01)
    simulation.add_callback(lambda now: steps.append(now.steps), steps=50)
    simulation.run()
    assert times == [k * 0.01 for k in range(1, 6)]
    assert steps == list(range(50, simulation.steps + 1, 50))
    with pytest.raises(ValueError, match="either"):
        simulation.add_callback(print)
    with pytest.raises(ValueError, match="positive"):
        simulation.add_callback(print, interval=math.inf)
    with pytest.raises(ValueError, match="at least 1"):
        simulation.add_callback(print, steps=0)
    with pytest.raises(TypeError, match="cannot be called"):
        simulation.add_callback(3, steps=1)
    with pytest.raises(TypeError):
        simulation.add_callback(print, steps=2.5)
    with pytest.raises(ValueError, match="until"):
        simulation.run(until=math.nan)


@pytest.mark.parametrize(("interval", "pieces"), [(0.1, [0.3, 0.7]), (0.3, [0.9]), (0.05, [0.15, 0.35, 1.1])])
def test_multiples_of_an_interval_are_times_but_for_rounding(interval: float, pieces: list[float]):
    scene = cf.Scene.shipped("circle").with_values({"time.end": 1.2})
    simulation = cf.Simulation(scene)
    seen: list[float] = []
    simulation.add_callback(lambda now: seen.append(now.time), interval=interval)
    for until in pieces:
        assert simulation.run(until=until) and simulation.time == until
    assert not simulation.run() and simulation.status == "end-time"
    np.testing.assert_allclose(seen, interval * np.arange(1, round(1.2 / interval) + 1), rtol=1e-9)
    assert simulation.result().steps["size"].min() > 1e-9 * interval


def test_a_time_within_rounding_of_the_present_one_takes_no_step():
    simulation = cf.Simulation(cf.Scene.shipped("three_fold"))
    for until in (1e-310, 0.1, 0.3, 0.1 * 3, math.nextafter(0.3, 1), 0.3 * (1 + 1e-15), 0.4):
        assert simulation.run(until=until), simulation.status
    assert simulation.time == 0.4
    assert simulation.result().steps["size"].min() > 1e-14


def test_callbacks_that_are_due_with_one_that_stops_are_called(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    seen: list[float] = []

    def stop(_: cf.Simulation) -> None:
        raise StopIteration

    simulation.add_callback(stop, interval=0.02)
    simulation.add_callback(lambda now: seen.append(now.time), interval=0.01)
    while simulation.run():
        pass
    np.testing.assert_allclose(seen, [0.01, 0.02, 0.03, 0.04, 0.05])


def test_the_progress_callback_stops_a_run_with_a_schedule(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    seen: list[int] = []
    simulation.add_callback(lambda now: seen.append(now.steps), steps=1)

    assert simulation.run(callback=raising(StopIteration, 3))
    assert (simulation.steps, seen) == (3, [1, 2, 3])


def test_a_simulation_that_is_over_stays_so(tmp_path: Path):
    for values in [{}, {"time.stop_at_equilibrium": True, "time.end": 1e6}]:
        simulation = cf.Simulation(cf.Scene.shipped("figure_eight").with_values({"time.end": 0.01, **values}))
        simulation.run()
        simulation.checkpoint(tmp_path / "checkpoint")
        resumed = cf.Simulation.resume(tmp_path / "checkpoint")
        assert resumed.done and resumed.status == simulation.status
        assert not resumed.run() and not resumed.step()
        assert (resumed.steps, resumed.time) == (simulation.steps, simulation.time)
        np.testing.assert_array_equal(resumed.result().position, simulation.result().position)


def test_states_and_results_travel_between_processes(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    simulation.step()
    state = pickle.loads(pickle.dumps(simulation.state))
    np.testing.assert_array_equal(state.density["protein"], simulation.state.density["protein"])
    assert (state.time, state.energy) == (simulation.time, simulation.state.energy)
    assert not state.position.flags.writeable and not state.density["protein"].flags.writeable
    result = simulation.result()
    other = copy.deepcopy(result)
    np.testing.assert_array_equal(other.position, result.position)
    assert (other.status, other.scene) == (result.status, result.scene)


def test_a_callback_stops_the_run_and_it_goes_on(scene: cf.Scene):
    simulation = cf.Simulation(scene)

    simulation.add_callback(raising(StopIteration, 20), steps=10)
    assert simulation.run()
    assert simulation.steps == 20
    assert not simulation.run()


def test_the_progress_callback_cannot_use_the_simulation(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    with pytest.raises(RuntimeError, match="in use"):
        simulation.run(callback=lambda _: simulation.step())
    assert simulation.steps == 1
    assert simulation.step()


def test_ctrl_c_leaves_a_simulation_that_goes_on(endless: cf.Scene):
    simulation = cf.Simulation(endless)
    timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
    timer.start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    assert time.monotonic() - started < 1.5
    timer.join()
    steps = simulation.steps
    assert simulation.step() and simulation.steps == steps + 1
    # No loop around short runs, and no schedule, can keep it.
    simulation.add_callback(lambda _: None, steps=1)
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while simulation.run(until=simulation.time + 1e-6, callback=lambda _: None):
            pass
    timer.join()
    assert not simulation.done


def test_no_call_is_lost_and_none_comes_twice(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    steps: list[int] = []
    simulation.add_callback(lambda now: steps.append(now.steps), steps=1)

    interrupt = raising(KeyboardInterrupt, 3)
    with pytest.raises(KeyboardInterrupt):
        simulation.run(callback=interrupt)
    assert simulation.steps == 3
    simulation.step()  # which calls nothing, and leaves nothing due
    simulation.run(until=simulation.time * 1.5)
    assert steps == [1, 2, *range(5, simulation.steps + 1)]
    simulation = cf.Simulation(scene)
    steps.clear()
    simulation.add_callback(lambda now: steps.append(now.steps), steps=1)
    with pytest.raises(KeyboardInterrupt):
        simulation.run(callback=interrupt)
    simulation.run()
    assert steps == list(range(1, simulation.steps + 1))


@pytest.mark.parametrize(("end", "interval", "count"), [(0.1 * 3, 0.3, 1), (0.8, 0.1, 8), (0.1, 0.01, 10)])
def test_each_multiple_is_met_once(end: float, interval: float, count: int):
    for piece in (math.inf, interval):
        simulation = cf.Simulation(cf.Scene.shipped("circle").with_values({"time.end": end}))
        seen: list[float] = []
        simulation.add_callback(lambda now: seen.append(now.time), interval=interval)
        while simulation.run(until=simulation.time + piece):
            pass
        np.testing.assert_allclose(seen, interval * np.arange(1, count + 1))
    with pytest.raises(ValueError, match="rounding of the time"):
        simulation.add_callback(print, interval=1e-310)


def test_the_arrays_of_a_state_are_its_own(scene: cf.Scene):
    simulation = cf.Simulation(scene)
    simulation.step()
    state = simulation.state
    arrays = [state.position, state.curvature, state.metric, state.normal_velocity, state.density["protein"]]
    for array in arrays:
        # The buffer is one of the core that the array took over: no array stands behind it, and nobody can write to it.
        assert not array.flags.owndata and not array.flags.writeable and array.flags.c_contiguous
    position = arrays[0].base
    assert isinstance(position, np.ndarray) and not isinstance(position.base, np.ndarray)
    before = [array.copy() for array in arrays]
    simulation.step()
    assert all(np.array_equal(a, b) for a, b in zip(arrays, before))
    assert not np.array_equal(simulation.state.position, before[0])
    assert not any(np.shares_memory(a, b) for i, a in enumerate(arrays) for b in arrays[:i])


def test_what_cannot_be_copied_says_so():
    for thing in (cf.Simulation(cf.Scene.shipped("circle")), cf.System(cf.Scene.shipped("circle"))):
        for way in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="cannot be copied or pickled"):
                way(thing)
