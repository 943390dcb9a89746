"""Arrays are prepared as files are, and surfaces say what they are like and become files."""

import json
import subprocess
import sys
import types
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

X = np.arange(128) / 128
TILTED = np.add.outer(0.3 * X[::2], 0.5 * X) + 0.01 * np.add.outer(np.cos(6 * np.pi * X[::2]), np.cos(10 * np.pi * X))


def surfaces(folder: Path, **keys: object) -> tuple[asp.Surface, asp.Surface]:
    """The surface of the array, and that of a file of it."""
    np.save(folder / "h.npy", TILTED)
    return asp.Surface(TILTED, (0.5, 1.0), **keys), asp.Surface.read(folder / "h.npy", size=(0.5, 1.0), **keys)


@pytest.mark.parametrize(
    "prepare",
    ["auto", {"detrend": "plane"}, {"detrend": "plane", "mirror": "x"}, {"crop": [0, 32, 16, 80], "low_pass": 0.1}, {"steps": "auto", "taper": 0.1}],
)
def test_arrays_are_prepared_as_files_are(prepare: object, tmp_path: Path) -> None:
    of_array, of_file = surfaces(tmp_path, prepare=prepare)
    assert of_array.shape == of_file.shape and of_array.size == pytest.approx(of_file.size)
    assert np.array_equal(of_array.height, of_file.height)
    assert of_array.preparation == of_file.preparation and of_array.preparation
    contact = asp.solve(TILTED, (0.5, 1.0), reduced_pressure=0.01, prepare=prepare)
    assert np.array_equal(contact.height, of_array.height) and contact.problem.surface.preparation == of_array.preparation
    # the setup repeats it, with the heights in a file
    scene = contact.setup.to_toml().replace("array.npy", str(tmp_path / "h.npy"))
    assert np.array_equal(asp.Setup.from_toml(scene).solve().pressure, contact.pressure)


def test_the_tilt_is_seen_and_taken_off(tmp_path: Path) -> None:
    raw = asp.Surface(TILTED, (0.5, 1.0))
    survey = raw.survey()
    assert survey["tilt"] == pytest.approx([0.6, 0.5], rel=0.05) and min(survey["jumps"]) > 3 and survey["voids"] == 0
    flat = asp.Surface(TILTED, (0.5, 1.0), prepare="auto")
    assert max(map(abs, flat.survey()["tilt"])) < 0.01 and max(flat.survey()["jumps"]) < 1.5
    assert "not periodic" in flat.preparation[0] and raw.preparation == []
    np.save(tmp_path / "h.npy", TILTED)
    words = ["surface", "--height", str(tmp_path / "h.npy"), "--size", "0.5,1", "--json"]
    printed = json.loads(subprocess.run([sys.executable, "-m", "asperity", *words], check=True, capture_output=True).stdout)
    assert printed["survey"] == survey


def test_voids_are_filled() -> None:
    holes = TILTED.copy()
    holes[10:12, 20] = np.nan
    with pytest.raises(asp.AsperityError, match="2 of 8192 heights are void: fill them"):
        asp.Surface(holes, (0.5, 1.0), prepare={"detrend": "plane"})
    filled = asp.Surface(holes, (0.5, 1.0), prepare={"fill": "harmonic"})
    assert np.isfinite(filled.height).all() and "2 voids filled" in filled.preparation[0]


def test_steps_that_do_not_exist_are_refused() -> None:
    for prepare, sentence in (("best", "give \"auto\""), ({"smooth": 1.0}, "smooth"), ({"low_pass": -1.0}, "-1"), ({"crop": [0, 99, 0, 4]}, "99")):
        with pytest.raises(asp.AsperityError, match=sentence):
            asp.Surface(TILTED, (0.5, 1.0), prepare=prepare)  # type: ignore[arg-type]
    with pytest.raises(asp.AsperityError, match="channel is for a file of heights"):
        asp.solve(TILTED, (0.5, 1.0), reduced_pressure=0.1, channel=1)
    with pytest.raises(asp.AsperityError, match="a Surface has its own prepare"):
        asp.solve(asp.Surface(TILTED, (0.5, 1.0)), reduced_pressure=0.1, prepare="auto")


def test_keywords_of_files_reach_solve(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "h.txt", np.column_stack([X, 0.01 * np.cos(2 * np.pi * X)]))
    contact = asp.solve(tmp_path / "h.txt", reduced_pressure=0.1, file_unit="1 um")
    assert contact.problem.surface.size[0] == pytest.approx(1e-6)
    np.save(tmp_path / "h.npy", 0.01 * np.cos(2 * np.pi * X))
    both = asp.solve(tmp_path / "h.npy", 1.0, reduced_pressure=0.1, against=tmp_path / "h.npy")
    assert np.allclose(both.height, 0.02 * np.cos(2 * np.pi * X))


@pytest.mark.parametrize("ending", ["npy", "sdf", "x3p", "xyz"])
def test_surfaces_become_files(ending: str, tmp_path: Path) -> None:
    rough = asp.Surface.rough((32, 48), (2e-6, 3e-6), hurst=0.8, rolloff_wavelength=1e-6, short_cutoff=2e-7, rms_gradient=0.1)
    rough.save(tmp_path / f"h.{ending}")
    again = asp.Surface.read(tmp_path / f"h.{ending}", size=(2e-6, 3e-6))
    assert np.allclose(again.height, rough.height, atol=1e-15)
    with pytest.raises(asp.AsperityError, match="give a name that ends in"):
        rough.save(tmp_path / "h.csv")


def test_spectra_have_conventions(tmp_path: Path) -> None:
    surface = asp.Surface.rough((128, 128), 2 * (1.0,), hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.05, rms_gradient=0.1)
    wave, density = surface.spectrum("surface")
    two_pi = surface.spectrum("surface-two-pi")[1]
    assert np.allclose(two_pi, (2 * np.pi) ** 2 * density)
    # a surface with the spectrum of the file has the gradient of this one
    surface.save_spectrum(tmp_path / "psd.csv", convention="profile")
    assert (tmp_path / "psd.csv").read_text().startswith("# convention: profile\n")
    profile = np.loadtxt(tmp_path / "psd.csv", delimiter=",", skiprows=2)
    assert np.array_equal(profile[:, 0], wave) and np.allclose(profile[:, 1], surface.spectrum("profile")[1])
    with pytest.raises(asp.AsperityError, match="the convention is \"volume\""):
        surface.spectrum("volume")  # type: ignore[arg-type]


def test_other_formats_are_tried_with_another_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "heights.h5"
    file.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    with pytest.raises(asp.AsperityError, match="HDF5"):
        asp.Surface.read(file)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", of_peer(TILTED.T * 1e9, (1e6, 0.5e6), "nm"))
    monkeypatch.setitem(sys.modules, "SurfaceTopography.Support.UnitConversion", factors({("nm", "m"): 1e-9}))
    with pytest.warns(asp.AsperityWarning, match="heights.h5 was read by SurfaceTopography 1.2 as a file of the format 'h5'"):
        read = asp.Surface.read(file, prepare={"detrend": "plane"})
    assert read.size == pytest.approx((0.5e-3, 1e-3)) and read.shape == TILTED.shape
    wanted = asp.Surface(TILTED, (0.5e-3, 1e-3), prepare={"detrend": "plane"}).height
    assert np.allclose(read.height, wanted, atol=1e-12)
    # what this package reads is read by it, and what scales a file is not for another package
    np.save(tmp_path / "h.npy", TILTED)
    assert asp.Surface.read(tmp_path / "h.npy", size=(0.5, 1.0)).shape == TILTED.shape
    with pytest.raises(asp.AsperityError, match="HDF5"):
        asp.Surface.read(file, file_unit="1 um")


def of_peer(heights: np.ndarray, lengths: tuple[float, float], unit: str) -> types.ModuleType:
    """A package that reads every file as some heights, whose first axis is x."""

    class Topography:
        physical_sizes = lengths

        def heights(self) -> np.ndarray:
            return heights

    class File:
        channels = (types.SimpleNamespace(name="height", physical_sizes=lengths, dim=2),)

        def __enter__(self) -> "File":
            return self

        def __exit__(self, *_: object) -> None:
            pass

        def topography(self, channel_index: int = 0) -> Topography:
            found = Topography()
            found.unit = unit
            return found

        def format(self) -> str:
            return "h5"

    package = types.ModuleType("SurfaceTopography")
    package.__version__ = "1.2"
    package.open_topography = lambda path: File()
    return package


def factors(known: dict[tuple[str, str], float]) -> types.ModuleType:
    """The module of such a package that converts units."""
    module = types.ModuleType("SurfaceTopography.Support.UnitConversion")
    module.get_unit_conversion_factor = lambda one, other: known[one, other]
    return module
