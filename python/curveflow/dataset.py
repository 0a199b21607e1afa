"""Results as datasets of xarray, which is imported at the first use only."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from . import _curveflow
from .extras import need

if TYPE_CHECKING:
    import xarray


def of_record(record: _curveflow.Record) -> xarray.Dataset:
    """Read the result file of a record, made in memory, so that names, units and attributes are the file's own."""
    xarray = need("xarray", "a dataset", "data")
    need("h5netcdf", "a dataset", "data")
    image = io.BytesIO(_curveflow.file_bytes(record))
    with xarray.open_datatree(image, engine="h5netcdf") as tree:
        groups = [_renamed(group.path, group.to_dataset(inherit=False).load()) for group in tree.subtree]
        merged: xarray.Dataset = xarray.merge(groups, combine_attrs="override")
    return merged.assign_attrs(groups[0].attrs)


def _renamed(path: str, group: xarray.Dataset) -> xarray.Dataset:
    """Put the name of the group before those of its variables."""
    prefix = path.strip("/").replace("/", "_")
    return group.rename_vars({name: f"{prefix}_{name}" for name in group.variables if name not in group.dims} if prefix else {})
