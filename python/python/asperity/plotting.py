"""Figures of surfaces, contacts and load curves by matplotlib."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity._asperity import AsperityError, Contact, LoadCurve, Surface

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _figure(width: float, height: float) -> Figure:
    """An empty figure, which no window of pyplot holds."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise AsperityError("plot needs matplotlib: install it with `pip install matplotlib`") from error
    return Figure(figsize=(width, height), layout="constrained")


def plot_surface(surface: Surface) -> Figure:
    """The heights of a line, or a map of the heights of a surface."""
    figure = _figure(6, 4)
    axes = figure.subplots()
    if surface.height.ndim == 1:
        axes.plot(surface.x, surface.height)
        axes.set(xlabel="x", ylabel="height")
    else:
        _map(axes, surface.height, surface.size, "height")
    return figure


def plot_contact(contact: Contact) -> Figure:
    """Surfaces and pressure of a line, or maps of pressure and gap of a surface."""
    figure = _figure(9, 4)
    left, right = figure.subplots(1, 2)
    if contact.pressure.ndim == 1:
        near = _near_contact(contact)
        x, displacement = contact.x[near], contact.displacement[near]
        # z points up, away from the solid; displacement points into the solid, and so do the peaks
        left.plot(x, contact.gap[near] - displacement, label="rigid surface")
        left.plot(x, -displacement, label="solid")
        left.set(xlabel="x", ylabel="z", title="surfaces")
        left.legend()
        right.plot(x, contact.pressure[near])
        right.set(xlabel="x", ylabel="pressure", title="pressure")
        return figure
    size = contact.problem.surface.size
    _map(left, contact.pressure, size, "pressure")
    _map(right, contact.gap, size, "gap")
    return figure


def plot_curve(curve: LoadCurve) -> Figure:
    """Relative contact area, kappa_r and mean gap over the reduced pressure, all with edges between the nodes where they are known."""
    figure = _figure(12, 4)
    measures = curve.measures
    resolved = [("relative_area", "relative contact area"), ("kappa_r", "kappa_r"), ("mean_gap", "mean gap")]
    for axes, (name, label) in zip(figure.subplots(1, 3), resolved):
        axes.plot(measures["reduced_pressure"], measures[name], marker=".")
        axes.set(xscale="log", xlabel="reduced pressure", ylabel=label)
    return figure


def contact_as_html(contact: Contact) -> str:
    """A small picture and the main numbers of a contact, for notebooks."""
    rows = {
        "load": ", ".join(f"{name.replace('-', ' ')} {value:g}" for name, value in contact.setup.to_dict()["load"].items()),
        "status": f"{contact.solver}: {contact.status}",
        "mean pressure": f"{contact.mean_pressure:.6g}",
        "largest pressure": f"{contact.measures['max_pressure']:.6g}",
        "relative contact area": f"{contact.measures['relative_area']:.6g}",
        "mean gap": f"{contact.mean_gap:.6g}",
        "certificate": f"{contact.certificate.eta:.1e}",
    }
    return _html("Contact", rows, lambda: plot_contact(contact))


def surface_as_html(surface: Surface) -> str:
    """A small picture and the main numbers of a surface, for notebooks."""
    numbers = {name.replace("_", " "): f"{value:.6g}" for name, value in surface.statistics.items() if value is not None}
    rows = {"points": " x ".join(map(str, surface.shape)), "size": " x ".join(f"{it:g}" for it in surface.size)} | numbers
    return _html("Surface", rows, lambda: plot_surface(surface))


def _html(title: str, rows: dict[str, str], plot: Any) -> str:
    """A table of some rows, beside a figure where matplotlib is installed."""
    cells = "".join(f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows.items())
    table = f"<table><caption>{title}</caption>{cells}</table>"
    try:
        image = BytesIO()
        plot().savefig(image, format="png", dpi=60)
    except AsperityError:
        return table
    data = b64encode(image.getvalue()).decode()
    return f'<div style="display: flex; align-items: center">{table}<img alt="{title}" src="data:image/png;base64,{data}"></div>'


def _map(axes: Any, field: Any, size: tuple[float, ...], name: str) -> None:
    """A map of a field, its first row at the top."""
    image = axes.imshow(np.asarray(field), extent=(0.0, size[1], size[0], 0.0))
    axes.set(xlabel="x", ylabel="y", title=name)
    axes.ticklabel_format(scilimits=(-3, 4))
    axes.locator_params(nbins=5)
    axes.figure.colorbar(image, ax=axes, shrink=min(max(size[0] / size[1], 0.3), 1.0))


def _near_contact(contact: Contact) -> slice:
    """The nodes of a line from the first to the last one in contact, with as many on either side; all nodes without contact."""
    touching = np.flatnonzero(contact.contact)
    if touching.size == 0:
        return slice(None)
    first, last = int(touching[0]), int(touching[-1])
    width = last - first + 1
    return slice(max(first - width, 0), last + width + 1)
