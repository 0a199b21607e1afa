from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
import xarray

import curveflow as cf

VALUES = (
    "time", "energy", "dissipation", "energy_balance", "remap_error", "length", "area", "closure_defect", "crossings",
)
REQUESTED = ("normal_force", "tangential_velocity", "excess_density", "membrane_flux", "energy_density")
FIELDS = ("curvature", "metric", "normal_velocity")


def test_the_membrane_reaches_its_equilibrium(membrane: cf.Result):
    assert membrane.success
    assert membrane.status == "equilibrium"
    assert "equilibrium" in membrane.message
    # With twice the nodes and a hundredth of the tolerance the energy is 5.604812.
    assert membrane.energy[-1] == pytest.approx(5.604812, abs=1e-4)
    # The tolerance of the scene is 1e-5.
    assert membrane.mass["protein"][-1] == pytest.approx(membrane.mass["protein"][0], rel=1e-5)


def test_arrays_have_the_promised_shapes(membrane: cf.Result):
    frames, nodes = len(membrane.time), 512
    for name in VALUES:
        check(getattr(membrane, name), (frames,))
    for name in FIELDS:
        check(getattr(membrane, name), (frames, nodes))
    check(membrane.position, (frames, nodes, 2))
    assert sorted(membrane.energy_terms) == ["agents", "length"]
    assert list(membrane.density) == list(membrane.mass) == ["protein"]
    check(membrane.density["protein"], (frames, nodes))
    check(membrane.mass["protein"], (frames,))
    for name, values in membrane.steps.items():
        assert values.shape == (membrane.stats["steps"],), name
        assert not values.flags.writeable
        assert f"``{name}``" in str(cf.Result.steps.__doc__)
    assert membrane.steps["rejections_error"].sum() == membrane.stats["rejections_error"]


def check(array: np.ndarray, shape: tuple[int, ...]) -> None:
    assert array.shape == shape
    assert array.dtype == np.float64
    assert array.flags.c_contiguous
    assert not array.flags.writeable
    assert np.isfinite(array).all()


def test_arrays_mean_what_their_names_say(membrane: cf.Result):
    np.testing.assert_allclose(sum(membrane.energy_terms.values()), membrane.energy, rtol=1e-12)
    np.testing.assert_allclose(membrane.metric.mean(axis=1), membrane.length, rtol=1e-12)
    mass = (membrane.density["protein"] * membrane.metric).mean(axis=1)
    np.testing.assert_allclose(mass, membrane.mass["protein"], rtol=1e-10)
    # Chords of a curve with 512 nodes are shorter than its arcs by a part in 10^4.
    chords = np.linalg.norm(membrane.position - np.roll(membrane.position, 1, axis=1), axis=2)
    np.testing.assert_allclose(chords.sum(axis=1), membrane.length, rtol=1e-3)
    assert membrane.energy is membrane.energy


@pytest.fixture(scope="session")
def stiff() -> cf.Result:
    """A stiff membrane on its way to the incompressible manifold, with all fields that there are."""
    scene = cf.Scene.shipped("membrane_penalty")
    fields = [name.replace("_", "-") for name in REQUESTED]
    output = {"output.fields": fields, "output.frames": 4}
    return cf.run(scene.with_values({**output, "accuracy.tolerance": 1e-4, "accuracy.nodes": 256}))


def test_requested_fields_and_diagnostics_are_arrays(stiff: cf.Result):
    frames, nodes = len(stiff.time), 256
    assert tuple(stiff.fields) == REQUESTED
    for field in stiff.fields.values():
        check(field, (frames, nodes))
    assert list(stiff.diagnostics) == ["incompressible_distance", "velocity_residual"]
    for values in stiff.diagnostics.values():
        check(values, (frames,))
    assert list(stiff.energy_terms) == ["bending", "membrane"]
    check(stiff.parameter, (nodes,))
    np.testing.assert_array_equal(stiff.parameter * nodes, np.arange(nodes))


def test_what_no_scene_asks_for_is_not_there(membrane: cf.Result):
    assert not membrane.fields
    assert not membrane.diagnostics


def test_requested_fields_mean_what_their_names_say(stiff: cf.Result):
    # The mobility of the scene is the identity.
    np.testing.assert_allclose(stiff.fields["normal_force"], stiff.normal_velocity, rtol=1e-12)
    total = (stiff.fields["energy_density"] * stiff.metric).mean(axis=1)
    np.testing.assert_allclose(total, stiff.energy, rtol=1e-10)
    # (F1): the gauge stretches every piece at the same rate. At the start V has a sawtooth that (F1) leaves out.
    stretching = stiff.metric * stiff.curvature * stiff.normal_velocity
    rate = stretching.mean(axis=1, keepdims=True) - stretching
    slope = derivative(stiff.fields["tangential_velocity"])
    np.testing.assert_allclose(slope[1:], rate[1:], atol=1e-6 * np.abs(rate).max())
    # (F11): the flux is the slope of the excess density, downhill.
    excess, flux = stiff.fields["excess_density"], stiff.fields["membrane_flux"]
    np.testing.assert_allclose(-derivative(excess), flux * stiff.metric, atol=1e-6 * np.abs(flux).max())
    epsilon = 0.01
    off = stiff.density["membrane"] - 1 - epsilon * excess
    distance = np.sqrt((off**2 * stiff.metric).mean(axis=1))
    np.testing.assert_allclose(stiff.diagnostics["incompressible_distance"], distance, rtol=1e-10)
    assert distance[-1] < 0.2 * distance[0]


def derivative(field: np.ndarray) -> np.ndarray:
    """Derivative by the parameter of periodic rows."""
    spectrum = np.fft.rfft(field, axis=1)
    modes = np.arange(spectrum.shape[1])
    return np.fft.irfft(2j * np.pi * modes * spectrum, field.shape[1], axis=1)


def test_saved_results_come_back(membrane: cf.Result, tmp_path: Path):
    path = tmp_path / "out.h5"
    membrane.save(path)
    again = cf.open(path)
    for name in VALUES + FIELDS + ("position",):
        np.testing.assert_array_equal(getattr(again, name), getattr(membrane, name), err_msg=name)
    np.testing.assert_array_equal(again.density["protein"], membrane.density["protein"])
    for name, values in membrane.steps.items():
        np.testing.assert_array_equal(again.steps[name], values, err_msg=name)
    assert dict(again.stats) == dict(membrane.stats)
    assert again.scene == membrane.scene
    assert again.scene.text == membrane.scene.text
    assert again.resolved_scene == membrane.resolved_scene
    assert repr(again) == repr(membrane)


def test_requested_fields_and_diagnostics_come_back(stiff: cf.Result, tmp_path: Path):
    path = tmp_path / "out.h5"
    stiff.save(path)
    again = cf.open(path)
    for kind in ("fields", "diagnostics", "energy_terms", "mass"):
        ours, theirs = getattr(stiff, kind), getattr(again, kind)
        assert list(ours) == list(theirs)
        for name, values in ours.items():
            np.testing.assert_array_equal(theirs[name], values, err_msg=name)
    with h5py.File(path) as file:
        for name, values in stiff.fields.items():
            np.testing.assert_array_equal(file[f"fields/{name}"], values)
        for name, values in stiff.diagnostics.items():
            np.testing.assert_array_equal(file[f"diagnostics/{name}"], values)
        np.testing.assert_array_equal(file["parameter"], stiff.parameter)


def test_existing_files_are_kept(membrane: cf.Result, tmp_path: Path):
    path = tmp_path / "out.h5"
    path.write_text("precious")
    with pytest.raises(cf.StorageError, match=r"out\.h5: already exists") as raised:
        membrane.save(path)
    assert isinstance(raised.value, OSError)
    assert path.read_text() == "precious"
    membrane.save(path, replace=True)
    assert cf.open(path).success


def test_names_of_files_may_be_bytes(membrane: cf.Result, tmp_path: Path):
    path: Any = bytes(tmp_path / "ring.h5")
    membrane.save(path)
    assert cf.open(path).status == membrane.status
    with pytest.raises(TypeError, match=r"expected str, bytes or os\.PathLike object, not NoneType"):
        cf.open(None)  # type: ignore[arg-type]


def test_foreign_files_are_refused(tmp_path: Path):
    path = tmp_path / "text.h5"
    path.write_text("not HDF5")
    with pytest.raises(cf.StorageError, match="is not an HDF5 file"):
        cf.open(path)
    with pytest.raises(cf.StorageError, match="No such file"):
        cf.open(tmp_path / "none.h5")


def test_h5py_and_xarray_read_saved_results(membrane: cf.Result, tmp_path: Path):
    path = tmp_path / "out.h5"
    membrane.save(path)
    with h5py.File(path) as file:
        np.testing.assert_array_equal(file["density/protein"], membrane.density["protein"])
        assert file.attrs["scene"] == membrane.scene.text
        assert file.attrs["stop_reason"] == membrane.status
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        assert data.position.dims == ("frame", "node", "component")
        np.testing.assert_array_equal(data.curvature, membrane.curvature)
        assert list(data.component.values) == ["x", "y"]
    with xarray.open_dataset(path, engine="h5netcdf", group="density") as data:
        assert data.protein.shape == membrane.density["protein"].shape


def test_a_doubtful_result_says_so(membrane: cf.Result):
    assert membrane.warnings == ()
    few = cf.run(cf.Scene.shipped("three_fold").with_values({"accuracy.nodes": 64, "time.end": 1e-3}))
    assert few.success
    assert any("were not resolved by their nodes" in told for told in few.warnings)


def test_a_run_with_terms_from_outside_its_scene_says_so(membrane: cf.Result, tmp_path: Path):
    path = tmp_path / "own.h5"
    membrane.save(path)
    with h5py.File(path, "a") as file:
        file.attrs["own_terms"] = ["length"]
    with pytest.warns(UserWarning, match=r"outside its scene \(length\)"):
        assert cf.open(path).scene == membrane.scene
