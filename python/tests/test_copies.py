"""Copies, pickles and comparisons: the same to the last bit."""

import copy
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity as asp

ROUGH = dict(hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)


def again(it: Any) -> Any:
    return pickle.loads(pickle.dumps(it))


@pytest.mark.parametrize(
    "surface",
    [
        asp.Surface.rough(512, 1.0, **ROUGH),
        asp.Surface.indenter("sphere", (32, 48), (1.0, 1.5), radius=2.0, boundary="free"),
        asp.Surface(np.random.default_rng(1).normal(size=(8, 16)) + 5.0, (1.0, 2.0), boundary=("free", "periodic")),
        asp.Surface(np.round(np.cos(2 * np.pi * np.arange(32) / 32), 1), 1.0, refine=4),
        asp.Surface(np.arange(1.0, 9.0)[None, :], (1.0, 2.0)),
    ],
    ids=["rough", "sphere", "array", "refined plateaus", "one row"],
)
def test_a_surface_comes_back_to_the_last_bit(surface: asp.Surface) -> None:
    same = again(surface)
    assert same == surface and same.height.tobytes() == surface.height.tobytes() and same.shape == surface.shape
    assert (same.mean_height, same.size, repr(same)) == (surface.mean_height, surface.size, repr(surface))
    assert same != asp.Surface(np.arange(8.0), 1.0)
    # what the grid is worth must be known of the copy as well
    keys = {"solid": 1.0, "force": 1e-3} if "free" in repr(surface) and surface.shape[0] == 32 else {"reduced_pressure": 0.1}
    if "free" not in repr(surface) or "sphere" in repr(surface.statistics):
        first, second = (asp.solve(it, **keys).measures for it in (surface, same))
        assert all(np.array_equal(first[name], second[name], equal_nan=True) for name in first if name != "seconds")


def test_surfaces_of_files_need_no_file(tmp_path: Path) -> None:
    np.save(tmp_path / "height.npy", np.cos(2 * np.pi * np.arange(64) / 64))
    surface = asp.Surface.read(tmp_path / "height.npy", size=1.0)
    text = pickle.dumps(surface)
    (tmp_path / "height.npy").unlink()
    assert pickle.loads(text) == surface


def test_problems_setups_and_contacts_come_back() -> None:
    problem = asp.Problem(
        asp.Surface.rough(512, "160 um", **(ROUGH | {"rolloff_wavelength": "40 um", "short_cutoff": "2 um"})),
        solid={"young": "210 GPa", "poisson": 0.3},
        mean_pressure="1 GPa",
        friction={"coefficient": 0.5, "tangential": "0.1 GPa"},
    )
    with pytest.warns(asp.AsperityWarning, match="Dundurs"):
        contact = problem.solve(diagnose=True)
    for it in (problem, problem.setup, contact, contact.certificate, contact.work):
        assert again(it) == it and copy.copy(it) == it and copy.deepcopy(it) == it, it
    assert copy.copy(contact) is contact and copy.deepcopy(problem) is problem
    same = again(contact)
    for name in ("pressure", "gap", "displacement", "height", "contact"):
        assert np.array_equal(getattr(same, name), getattr(contact, name)), name
    assert same.measures.keys() == contact.measures.keys()
    assert all(np.array_equal(same.measures[name], value, equal_nan=True) for name, value in contact.measures.items())
    assert (same.status, same.solver, same.diagnosis) == (contact.status, contact.solver, contact.diagnosis)
    assert contact.slip is not None and np.array_equal(same.slip.traction, contact.slip.traction)
    assert same.slip.stick_area == contact.slip.stick_area
    other = problem.with_load(mean_pressure="2 GPa")
    assert other != problem and same != asp.solve(problem.surface, reduced_pressure=0.1)


def solve(problem: asp.Problem) -> asp.Contact:
    return problem.solve()


def test_problems_and_contacts_travel_between_processes() -> None:
    problem = asp.Problem(asp.Surface.rough(512, 1.0, **ROUGH), reduced_pressure=0.1)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as executor:
        there = executor.submit(solve, problem).result()
    assert there == problem.solve()


def test_histories_slips_and_certifications_come_back() -> None:
    rough = asp.Surface.rough(512, 1.0, **ROUGH)
    creep = asp.solve(rough, reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": [0.0, 1.0, 2.0], "load": [0.0, 0.05, 0.0]})
    cycle = asp.solve(
        rough, solid=1.0, mean_pressure=2e-3, friction={"coefficient": 0.5}, path={"tangential": [5e-4, -5e-4, 5e-4, -5e-4, 5e-4]}
    )
    sine = asp.Surface.indenter("sine", 512, "20 um", amplitude="1 um")
    sticky = asp.solve(
        sine, solid="1 MPa", mean_pressure=0.0, path={"load": ["0 Pa", "-20 kPa"], "steps": 8}, adhesion={"work": "10 mJ/m^2", "range": "80 nm"}
    )
    pulled = asp.solve(rough, solid=1.0, mean_pressure=2e-3, friction={"coefficient": 0.5, "tangential": 5e-4})
    certified = asp.certify(rough, solid=1.0, pressure=pulled.pressure)
    assert pulled.slip is not None
    for it in (creep, cycle, sticky, pulled.slip, certified):
        assert again(it) == it and copy.copy(it) is it and copy.deepcopy(it) is it, it
    for history in (creep, cycle, sticky):
        same = again(history)
        assert (same.process, same.claims, same.adhesion) == (history.process, history.claims, history.adhesion)
        assert np.array_equal(same.energy_per_cycle, history.energy_per_cycle)
        for there, here in ((same.numbers, history.numbers), (same.fields, history.fields)):
            assert there.keys() == here.keys() and all(np.array_equal(there[it], here[it], equal_nan=True) for it in here)
        assert again(history[-1]) == history[-1] != history[0]
        assert again(history[-1]).measures.keys() == history[-1].measures.keys()
    assert creep != cycle and certified != asp.certify(rough, solid=1.0, pressure=2 * pulled.pressure)
    assert (again(certified).holds, again(certified).mistakes) == (certified.holds, certified.mistakes)


def test_a_table_comes_back() -> None:
    study = asp.Study(
        surface={"spectrum": ROUGH, "seed": "1-2"}, grid={"points": 256, "size": 1.0}, load={"reduced_pressure": [0.05, 0.1]}
    )
    table = asp.study(study)
    same = again(table)
    assert same == table and same.columns == table.columns and len(same) == 4
    assert same["row"].dtype == table["row"].dtype and list(same["scene"]) == list(table["scene"])
    assert again(study) == study
