"""Contacts and recordings in notebooks: in the Rerun viewer where it is installed, and as figures of matplotlib."""

from __future__ import annotations

import os
from importlib.util import find_spec
from time import monotonic
from typing import Any

from asperity._asperity import AsperityError, Contact, History, Setup, Surface


def show(what: Contact | History | Surface | os.PathLike[str] | str, *, width: int = 1000, height: int = 700) -> Any:
    """Shows a recording in the viewer inside a notebook, or a figure of a contact, a history or a surface.

    what: the file of a recording (.rrd), a contact, a history or a surface. The package `rerun-notebook` shows recordings. Without
        it the setup in the recording is solved again, to the last bit, and its figure is shown. A recording without a whole setup, such as that of
        heights given as an array, returns its path, which `asperity view` or any Rerun viewer opens.
    """
    if isinstance(what, (Contact, History, Surface)):
        return what.plot()
    if not isinstance(what, (str, os.PathLike)):
        raise TypeError(f"what must be a Contact, a History, a Surface or the name of a file, not {type(what).__name__}")
    path = os.fspath(what)
    if not os.path.exists(path):
        raise FileNotFoundError(f"cannot read {path}: there is no such file")
    if not has_viewer():
        return _picture(path)
    widget = _widget(width, height)
    with open(path, "rb") as recording:
        widget.send_rrd(recording.read())
    return widget


def _picture(path: str) -> Any:
    """A figure of what a recording shows at its end, or its path if that is not known."""
    try:
        solved = Setup.read(path).solve()
    except (AsperityError, FileNotFoundError):
        return path
    return solved.plot()


class Viewer:
    """A viewer in the cell that makes it, which shows a recording while it grows: use it as the `stream` of a `Recorder`, or of `solve`.

        viewer = await asp.notebook.Viewer().ready()
        with asp.Recorder(problem, stream=viewer) as recorder:
            for pressure in my_iteration():
                recorder.step(pressure)

    It needs the package `rerun-notebook`. Data wait until the browser has loaded the viewer, and a kernel does not receive messages of the
    browser while a cell runs. Without `ready` a recording may appear only at the end of the cell, as it does with kernels before ipykernel 7.4.
    """

    def __init__(self, *, width: int = 1000, height: int = 700) -> None:
        from IPython.display import display

        self._widget = _widget(width, height)
        self._is_ready = False
        self._widget.on_msg(self._on_message)
        display(self._widget)

    def __call__(self, piece: bytes) -> None:
        """Shows a piece of the recording."""
        self._widget.send_rrd(piece)

    async def ready(self, timeout: float = 10.0) -> Viewer:
        """Waits until the browser has loaded the viewer, or for `timeout` seconds, and returns the viewer."""
        from asyncio import sleep

        end = monotonic() + timeout
        while not self._is_ready and monotonic() < end:
            await sleep(0.05)
        return self

    def _on_message(self, _widget: Any, message: Any, _buffers: Any) -> None:
        self._is_ready |= message == "ready"


def _widget(width: int, height: int) -> Any:
    """The widget with the viewer. It comes from its package and not from the network, unless the environment says otherwise."""
    os.environ.setdefault("RERUN_NOTEBOOK_ASSET", "serve-local")
    from rerun_notebook import Viewer

    return Viewer(width=width, height=height)


def has_viewer() -> bool:
    """Whether the viewer can be shown inside a notebook."""
    return find_spec("rerun_notebook") is not None
