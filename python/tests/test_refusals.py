"""What makes no contact is refused in the sentences of the command line."""

import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

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
        ({"reduced_pressure": 0.1, "solid": {"modulus": 1.0}}, "contact-modulus"),
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
        (np.array([0.0, 1.0, np.nan, 2.0]), 1.0, "NaN"),
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
