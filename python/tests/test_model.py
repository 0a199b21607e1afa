import pickle
from dataclasses import FrozenInstanceError, replace
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from family import ANGLES, BASE, CURVES, ENERGIES, FAMILY, FLOWS, LIPID, PROTEIN, fields_of

import curveflow as cf


@pytest.mark.parametrize("scene", FAMILY.values(), ids=FAMILY)
def test_objects_survive_being_written_out(scene: cf.Scene):
    again = cf.Scene.parse(scene.to_toml())
    assert fields_of(again) == fields_of(scene)
    assert again == scene
    assert hash(again) == hash(scene)
    of_objects = cf.Scene(**fields_of(scene))
    assert of_objects == scene
    assert of_objects.to_toml() == scene.to_toml()
    assert cf.Scene.parse(of_objects.text) == scene
    assert pickle.loads(pickle.dumps(of_objects)) == scene


@pytest.mark.parametrize("scene", FAMILY.values(), ids=FAMILY)
def test_a_scene_shows_how_to_make_it(scene: cf.Scene):
    if not isinstance(scene.curve, cf.Points):
        assert eval(repr(scene), vars(cf)) == scene


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES)
def test_curves_come_back_as_they_were_given(curve: cf.model.Curve):
    assert replace(BASE, curve=curve).curve == curve


@pytest.mark.parametrize("term", ENERGIES.values(), ids=ENERGIES)
def test_terms_come_back_as_they_were_given(term: cf.model.EnergyTerm):
    scene = replace(BASE, energy=[term], density=[PROTEIN, LIPID])
    assert scene.energy == (term,)
    assert scene.density == (PROTEIN, LIPID)


@pytest.mark.parametrize("flow", FLOWS.values(), ids=FLOWS)
def test_flows_come_back_as_they_were_given(flow: cf.Flow):
    assert replace(BASE, flow=flow).flow == flow


def test_defaults_are_those_of_a_scene_that_leaves_out_everything():
    scene = cf.Scene.parse("curve = { shape = 'trillium' }\nenergy.bending.rigidity = 1\ntime.end = 1")
    assert scene == cf.Scene(curve=cf.Trillium(), energy=[cf.Bending(1.0)], time=cf.Time(1.0))
    assert (scene.flow, scene.accuracy, scene.output) == (cf.Flow(), cf.Accuracy(), cf.Output())
    assert (cf.Accuracy().tolerance, cf.Output().frames, cf.FigureEight().turning_number) == (1e-5, 200, 0)


def test_what_the_core_concludes_is_in_the_scene():
    scene = replace(BASE, energy=[cf.Bending(1.0, "0.5*rho")], density=[PROTEIN])
    assert scene.energy == (cf.Bending(1.0, "0.5*rho", density="protein"),)


def test_the_order_of_terms_means_nothing():
    terms = [ENERGIES["pressure"], ENERGIES["bending"], ENERGIES["tension"]]
    assert replace(BASE, energy=terms) == replace(BASE, energy=terms[::-1])


def test_arrays_and_scalars_of_numpy_are_numbers():
    points = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)
    curve = cf.Points(points)
    assert isinstance(curve.points, tuple)
    np.testing.assert_array_equal(np.array(curve.points), points)
    assert hash(curve) == hash(cf.Points(points.tolist()))
    assert repr(curve) == "Points(<16 points>, file=None, turning_number=1)"
    assert repr(cf.Points(3)) == "Points(3, file=None, turning_number=1)"
    term = cf.Bending(np.int64(2), np.float32(0.5))
    assert (type(term.rigidity), type(term.preferred_curvature)) == (int, float)
    assert cf.Ellipse(np.array([2, 1])) == cf.Ellipse((2, 1))
    assert cf.Output(times=np.array([0.0, 1.0])).times == (0.0, 1.0)
    assert cf.Accuracy(nodes=np.int32(64)) == cf.Accuracy(nodes=64)


def test_whatever_counts_is_a_count():
    class Many:
        def __index__(self) -> int:
            return 64

    for scene in (replace(BASE, accuracy=cf.Accuracy(nodes=Many())), BASE.with_values({"accuracy.nodes": Many()})):
        assert scene.accuracy.nodes == 64


@pytest.mark.parametrize("tenth", [np.longdouble(0.1), Decimal("0.1"), Fraction(1, 10)])
def test_other_numbers_are_floats(tenth: Any):
    assert type(cf.Time(tenth).end) is float
    assert replace(BASE, time=cf.Time(tenth)).time.end == pytest.approx(0.1)
    assert BASE.with_values({"time.end": tenth}).time.end == pytest.approx(0.1)
    assert BASE.with_values({"output": cf.Output(times=(0, tenth))}).output.times == pytest.approx((0, 0.1))


def test_points_come_from_a_file(tmp_path: Path):
    file = tmp_path / "points.txt"
    np.savetxt(file, np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1))
    curve = replace(BASE, curve=cf.Points(file=file)).curve
    assert isinstance(curve, cf.Points)
    assert curve.file is None
    np.testing.assert_array_equal(np.array(curve.points), np.loadtxt(file))


def test_objects_are_frozen_and_replaced():
    scene = replace(BASE, accuracy=replace(BASE.accuracy, tolerance=1e-3))
    assert (scene.accuracy.tolerance, BASE.accuracy.tolerance) == (1e-3, 1e-5)
    assert scene != BASE
    for table, key in ((BASE, "title"), (BASE.accuracy, "tolerance"), (BASE.curve, "radius")):
        with pytest.raises(FrozenInstanceError):
            setattr(table, key, 1.0)
    with pytest.raises((AttributeError, TypeError)):
        BASE.accuracy.tolerence = 1e-3


def test_whole_tables_can_be_values():
    changed = BASE.with_values({"curve": cf.Ellipse((2, 1)), "energy.length": cf.Length(tension=1.0)})
    assert changed.curve == cf.Ellipse((2.0, 1.0))
    assert changed.energy == (cf.Bending(1.0), cf.Length(tension=1.0))


def test_mistakes_are_reported_with_their_keys_all_at_once():
    with pytest.raises(cf.SceneError) as raised:
        cf.Scene(
            curve=cf.Circle(-1.0),
            density=[cf.Density("protein", "0.5 + t", "diffusion")],
            energy=[cf.Bending("soft"), cf.Membrane(density="lipid", epsilon=0.1)],
            flow=cf.Flow(gauge="garded"),
            time=cf.Time(float("nan")),
        )
    message = str(raised.value)
    assert "6 problems in scene" in message
    assert "line" not in message
    for place, text in (
        ("curve.radius", "= -1.0 is out of range: it must be greater than 0"),
        ("density.0.initial", "column 7"),
        ("energy.bending.rigidity", 'must be a number, found the text "soft"'),
        ("energy.membrane.density", "did you mean `protein`"),
        ("flow.gauge", "did you mean `graded`"),
        ("time.end", "= nan is not a finite number"),
    ):
        assert f"scene, {place}\n  `{place}`" in message
        assert text in message


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"energy": []}, r"scene, energy\n  `energy` is missing"),
        ({"energy": [cf.Bending(1.0), cf.Bending(2.0)]}, r"scene, energy\.bending\n.*at most 1 of each kind"),
        ({"energy": [cf.Length(tension=1, penalty=1)]}, r"energy\.length\.penalty.*exclude each other"),
        ({"curve": cf.Points()}, r"`curve\.points` is missing"),
        ({"output": cf.Output(frames=3, times=[0.5])}, r"output\.frames.*exclude each other"),
        ({"accuracy": cf.Accuracy(nodes=7)}, r"`accuracy\.nodes` = 7 is out of range"),
    ],
)
def test_a_mistake_names_its_key(changes: dict[str, object], message: str):
    with pytest.raises(cf.SceneError, match=message):
        replace(BASE, **changes)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"curve": "circle"}, "curve: str is not an object of: Circle, Ellipse"),
        ({"curve": cf.Trillium}, "curve: the class Trillium is not an object"),
        ({"energy": cf.Bending(1.0)}, "energy: Bending stands alone"),
        ({"energy": None}, "energy: NoneType is not a list of objects of: Bending"),
        ({"density": None}, "density: NoneType is not a list of objects of: Density"),
        ({"density": 3}, "density: int is not a list of objects of: Density"),
        ({"energy": [cf.Flow()]}, r"energy\.0: Flow is not an object of: Bending"),
        ({"accuracy": cf.Flow()}, "accuracy: Flow is not an object of: Accuracy"),
        ({"curve": cf.Circle(1j)}, r"curve\.radius: complex is not a number"),
    ],
)
def test_an_object_of_another_kind_is_refused(changes: dict[str, object], message: str):
    with pytest.raises(TypeError, match=message):
        replace(BASE, **changes)


def test_a_scene_of_objects_runs():
    scene = replace(BASE, time=cf.Time(1.0, stop_at_equilibrium=False), accuracy=cf.Accuracy(tolerance=1e-4, nodes=32))
    result = cf.run(scene)
    np.testing.assert_allclose(result.length, 2 * np.pi * (1 + 2 * result.time) ** 0.25, rtol=1e-3)
    assert result.scene is scene
