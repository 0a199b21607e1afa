import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray

import curveflow as cf


@pytest.fixture(scope="module")
def stiff() -> cf.Result:
    """A run with a requested field and diagnostics."""
    scene = cf.Scene.shipped("membrane_penalty").with_values(
        {"output.frames": 4, "output.fields": ["normal-force", "membrane-flux"], "accuracy.tolerance": 1e-4, "accuracy.nodes": 256}
    )
    return cf.run(scene)


def groups(path: Path) -> dict[str, xarray.Dataset]:
    with xarray.open_datatree(path, engine="h5netcdf") as tree:
        return {group.path: group.to_dataset(inherit=False).load() for group in tree.subtree}


@pytest.mark.parametrize("which", ["membrane", "stiff"])
def test_it_is_the_file_in_names_values_and_attributes(which: str, request: pytest.FixtureRequest, tmp_path: Path):
    result: cf.Result = request.getfixturevalue(which)
    data, path = result.to_xarray(), tmp_path / "out.h5"
    result.save(path)
    seen, attributes = set(), {}
    for group, held in groups(path).items():
        prefix = "".join(f"{part}_" for part in group.strip("/").split("/") if part)
        attributes |= {f"{prefix}{name}": value for name, value in held.attrs.items()}
        for name in held.variables:
            ours = name if name in held.dims else f"{prefix}{name}"
            xarray.testing.assert_identical(held[name].variable, data[ours].variable)
            seen.add(ours)
    assert seen == set(data.variables)
    assert data.attrs == attributes
    with xarray.open_dataset(path, engine="h5netcdf") as root:
        for name in root.variables:
            xarray.testing.assert_identical(root[name].variable.load(), data[name].variable)
        assert root.attrs.items() <= data.attrs.items()
    xarray.testing.assert_identical(cf.open(path).to_xarray(), data)


def test_every_dataset_of_the_file_says_what_it_is(stiff: cf.Result, tmp_path: Path):
    path = tmp_path / "out.h5"
    stiff.save(path)
    seen = {}

    def look(name: str, item: h5py.HLObject) -> None:
        if isinstance(item, h5py.Dataset):
            seen[name] = (item.attrs.get("long_name"), item.attrs.get("units"))

    with h5py.File(path) as file:
        file.visititems(look)
    assert len(seen) > 30 and all(long_name and units for long_name, units in seen.values()), seen
    assert (seen["frame"], seen["steps/step"]) == (("saved state", "1"), ("accepted step", "1"))


def test_it_has_named_dimensions_coordinates_units_and_provenance(stiff: cf.Result):
    data = stiff.to_xarray()
    steps = len(stiff.steps["time"])
    assert dict(data.sizes) == {"frame": 5, "node": 256, "component": 2, "step": steps}
    assert set(data.coords) == {"time", "parameter", "component", "steps_time"}
    assert data.position.dims == ("frame", "node", "component")
    assert data.fields_normal_force.dims == data.density_membrane.dims == ("frame", "node")
    assert data.diagnostics_velocity_residual.dims == ("frame",)
    assert data.steps_energy.dims == data.steps_rejections_error.dims == ("step",)
    np.testing.assert_array_equal(data.energy, stiff.energy)
    np.testing.assert_array_equal(data.density_membrane, stiff.density["membrane"])
    np.testing.assert_array_equal(data.steps_rejections_error, stiff.steps["rejections_error"])
    np.testing.assert_array_equal(data.position.sel(component="y"), stiff.position[:, :, 1])
    assert data.curvature.attrs == {"long_name": "curvature, positive on a circle", "units": "length_unit-1"}
    assert data.fields_normal_force.attrs == {"long_name": "normal force", "units": "energy_unit length_unit-2"}
    assert data.fields_membrane_flux.units == "density_unit epsilon_unit-1 length_unit-1"
    assert data.diagnostics_velocity_residual.units == "length_unit1.5 time_unit-1"
    assert data.attrs["scene"] == stiff.scene.text
    assert data.attrs["curveflow_version"] == cf.__version__ == stiff.provenance.version
    assert data.attrs["machine"] == stiff.provenance.machine


def test_it_can_be_stored_by_xarray(stiff: cf.Result, tmp_path: Path):
    data, path = stiff.to_xarray(), tmp_path / "out.nc"
    data.to_netcdf(path, engine="h5netcdf")
    with xarray.open_dataset(path, engine="h5netcdf") as again:
        xarray.testing.assert_equal(again.load(), data)


def test_xarray_is_missed_clearly():
    code = """
import sys
sys.modules[sys.argv[1]] = None
import curveflow as cf
try:
    cf.run(cf.Scene.shipped("circle").with_values({"accuracy.tolerance": 1e-3})).to_xarray()
except cf.MissingExtraError as error:
    print(error)
"""
    for module in ("xarray", "h5netcdf"):
        done = subprocess.run([sys.executable, "-c", code, module], capture_output=True, text=True, check=True)
        assert done.stdout == f'a dataset needs {module}: pip install "curveflow[data]"\n'
