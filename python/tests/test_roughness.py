"""Random roughness: lays, tables of spectra, heights that are not Gaussian, and what a surface is."""

from pathlib import Path

import numpy as np
import pytest

import asperity as asp

LAW = {"hurst": 0.8, "rolloff_wavelength": 0.125, "short_cutoff": 1 / 32}


def test_a_lay_has_its_peklenik_number() -> None:
    surface = asp.Surface.rough([256, 256], 1.0, **LAW, rms_height=1e-3, peklenik=4.0, seed=2)
    texture = surface.texture()
    peklenik = texture["peklenik"]
    assert peklenik is not None and abs(peklenik / 4 - 1) < 0.3
    assert np.isclose(np.sqrt(np.mean(surface.height**2)), 1e-3, rtol=1e-12)
    assert texture["Sq"] == pytest.approx(1e-3)


def test_heights_have_their_skewness_and_kurtosis() -> None:
    surface = asp.Surface.rough([128, 128], 1.0, **LAW, rms_gradient=0.1, skewness=-1.0, kurtosis=4.0)
    z = surface.height / surface.height.std()
    assert abs(np.mean(z**3) + 1) < 0.02 and abs(np.mean(z**4) - 4) < 0.05
    rank_map = surface.rank_map
    assert rank_map is not None and rank_map["height_error"] == 0 and 0 < rank_map["spectrum_error"] < 0.02
    assert asp.Surface.rough(128, 1.0, **LAW, rms_gradient=0.1).rank_map is None


def test_impossible_pairs_are_refused_with_the_bound() -> None:
    with pytest.raises(ValueError, match=r"above skewness\^2 \+ 1, which is 2"):
        asp.Surface.rough(128, 1.0, **LAW, rms_gradient=0.1, skewness=1.0, kurtosis=1.9)


def test_a_table_in_a_convention_gives_its_heights(tmp_path: Path) -> None:
    q = 2 * np.pi * np.geomspace(4, 24, 200)
    density = 1e-4 * q**-3.6
    heights = []
    for convention, factor in (("surface", 1.0), ("surface-two-pi", (2 * np.pi) ** 2)):
        path = tmp_path / f"{convention}.csv"
        np.savetxt(path, np.column_stack([q, factor * density]))
        surface = asp.Surface.rough([64, 64], 1.0, table=path, convention=convention, seed=3)
        heights.append(surface.height)
    assert np.allclose(heights[0], heights[1], rtol=1e-9)
    expected = np.sqrt(2 * np.pi * np.trapezoid(density * q, q))
    assert abs(np.std(heights[0]) / expected - 1) < 0.2


def test_moments_are_those_of_a_wave() -> None:
    x = np.arange(64) / 64
    moments = asp.Surface(2 * np.sin(2 * np.pi * x), 1.0).moments()
    q = 2 * np.pi
    assert np.allclose([moments[name] for name in ("m0", "m2", "m4", "nayak")], [2, 2 * q**2, 2 * q**4, 1])
