"""Contacts, histories and surfaces as Datasets of xarray, and as files of them."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity._asperity import AsperityError, Contact, History, Surface

if TYPE_CHECKING:
    import os

    import xarray as xr

NAMES = {
    "height": "height of the rigid surface about its mean, a length",
    "pressure": "contact pressure",
    "gap": "gap between the surfaces, a length",
    "displacement": "displacement of the surface of the solid into the solid, a length",
    "contact": "nodes in contact",
    "traction": "tangential traction along x",
    "stick": "nodes that stick",
    "slip": "slip of the solid along x, a length",
    "traction_across": "tangential traction along y",
    "slip_across": "slip of the solid along y, a length",
    "attraction": "attraction between the surfaces, a pressure",
    "stored_strain": "stored strain, as the pressure that would cause it in the glassy solid",
}
"""The fields, and what they hold."""


def surface_to_xarray(surface: Surface) -> xr.DataArray:
    """The heights as a DataArray over the positions of the nodes."""
    import xarray as xr

    axes = _axes(surface.height)
    return xr.DataArray(surface.height, _positions(surface, axes), axes, "height", {"long_name": NAMES["height"]})


def contact_to_xarray(contact: Contact) -> xr.Dataset:
    """The fields of a contact, with its measures, status and setup as attributes."""
    import xarray as xr

    axes = _axes(contact.pressure)
    fields = {name: (axes, field, {"long_name": NAMES[name]}) for name, field in _fields(contact).items()}
    words = {"status": contact.status, "solver": contact.solver, "setup": contact.setup.to_toml()}
    return xr.Dataset(fields, _positions(contact, axes), contact.measures | words)


def load_displacement(curve: History) -> tuple[Any, Any, str]:
    """The mean pressure over the displacement of the surface, for all boundaries: two arrays, and what the displacement is.

    On a free boundary it is the "approach". On a periodic one, where there is no approach, it is the "mean displacement": how far the mean plane of the
    rigid surface has moved since its highest peak has touched, which is the height of this peak above the mean less the mean gap.
    """
    measures = curve.measures
    approach = measures.get("approach", np.full(len(curve), np.nan))
    if np.isfinite(approach).all():
        return measures["mean_pressure"], approach, "approach"
    height = curve[0].height
    return measures["mean_pressure"], np.max(height) - np.mean(height) - measures["mean_gap"], "mean displacement"


def history_to_xarray(history: History) -> xr.Dataset:
    """The fields of all states along the dimension `state`, with the numbers as variables."""
    import xarray as xr

    if len(history) == 0:
        raise AsperityError("the history has no states: there is nothing to export")
    first = history[0]
    axes = _axes(first.pressure)
    further = {name: (("state", *axes), values, {"long_name": NAMES[name]}) for name, values in history.fields.items()}
    numbers = {name: ("state", values, _explained(name)) for name, values in history._columns().items()}
    words = {"status": ("state", [contact.status for contact in history]), "claim": ("state", history.claims)}
    positions = _positions(first, axes) | {"state": np.arange(1, len(history) + 1)}
    if history.loads.size:
        # a list that was ended early has fewer states than loads
        positions["load"] = ("state", history.loads[: len(history)])
    described = {"process": history.process, "setup": history.setup.to_toml()}
    return xr.Dataset(_stacked("state", list(history)) | further | numbers | words, positions, described)


def _explained(name: str) -> dict[str, str]:
    """What a number is, and its unit in a word; nothing of a number that no table explains."""
    try:
        return {"long_name": History.explain(name), "unit": History._unit(name)}
    except AsperityError:
        return {}


def write_netcdf(what: Contact | History | Surface, path: os.PathLike[str] | str) -> None:
    """Writes the Dataset of a contact, a history or a surface to a NetCDF file."""
    data = what.to_xarray()
    # NetCDF has no attributes that are true or false
    data.attrs = {name: int(value) if isinstance(value, bool) else value for name, value in data.attrs.items()}
    try:
        data.to_netcdf(path)
    except (ImportError, ValueError) as error:
        if find_spec("netCDF4") or find_spec("h5netcdf") or find_spec("scipy"):
            raise
        raise AsperityError("to_netcdf needs a package for NetCDF: install it with `pip install netcdf4`") from error


def _stacked(dimension: str, contacts: list[Contact]) -> dict[str, Any]:
    """The heights, and the other fields of all contacts along a dimension."""
    axes, every = _axes(contacts[0].pressure), [_fields(contact) for contact in contacts]
    fields: dict[str, Any] = {"height": (axes, contacts[0].height, {"long_name": NAMES["height"]})}
    for name in every[0].keys() - {"height"}:
        fields[name] = ((dimension, *axes), np.stack([one[name] for one in every]), {"long_name": NAMES[name]})
    return fields


def _fields(contact: Contact) -> dict[str, Any]:
    """The fields of a contact by their names."""
    fields: dict[str, Any] = {name: getattr(contact, name) for name in ("height", "pressure", "gap", "displacement", "contact")}
    slip = contact.slip
    return fields | ({"traction": slip.traction, "stick": slip.stick} if slip else {})


def _axes(field: Any) -> tuple[str, ...]:
    return ("y", "x")[2 - field.ndim :]


def _positions(where: Contact | Surface, axes: tuple[str, ...]) -> dict[str, Any]:
    """The positions of the nodes along each axis."""
    return {axis: (axis, getattr(where, axis), {"long_name": f"position along {axis}, a length"}) for axis in axes}
