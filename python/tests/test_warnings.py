"""Warnings: one for each reason to doubt a result, in the sentences of the command line, with keywords in place of flags."""

import re
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity as asp

ROUGH = dict(hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)


def sentences(solve: Any) -> list[str]:
    """The warnings of a solve."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        solve()
    assert all(issubclass(warning.category, asp.AsperityWarning) for warning in caught)
    assert all(warning.filename == __file__ for warning in caught)
    return [str(warning.message) for warning in caught]


def of_command(*arguments: str, cwd: Path) -> list[str]:
    """The warnings of the command line."""
    ran = subprocess.run([sys.executable, "-m", "asperity", "solve", *arguments], cwd=cwd, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    return [line.removeprefix("warning: ") for line in ran.stderr.splitlines() if line.startswith("warning: ")]


def without_remedies(sentence: str) -> str:
    return re.sub(r" \((--|[a-z_]+=)[^()]*(\([^()]*\))?[^()]*\)", "", sentence)


def test_a_good_contact_has_no_warning() -> None:
    surface = asp.Surface.rough(4096, 1.0, **ROUGH)
    assert sentences(lambda: asp.solve(surface, reduced_pressure=0.1)) == []


def test_a_coarse_grid_is_told_in_the_words_of_the_command_line(tmp_path: Path) -> None:
    height = np.random.default_rng(1).normal(size=128) + 100.0 * np.arange(128)
    np.save(tmp_path / "height.npy", height)
    here = sentences(lambda: asp.solve(tmp_path / "height.npy", 1e5, reduced_pressure=0.1))
    there = of_command("--height", "height.npy", "--size", "1e5", "--reduced-pressure", "0.1", cwd=tmp_path)
    assert len(here) >= 2 and [without_remedies(it) for it in here] == [without_remedies(it) for it in there]
    assert any("refine='auto'" in it for it in here) and any("prepare='auto'" in it for it in here)
    assert not any("--" in it for it in here)
    assert here == sentences(lambda: asp.solve(height, 1e5, reduced_pressure=0.1))


def test_what_a_warning_advises_is_a_keyword_that_exists() -> None:
    surface = asp.Surface.rough(128, 1.0, **ROUGH)
    doubts = sentences(lambda: asp.solve(surface, reduced_pressure=0.05))
    assert any("kappa_r may be off by" in it and "(refine='auto')" in it for it in doubts)
    settled: list[asp.Contact] = []
    assert sentences(lambda: settled.append(asp.solve(surface, reduced_pressure=0.05, refine="auto"))) == []
    assert settled[0].measures["kappa_r_error"] < 0.01 and settled[0].pressure.size > 128


def test_metals_free_rims_and_coupling_are_told() -> None:
    cylinder = asp.Surface.indenter("cylinder", 1024, "1 mm", radius="1 mm")
    steel = {"young": "210 GPa", "poisson": 0.3}
    hard = sentences(lambda: asp.solve(cylinder, solid=steel, mean_pressure="20 GPa"))
    assert any("Metals yield at lower pressures" in it and "(law={'hardness': ...})" in it for it in hard)
    ramp = np.linspace(0.0, 0.1, 64)
    rim = sentences(lambda: asp.solve(ramp, 1.0, boundary="free", solid=1.0, force=1e-4))
    assert any("reaches the free rim" in it for it in rim)
    pulled = sentences(
        lambda: asp.solve(cylinder, solid=steel, mean_pressure="1 MPa", friction={"coefficient": 0.5, "tangential": "0.2 MPa"})
    )
    assert any("Dundurs' beta" in it for it in pulled)


def test_a_curve_warns_once_for_all_loads() -> None:
    surface = asp.Surface.rough(128, 1.0, **ROUGH)
    doubts = sentences(lambda: asp.solve(surface, reduced_pressure=[0.02, 0.05, 0.1]))
    assert sum("kappa_r may be off by" in it for it in doubts) == 1
    assert any(re.search(r"under \d of 3 loads", it) for it in doubts)


def test_a_run_that_a_callback_ends_has_no_warning() -> None:
    surface = asp.Surface.rough(128, 1.0, **ROUGH)
    assert sentences(lambda: asp.solve(surface, reduced_pressure=0.05, callback=lambda step: False)) == []


def test_large_pressures_and_steep_slopes_are_told_and_small_ones_are_not() -> None:
    cylinder = asp.Surface.indenter("cylinder", 1024, "1 mm", radius="1 mm")
    for load, is_told in ("2 GPa", True), ("20 MPa", False):
        doubts = sentences(lambda load=load: asp.solve(cylinder, solid="3 GPa", mean_pressure=load))  # type: ignore[misc]
        assert any("Nearly all solids yield at lower pressures" in it and "(law={'hardness': ...})" in it for it in doubts) == is_told
    for slope, is_told in (1.0, True), (0.1, False):
        wedge = asp.Surface.indenter("wedge", 1024, 1.0, slope=slope)
        doubts = sentences(lambda wedge=wedge: asp.solve(wedge, solid=1.0, mean_pressure=0.01))  # type: ignore[misc]
        assert any(it.startswith("The rms slope of the contact is ") for it in doubts) == is_told
