"""Rough contact: a rough surface pressed on an elastic solid, solved, certified and recorded step by step.

    >>> import asperity as asp
    >>> surface = asp.Surface.rough(4096, 160e-6, hurst=0.8, rolloff_wavelength=20e-6, short_cutoff=1e-6, rms_gradient=1e-3)
    >>> contact = asp.solve(surface, reduced_pressure=0.01)
    >>> contact.converged
    True

- `solve` presses heights on a solid and returns a `Contact`: fields as numpy arrays, measures, and a `Certificate` that bounds its error. With a
  list of loads, along a path, at several speeds and while rolling it returns a `History`.
- `Surface`, `Problem` and `Setup` describe a contact. A `Setup` is text that repeats it to the last bit.
- `study` solves a setup with lists, in this process or on the workers of Dask, and returns a `Table` for numpy, pandas and Arrow.
- `certify` checks a result of any other code, and `Recorder` each step of your own loop.
- `load` reads a saved result again. `theory` has closed forms. `show` displays contacts and recordings in a notebook, `explore` opens the
  interactive page on a setup.

Conventions: heights are positive towards the solid, pressure in compression, displacement into the solid. The gap is displacement minus
height plus a datum. Wavenumbers are 2 pi / wavelength. Any consistent set of units works; texts such as "160 um" and "1 GPa" become metres and
pascals. Callbacks, recordings and the number of threads (RAYON_NUM_THREADS) do not change results.
"""

from __future__ import annotations

from importlib import import_module

from asperity import theory
from asperity._asperity import (
    AsperityError,
    AsperityWarning,
    Batch,
    CancelToken,
    Certificate,
    Certification,
    Contact,
    History,
    Ledger,
    NotConverged,
    PartialSlip,
    Problem,
    Recorder,
    Setup,
    Step,
    Study,
    Surface,
    Table,
    Work,
    load,
    observables,
    unexpected_keyword,
)

# type checkers read this name as true; importing `typing` would take as long as all the rest
TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from typing import Any, Callable, Literal, Mapping, Sequence, Union, overload

    import numpy as np
    from numpy.typing import ArrayLike
    from typing_extensions import Required, Unpack

    from asperity import notebook
    from asperity._asperity import ListOfLoads, Load, Loads, OwnSolver, SolveOptions, Stiffness
    from asperity.export import load_displacement
    from asperity.notebook import show
    from asperity.page import explore
    from asperity.studies import study
    from asperity.vtk import to_vtk

    Length = Union[float, str]
    """A number, or a text with a unit such as "160 um"."""
    Pressure = Union[float, str]
    """A number, or a text with a unit such as "1 GPa"."""
    Keys = Mapping[str, Any]
    """A section of a scene, with `_` for `-` in its keys."""
    Heights = Union[ArrayLike, Surface, os.PathLike[str], str]
    """An array of heights, a Surface, or a file of heights."""

    class PressOptions(SolveOptions, total=False):
        """The keywords of `solve` besides heights, size and load."""

        boundary: Literal["periodic", "free"] | Sequence[str] | None
        datum: Length | None
        prepare: Keys | Literal["auto"] | None
        channel: str | int | None
        file_unit: Length | None
        height_unit: Length | None
        against: os.PathLike[str] | str | None
        solid: Pressure | Keys | Stiffness | None
        law: Keys | None
        friction: Keys | None
        viscoelastic: Keys | None
        sliding: Keys | None
        flow: Keys | None
        progress: bool

    class Press(Load, PressOptions, total=False): ...

    class PressSeveral(ListOfLoads, PressOptions, total=False): ...

    class PressAlong(Load, PressOptions, total=False):
        path: Required[Keys | os.PathLike[str] | str]

    class PressSticky(Load, PressOptions, total=False):
        adhesion: Required[Keys]
        path: Keys | os.PathLike[str] | str | None

    class PressRolling(Load, PressOptions, total=False):
        rolling: Required[Keys]

__all__ = [
    "AsperityError",
    "AsperityWarning",
    "Batch",
    "CancelToken",
    "Certificate",
    "Certification",
    "Contact",
    "History",
    "Ledger",
    "NotConverged",
    "PartialSlip",
    "Problem",
    "Recorder",
    "Setup",
    "Step",
    "Study",
    "Surface",
    "Table",
    "Work",
    "certify",
    "explore",
    "load",
    "load_displacement",
    "notebook",
    "observables",
    "show",
    "solve",
    "study",
    "theory",
    "to_vtk",
]


def __getattr__(name: str) -> Any:
    # modules that take long to import are imported when they are first used
    if name == "notebook":
        return import_module("asperity.notebook")
    if name == "explore":
        return import_module("asperity.page").explore
    if name == "show":
        return import_module("asperity.notebook").show
    if name == "study":
        return import_module("asperity.studies").study
    if name == "to_vtk":
        return import_module("asperity.vtk").to_vtk
    if name == "load_displacement":
        return import_module("asperity.export").load_displacement
    if name == "__version__":
        return import_module("importlib.metadata").version("asperity-contact")
    raise AttributeError(f"module 'asperity' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


if TYPE_CHECKING:
    @overload
    def solve(height: Heights, size: Length | Sequence[Length] | None = None, **keywords: Unpack[Press]) -> Contact: ...
    @overload
    def solve(height: Heights, size: Length | Sequence[Length] | None = None, **keywords: Unpack[PressSeveral]) -> History: ...
    @overload
    def solve(height: Heights, size: Length | Sequence[Length] | None = None, **keywords: Unpack[PressAlong]) -> History: ...
    @overload
    def solve(height: Heights, size: Length | Sequence[Length] | None = None, **keywords: Unpack[PressSticky]) -> History: ...
    @overload
    def solve(height: Heights, size: Length | Sequence[Length] | None = None, **keywords: Unpack[PressRolling]) -> History: ...


def solve(
    height: Heights,
    size: Length | Sequence[Length] | None = None,
    *,
    mean_pressure: Pressure | Loads | None = None,
    reduced_pressure: float | Loads | None = None,
    mean_gap: Length | Loads | None = None,
    force: float | str | Loads | None = None,
    approach: Length | Loads | None = None,
    boundary: Literal["periodic", "free"] | Sequence[str] | None = None,
    datum: Length | None = None,
    prepare: Keys | Literal["auto"] | None = None,
    channel: str | int | None = None,
    file_unit: Length | None = None,
    height_unit: Length | None = None,
    against: os.PathLike[str] | str | None = None,
    solid: Pressure | Keys | Stiffness | None = None,
    law: Keys | None = None,
    friction: Keys | None = None,
    adhesion: Keys | None = None,
    viscoelastic: Keys | None = None,
    path: Keys | os.PathLike[str] | str | None = None,
    sliding: Keys | None = None,
    rolling: Keys | None = None,
    flow: Keys | None = None,
    solver: str | Keys | OwnSolver | None = None,
    tolerance: float | None = None,
    pressure_tolerance: float | None = None,
    max_iterations: int | None = None,
    refine: Literal["auto"] | None = None,
    area_tolerance: float | None = None,
    start: ArrayLike | None = None,
    callback: Callable[[Step], bool | None] | None = None,
    progress: bool = False,
    record: os.PathLike[str] | str | None = None,
    recording: Keys | None = None,
    live: bool = False,
    stream: Callable[[bytes], object] | None = None,
    diagnose: bool = False,
    **unknown: Any,
) -> Contact | History:
    """Presses heights on an elastic solid, and returns the contact.

    height: heights of a line, shape (n), or of a surface, shape (ny, nx), as lengths, with peaks towards the solid positive; or a Surface; or a
        file of heights.
    size: length of the cell, or the lengths along y and x. It is not needed where a file contains it.
    mean_pressure, reduced_pressure (mean pressure divided by rms gradient and contact modulus), mean_gap, force (of a line: force per length),
        approach: the load, one of them. A list of loads, or a range such as "1e-3..1e-1:5", returns a History; each solve starts from the
        previous contact.
    boundary: "periodic" (the cell repeats) or "free" (no pressure outside the cell), or one for each axis.
    datum: on a free boundary of a line, the distance from a line load at which the displacement is zero.
    prepare: "auto" prepares measured heights as they need it, or a dictionary of steps, as of Surface.read. Contact.problem.surface.preparation says
        what was done, and why.
    channel, file_unit, height_unit, against: of a file of heights: its channel, the unit of one that states none, that of its heights where it is
        another one, and a file of the second body.
    solid: contact modulus E / (1 - nu^2), or a dictionary: contact_modulus, or young and poisson (two each for two bodies); for a layer also its
        thickness as layer, and base. Without a solid, pressures are in units of the contact modulus. A solid of your own is a function k(q)
        that returns the stiffness, pressure over displacement, of waves of the wavenumbers q = 2 pi / wavelength; or a dictionary with such
        a function or array as stiffness, with the wavenumbers of an array as wavenumber, and with uniform_stiffness, the stiffness
        under a uniform pressure. Its boundary is periodic.
        A body that yields below its surface also has yield_stress and hardening_modulus, pressures; and, if you want, kinematic_hardening, yield_depth
        (where the layers end in which it may yield), yield_layers (their number) and yield_errors (True: also estimate the errors by steps, layers and grid). It returns a History: a list of loads, or the loads of a
        path, follow each other, up and down. History.fields["imprint"] has what stays, History.cut the strain and the stress below.
    law: {"hardness": pressure} of the softer body. Without it the solid is elastic at any pressure.
    friction: {"coefficient": mu, "tangential": load} adds a tangential load along x; Contact.slip has the stick and slip areas.
    adhesion: {"work": w, "range": rho} attracts the surfaces, with "form" "exponential", "cubic" or "dugdale", or {"table": file.csv}. Its
        "method" is "fast", "safe", or "gfmd", a motion whose frames show jumps. It returns a History. History.fields["attraction"] has the
        attraction, History.claims what each state claims to be, and History.adhesion pull-off, jumps and energies. Pressures may be negative.
    viscoelastic: {"creep": [f, tau, ...]} or {"relaxation": [g, tau, ...]}: pairs of a ratio and a time of a solid that creeps. The elastic
        constants are those at once after loading. It needs a path with times, or sliding. Of two bodies both creep alike.
    path: {"time": ..., "load": ..., "tangential": ...}: lists of one length, of which some may be missing. Between two points loads change
        linearly. It returns a History: creep where there are times, partial slip where there are tangential loads and friction. With
        adhesion or a yield stress it has loads alone. A path may be a file: a table with the columns time, load and tangential.
    sliding: {"speed": v}: slides steadily along x; measures["friction"] is the friction. Several speeds return a History.
    rolling: {"creepage": ...} or {"tangential": ...}: lines roll steadily with friction, which needs friction={"coefficient": mu}. It returns a History.
    flow: {"leakage": True} finds percolation and leakage, {"resistivity": rho} or {"conductivity": k} (one for both bodies, or two) the conductance.
        They are among the measures, under the names of the tables of the command line.
    solver: "multilevel" (the fastest), "polonsky-keer" or "gfmd", or a dictionary with its method and settings; or a function of the Problem that
        yields one pressure after the other. Each is certified, and no more are taken when the tolerance is reached.
    tolerance: the certificate to reach (1e-8). pressure_tolerance: the bound of the relative error of the pressure to reach.
    refine: "auto" refines the grid until the estimated errors of area and kappa_r are below area_tolerance (0.01).
    start: a pressure to start from, such as the solution under a similar load.
    callback: called with every Step; the run ends when it returns False. progress: shows a bar by tqdm.
    record: a file .rrd for all steps, for the contacts under a list of loads, or for the states of a history, to be opened in the Rerun viewer.
        recording: keys of the section `record` of a scene. live: shows the steps
        in the installed viewer. stream: a callable that takes the recording as bytes, piece by piece, such as `asperity.notebook.Viewer()`.
    diagnose: solves twice; Contact.diagnosis then states why the solver is slow.

    Raises AsperityError, a ValueError, for invalid input, TypeError for an argument of another type or a keyword that does not exist, and
    FileNotFoundError for a missing file. Doubtful results give an AsperityWarning. Ctrl-C ends the run.
    """
    for name in unknown:
        raise unexpected_keyword("solve", name, list(solve.__kwdefaults__ or ()))
    keys: dict[str, Any] = {
        "solid": solid,
        "law": law,
        "friction": friction,
        "adhesion": adhesion,
        "viscoelastic": viscoelastic,
        "path": path,
        "sliding": sliding,
        "rolling": rolling,
        "flow": flow,
        "mean_pressure": mean_pressure,
        "reduced_pressure": reduced_pressure,
        "mean_gap": mean_gap,
        "force": force,
        "approach": approach,
    }
    of_file = {"channel": channel, "file_unit": file_unit, "height_unit": height_unit, "against": against}
    problem: Problem[Any] = Problem(_surface(height, size, boundary, datum, prepare, of_file), **keys)
    options: SolveOptions = {
        "solver": solver,
        "tolerance": tolerance,
        "pressure_tolerance": pressure_tolerance,
        "max_iterations": max_iterations,
        "refine": refine,
        "area_tolerance": area_tolerance,
        "start": start,
        "callback": callback,
        "record": record,
        "recording": recording,
        "live": live,
        "stream": stream,
        "diagnose": diagnose,
    }
    if not progress:
        solved: Contact | History = problem.solve(**options)
        return solved
    from asperity.progress import show_steps

    with show_steps(callback, tolerance) as options["callback"]:
        solved = problem.solve(**options)
    return solved


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
    solid: Pressure | Keys | Stiffness | None = None,
    law: Keys | None = None,
    tolerance: float | None = None,
) -> Certification:
    """Certifies a result of another code: bounds its error, and recognises common mistakes.

    The result is one of pressure (positive in compression), gap and displacement (lengths), of the shape of the heights. Without a load, the
    mean of the pressure or of the gap is the load. The result holds if its certificate meets the tolerance (1e-8). The other keywords are those of
    `solve`.
    """
    results = (pressure, gap, displacement)
    if sum(result is not None for result in results) != 1:
        raise AsperityError("give one result to certify: a pressure, a gap or a displacement")
    loads = (mean_pressure, reduced_pressure, mean_gap, force, approach)
    if all(load is None for load in loads):
        mean_pressure = None if pressure is None else abs(_mean("pressure", pressure))
        mean_gap = None if gap is None else _mean("gap", gap)
        if displacement is not None:
            raise AsperityError("a displacement does not say its load: give one (mean_pressure, reduced_pressure, mean_gap, force, approach)")
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
    return problem.certify(pressure=pressure, gap=gap, displacement=displacement, tolerance=tolerance)


def _surface(
    height: Any, size: Any, boundary: Any, datum: Any, prepare: Any = None, of_file: Mapping[str, Any] | None = None
) -> Surface:
    """The surface of heights that are an array, a Surface or a file."""
    if isinstance(height, Surface):
        given = {"size": size, "boundary": boundary, "datum": datum, "prepare": prepare, **(of_file or {})}
        if named := [name for name, value in given.items() if value is not None]:
            raise AsperityError(f"a Surface has its own {named[0]}: give {named[0]} to the Surface")
        return height
    if isinstance(height, str) or hasattr(height, "__fspath__"):
        if str(height).endswith((".toml", ".json")):
            raise AsperityError(f"{height} is a scene and not a file of heights: use Setup.read({str(height)!r}).solve()")
        return Surface.read(height, size=size, boundary=boundary, datum=datum, prepare=prepare, **(of_file or {}))
    if isinstance(height, (Setup, Problem)):
        name = type(height).__name__
        raise TypeError(f"height must be an array, a Surface or the name of a file, not {name}: solve a {name} by its own method solve()")
    if height is None:
        raise TypeError("height must be an array, a Surface or the name of a file, not None")
    if named := [name for name, value in (of_file or {}).items() if value is not None]:
        raise AsperityError(f"{named[0]} is for a file of heights, but the heights are an array: leave {named[0]} out")
    if size is None:
        raise AsperityError("no size is given: give the length of the cell, or those along y and x (size)")
    return Surface(height, size, boundary=boundary, datum=datum, prepare=prepare)


def _mean(name: str, field: ArrayLike) -> float:
    import numpy as np

    if np.iscomplexobj(field):
        raise TypeError(f"{name} is complex: give real numbers, such as its real part")
    try:
        return float(np.mean(np.asarray(field), dtype=float))
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be an array of numbers, not {type(field).__name__}") from None
