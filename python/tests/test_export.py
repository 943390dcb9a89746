"""Contacts in xarray, and scalars of numpy and xarray as numbers."""

import base64
from pathlib import Path
from xml.etree import ElementTree

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
    assert data.pressure.dims == ("state", "x") and data.height.dims == ("x",)
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


def arrays_of(path: Path) -> tuple[ElementTree.Element, dict[str, np.ndarray]]:
    """The grid in a file of VTK, and its arrays."""
    grid = ElementTree.parse(path).getroot()[0]
    arrays = {}
    for it in grid.iter("DataArray"):
        data = base64.b64decode(it.text or "")
        assert int.from_bytes(data[:8], "little") == len(data) - 8
        arrays[it.attrib["Name"]] = np.frombuffer(data[8:], {"Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}[it.attrib["type"]])
    return grid, arrays


def test_fields_are_written_for_paraview(tmp_path: Path) -> None:
    surface = asp.Surface.rough((32, 48), (1.0, 1.5), hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.2, rms_gradient=0.1)
    contact = asp.solve(surface, reduced_pressure=0.1)
    asp.to_vtk(contact, tmp_path / "contact.vti")
    grid, arrays = arrays_of(tmp_path / "contact.vti")
    assert grid.attrib["WholeExtent"] == "0 47 0 31 0 0" and grid.attrib["Spacing"].split()[:2] == ["0.03125", "0.03125"]
    assert np.array_equal(arrays["pressure"].reshape(32, 48), contact.pressure)
    assert np.array_equal(arrays["contact"].reshape(32, 48), contact.contact) and set(arrays) >= {"height", "gap", "displacement"}
    asp.to_vtk(surface, tmp_path / "surface.vti")
    assert np.array_equal(arrays_of(tmp_path / "surface.vti")[1]["height"], surface.height.ravel())
    stress = contact.stress(poisson=0.3, depths=[0.01, 0.02, 0.05])
    asp.to_vtk(stress, tmp_path / "stress.vtr")
    grid, arrays = arrays_of(tmp_path / "stress.vtr")
    assert grid.attrib["WholeExtent"] == "0 47 0 0 0 2" and np.array_equal(arrays["z"], [-0.05, -0.02, -0.01])
    assert np.array_equal(arrays["von_mises"].reshape(3, 48)[::-1], stress["von_mises"])
    asp.to_vtk(contact, tmp_path / "contact.vtp")
    grid, arrays = arrays_of(tmp_path / "contact.vtp")
    places = arrays["places"].reshape(32, 48, 3)
    assert np.array_equal(places[..., 2], contact.height) and np.array_equal(places[3, :, 0], contact.x) and np.array_equal(places[:, 5, 1], contact.y)
    corners = places.reshape(-1, 3)[arrays["connectivity"].reshape(-1, 4)]
    along, up = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    assert len(corners) == 31 * 47 and np.allclose(np.cross(along[:, :2], up[:, :2]), 0.03125**2) and arrays["offsets"][-1] == 4 * 31 * 47
    assert np.array_equal(arrays["pressure"].reshape(32, 48), contact.pressure)
    line = asp.Surface(np.sin(np.arange(16.0)), 1.0)
    asp.to_vtk(line, tmp_path / "line.vtp")
    assert np.array_equal(arrays_of(tmp_path / "line.vtp")[1]["connectivity"], np.arange(16))
    asp.to_vtk(line, tmp_path / "line.vti")
    assert arrays_of(tmp_path / "line.vti")[0].attrib["WholeExtent"] == "0 15 0 0 0 0"
    with pytest.raises(asp.AsperityError, match=r"give a name that ends in \.vti or \.vtp"):
        asp.to_vtk(surface, tmp_path / "surface.vtk")
    with pytest.raises(TypeError, match="not list"):
        asp.to_vtk([1.0], tmp_path / "list.vti")  # type: ignore[arg-type]


def test_load_and_displacement_are_known_on_all_boundaries() -> None:
    x = (np.arange(64) + 0.5) / 64 - 0.5
    sphere = -(x[:, None] ** 2 + x**2) / 2
    free = asp.solve(sphere, 1.0, boundary="free", solid=1.0, mean_pressure=[0.001, 0.002])
    pressure, displacement, what = asp.load_displacement(free)
    assert what == "approach" and np.array_equal(displacement, free.measures["approach"])
    # Hertz: a load as the approach to the power of 3/2
    assert abs(np.log(pressure[1] / pressure[0]) / np.log(displacement[1] / displacement[0]) - 1.5) < 0.02
    periodic = asp.solve(0.01 * np.cos(2 * np.pi * x), 1.0, solid=1.0, mean_pressure=[1e-4, 0.005, 0.05])
    pressure, displacement, what = asp.load_displacement(periodic)
    assert what == "mean displacement" and (np.diff(displacement) > 0).all()
    # it begins at touch, and ends at the height of the crest where the contact is full
    assert 0 < displacement[0] < 2e-3 and abs(displacement[2] - 0.01) < 1e-4
