"""Leakage, conductance and percolation of contacts."""

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


def test_other_axes_are_refused(contact: asp.Contact) -> None:
    with pytest.raises(ValueError, match="the axis is 'z'"):
        contact.leakage("z")
