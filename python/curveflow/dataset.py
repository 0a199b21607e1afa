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
    library = need("xarray", "a dataset", "data")
    need("h5netcdf", "a dataset", "data")
    image = io.BytesIO(_curveflow.file_bytes(record))
    with library.open_datatree(image, engine="h5netcdf") as tree:
        groups = [_renamed(group.path, group.to_dataset(inherit=False).load()) for group in tree.subtree]
    merged: xarray.Dataset = library.merge(groups, join="exact", compat="identical", combine_attrs="override")
    return merged.assign_attrs({name: value for group in groups for name, value in group.attrs.items()})


def _renamed(path: str, group: xarray.Dataset) -> xarray.Dataset:
    """Put the name of the group before those of its variables and attributes."""
    prefix = "".join(f"{part}_" for part in path.split("/") if part)
    renamed = group.rename_vars({name: f"{prefix}{name}" for name in group.variables if name not in group.dims})
    renamed.attrs = {f"{prefix}{name}": value for name, value in group.attrs.items()}
    return renamed
