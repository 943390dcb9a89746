"""The interactive page, opened on a setup."""

from __future__ import annotations

import atexit
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from asperity._asperity import AsperityError, Contact, Problem, Setup, Surface

REDUCED_PRESSURE = 0.05
"""The load under which the page shows a surface that has none."""
ARRAY = "array.npy"
"""The name in a setup for heights that were given as an array."""


class Page:
    """A page that is served on this machine, until it is closed or Python ends. `address` is where a browser finds it."""

    def __init__(self, setup: Setup, surface: Surface | None, port: int, opens: bool) -> None:
        self._folder = TemporaryDirectory(prefix="asperity-")
        folder = Path(self._folder.name)
        scene = folder / "scene.toml"
        _with_array(setup, surface, folder / ARRAY).write(scene)
        command = [sys.executable, "-m", "asperity", "explore", str(scene), "--port", str(port)]
        with open(folder / "errors.txt", "wb") as errors:
            self._process = subprocess.Popen(
                command if opens else [*command, "--no-open"], stdout=subprocess.PIPE, stderr=errors, text=True
            )
        atexit.register(self.close)
        try:
            self.address = self._begun(folder / "errors.txt")
        except BaseException:
            self.close()
            raise

    def _begun(self, errors: Path) -> str:
        """The address, which is printed when the page is ready."""
        assert self._process.stdout is not None
        for line in self._process.stdout:
            if line.startswith("http"):
                return line.split()[0]
        self._process.wait()
        sentences = [line.removeprefix("error: ") for line in errors.read_text(encoding="utf-8").splitlines() if line.startswith("error: ")]
        raise AsperityError(sentences[0] if sentences else "the page ended before it began")

    def close(self) -> None:
        """Ends the page."""
        self._process.terminate()
        self._process.wait()
        if self._process.stdout is not None:
            self._process.stdout.close()
        self._folder.cleanup()
        atexit.unregister(self.close)

    def __enter__(self) -> Page:
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"Page({self.address!r})"

    def _repr_html_(self) -> str:
        return f'<a href="{self.address}" target="_blank">{self.address}</a>'


def explore(what: Setup | Problem[Any] | Contact | Surface, *, port: int = 8765, open_browser: bool = True) -> Page:
    """Opens the interactive page on a setup, in the browser of this machine, and returns the Page.

    what: a Setup, Problem or Contact under one load; or a Surface, which is pressed with a reduced pressure of 0.05.
    port: the port on this machine; if it is in use, the next free one. 0 takes any.
    open_browser: whether the browser opens. In a notebook the returned page is shown as a link.

    The page is served to this machine alone. Close it with `Page.close()`, or use it in a `with` block; it also ends with Python.
    Raises AsperityError for what the page cannot show, such as a list of loads.
    """
    if isinstance(what, Setup):
        return Page(what, None, port, open_browser)
    if isinstance(what, Surface):
        what = Problem(what, reduced_pressure=REDUCED_PRESSURE)
    if isinstance(what, Contact):
        what = what.problem
    if not isinstance(what, Problem):
        raise AsperityError(f"{type(what).__name__} cannot be shown on the page: give a Setup, a Problem, a Contact or a Surface")
    return Page(what.setup, what.surface, port, open_browser)


def _with_array(setup: Setup, surface: Surface | None, path: Path) -> Setup:
    """The setup, with the name of a file for heights that were given as an array, which is written."""
    sections = setup.to_dict()
    if surface is None or sections["surface"].get("height") != ARRAY:
        return setup
    np.save(path, surface.height)
    sections["surface"]["height"] = path
    return Setup(**sections)
