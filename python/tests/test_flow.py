"""Leakage, conductance and percolation of contacts."""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

ROUGH = {"hurst": 0.8, "rolloff_wavelength": 0.25, "short_cutoff": 1 / 16, "rms_gradient": 0.1}


@pytest.fixture(scope="module")
def contact() -> asp.Contact:
    surface = asp.Surface.rough([64, 64], 1.0, **ROUGH)
    return asp.solve(surface, solid=1.0, reduced_pressure=0.05)


def test_the_flux_is_conserved_and_its_power_lies_between_the_bounds(contact: asp.Contact) -> None:
    leakage = contact.leakage("x", tolerance=1e-8)
    assert leakage["converged"] and not leakage["sealed"]
    assert 0 < leakage["lower"] <= leakage["upper"] <= contact.mean_gap**3
    assert np.isclose(leakage["hydraulic_gap"], leakage["upper"] ** (1 / 3))
    assert leakage["flux"].shape == contact.gap.shape
    # the pressure falls from one side to the other, and nothing flows through what touches
    columns = np.nanmean(leakage["pressure"], axis=0)
    assert columns[0] > 0.8 and columns[-1] < 0.2
    assert np.all(leakage["flux"][contact.contact] == 0)


def test_conductance_follows_from_the_stiffness(contact: asp.Contact) -> None:
    assert np.isclose(contact.conductance([1.0, 3.0]), 2 * contact.stiffness() / 4.0, rtol=1e-6)
    assert np.isclose(contact.conductance(2.0), contact.conductance([1.0, 3.0]))
    with pytest.raises(ValueError, match="-1"):
        contact.conductance(-1.0)


def test_a_contact_seals_above_its_sealing_load(contact: asp.Contact) -> None:
    assert contact.percolation()["open_x"]
    load = contact.sealing_load("x", width=0.01)
    assert 0.2 < load["sealed"]["relative_area"] < 0.6
    surface = asp.Surface.rough([64, 64], 1.0, **ROUGH)
    for side, is_open in (("open", True), ("sealed", False)):
        pressure = load[side]["reduced_pressure"]
        solved = asp.solve(surface, solid=1.0, reduced_pressure=pressure)
        assert solved.percolation()["open_x"] == is_open
        assert solved.leakage("x")["sealed"] != is_open


def test_flow_is_among_the_measures(contact: asp.Contact, tmp_path: Path) -> None:
    asked = {"leakage": True, "resistivity": [1.0, 3.0]}
    curve = asp.solve(contact.problem.surface, solid=1.0, reduced_pressure=[0.05, 0.4], flow=asked)
    found = curve[0].measures
    assert found["leakage_upper_x"] == contact.leakage("x")["upper"] and found["open_percolates_x"] is True
    assert found["conductance_per_area"] == contact.conductance([1.0, 3.0])
    assert list(curve.measures["open_percolates_x"]) == [True, contact.problem.with_load(reduced_pressure=0.4).solve().percolation()["open_x"]]
    # the columns and values of the command line
    curve.setup.write(tmp_path / "scene.toml")
    words = ["solve", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "there.npz")]
    subprocess.run([sys.executable, "-m", "asperity", *words], check=True, capture_output=True)
    subprocess.run([sys.executable, "-m", "asperity", *words[:3], str(tmp_path / "there.csv")], check=True, capture_output=True)
    with open(tmp_path / "there.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for name in ("leakage_lower_x", "hydraulic_gap_y", "conductance_per_area", "conductance_times_resistivity"):
        assert [float(row[name]) for row in rows] == list(curve.measures[name]), name
    curve.save(tmp_path / "own.npz")
    with np.load(tmp_path / "own.npz") as own, np.load(tmp_path / "there.npz") as there:
        assert set(own) == set(there) and np.array_equal(own["flux_x"], there["flux_x"])
    problem = asp.Problem(contact.problem.surface, solid=1.0, reduced_pressure=0.05, flow={"conductivity": 2.0})
    alone = problem.solve()
    assert alone.measures["conductance_per_area"] == contact.conductance(0.5) and "leakage_upper_x" not in alone.measures
    with pytest.raises(asp.AsperityError, match="both resistivities and conductivities"):
        asp.solve(contact.problem.surface, reduced_pressure=0.05, flow={"resistivity": 1.0, "conductivity": 1.0})


def test_resistivities_have_units(contact: asp.Contact) -> None:
    assert contact.conductance("17 nohm*m") == contact.conductance(17e-9)
    assert contact.conductance(["17 nohm*m", 28e-9]) == contact.conductance([17e-9, 28e-9])
    assert contact.conductance(conductivity="401 W/m/K") == contact.conductance(1 / 401)
    for wrong in ({}, {"resistivity": [1.0, 2.0, 3.0]}, {"resistivity": 1.0, "conductivity": 1.0}, {"resistivity": "17 m"}):
        with pytest.raises(asp.AsperityError):
            contact.conductance(**wrong)


def test_what_yields_is_among_the_measures(tmp_path: Path) -> None:
    surface = asp.Surface.rough(512, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=1 / 64, rms_gradient=0.1)
    contact = asp.solve(surface, solid=1.0, reduced_pressure=0.05, law={"hardness": 0.06})
    found = contact.measures
    assert found["plastic_load_share"] == pytest.approx(0.06 * found["plastic_area"] / contact.mean_pressure)
    assert 0 < found["plastic_overlap"] == pytest.approx(contact.overlap.mean())
    assert (contact.overlap > 0)[contact.pressure < 0.0599].sum() == 0 and contact.gap.min() == 0
    assert contact.mean_gap == pytest.approx(contact.gap.mean())
    assert "plastic_overlap" not in asp.solve(surface, reduced_pressure=0.05).measures


def test_other_axes_are_refused(contact: asp.Contact) -> None:
    with pytest.raises(ValueError, match="the axis is 'z'"):
        contact.leakage("z")
