"""Contacts and recordings in notebooks: the Rerun viewer where it is installed, and a picture everywhere."""

from __future__ import annotations

import os
from importlib.util import find_spec
from time import monotonic
from typing import Any

import numpy as np

from asperity._asperity import Contact


def show(what: Contact | os.PathLike[str] | str, *, width: int = 1000, height: int = 700) -> Any:
    """Shows a recording in the viewer inside a notebook, or a picture of a contact.

    what: the file of a recording (.rrd), or a contact. Without the package `rerun-notebook` a recording cannot be shown: its path comes
    back, to be opened by `asperity view` or any Rerun viewer.
    """
    if isinstance(what, Contact):
        return picture(what)
    path = os.fspath(what)
    if not has_viewer():
        return path
    widget = _widget(width, height)
    with open(path, "rb") as recording:
        widget.send_rrd(recording.read())
    return widget


class Viewer:
    """The viewer in the cell that makes it, and a recording that grows there: the `stream` of a `Recorder`, or of `solve`.

        viewer = await asp.notebook.Viewer().ready()
        with asp.Recorder(problem, stream=viewer) as recorder:
            for pressure in my_iteration():
                recorder.step(pressure)

    It needs the package `rerun-notebook`. What comes before the browser has loaded the viewer waits, and while a cell runs the kernel does
    not hear of the browser: without `ready` a recording may appear at the end of the cell only, as it does with kernels before ipykernel 7.4.
    """

    def __init__(self, *, width: int = 1000, height: int = 700) -> None:
        from IPython.display import display

        self._widget = _widget(width, height)
        self._is_ready = False
        self._widget.on_msg(self._hear)
        display(self._widget)

    def __call__(self, piece: bytes) -> None:
        """Shows a piece of the recording."""
        self._widget.send_rrd(piece)

    async def ready(self, patience: float = 10.0) -> Viewer:
        """The viewer, once the browser has loaded it, or after so many seconds."""
        from asyncio import sleep

        end = monotonic() + patience
        while not self._is_ready and monotonic() < end:
            await sleep(0.05)
        return self

    def _hear(self, _widget: Any, word: Any, _buffers: Any) -> None:
        self._is_ready |= word == "ready"


def _widget(width: int, height: int) -> Any:
    """The widget with the viewer, which comes from its package and not from the network, unless that is said otherwise."""
    os.environ.setdefault("RERUN_NOTEBOOK_ASSET", "serve-local")
    from rerun_notebook import Viewer

    return Viewer(width=width, height=height)


def has_viewer() -> bool:
    """Whether the viewer can be shown inside a notebook."""
    return find_spec("rerun_notebook") is not None


def picture(contact: Contact) -> Any:
    """A figure of a contact by matplotlib: surfaces and pressure of a line, images of pressure and gap of a surface."""
    from matplotlib.figure import Figure

    surface = contact.problem.surface
    figure = Figure(figsize=(9, 4), layout="constrained")
    above, below = figure.subplots(1, 2)
    if contact.pressure.ndim == 1:
        seen = _beside(contact)
        x, displacement = surface.x[seen], contact.displacement[seen]
        # upwards from the surface of the unloaded solid: displacement points into the solid, and peaks towards it
        above.plot(x, contact.gap[seen] - displacement, label="rigid surface")
        above.plot(x, -displacement, label="solid")
        above.set(xlabel="x", ylabel="z", title="surfaces")
        above.legend()
        below.plot(x, contact.pressure[seen])
        below.set(xlabel="x", ylabel="pressure", title="pressure")
        return figure
    extent = (0.0, surface.size[1], surface.size[0], 0.0)
    for axes, field, name in ((above, contact.pressure, "pressure"), (below, contact.gap, "gap")):
        image = axes.imshow(np.asarray(field), extent=extent)
        axes.set(xlabel="x", ylabel="y", title=name)
        figure.colorbar(image, ax=axes)
    return figure


def _beside(contact: Contact) -> slice:
    """The nodes of a line in contact and between, with as many on either side; all of them where nothing touches."""
    touching = np.flatnonzero(contact.pressure)
    if touching.size == 0:
        return slice(None)
    first, last = int(touching[0]), int(touching[-1])
    width = last - first + 1
    return slice(max(first - width, 0), last + width + 1)
