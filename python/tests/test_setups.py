"""Setups as text, and contacts that are repeated from it."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

SCENE = """
[surface.indenter]
shape = "cylinder"
radius = "40 um"

[grid]
points = 512
size = "160 um"

[solid]
contact-modulus = "1 GPa"

[load]
mean-pressure = "1 MPa"

[solver]
method = "polonsky-keer"
"""


def test_a_scene_is_read_solved_and_repeated_to_the_last_bit(tmp_path: Path) -> None:
    setup = asp.Setup.from_toml(SCENE)
    contact = setup.solve()
    assert contact.converged and contact.solver == "polonsky-keer"
    assert setup.to_dict()["solid"] == {"contact-modulus": 1e9}
    for again in (
        asp.Setup.from_toml(contact.setup.to_toml()),
        asp.Setup.from_json(setup.to_json()),
        asp.Setup(**setup.to_dict()),
        pickle.loads(pickle.dumps(setup)),
    ):
        assert again == setup
    setup.write(tmp_path / "scene.toml")
    assert np.array_equal(asp.Setup.read(tmp_path / "scene.toml").solve().pressure, contact.pressure)
    assert setup.command().startswith("asperity solve --indenter cylinder")


def test_keywords_go_over_what_a_setup_says() -> None:
    contact = asp.Setup.from_toml(SCENE).solve(solver="multilevel", tolerance=1e-10)
    assert contact.solver == "multilevel" and contact.certificate.eta <= 1e-10
    assert contact.setup.to_dict()["stop"]["tolerance"] == 1e-10


def test_a_saved_contact_holds_the_heights_that_were_an_array(tmp_path: Path) -> None:
    rough = np.random.default_rng(2).normal(size=(16, 24))
    contact = asp.solve(rough, (2.0, 3.0), solid=1.0, reduced_pressure=0.2)
    assert 'height = "array.npy"' in contact.setup.to_toml()
    with pytest.raises(asp.AsperityError, match="array"):
        contact.setup.solve()
    contact.save(tmp_path / "run.npz")
    saved = np.load(tmp_path / "run.npz")
    assert np.array_equal(saved["pressure"], contact.pressure) and saved["height"].shape == (16, 24)
    again = asp.Setup.read(tmp_path / "run.npz").solve()
    assert np.allclose(again.pressure, contact.pressure, rtol=1e-6, atol=1e-9)


def test_a_misspelt_key_is_told_with_the_nearest() -> None:
    with pytest.raises(TypeError, match="Did you mean 'rms_gradient'"):
        asp.Surface.rough(64, 1.0, hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.1, rms_gradint=0.1)
    with pytest.raises(asp.AsperityError, match="'rolloff_wavelength' is missing: give it$"):
        asp.Surface.rough(64, 1.0, hurst=0.8)
    with pytest.raises(TypeError, match="It takes radius"):
        asp.Surface.indenter("cylinder", 64, 1.0, amplitude=1.0)
