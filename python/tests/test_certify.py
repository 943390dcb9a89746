"""Results of other codes."""

import numpy as np
import pytest

import asperity as asp

HEIGHT = 0.01 * np.cos(2 * np.pi * np.arange(1024) / 1024)
SINE = asp.theory.Westergaard(0.01, 1.0)
MEAN = 0.31 * SINE.full_pressure
X = np.where(np.arange(1024) < 512, np.arange(1024), np.arange(1024) - 1024) / 1024
EXACT = SINE.pressure(MEAN, X)


def test_a_contact_holds_in_all_its_quantities() -> None:
    contact = asp.solve(HEIGHT, 1.0, solid=1.0, mean_pressure=MEAN, tolerance=1e-12)
    for quantity in ("pressure", "gap", "displacement"):
        certification = asp.certify(HEIGHT, 1.0, solid=1.0, mean_pressure=MEAN, **{quantity: getattr(contact, quantity)})
        assert certification and certification.holds and certification.mistakes == [], quantity


def test_the_closed_form_is_as_good_as_its_nodes() -> None:
    certification = asp.certify(HEIGHT, 1.0, solid=1.0, pressure=EXACT)
    assert not certification and 1e-8 < certification.certificate.eta < 1e-3
    assert float(certification.certificate) == certification.certificate.eta


@pytest.mark.parametrize(
    ("pressure", "word"),
    [(-EXACT, "negative in compression"), (EXACT / 1024, "forces"), (np.roll(EXACT, 512), "fftshift")],
)
def test_everyday_mistakes_are_recognised(pressure: np.ndarray, word: str) -> None:
    certification = asp.certify(HEIGHT, 1.0, solid=1.0, mean_pressure=MEAN, pressure=pressure)
    assert not certification and any(word in sentence for sentence in certification.mistakes), certification.mistakes


def test_a_displacement_for_a_gap_is_told_by_its_keyword() -> None:
    contact = asp.solve(HEIGHT, 1.0, solid=1.0, mean_pressure=MEAN)
    certification = asp.certify(HEIGHT, 1.0, solid=1.0, mean_pressure=MEAN, gap=contact.displacement)
    assert any("give it as displacement" in sentence for sentence in certification.mistakes), certification.mistakes


def test_a_tolerance_decides_whether_a_result_holds() -> None:
    assert not asp.certify(HEIGHT, 1.0, solid=1.0, pressure=EXACT)
    assert asp.certify(HEIGHT, 1.0, solid=1.0, pressure=EXACT, tolerance=1e-3)
    with pytest.raises(asp.AsperityError, match="tolerance"):
        asp.certify(HEIGHT, 1.0, solid=1.0, pressure=EXACT, tolerance=-1.0)


def test_one_result_is_given_at_a_time() -> None:
    with pytest.raises(asp.AsperityError, match="one result"):
        asp.certify(HEIGHT, 1.0, solid=1.0, mean_pressure=MEAN)
    with pytest.raises(asp.AsperityError, match="transpose"):
        rough = np.random.default_rng(1).normal(size=(8, 16))
        asp.certify(rough, 1.0, solid=1.0, pressure=np.ones((16, 8)))


def test_a_layer_is_certified_as_well() -> None:
    solid = {"contact_modulus": 1.0, "poisson": 0.3, "layer": 0.1}
    contact = asp.solve(HEIGHT, 1.0, solid=solid, mean_pressure=MEAN)
    certification = contact.problem.certify(pressure=contact.pressure)
    assert certification.holds and certification.assessment is None
    assert not contact.problem.certify(pressure=EXACT).holds
