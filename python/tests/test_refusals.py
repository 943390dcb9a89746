"""What makes no contact is refused by exceptions of Python, in sentences with keywords of Python."""

import itertools
import re
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any, Callable, Mapping

import numpy as np
import pytest

import asperity as asp

HEIGHT = 0.01 * np.cos(2 * np.pi * np.arange(64) / 64)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({}, "no load is given"),
        ({"mean_pressure": 0.1}, "(solid)"),
        ({"reduced_pressure": -1.0}, "-1"),
        ({"reduced_pressure": float("nan")}, "finite"),
        ({"reduced_pressure": 0.1, "mean_gap": 0.01}, "give one of them"),
        ({"reduced_pressure": 0.1, "solver": "multigrid"}, "multilevel"),
        ({"reduced_pressure": 0.1, "tolerance": 0.0}, "tolerance"),
        ({"reduced_pressure": 0.1, "solid": {"modulus": 1.0}}, "contact_modulus"),
        ({"reduced_pressure": 0.1, "solid": {"young": 1.0, "poisson": 0.7}}, "0.7"),
        ({"reduced_pressure": 0.1, "start": np.zeros(32)}, "does not fit"),
        ({"reduced_pressure": 0.1, "record": "steps.txt"}, "rrd"),
        ({"mean_gap": 1.0}, "1.0"),
    ],
)
def test_each_refusal_is_one_sentence_with_what_to_do(keys: dict[str, Any], sentence: str) -> None:
    with pytest.raises(asp.AsperityError) as refusal:
        asp.solve(HEIGHT, 1.0, **keys)
    assert sentence in str(refusal.value) and "\n" not in str(refusal.value)
    assert isinstance(refusal.value, ValueError)


@pytest.mark.parametrize(
    ("height", "size", "sentence"),
    [
        (np.zeros(64), 1.0, "flat"),
        (np.zeros((2, 2, 2)), 1.0, "neither a line nor a surface"),
        (np.array([0.0, 1.0, np.nan, 2.0]), 1.0, "index 2 is nan"),
        (HEIGHT, -1.0, "-1"),
        (HEIGHT, (1.0, 2.0), "2"),
        (HEIGHT, None, "size"),
        (HEIGHT[:2], 1.0, "2"),
    ],
)
def test_heights_that_are_none_are_refused(height: Any, size: Any, sentence: str) -> None:
    with pytest.raises(asp.AsperityError, match=sentence):
        asp.solve(height, size, reduced_pressure=0.1)


def test_files_that_are_missing_raise_what_python_raises(tmp_path: Path) -> None:
    for read in (asp.solve, asp.Surface.read, asp.Setup.read, asp.Study.read):
        with pytest.raises(FileNotFoundError, match="cannot read .*nowhere.npy"):
            read(tmp_path / "nowhere.npy")
    (tmp_path / "empty.npy").write_bytes(b"")
    with pytest.raises(asp.AsperityError, match="empty.npy"):
        asp.solve(tmp_path / "empty.npy", 1.0, reduced_pressure=0.1)


def test_a_contact_that_did_not_converge_can_be_raised() -> None:
    with pytest.warns(asp.AsperityWarning):
        contact = asp.solve(HEIGHT, 1.0, reduced_pressure=0.1, solver="polonsky-keer", max_iterations=2)
    with pytest.raises(asp.NotConverged, match="not converged: .* after 2 iterations") as raised:
        contact.raise_if_not_converged()
    assert raised.value.contact is contact and isinstance(raised.value, ValueError)
    good = asp.solve(HEIGHT, 1.0, reduced_pressure=0.1)
    assert good.raise_if_not_converged() is good


def test_what_is_masked_is_void() -> None:
    masked = np.ma.masked_array(HEIGHT, mask=np.arange(64) % 16 == 0)
    with pytest.raises(asp.AsperityError, match="4 of 64 values are masked: fill them, or crop the array"):
        asp.solve(masked, 1.0, reduced_pressure=0.1)
    with pytest.raises(asp.AsperityError, match="4 of 64 values are masked"):
        asp.solve(HEIGHT, 1.0, reduced_pressure=0.1).problem.certify(pressure=masked)
    whole = asp.solve(np.ma.masked_array(HEIGHT), 1.0, reduced_pressure=0.1)
    assert np.array_equal(whole.pressure, asp.solve(HEIGHT, 1.0, reduced_pressure=0.1).pressure)


@pytest.mark.parametrize("name", ["x.txt", "x.h5", "x"])
def test_a_file_of_another_kind_is_refused(name: str, tmp_path: Path) -> None:
    contact = asp.solve(HEIGHT, 1.0, reduced_pressure=0.1)
    with pytest.raises(asp.AsperityError, match=r"give a name that ends in \.npz"):
        contact.save(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_keyword_that_is_none_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="toleranse"):
        asp.Problem(asp.Surface(HEIGHT, 1.0), reduced_pressure=0.1).solve(toleranse=1.0)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="load"):
        asp.Problem(asp.Surface(HEIGHT, 1.0), load=0.1)  # type: ignore[call-arg]


def test_a_run_that_does_not_converge_comes_back_with_a_warning() -> None:
    with pytest.warns(asp.AsperityWarning, match="iteration cap") as caught:
        contact = asp.solve(HEIGHT, 1.0, reduced_pressure=0.1, solver="polonsky-keer", max_iterations=2)
        contact.problem.solve(solver="polonsky-keer", max_iterations=2)
    # a warning at a line of the package would be shown once only
    assert [warning.filename for warning in caught] == [__file__] * len(caught)
    assert not contact.converged and contact.certificate.eta > 1e-8
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        asp.solve(HEIGHT, 1.0, reduced_pressure=0.1)


def test_the_sentences_are_those_of_the_command_line() -> None:
    with pytest.raises(asp.AsperityError) as refusal:
        asp.Setup(surface={"indenter": {"shape": "sine", "amplitude": 0.01}}, grid={"points": 64, "size": 1.0},
                  load={"reduced_pressure": -1.0}).solve()
    words = "solve --indenter sine --amplitude 0.01 --points 64 --size 1 --reduced-pressure -1".split()
    ran = subprocess.run([sys.executable, "-m", "asperity", *words], capture_output=True, text=True)
    assert ran.returncode == 2 and str(refusal.value) in ran.stderr


P = {"reduced_pressure": 0.1}
SINE = {"indenter": {"shape": "sine", "amplitude": 0.01}}
GRID = {"points": 64, "size": 1.0}
CREEP = {"viscoelastic": {"creep": [9, 1.0]}, "path": {"time": [1.0]}}
OF_GRID = "points, size, refine, boundary, datum"


def solve(height: Any = HEIGHT, size: Any = 1.0, /, **keys: Any) -> Any:
    return asp.solve(height, size, **{**P, **keys})


def recorded(**recording: Any) -> Any:
    return solve(record="run.rrd", recording=recording)


def rough(**keys: Any) -> Any:
    spectrum = {"hurst": 0.8, "rolloff_wavelength": 0.5, "short_cutoff": 0.1, "rms_gradient": 0.1}
    return asp.Surface.rough(64, 1.0, **{**spectrum, **keys})


def read(**keys: Any) -> Any:
    np.save("heights.npy", HEIGHT)
    return asp.Surface.read("heights.npy", size=1.0, **keys)


def problem() -> Any:
    return asp.Problem(asp.Surface(HEIGHT, 1.0), **P)


def setup(**sections: Any) -> Any:
    return asp.Setup(**{"surface": SINE, "grid": GRID, "load": P, **sections})


def study(amplitude: float = 0.01) -> Any:
    surface = {"indenter": {"shape": "sine", "amplitude": amplitude}}
    return asp.Study(surface=surface, grid=GRID, load={"reduced_pressure": [0.1, 0.2]})


def with_steps(*steps: Any, **keywords: Any) -> Any:
    with asp.Recorder(problem(), **keywords) as recorder:
        for step in steps:
            recorder.step(*step)
    return recorder


def continued() -> Any:
    asp.study(study(), out="study.csv")
    return asp.study(study(0.02), out="study.csv")


def text_file(name: str, text: bytes = b"") -> str:
    Path(name).write_bytes(text)
    return name


def holding_itself() -> list[Any]:
    within: list[Any] = []
    within.append(within)
    within.append(within)
    return within


def deep(depth: int = 100_000) -> Any:
    value: Any = 1.0
    for _ in range(depth):
        value = [value]
    return value


def dict_in_itself() -> dict[str, Any]:
    within: dict[str, Any] = {}
    within["surface"] = within
    return within


def of_doubles(*shape: int) -> Any:
    return np.broadcast_to(np.float64(1.0), shape)


Refusal = tuple[Callable[[], Any], type[Exception], str]
"""A call that is refused, the class of the exception, and its sentence or the decisive part of it."""

REFUSALS: list[Refusal] = [
    # arrays
    (lambda: solve(HEIGHT * 1j), TypeError, "height is complex: give real numbers, such as its real part"),
    (lambda: solve(["a", "b"]), TypeError, "height must be an array of numbers, not list"),
    (lambda: solve(None), TypeError, "height must be an array, a Surface or the name of a file, not None"),
    (lambda: solve(problem()), TypeError, "solve a Problem by its own method solve()"),
    (lambda: solve(setup()), TypeError, "solve a Setup by its own method solve()"),
    (lambda: solve("scene.toml"), asp.AsperityError, "scene.toml is a scene and not a file of heights: use Setup.read('scene.toml').solve()"),
    (lambda: solve(3.0), asp.AsperityError, "a single number is neither a line nor a surface: give an array with one or two axes"),
    (lambda: solve(np.zeros((2, 2, 2))), asp.AsperityError, "an array of shape (2, 2, 2) is neither a line nor a surface"),
    (lambda: solve(HEIGHT.reshape(64, 1)), asp.AsperityError, "an array of shape (64, 1) is a column: give a line as shape (64,)"),
    (lambda: solve(np.array([[0.0] * 4, [0, 1, np.inf, 2]])), asp.AsperityError, "the height at index (1, 2) is inf: all values must be finite"),
    (lambda: solve(start="x"), TypeError, "start must be an array of numbers, not str"),
    (lambda: solve(start=np.zeros(3)), asp.AsperityError,
        "the pressure to start from has the shape (3,) and does not fit heights of shape (64,): give one value for each height"),
    (lambda: problem().certify(pressure="result.npz"), TypeError, "pressure must be an array of numbers, not str"),
    (lambda: asp.certify(HEIGHT, 1.0, pressure="result.npz"), TypeError, "pressure must be an array of numbers, not str"),
    (lambda: asp.certify(HEIGHT, 1.0, pressure=HEIGHT, gap=HEIGHT), asp.AsperityError, "give one result to certify: a pressure, a gap or a displacement"),
    (lambda: asp.certify(HEIGHT, 1.0, pressure=1j * HEIGHT), TypeError, "pressure is complex: give real numbers, such as its real part"),
    (lambda: asp.certify(HEIGHT, 1.0), asp.AsperityError, "give one result to certify"),
    (lambda: asp.certify(HEIGHT, 1.0, displacement=HEIGHT), asp.AsperityError, "a displacement does not say its load: give one (mean_pressure, "),
    (lambda: asp.Problem(HEIGHT, **P), TypeError, "surface must be a Surface(height, size), not ndarray"),
    # arguments that have no end, or no room
    (lambda: solve(of_doubles(60000, 60000)), asp.AsperityError, "an array of shape (60000, 60000) does not fit in memory: it needs 58 GB"),
    (lambda: solve(np.broadcast_to(np.int8(1), (60000, 60000))), asp.AsperityError, "does not fit in memory"),
    (lambda: solve([[0.0] * 60000] * 60000), asp.AsperityError, "an array of shape (60000, 60000) does not fit in memory"),
    (lambda: solve(start=of_doubles(60000, 60000)), asp.AsperityError, "does not fit in memory"),
    (lambda: problem().certify(pressure=of_doubles(60000, 60000)), asp.AsperityError, "does not fit in memory"),
    (lambda: problem().displacement(of_doubles(60000, 60000)), asp.AsperityError, "does not fit in memory"),
    (lambda: asp.theory.persson_relative_area(of_doubles(60000, 60000)), asp.AsperityError, "does not fit in memory"),
    (lambda: with_steps((of_doubles(60000, 60000),)), asp.AsperityError, "does not fit in memory"),
    (lambda: asp.theory.persson_relative_area(np.ones((1,) * 40)), asp.AsperityError, "an array has 40 axes: give one with at most 32"),
    (lambda: solve(holding_itself()), TypeError, "height must be an array of numbers, not list"),
    (lambda: solve(deep()), TypeError, "height must be an array of numbers, not list"),
    (lambda: asp.Surface(HEIGHT, holding_itself()), asp.AsperityError,
        "size has more than 16 lists or dictionaries in each other: give a plain value"),
    (lambda: asp.Surface(HEIGHT, deep()), asp.AsperityError, "size has more than 16 lists or dictionaries in each other"),
    (lambda: asp.Surface(HEIGHT, 1.0, prepare=dict_in_itself()), asp.AsperityError, "more than 16 lists or dictionaries"),
    (lambda: asp.Surface(HEIGHT, itertools.repeat(1.0)), asp.AsperityError, "size has more than 4000000 values: give fewer"),
    (lambda: asp.Surface.rough(deep(), 1.0), asp.AsperityError, "points has more than 16 lists"),
    (lambda: asp.Surface.from_sections(dict_in_itself(), GRID), asp.AsperityError, "more than 16 lists or dictionaries"),
    (lambda: asp.Setup(**dict_in_itself()), asp.AsperityError, "more than 16 lists or dictionaries"),
    (lambda: asp.Study(**dict_in_itself()), asp.AsperityError, "more than 16 lists or dictionaries"),
    (lambda: asp.study(dict_in_itself()), asp.AsperityError, "more than 16 lists or dictionaries"),
    (lambda: solve(solid=dict_in_itself()), asp.AsperityError, "more than 16 lists or dictionaries"),
    (lambda: solve(solver=deep()), asp.AsperityError, "solver has more than 16 lists"),
    (lambda: solve(recording=deep()), asp.AsperityError, "recording has more than 16 lists"),
    (lambda: problem().with_load(mean_pressure=deep()), asp.AsperityError, "more than 16 lists"),
    (lambda: solve().stress(poisson=0.3, depths=itertools.repeat(1.0)), asp.AsperityError, "depths has more than 1000000 values: give fewer"),
    (lambda: solve().stress(poisson=0.3, depths=of_doubles(60000, 60000)), TypeError, "a depth must be a length, a number or a text such as '1 um', not ndarray"),
    (lambda: solve().pressure_distribution(bins=10**12), asp.AsperityError, "a distribution has 1000000000000 bins: give at most 1000000"),
    (lambda: study().solve([0], threads=10**9), asp.AsperityError, "on 1000000000 threads: give at most 4096"),
    # keywords that a function does not take
    (lambda: solve(modulus=1.0), TypeError, "solve() got an unexpected keyword argument 'modulus'. Did you mean solid=...?"),
    (lambda: solve(pressure=1.0), TypeError, "'pressure'. Did you mean mean_pressure=...?"),
    (lambda: solve(hardness=1.0), TypeError, "'hardness'. Did you mean law={'hardness': ...}?"),
    (lambda: solve(toleranse=1.0), TypeError, "'toleranse'. Did you mean 'tolerance'?"),
    (lambda: problem().solve(masses="uniform"), TypeError, "'masses'. Did you mean solver={'masses': ...}?"),
    (lambda: problem().with_load(pressure=1.0), TypeError, "with_load() got an unexpected keyword argument 'pressure'. Did you mean mean_pressure=...?"),
    (lambda: asp.Problem(asp.Surface(HEIGHT, 1.0), modulus=1.0), TypeError, "Problem() got an unexpected keyword argument 'modulus'. Did you mean solid=...?"),
    (lambda: setup(modulus=1.0), TypeError, "Setup() got an unexpected keyword argument 'modulus'. Did you mean solid=...?"),
    (lambda: asp.Study(surface=SINE, grid=GRID, load=P, modulus=1.0), TypeError,
        "Study() got an unexpected keyword argument 'modulus'. Did you mean solid=...?"),
    (lambda: asp.Surface(HEIGHT, 1.0, channel=1), TypeError, f"Surface() got an unexpected keyword argument 'channel'. It takes {OF_GRID}"),
    (lambda: rough(rolloff=1.0), TypeError, "rough() got an unexpected keyword argument 'rolloff'. Did you mean rolloff_wavelength=...?"),
    (lambda: rough(short_cutof=1.0), TypeError, "'short_cutof'. Did you mean 'short_cutoff'?"),
    (lambda: read(unit="1 um"), TypeError, "read() got an unexpected keyword argument 'unit'. Did you mean 'file_unit'?"),
    (lambda: asp.Surface.indenter("punch", 64, 1.0, half_widht=1), TypeError, "'half_widht'. Did you mean 'half_width'?"),
    # values of another type
    (lambda: solve(callback=3), TypeError, "callback must be a callable that takes a Step, not int"),
    (lambda: solve(callback=3, progress=True), TypeError, "callback must be a callable that takes a Step, not int"),
    (lambda: solve(stream=3), TypeError, "stream must be a callable that takes bytes, not int"),
    (lambda: solve(live=3), TypeError, "live must be True or False, not int"),
    (lambda: solve(diagnose="x"), TypeError, "diagnose must be True or False, not str"),
    (lambda: solve(record=3), TypeError, "record must be the name of a file, not int"),
    (lambda: asp.Surface.indenter(64, 1.0, "sine"), TypeError, "shape must be the name of an indenter, not int"),
    (lambda: asp.Surface.read(3), TypeError, "path must be the name of a file, not int"),
    (lambda: asp.Recorder(HEIGHT), TypeError, "problem must be a Problem, not ndarray"),
    (lambda: solve().leakage(0), TypeError, "axis must be 'x' or 'y', not int"),
    (lambda: solve().stress(depths=1.0), TypeError, "depths must be a list of lengths, numbers or texts such as '1 um', not float"),
    (lambda: solve().stress(depths=["1 s"]), asp.AsperityError, "a depth is '1 s': give a length, a number or one with a unit such as '1 um'"),
    (lambda: asp.show(3), TypeError, "what must be a Contact, a History, a Surface or the name of a file, not int"),
    # sections
    (lambda: solve(law=1.0), asp.AsperityError, "law is 1.0: give a dictionary of hardness"),
    (lambda: solve(friction=0.3), asp.AsperityError, "friction is 0.3: give a dictionary of coefficient, tangential"),
    (lambda: solve(path=1.5), asp.AsperityError, "path is 1.5: give a dictionary of file, time, load, tangential, steps, tolerance, time_tolerance"),
    (lambda: solve(path=[0, 1]), asp.AsperityError, "path is a list: give a dictionary of file, time, load, tangential, steps, tolerance, time_tolerance"),
    (lambda: solve(viscoelastic=[9, "9 ms"], path={"time": 1.0}), asp.AsperityError, "viscoelastic is a list: give a dictionary of creep, relaxation"),
    (lambda: solve(friction=[0.3, 0.1]), asp.AsperityError, "friction is a list: give a dictionary of coefficient, tangential"),
    (lambda: solve(viscoelastic={"creep": ["9 ms", 9]}, path={"time": 1.0}), asp.AsperityError, "`9 ms` is a time, but a ratio stands in its place"),
    (lambda: solve(viscoelastic={"creep": [9, 1]}, path={"time": 1.0, "steps": 2, "time_tolerance": 1e-2}), asp.AsperityError,
        "it has no effect on a given number of steps: leave the steps out, or the tolerance"),
    (lambda: solve(solver=3), asp.AsperityError, "solver is 3: give a name, or a dictionary of method, masses, dynamics, time_step, damping"),
    (lambda: solve(solid=True), asp.AsperityError, "solid is True: give a number, or a dictionary of contact_modulus, young, poisson, layer, base"),
    (lambda: solve(solid={"modulus": 1.0}), asp.AsperityError,
        "solid: unknown key 'modulus', expected one of 'contact_modulus', 'young', 'poisson', 'layer', 'base', 'wavenumber', 'stiffness', 'uniform_stiffness', 'yield_stress', 'hardening_modulus', 'kinematic_hardening', 'yield_depth', 'yield_layers', 'yield_errors': did you mean 'contact_modulus'?"),
    (lambda: solve(path={"tme": [1.0]}), asp.AsperityError, "path: unknown key 'tme', expected one of 'file', 'time', 'load', 'tangential', 'steps', 'time_tolerance', 'tolerance'"),
    (lambda: solve(solver={"method": "gfmd", "timestep": 1}), asp.AsperityError, "did you mean 'time_step'?"),
    (lambda: solve(solver={"masses": "stiffness"}), asp.AsperityError,
        "solver: 'masses' is a setting of the method gfmd, but the method is multilevel: give the method gfmd, or leave 'masses' out"),
    (lambda: setup(stop={"max_iteration": 1}), asp.AsperityError, "stop: unknown key 'max_iteration', expected one of 'tolerance', 'pressure_tolerance', "),
    (lambda: setup(load=3), asp.AsperityError, "load: expected a name and a number, such as {'mean_pressure': 0.01}"),
    (lambda: setup(load={"pressure": 3}), asp.AsperityError, "load is 'pressure', expected one of 'mean_pressure', 'reduced_pressure', "),
    (lambda: solve(solid={"young": [1, 2], "poisson": 0.3}), asp.AsperityError, "solid: 2 Young's moduli and 1 Poisson's ratio are given: give one of each"),
    (lambda: asp.Surface.indenter("sphere", (64, 64), 1.0), asp.AsperityError, "indenter: 'radius' is missing: give it"),
    # numbers and names
    (lambda: solve(tolerance="small"), asp.AsperityError, "tolerance is 'small': give a number"),
    (lambda: solve(max_iterations=-1), asp.AsperityError, "max_iterations is -1: give a whole number, 0 or more"),
    (lambda: solve(max_iterations=10**30), asp.AsperityError, "give a whole number of less than 64 bits"),
    (lambda: setup(stop={"max_iterations": 1.5}), asp.AsperityError, "max_iterations is 1.5: give a whole number, 0 or more"),
    (lambda: solve(HEIGHT, "x"), asp.AsperityError, "size is 'x': give a length: a number, or one with a unit such as"),
    (lambda: solve(boundary="fre"), asp.AsperityError, "boundary is 'fre', expected 'periodic' or 'free': did you mean 'free'?"),
    (lambda: solve(boundary=3), asp.AsperityError, "boundary is 3: give 'periodic' or 'free'"),
    (lambda: solve(solver="multigrid"), asp.AsperityError, "solver is 'multigrid', expected one of 'multilevel', 'polonsky-keer', 'gfmd'"),
    (lambda: solve(refine=2), asp.AsperityError, "refine is 2: give 'auto' here, or a number to the surface"),
    (lambda: read(refine="auto"), asp.AsperityError, "refine is 'auto': give a whole number here, or refine='auto' to solve"),
    (lambda: read(refine=0), asp.AsperityError, "refine is 0: give 1 or more"),
    (lambda: read(prepare="best"), asp.AsperityError, "prepare: \"best\" is not a preparation: give \"auto\", or the individual steps"),
    (lambda: read(prepare=["auto"]), asp.AsperityError, "prepare: [\"auto\"] is not a preparation"),
    (lambda: read(prepare={"fil": "harmonic"}), asp.AsperityError, "prepare: unknown key 'fil', expected one of 'resample', "),
    (lambda: asp.Surface.rough("auto", 1.0, hurst=0.8), asp.AsperityError, "points is 'auto': give whole numbers here, or grid={'points': 'auto', ...} to Setup"),
    (lambda: solve(area_tolerance=0.1), asp.AsperityError, "an area tolerance needs refine='auto' or points='auto'"),
    (lambda: rough(beta=[2]), asp.AsperityError, "beta has the length 1: give 2 values"),
    (lambda: rough(hurst="a"), asp.AsperityError, "hurst is 'a': give a number"),
    (lambda: asp.Surface.rough(64, 1.0, hurst=0.8), asp.AsperityError, "spectrum: 'rolloff_wavelength' is missing: give it"),
    (lambda: asp.Surface.from_sections({**SINE, "joined": "lower"}, GRID), asp.AsperityError,
        "joined needs two spectra: give surface={'second_spectrum': ...} as well, or leave it out"),
    (lambda: solve(mean_pressure=1.0), asp.AsperityError, "load: both 'mean_pressure' and 'reduced_pressure' are given: give one of them"),
    (lambda: solve(reduced_pressure=float("nan")), asp.AsperityError, "reduced_pressure is nan: give a finite number"),
    (lambda: solve(reduced_pressure=1j), asp.AsperityError, "reduced_pressure is 1j: give a number, a text, a list or a dictionary"),
    (lambda: solve(reduced_pressure="x"), asp.AsperityError, "reduced_pressure is 'x': give a number"),
    (lambda: solve(reduced_pressure={}), asp.AsperityError, "reduced_pressure is a dictionary: give a number"),
    (lambda: solve(solid={"young": "1 um", "poisson": 0.3}), asp.AsperityError, "solid['young'] is '1 um': give a pressure: a number, or one with a unit"),
    (lambda: solve(solid="x"), asp.AsperityError, "solid is 'x': give a pressure"),
    (lambda: solve(law={"hardness": "x"}), asp.AsperityError, "law['hardness'] is 'x': give a pressure"),
    (lambda: solve(solver={"method": "gfmd", "masses": "x"}), asp.AsperityError, "solver['masses'] is 'x', expected 'uniform' or 'stiffness'"),
    (lambda: solve(sliding={"speed": True}), asp.AsperityError, "sliding['speed'] is True: give one value, or a list of them"),
    (lambda: solve(adhesion={"table": [[0, 1]]}), asp.AsperityError, "adhesion['table'] is a list: give the name of a file"),
    # recordings
    (lambda: solve(live=True), asp.AsperityError, "or write a file (record)"),
    (lambda: with_steps(live=True), asp.AsperityError, "or write a file (record)"),
    (lambda: solve(recording={"what": ["traces"]}), asp.AsperityError,
        "recording says what is recorded, but nothing is recorded: give a file (record), live or stream as well, or leave it out"),
    (lambda: with_steps(recording={"what": ["traces"]}), asp.AsperityError, "recording says what is recorded, but nothing is recorded"),
    (lambda: recorded(unit="m"), asp.AsperityError, "recording: unknown key 'unit', expected one of 'what', 'every', 'length_unit', 'pressure_unit', 'raster_at', 'theme', 'iterations'"),
    (lambda: recorded(record_what="mesh"), asp.AsperityError, "recording: unknown key 'record_what'"),
    (lambda: recorded(what="traces"), asp.AsperityError, "recording['what'] is 'traces': give a list"),
    (lambda: recorded(what=["meshes"]), asp.AsperityError, "recording['what'] is 'meshes', expected one of 'traces', "),
    (lambda: solve(diagnose=True, **CREEP), asp.AsperityError, "diagnose is for one contact: leave it out of a history"),
    (lambda: with_steps((HEIGHT, -1.0)), asp.AsperityError, "seconds is -1: give the seconds since the start, 0 or more"),
    (lambda: with_steps((HEIGHT, 1.0), (HEIGHT, 0.5)), asp.AsperityError, "seconds is 0.5: give the seconds since the start, 1 or more"),
    (lambda: with_steps().contact, asp.AsperityError, "the recorder has no results: record steps in its `with` block"),
    (lambda: with_steps().diagnosis, asp.AsperityError, "the recorder has no results"),
    (lambda: with_steps(("x",)), TypeError, "values must be an array of numbers, not str"),
    # files, rows and names
    (lambda: setup().write("scene.txt"), asp.AsperityError, "cannot write scene.txt: give a name that ends in .toml"),
    (lambda: asp.show("nowhere.rrd"), FileNotFoundError, "cannot read nowhere.rrd"),
    (lambda: asp.Setup.from_json("{"), asp.AsperityError, "this is not a setup in JSON: the text ends too early, in line 1"),
    (lambda: asp.Setup.from_toml("grid.size = .1"), asp.AsperityError, "line 1: a number has no digits before its point: write 0.1 for .1"),
    (lambda: asp.Setup.read(text_file("heights.npy", b"\x93NUMPY")), asp.AsperityError,
        "heights.npy is not a valid setup file: it is not text: give a scene (.toml or .json), or a result (.npz)"),
    (lambda: continued(), asp.AsperityError, "study.csv holds 2 rows of another study, or of another version: give another file, or delete this one"),
    (lambda: study().setup(2), IndexError, "there is no row 2: give one from 0 to 1"),
    (lambda: study().setup(-3), IndexError, "there is no row -3: give one from 0 to 1"),
    (lambda: study().solve([1]), IndexError, "there is no realisation 1: give one from 0 to 0"),
    (lambda: asp.History.explain("frictoin"), KeyError, "there is no number \"frictoin\": did you mean \"friction\"?"),
]


def keys_of(sections: Mapping[str, Any]) -> set[str]:
    """All keys with a `-` in dictionaries of dictionaries."""
    below = (keys_of(it) for it in sections.values() if isinstance(it, Mapping))
    return {key for key in sections if "-" in key}.union(*below)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))  # where no viewer is installed


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(("call", "kind", "sentence"), REFUSALS)
def test_an_error_is_one_of_python(call: Callable[[], Any], kind: type[Exception], sentence: str) -> None:
    with pytest.raises(kind) as refusal:
        call()
    said = str(refusal.value.args[0])
    assert type(refusal.value) is kind and sentence in said and "\n" not in said, said


@pytest.mark.usefixtures("folder")
def test_no_error_has_flags_or_words_of_a_parser_or_keys_of_a_scene() -> None:
    keys = keys_of(setup(solid={"contact_modulus": 1.0}, solver={"method": "gfmd"}).to_dict())
    assert {"contact-modulus", "max-iterations", "reduced-pressure", "time-step", "length-unit"} <= keys
    keys |= {"rolloff-wavelength", "short-cutoff", "mean-pressure", "pressure-tolerance", "half-width", "file-unit", "height-unit", "raster-at", "time-tolerance"}
    for call, _, _ in REFUSALS:
        with pytest.raises(Exception) as refusal:
            call()
        said = str(refusal.value.args[0])
        assert not re.search(r"--|\bfields? |\bvariant|\benum\b|\bmap\b|invalid (type|value)|boolean", said), said
        assert not any(key in said for key in keys), said


@pytest.mark.parametrize("solver", ["polonsky_keer", "polonsky-keer", {"method": "polonsky_keer"}])
def test_a_method_may_be_written_like_a_name_of_python(solver: Any) -> None:
    assert solve(solver=solver).solver == "polonsky-keer"
    assert setup(solver=solver).solve().solver == "polonsky-keer"


def test_rows_count_from_0_and_from_the_end() -> None:
    assert study().setup(-1) == study().setup(1) != study().setup(0) == study().setup(-2)
    surface = asp.Surface.indenter("crossed-sine", (16, 16), 1.0, amplitude=0.01)
    stress = asp.solve(surface, reduced_pressure=0.1).stress
    assert stress(row=-1, poisson=0.3)["row"] == 15


def test_depths_have_units() -> None:
    contact = asp.solve(asp.Surface(1e-3 * HEIGHT, "1 mm"), reduced_pressure=0.1)
    by_text, by_number = (contact.stress(depths=depths, poisson=0.3) for depths in (["1 um", 2e-5], [1e-6, 2e-5]))
    assert np.array_equal(by_text["depth"], [1e-6, 2e-5]) and np.array_equal(by_text["sigma_zz"], by_number["sigma_zz"])


def test_a_recorder_without_a_reference_has_no_diagnosis() -> None:
    recorder = with_steps((np.full(64, 0.01), 0.0), (np.full(64, 0.01), 1.0), reference=False)
    assert recorder.diagnosis is None and recorder.contact.diagnosis is None


def test_forces_have_the_unit_of_their_surface() -> None:
    line = asp.Surface.indenter("cylinder", 64, "1 mm", radius="1 mm")
    surface = asp.Surface.indenter("sphere", [16, 16], "1 mm", radius="1 mm")
    for heights, force, sentence in (
        (line, "1 N", "the force 1 N is not per length, .* did you mean 1 N/m"),
        (surface, "10mN/m", "the force 10mN/m is per length, .* did you mean 10mN"),
        (line, 5, "the force 5 has no unit, but the contact modulus 1 GPa has one: .* such as 5N/m"),
        (surface, 0.5, "the force 0.5 has no unit, .* such as 0.5N$"),
    ):
        with pytest.raises(asp.AsperityError, match=sentence):
            asp.solve(heights, solid="1 GPa", force=force)
    for heights, force in (line, "1 N/m"), (surface, "10mN"):
        assert asp.solve(heights, solid="1 GPa", force=force).converged
    bare = asp.Surface.indenter("cylinder", 64, 1e-3, radius=1e-3)
    assert asp.solve(bare, solid=1e9, force=5.0).converged


def test_numbers_alone_beside_values_with_units_are_refused() -> None:
    sphere = {"points": [16, 16], "size": "1 mm", "radius": "1 mm"}
    surface = asp.Surface.indenter("sphere", **sphere)
    steel = {"young": "210 GPa", "poisson": 0.3}
    scene = {"surface": {"indenter": {"shape": "sphere", "radius": 1e-3}}, "grid": {"points": [16, 16], "size": 1e-3}}
    for attempt, sentence in (
        (lambda: asp.solve(surface, solid=steel, mean_pressure=3e6), "the mean pressure 3000000.* has no unit, but Young's modulus 210 GPa has"),
        (lambda: asp.solve(surface, solid=2e11, mean_pressure="3 MPa"), "the contact modulus 2.* has no unit, but the mean pressure 3 MPa has"),
        (lambda: asp.Problem(surface, solid="1 GPa", mean_pressure="3 MPa", law={"hardness": 1e9}), "the hardness 1.* has no unit"),
        (lambda: asp.Surface.indenter("sphere", **sphere | {"radius": 1e-3}), "the radius 0.001 has no unit, but the size 1 mm has"),
        (lambda: asp.Setup(**scene, solid=steel, load={"mean_pressure": 3e6}), "the mean pressure 3000000.* has no unit"),
        (lambda: asp.Setup(**scene, solid=steel, load={"mean_pressure": "3 MPa"}), None),
        (lambda: asp.Problem(surface, solid=steel, mean_pressure="3 MPa").with_load(mean_pressure="1 MPa").solve(), None),
    ):
        if sentence is None:
            attempt()
        else:
            with pytest.raises(asp.AsperityError, match=sentence):
                attempt()


def test_values_between_others_are_read_where_they_are() -> None:
    records = np.zeros(64, dtype=[("tag", "i1"), ("height", "f8")])
    records["height"] = HEIGHT
    backwards = HEIGHT[::-1].copy()[::-1]
    for height in (records["height"], backwards, np.repeat(HEIGHT, 3)[::3], HEIGHT.astype(">f8")):
        assert np.array_equal(asp.Surface(height, 1.0).height, asp.Surface(HEIGHT, 1.0).height)
