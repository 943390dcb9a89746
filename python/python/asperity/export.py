"""Contacts and surfaces as Datasets of xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity._asperity import Contact, LoadCurve, Surface, observables

if TYPE_CHECKING:
    import xarray as xr

NAMES = {
    "height": "height of the rigid surface about its mean, a length",
    "pressure": "contact pressure",
    "gap": "gap between the surfaces, a length",
    "displacement": "displacement of the surface of the solid into the solid, a length",
    "contact": "nodes in contact",
    "traction": "tangential traction along x",
    "stick": "nodes that stick",
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


def curve_to_xarray(curve: LoadCurve) -> xr.Dataset:
    """The fields of all contacts along the dimension `load`, with the measures as variables."""
    import xarray as xr

    first = curve[0]
    axes = _axes(first.pressure)
    every = [_fields(contact) for contact in curve]
    fields: dict[str, Any] = {"height": (axes, first.height, {"long_name": NAMES["height"]})}
    for name in every[0].keys() - {"height"}:
        fields[name] = (("load", *axes), np.stack([one[name] for one in every]), {"long_name": NAMES[name]})
    explained = {row["name"]: {"long_name": row["sentence"], "symbol": row["symbol"]} for row in observables()}
    measures = {name: ("load", values, explained[name]) for name, values in curve.measures.items()}
    status = {"status": ("load", [contact.status for contact in curve])}
    positions = _positions(first, axes) | {"load": curve.loads}
    return xr.Dataset(fields | measures | status, positions, {"setup": curve.setup.to_toml()})


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
