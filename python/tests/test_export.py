"""Contacts in xarray, and scalars of numpy and xarray as numbers."""

from pathlib import Path

import numpy as np
import pytest

import asperity as asp

ROUGH = dict(hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.1, rms_gradient=0.1)
SURFACE = asp.Surface.rough((64, 128), (1.0, 2.0), seed=1, **ROUGH)


def test_a_contact_is_a_dataset_over_positions(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    contact = asp.solve(SURFACE, solid=1.0, reduced_pressure=0.1)
    data = contact.to_xarray()
    assert isinstance(data, xarray.Dataset) and dict(data.sizes) == {"y": 64, "x": 128}
    for name in ("pressure", "gap", "displacement", "height", "contact"):
        assert np.array_equal(data[name], getattr(contact, name)), name
    assert float(data.x[1] - data.x[0]) == pytest.approx(2.0 / 128) and float(data.y[-1]) == pytest.approx(63 / 64)
    row = data.pressure.sel(y=0.5, method="nearest")
    assert np.array_equal(row, contact.pressure[32])
    assert data.attrs["kappa_r"] == contact.measures["kappa_r"] and data.attrs["status"] == "converged"
    assert asp.Setup.from_toml(data.attrs["setup"]).solve() == contact


def test_histories_are_datasets_over_their_states() -> None:
    pytest.importorskip("xarray")
    history = asp.solve(SURFACE, reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 1.0, "steps": 2})
    data = history.to_xarray()
    assert dict(data.sizes) == {"state": 3, "y": 64, "x": 128} and list(data.state) == [1, 2, 3]
    assert np.array_equal(data.stored_strain, history.fields["stored_strain"]) and np.array_equal(data.pressure[2], history[2].pressure)
    assert data.time.attrs == {"long_name": "Time since the beginning.", "unit": "time"}
    assert list(data.claim.values) == history.claims and data.attrs["process"] == "creep"


def test_netcdf_files_come_back(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    contact = asp.solve(SURFACE, solid=1.0, reduced_pressure=0.1, flow={"leakage": True})
    curve = asp.solve(SURFACE, reduced_pressure=[0.05, 0.1])
    history = asp.solve(SURFACE, reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 1.0, "steps": 2})
    for name, it in (("contact", contact), ("curve", curve), ("history", history)):
        it.to_netcdf(tmp_path / f"{name}.nc")
        with xarray.open_dataset(tmp_path / f"{name}.nc") as again:
            assert again.equals(it.to_xarray()), name
            assert again.attrs["setup"] == it.setup.to_toml()
    SURFACE.to_netcdf(tmp_path / "surface.nc")
    with xarray.open_dataarray(tmp_path / "surface.nc") as again:
        assert np.array_equal(again, SURFACE.height)


def test_lines_surfaces_and_curves_are_datasets_too() -> None:
    pytest.importorskip("xarray")
    line = asp.Surface.rough(256, 1.0, **ROUGH)
    assert line.to_xarray().dims == ("x",) and SURFACE.to_xarray().dims == ("y", "x")
    assert np.array_equal(SURFACE.to_xarray(), SURFACE.height)
    curve = asp.solve(line, reduced_pressure=[0.05, 0.1])
    data = curve.to_xarray()
    assert data.pressure.dims == ("load", "x") and data.height.dims == ("x",)
    assert np.array_equal(data.pressure[1], curve[1].pressure) and list(data["load"]) == [0.05, 0.1]
    assert np.array_equal(data.mean_gap, curve.measures["mean_gap"])


def test_scalars_of_numpy_and_xarray_are_numbers() -> None:
    expected = asp.solve(SURFACE, solid=2.0, mean_pressure=0.01, max_iterations=1000)
    scalars = [np.float64, np.array, lambda number: np.array([number])[0]]
    if xarray := pytest.importorskip("xarray"):
        scalars.append(xarray.DataArray)
    for scalar in scalars:
        height = asp.Surface.rough(
            (np.int64(64), np.array(128)), [scalar(1.0), 2.0], seed=np.uint8(1), **{key: scalar(value) for key, value in ROUGH.items()}
        )
        contact = asp.solve(height, solid=scalar(2.0), mean_pressure=scalar(0.01), max_iterations=np.array(1000))
        assert contact == expected, scalar
    assert asp.solve(SURFACE, reduced_pressure=np.float32(0.5)).problem.mean_pressure is not None
    heights = pytest.importorskip("xarray").DataArray(np.array(SURFACE.height), dims=("y", "x"))
    assert np.array_equal(asp.solve(heights, (1.0, 2.0), solid=2.0, mean_pressure=0.01).contact, expected.contact)
    assert asp.theory.sphere(np.float64(1.0)).load(np.float32(0.5)) == pytest.approx(4 * 0.5**3 / 3)
    with pytest.raises(asp.AsperityError, match="finite"):
        asp.solve(SURFACE, solid=np.array(np.nan), mean_pressure=0.01)


def test_masks_and_positions_are_those_of_the_nodes() -> None:
    contact = asp.solve(SURFACE, reduced_pressure=0.1)
    assert contact.contact.dtype == np.bool_ and np.array_equal(contact.contact, contact.pressure > 0)
    assert contact.contact.mean() == pytest.approx(contact.measures["relative_area_counted"])
    assert np.array_equal(contact.x, SURFACE.x) and np.array_equal(contact.y, SURFACE.y)
