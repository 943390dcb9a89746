"""Bodies that yield below their surface: imprint, cut, files and refusals."""

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

STEEL = dict(young=1.0, poisson=0.3, yield_stress=0.005, hardening_modulus=0.05)


def cylinder() -> asp.Surface:
    return asp.Surface.indenter(shape="cylinder", points=128, size=1.0, radius=1.0)


def pressed() -> asp.History:
    history = asp.solve(cylinder(), solid=STEEL, mean_pressure=1.5e-3, path={"load": [2e-4, 1.5e-3, 0.0]})
    assert isinstance(history, asp.History)
    return history


def test_an_imprint_stays_and_the_cut_shows_where_it_yields() -> None:
    history = pressed()
    assert history.process == "plastic" and history.converged
    assert history.claims == ["load-step"] * 3 and "each load step" in history.claim
    numbers, imprint, cut = history.numbers, history.fields["imprint"], history.cut
    assert numbers["imprint_depth"][0] == 0.0 and imprint.shape == (3, 128)
    assert np.ptp(imprint[2]) == pytest.approx(numbers["imprint_depth"][2], rel=1e-12)
    layers = len(cut["interfaces"]) - 1
    assert cut["plastic_strain"].shape == cut["von_mises"].shape == (3, layers, 128)
    # below a line the cut is all there is
    assert cut["plastic_strain"].max(axis=(1, 2)) == pytest.approx(numbers["max_plastic_strain"])
    depth = cut["interfaces"][1:][cut["plastic_strain"][2].max(axis=1) > 1e-3 * 0.005]
    assert depth[-1] == pytest.approx(numbers["deepest_yield"][2])
    assert "yielded" in asp.History.explain("deepest_yield")
    assert asp.solve(cylinder(), solid=1.0, mean_pressure=[1e-4, 2e-4])[0].measures.get("imprint_depth") is None


def test_a_list_of_loads_is_a_path_of_a_body_that_yields() -> None:
    listed = asp.solve(cylinder(), solid=STEEL, mean_pressure=[2e-4, 1.5e-3])
    assert isinstance(listed, asp.History) and len(listed) == 2
    # the same steps as by a path, to the bit
    assert np.array_equal(listed[1].pressure, pressed()[1].pressure)


def test_it_is_saved_loaded_and_copied_with_its_cut(tmp_path: Path) -> None:
    history = pressed()
    history.save(tmp_path / "steel.npz")
    loaded = asp.load(tmp_path / "steel.npz")
    for other in [loaded, copy.deepcopy(history), pickle.loads(pickle.dumps(history))]:
        assert np.array_equal(other.cut["plastic_strain"], history.cut["plastic_strain"])
        assert np.array_equal(other.fields["imprint"], history.fields["imprint"])
        assert other.claims == history.claims and other.numbers["plastic_work"][2] == history.numbers["plastic_work"][2]
    history.save(tmp_path / "steel.csv")
    assert "imprint_depth" in (tmp_path / "steel.csv").read_text().splitlines()[0]


def test_what_does_not_go_together_is_refused() -> None:
    for keys, words in [
        (dict(law={"hardness": 0.1}), "hardness"),
        (dict(adhesion={"work": 1e-4, "range": 1e-2}), "adhesion"),
        (dict(friction={"coefficient": 0.3, "tangential": 1e-5}), "friction"),
        (dict(mean_pressure=1.0), "at all depths"),
        (dict(solid={**STEEL, "hardening_modulus": 0.0}), "hardening modulus"),
        (dict(solid=dict(young=1.0, poisson=0.3, yield_stress=0.01)), "hardening"),
    ]:
        with pytest.raises((asp.AsperityError, ValueError), match=words):
            asp.solve(cylinder(), **{"solid": STEEL, "mean_pressure": 1e-3, **keys})
