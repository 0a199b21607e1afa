import copy
import pickle
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import curveflow as cf


def test_shipped_scenes_can_be_parsed():
    assert "three_fold" in cf.scenes()
    for name in cf.scenes():
        assert cf.Scene.shipped(name).title


def test_an_unknown_shipped_scene_names_those_there_are():
    with pytest.raises(cf.SceneError, match="'threefold'.*three_fold, "):
        cf.Scene.shipped("threefold")


def test_a_typo_is_reported_with_key_and_line(tmp_path: Path, circle: cf.Scene):
    path = tmp_path / "typo.toml"
    path.write_text(circle.text.replace("energy.bending = { rigidity", "energy.bending = { rigidty"))
    with pytest.raises(cf.SceneError, match=r"(?s)typo\.toml.*line 4.*rigidty.*did you mean `rigidity`") as raised:
        cf.Scene.load(path)
    assert isinstance(raised.value, ValueError)
    assert isinstance(raised.value, cf.CurveflowError)


def test_a_missing_file_is_named(tmp_path: Path):
    with pytest.raises(cf.SceneError, match=r"(?s)none\.toml.*No such file"):
        cf.Scene.load(tmp_path / "none.toml")


def test_values_can_be_changed(circle: cf.Scene):
    changed = circle.with_values(
        {
            "title": 'A "quoted" title',
            "accuracy.tolerance": np.float64(1e-3),
            "accuracy.nodes": 64,
            "time.stop_at_equilibrium": True,
        }
    )
    assert changed.title == 'A "quoted" title'
    for line in ("tolerance = 0.001", "nodes = 64", "stop_at_equilibrium = true"):
        assert line in changed.to_toml()
    assert circle.title == "Circle"


def test_none_takes_a_key_out():
    scene = cf.Scene.shipped("three_fold").with_values(
        {"output.frames": None, "output.spacing": None, "output.times": [0.1, 0.2]}
    )
    assert scene.output.times == (0.1, 0.2)
    with pytest.raises(cf.SceneError, match=r"output\.frmes.*not there"):
        scene.with_values({"output.frmes": None})


def test_values_reach_densities_by_name():
    scene = cf.Scene.shipped("three_fold").with_values({"density.protein.initial": "0.5 + 0.1*cos(2*pi*s)"})
    assert 'initial = "0.5 + 0.1*cos(2*pi*s)"' in scene.to_toml()


def test_a_changed_value_out_of_range_is_reported(circle: cf.Scene):
    with pytest.raises(cf.SceneError, match="accuracy.tolerance.*-1"):
        circle.with_values({"accuracy.tolerance": -1.0})
    with pytest.raises(TypeError, match="accuracy.tolerance: complex"):
        circle.with_values({"accuracy.tolerance": 1j})


def test_scenes_compare_by_meaning_and_can_be_pickled(circle: cf.Scene):
    again = cf.Scene.parse(circle.to_toml())
    assert again == circle
    assert hash(again) == hash(circle)
    other = pickle.loads(pickle.dumps(circle))
    assert other == circle
    assert other.text == circle.text
    assert "Circle" in repr(circle)
    assert circle != circle.with_values({"accuracy.nodes": 64})


def test_a_scene_that_makes_no_state_is_a_setup_error():
    scene = cf.Scene.shipped("three_fold").with_values({"density.protein.initial": "ln(s)"})
    with pytest.raises(cf.SetupError, match=r"density\.protein\.initial.*-inf at node 0"):
        cf.run(scene)


def test_the_points_of_a_scene_do_not_change_with_their_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    phi = np.linspace(0, 2 * np.pi, 64, endpoint=False)

    def write(name: str, half_width: float) -> None:
        np.savetxt(tmp_path / name, np.stack([half_width * np.cos(phi), np.sin(phi)], axis=1))

    write("ring.txt", 1.5)
    scene = cf.Scene(curve=cf.Points(file="ring.txt"), energy=[cf.Bending(1.0)], time=cf.Time(0.01))
    pickled = pickle.dumps(scene)
    write("ring.txt", 3.0)
    write("other.txt", 2.0)
    for same in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickled)):
        assert same == scene
    assert scene.with_values({"time.end": 0.02}).curve == scene.curve
    other = scene.with_values({"curve.file": "other.txt"}).curve
    assert isinstance(other, cf.Points) and other.points[0] == (2.0, 0.0)
    chained = pickle.loads(pickled).with_values({"time.end": 0.02}).with_values({"curve.file": "other.txt"})
    assert chained.curve == other
    (tmp_path / "ring.txt").unlink()
    assert copy.deepcopy(scene) == scene


def test_what_is_no_scene_is_refused():
    for call in (cf.run, cf.Simulation, cf.System, cf.tradeoff):
        with pytest.raises(TypeError, match=r"'three_fold'.*Scene\.load.*Scene\.shipped"):
            call("three_fold")  # type: ignore[arg-type,operator]


def test_values_can_be_nested(circle: cf.Scene):
    nested = circle.with_values({"accuracy": {"tolerance": 1e-3}, "output": {"frames": None, "times": [0.5]}})
    flat = {"accuracy.tolerance": 1e-3, "output.frames": None, "output.times": [0.5]}
    assert nested == circle.with_values(flat)
    assert nested.accuracy.nodes == circle.accuracy.nodes == 32
    protein = cf.Scene.shipped("three_fold").with_values({"density": {"protein": {"initial": 0.5}}})
    assert protein.density[0].initial == 0.5
    with pytest.raises(TypeError, match=r"accuracy\.tolerance: complex"):
        circle.with_values({"accuracy": {"tolerance": 1j}})


def test_nested_points_are_those_of_another_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    phi = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    np.savetxt(tmp_path / "ring.txt", np.stack([2 * np.cos(phi), np.sin(phi)], axis=1))
    points = cf.Points(np.stack([np.cos(phi), np.sin(phi)], axis=1))
    scene = cf.Scene(curve=points, energy=[cf.Bending(1.0)], time=cf.Time(0.01))
    assert scene.with_values({"curve": {"file": "ring.txt"}}) == scene.with_values({"curve.file": "ring.txt"}) != scene


@pytest.mark.parametrize("values", [None, 3, "accuracy", [("accuracy.tolerance", 1e-3)]])
def test_values_that_are_no_mapping_are_refused(circle: cf.Scene, values: Any):
    with pytest.raises(TypeError, match=r'must map keys to values: {"accuracy\.tolerance"'):
        circle.with_values(values)


def test_keys_are_refused_as_they_are(circle: cf.Scene):
    with pytest.raises(TypeError, match="the key 3 is no text"):
        circle.with_values({3: 3})  # type: ignore[dict-item]
    for key in ("accuracy.tolerance ", " accuracy.tolerance", "accuracy .tolerance"):
        with pytest.raises(cf.SceneError, match=f"`{key}` cannot be set: the key has a blank in it"):
            circle.with_values({key: 1e-3})


def test_what_is_no_result_has_no_scene():
    with pytest.raises(TypeError, match=r"result is None, but it must be a curveflow\.Result"):
        cf.Scene.of(None)  # type: ignore[arg-type]


def test_a_scene_can_be_taken_apart(circle: cf.Scene):
    parts = asdict(circle)
    assert parts["accuracy"] == asdict(circle.accuracy)
    assert (parts["title"], parts["curve"]["radius"], parts["energy"][0]["rigidity"]) == ("Circle", 1.0, 1.0)
    assert list(parts) == ["title", "curve", "density", "energy", "flow", "time", "accuracy", "output"]
    assert replace(circle, title="Other").title == "Other"


HALF = "a\ud800"


@pytest.mark.parametrize(
    "call",
    [
        lambda scene: replace(scene, title=HALF),
        lambda scene: replace(scene, curve=cf.Points(file=HALF)),
        lambda scene: scene.with_values({"title": HALF}),
        lambda scene: scene.with_values({HALF: 1}),
        lambda scene: scene.with_values({"flow": {HALF: 1}}),
        lambda _: cf.Scene.parse(HALF),
        lambda scene: cf.Scene.parse(scene.text, HALF),
        lambda _: cf.Scene.load(HALF),
    ],
)
def test_half_a_character_is_refused(circle: cf.Scene, call: Callable[[cf.Scene], object]):
    with pytest.raises(cf.SceneError, match=r"\\ud800'(: no file can have this name| is half a character)"):
        call(circle)


def test_half_a_character_is_no_name_of_a_file(circle: cf.Scene, tmp_path: Path):
    result, simulation = cf.run(circle), cf.Simulation(circle)
    name = str(tmp_path / HALF)
    for call in (
        lambda: cf.open(name),
        lambda: cf.Simulation.resume(name),
        lambda: simulation.checkpoint(name),
        lambda: result.save(name),
        lambda: result.picture(f"{name}.png"),
        lambda: result.view(name),
        lambda: result.animate(f"{name}.gif"),
        lambda: cf.tradeoff(circle, [1e-2]).picture(f"{name}.png"),
    ):
        with pytest.raises(cf.StorageError, match="no file can have this name"):
            call()
    assert not list(tmp_path.iterdir())
