"""Rough contact: a rough surface pressed on an elastic solid, solved, certified and recorded step by step.

    >>> import asperity as asp
    >>> surface = asp.Surface.rough(4096, 160e-6, hurst=0.8, rolloff_wavelength=20e-6, short_cutoff=1e-6, rms_gradient=1e-3)
    >>> contact = asp.solve(surface, reduced_pressure=0.01)
    >>> contact.converged
    True

- `solve` presses heights on a solid; the `Contact` has fields as numpy arrays, measures, and a `Certificate` that bounds its error.
- `Surface`, `Problem` and `Setup` describe a contact, the last as text that repeats it to the last bit.
- `study` solves a setup with lists, here or on the workers of Dask, and returns a `Table` for numpy, pandas and Arrow.
- `certify` judges a result of any other code, and `Recorder` each step of a loop of your own.
- `theory` has closed forms; `show` looks at contacts and recordings in a notebook.

Conventions: heights are positive towards the solid, pressure in compression, displacement into the solid; the gap is the displacement
less the heights plus a datum. Wavenumbers are 2 pi / wavelength. Any consistent set of units will do; texts such as "160 um" and
"1 GPa" become metres and pascals. Results do not depend on who watches, nor on the number of threads (RAYON_NUM_THREADS).
"""

from __future__ import annotations

from importlib import import_module

from asperity import theory
from asperity._asperity import (
    AsperityError,
    AsperityWarning,
    Batch,
    Certificate,
    Contact,
    Halt,
    Ledger,
    Problem,
    Recorder,
    Setup,
    Step,
    Study,
    Surface,
    Table,
    Verdict,
    Work,
    observables,
)

# type checkers take this name for true; to import `typing` would take as long as all the rest
TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from typing import Any, Callable, Literal, Mapping, Sequence, Union

    import numpy as np
    from numpy.typing import ArrayLike

    from asperity import notebook
    from asperity.campaign import study
    from asperity.notebook import show

    Length = Union[float, str]
    """A number, or a text with a unit such as "160 um"."""
    Pressure = Union[float, str]
    """A number, or a text with a unit such as "1 GPa"."""
    Keys = Mapping[str, Any]
    """A section of a scene, with `_` for `-` in its keys."""

__all__ = [
    "AsperityError",
    "AsperityWarning",
    "Batch",
    "Certificate",
    "Contact",
    "Halt",
    "Ledger",
    "Problem",
    "Recorder",
    "Setup",
    "Step",
    "Study",
    "Surface",
    "Table",
    "Verdict",
    "Work",
    "certify",
    "notebook",
    "observables",
    "show",
    "solve",
    "study",
    "theory",
]


def __getattr__(name: str) -> Any:
    # what takes long to import, or is read from disk, waits until it is asked for
    if name == "notebook":
        return import_module("asperity.notebook")
    if name == "show":
        return import_module("asperity.notebook").show
    if name == "study":
        return import_module("asperity.campaign").study
    if name == "__version__":
        return import_module("importlib.metadata").version("asperity")
    raise AttributeError(f"module 'asperity' has no attribute {name!r}")


def solve(
    height: ArrayLike | Surface | os.PathLike[str] | str,
    size: Length | Sequence[Length] | None = None,
    *,
    mean_pressure: Pressure | None = None,
    reduced_pressure: float | None = None,
    mean_gap: Length | None = None,
    force: float | str | None = None,
    approach: Length | None = None,
    boundary: Literal["periodic", "free"] | Sequence[str] | None = None,
    datum: Length | None = None,
    solid: Pressure | Keys | None = None,
    law: Keys | None = None,
    solver: str | Keys | None = None,
    tolerance: float | None = None,
    pressure_tolerance: float | None = None,
    max_iterations: int | None = None,
    start: ArrayLike | None = None,
    callback: Callable[[Step], bool | None] | None = None,
    record: os.PathLike[str] | str | None = None,
    recording: Keys | None = None,
    live: bool = False,
    stream: Callable[[bytes], object] | None = None,
    diagnose: bool = False,
) -> Contact:
    """Presses heights on an elastic solid, and returns the contact.

    height: heights of a line, shape (n), or of a surface, shape (ny, nx), a length each, peaks towards the solid positive; or a Surface, or
        a file of heights.
    size: length of the cell, or the lengths along y and x; none where a file says its own.
    mean_pressure, reduced_pressure (mean pressure over rms gradient and contact modulus), mean_gap, force (of a line per length), approach:
        the load, one of them.
    boundary: "periodic" (the cell repeats itself) or "free" (nothing presses the solid beyond the cell), or one for each axis.
    datum: distance from a line load at which the surface stands still, of a line on a free boundary.
    solid: contact modulus E / (1 - nu^2), or a dictionary: contact_modulus, or young and poisson (two each for two bodies), and of a layer
        its thickness as layer, and base. Without one pressures are over the contact modulus.
    law: {"hardness": pressure} of the softer body; else it is elastic at any pressure.
    solver: "multilevel" (the fast one), "polonsky-keer" or "gfmd", or a dictionary with its method and settings.
    tolerance: the certificate to reach, 1e-8 if none is given; pressure_tolerance: the bound of the relative error of the pressure.
    start: a pressure to start from, such as that under a neighbouring load.
    callback: called with every Step; the run ends when it returns False.
    record: a file .rrd that gets every step, for the Rerun viewer; recording: the keys of the section `record` of a scene; live: shows the
        steps in the installed viewer; stream: a callable that takes the recording as bytes, piece by piece as it grows, such as
        `asperity.notebook.Viewer()`.
    diagnose: solves twice, and the contact says what held the solver up.

    Raises AsperityError for what makes no contact. Ctrl-C ends the run.
    """
    surface = _surface(height, size, boundary, datum)
    problem = Problem(
        surface,
        solid=solid,
        law=law,
        mean_pressure=mean_pressure,
        reduced_pressure=reduced_pressure,
        mean_gap=mean_gap,
        force=force,
        approach=approach,
    )
    return problem.solve(
        solver=solver,
        tolerance=tolerance,
        pressure_tolerance=pressure_tolerance,
        max_iterations=max_iterations,
        start=start,
        callback=callback,
        record=record,
        recording=recording,
        live=live,
        stream=stream,
        diagnose=diagnose,
    )


def certify(
    height: ArrayLike | Surface | os.PathLike[str] | str,
    size: Length | Sequence[Length] | None = None,
    *,
    pressure: ArrayLike | None = None,
    gap: ArrayLike | None = None,
    displacement: ArrayLike | None = None,
    mean_pressure: Pressure | None = None,
    reduced_pressure: float | None = None,
    mean_gap: Length | None = None,
    force: float | str | None = None,
    approach: Length | None = None,
    boundary: Literal["periodic", "free"] | Sequence[str] | None = None,
    datum: Length | None = None,
    solid: Pressure | Keys | None = None,
    law: Keys | None = None,
) -> Verdict:
    """Certifies somebody's result: bounds its error, and recognises everyday mistakes from the numbers.

    One of pressure (positive in compression), gap and displacement (lengths) is the result, of the shape of the heights. Without a load it
    is certified under its own: the mean of the pressure, or of the gap. All else is as in `solve`.
    """
    loads = (mean_pressure, reduced_pressure, mean_gap, force, approach)
    if all(load is None for load in loads):
        mean_pressure = None if pressure is None else abs(_mean(pressure))
        mean_gap = None if gap is None else _mean(gap)
    problem = Problem(
        _surface(height, size, boundary, datum),
        solid=solid,
        law=law,
        mean_pressure=mean_pressure,
        reduced_pressure=reduced_pressure,
        mean_gap=mean_gap,
        force=force,
        approach=approach,
    )
    return problem.certify(pressure=pressure, gap=gap, displacement=displacement)


def _surface(height: Any, size: Any, boundary: Any, datum: Any) -> Surface:
    """The surface of heights, whatever they come as."""
    if isinstance(height, Surface):
        given = {"size": size, "boundary": boundary, "datum": datum}
        if named := [name for name, value in given.items() if value is not None]:
            raise AsperityError(f"a Surface has its own {named[0]}: give it to the Surface")
        return height
    if isinstance(height, str) or hasattr(height, "__fspath__"):
        return Surface.read(height, size=size, boundary=boundary, datum=datum)
    if size is None:
        raise AsperityError("no size is given: give the length of the cell, or those along y and x (size)")
    return Surface(height, size, boundary=boundary, datum=datum)


def _mean(field: ArrayLike) -> float:
    import numpy as np

    return float(np.mean(np.asarray(field, dtype=float)))
