"""Figures of surfaces, contacts and histories by matplotlib, and pictures of them for notebooks."""

from __future__ import annotations

from base64 import b64encode
from functools import partial
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity._asperity import AsperityError, Contact, History, Surface, Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _figure(width: float, height: float) -> Figure:
    """An empty figure, which no window of pyplot holds."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise AsperityError("plot needs matplotlib: install it with `pip install matplotlib`") from error
    figure = Figure(figsize=(width, height), layout="constrained")
    # notebooks show it, also where pyplot has not been imported
    setattr(figure, "_repr_png_", partial(_png, figure, figure.dpi))
    return figure


def _png(figure: Figure, dpi: float) -> bytes:
    image = BytesIO()
    figure.savefig(image, format="png", dpi=dpi)
    return image.getvalue()


class _Axes:
    """The units of the axes of a figure: what a number of a problem is divided by, and the names of axes."""

    METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9}
    PASCALS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}

    def __init__(self, length_unit: str | None, pressure_unit: str | None = None) -> None:
        self.names = {"length": length_unit, "pressure": pressure_unit}
        known = {"length": self.METRES, "pressure": self.PASCALS}
        for kind, unit in self.names.items():
            if unit is not None and unit not in known[kind]:
                raise AsperityError(f"{kind}_unit is {unit!r}: give one of {', '.join(known[kind])}")
        self.sizes = {kind: known[kind][unit] if unit else 1.0 for kind, unit in self.names.items()}

    def values(self, kind: str, values: Any) -> Any:
        """Values of a kind of quantity in its unit."""
        return values / self.sizes[kind] if self.sizes.get(kind, 1.0) != 1.0 else values

    def label(self, name: str, kind: str) -> str:
        """The name of an axis with its unit; where the unit is not known, the words for it."""
        if kind not in self.names:
            return name
        unit = self.names[kind] or f"unit of {kind}"
        return f"{name} / {unit.replace('um', 'µm')}"


def plot_surface(surface: Surface, length_unit: str | None = None) -> Figure:
    """The heights of a line, or a map of the heights of a surface."""
    figure, units = _figure(6, 4), _Axes(length_unit)
    axes = figure.subplots()
    if surface.height.ndim == 1:
        axes.plot(units.values("length", surface.x), units.values("length", surface.height))
        axes.set(xlabel=units.label("x", "length"), ylabel=units.label("height", "length"))
    else:
        _map(axes, surface.height, surface.size, ("height", "length"), units)
    return figure


def plot_contact(contact: Contact, length_unit: str | None = None, pressure_unit: str | None = None) -> Figure:
    """Surfaces, pressure and traction of a line, or maps of pressure and gap of a surface."""
    figure, units = _figure(9, 4), _Axes(length_unit, pressure_unit)
    left, right = figure.subplots(1, 2)
    if contact.pressure.ndim == 1:
        near = _near_contact(contact)
        x, displacement, gap = (units.values("length", it[near]) for it in (contact.x, contact.displacement, contact.gap))
        # z points up, away from the solid; displacement points into the solid, and so do the peaks
        left.plot(x, gap - displacement, label="rigid surface")
        left.plot(x, -displacement, label="solid")
        left.set(xlabel=units.label("x", "length"), ylabel=units.label("z", "length"), title="surfaces")
        left.legend()
        right.plot(x, units.values("pressure", contact.pressure[near]), label="pressure")
        right.set(xlabel=units.label("x", "length"), ylabel=units.label("pressure", "pressure"), title="pressure")
        if slip := contact.slip:
            right.plot(x, units.values("pressure", slip.traction[near]), label="traction")
            right.legend()
        return figure
    size = contact.problem.surface.size
    pressure = contact.pressure[contact.contact]
    largest = float(np.percentile(pressure, LIGHTEST)) if pressure.size else None
    shown = np.where(contact.contact, contact.pressure, np.nan)
    _map(left, shown, size, ("pressure", "pressure"), units, "pressure, white without contact", largest)
    _map(right, contact.gap, size, ("gap", "length"), units)
    return figure


def plot_history(history: History, length_unit: str | None = None, pressure_unit: str | None = None) -> Figure:
    """The two charts of a process, without the frames of motions; a jump of a history with adhesion is an arrow."""
    figure, units = _figure(9, 4), _Axes(length_unit, pressure_unit)
    claims = np.array(history.claims)
    still = claims != "moving"
    numbers: dict[str, Any] = {name: values[still] for name, values in history._columns().items()}
    numbers["state"] = 1.0 + np.arange(still.sum())
    apart = claims[still] == "separated"
    jumps: Any = np.flatnonzero(np.isfinite(numbers.get("jump", np.full(still.sum(), np.nan))))
    for axes, ((x, y), (xlabel, ylabel), is_logarithmic) in zip(figure.subplots(1, 2), history._charts()):
        missing = np.full(still.sum(), np.nan)
        kinds = [history._unit(name) for name in (x, y)]
        across, up = (
            units.values(kind, np.where(apart, np.nan, numbers.get(name, missing))) for name, kind in zip((x, y), kinds)
        )
        (line,) = axes.plot(across, up, marker=".")
        if y == "mean_pressure" and (_is_closed(across[~apart]) or _is_closed(up[~apart])):
            axes.fill(across[~apart], up[~apart], color=line.get_color(), alpha=0.15)
        for jump in jumps[jumps > 0]:
            ends = [(across[at], up[at]) for at in (jump - 1, jump)]
            if np.isfinite(ends).all():
                axes.annotate("", ends[1], ends[0], arrowprops={"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0})
        xlabel, ylabel = (units.label(label, kind) for label, kind in zip((xlabel, ylabel), kinds))
        axes.set(xlabel=xlabel, ylabel=ylabel, xscale="log" if is_logarithmic else "linear")
        if not is_logarithmic:
            axes.ticklabel_format(scilimits=(-3, 4))
            axes.locator_params(axis="x", nbins=5)
    return figure


def _is_closed(values: Any) -> bool:
    """Whether a curve ends where it has begun, and was elsewhere between."""
    return len(values) > 2 and bool(abs(values[-1] - values[0]) <= 1e-6 * np.ptp(values))


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


def history_as_html(history: History) -> str:
    """A small picture and the main numbers of a history, for notebooks."""
    named = dict.fromkeys(name for axes, _, _ in history._charts() for name in axes)
    rows = {"process": history.process, "states": str(len(history)), "claim": ", ".join(dict.fromkeys(history.claims))}
    return _html("History", rows | _ranges(history._columns(), named), lambda: plot_history(history))


def table_as_html(table: Table) -> str:
    """The first rows of a table, for notebooks."""
    names, shown = table.columns, min(len(table), MOST_ROWS)
    columns = [table[name] for name in names if name != "scene"]
    head = "".join(f"<th>{escape(name)}</th>" for name in names if name != "scene")
    rows = ("".join(f"<td>{escape(_cell(column[row]))}</td>" for column in columns) for row in range(shown))
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    left = f"<p>{shown} of {len(table)} rows</p>" if shown < len(table) else ""
    return f"<table><caption>Table of {len(table)} rows</caption><tr>{head}</tr>{body}</table>{left}"


MOST_ROWS = 10
"""Rows of a table that a notebook shows."""


def _cell(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _ranges(numbers: Any, names: Any) -> dict[str, str]:
    """The least and the largest of some numbers."""
    found = {name: numbers[name][np.isfinite(numbers[name])] for name in names if name in numbers}
    return {name.replace("_", " "): f"{it.min():.6g} to {it.max():.6g}" for name, it in found.items() if it.size}


def _html(title: str, rows: dict[str, str], plot: Any) -> str:
    """A table of some rows, beside a figure where matplotlib is installed."""
    cells = "".join(f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows.items())
    table = f"<table><caption>{title}</caption>{cells}</table>"
    try:
        data = b64encode(_png(plot(), 60)).decode()
    except AsperityError:
        return table
    return f'<div style="display: flex; align-items: center">{table}<img alt="{title}" src="data:image/png;base64,{data}"></div>'


LIGHTEST = 99.0
"""The percentile of the pressures in contact that has the lightest colour: single peaks do not set the scale."""


def _map(
    axes: Any, field: Any, size: tuple[float, ...], named: tuple[str, str], units: _Axes, title: str | None = None, largest: float | None = None
) -> None:
    """A map of a field, its first row at the bottom, as y points upwards. Values above the largest have its colour."""
    (name, kind), (height, width) = named, (units.values("length", length) for length in size)
    shown = units.values(kind, np.asarray(field))
    top = None if largest is None else units.values(kind, largest)
    image = axes.imshow(shown, origin="lower", extent=(0.0, width, 0.0, height), vmin=None if top is None else 0.0, vmax=top)
    axes.set(xlabel=units.label("x", "length"), ylabel=units.label("y", "length"), title=title or name)
    axes.ticklabel_format(scilimits=(-3, 4))
    axes.locator_params(nbins=5)
    is_above = largest is not None and np.nanmax(field) > largest
    shrink = min(max(size[0] / size[1], 0.3), 1.0)
    axes.figure.colorbar(image, ax=axes, shrink=shrink, extend="max" if is_above else "neither", label=units.label(name, kind))


def _near_contact(contact: Contact) -> slice:
    """The nodes of a line from the first to the last one in contact, with as many on either side; all nodes without contact."""
    touching = np.flatnonzero(contact.contact)
    if touching.size == 0:
        return slice(None)
    first, last = int(touching[0]), int(touching[-1])
    width = last - first + 1
    return slice(max(first - width, 0), last + width + 1)
