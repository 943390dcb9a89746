"""Writes the files of HDF5 beside it, whose heights are those of tests/files/measured/containers/mod.rs."""

import sys
from pathlib import Path

import h5py
import numpy as np

FOLDER = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
TEXT = h5py.string_dtype("ascii")
ROWS, COLUMNS, VOID = 4, 5, (1, 3)
y, x = np.mgrid[:ROWS, :COLUMNS]
HEIGHTS = 100.0 + 7 * x + 40 * y**2  # nm


def marked(values, void, kind):
    """Values of a type, with another one at the void point."""
    values = np.array(values)
    values[VOID] = void
    return values.astype(kind)


def plain():
    """Integers with the most significant byte first; links in circles, and what is no height."""
    with h5py.File(FOLDER / "plain.h5", "w", libver="earliest") as file:
        scan = file.create_group("scan")
        height = scan.create_dataset("height", data=marked(HEIGHTS * 2, -32768, ">i2"))
        height.attrs.update({"units": np.bytes_("nm"), "scale_factor": 0.5, "_FillValue": np.int16(-32768), "operator": "me"})
        scan.create_dataset("amplitude", data=HEIGHTS.astype("<f4")).attrs["unit"] = "V"
        scan.create_dataset("line", data=np.array([3.0, 1.0, 4.0])).attrs["unit"] = "um"
        scan["round"] = file["/"]
        file["alias"] = h5py.SoftLink("/scan/height")
        file["lost"] = h5py.SoftLink("/lost")
        file["note"] = "steel"


def packed():
    """Singles in packed chunks, of which the dataset may have more rows."""
    with h5py.File(FOLDER / "packed.h5", "w", libver="latest") as file:
        packing = {"chunks": (3, 2), "maxshape": (None, COLUMNS), "compression": "gzip", "shuffle": True, "fletcher32": True}
        z = file.create_dataset("z", data=marked(HEIGHTS * 1e-3, 1e20, "<f4"), **packing)
        z.attrs.update({"Unit": "µm", "missing_value": 1e20})
        file.create_dataset("series", data=HEIGHTS[None].astype("u1"))


def zygo(name, unit, heights, linked):
    """A surface as Mx writes it, to which links lead or which stands in its old place."""
    converter = np.dtype([("Category", TEXT), ("BaseUnit", TEXT), ("Parameters", h5py.vlen_dtype("<f8"))])
    with h5py.File(FOLDER / name, "w", libver="latest") as file:
        surface = file.create_dataset("Data/Surface/{7}" if linked else "Measurement/Surface", data=heights)
        if linked:
            links = [("Root", "Measurement", "{1}"), ("{1}", "Surface", "{2}"), ("{2}", "Path", "/Data/Surface/{7}")]
            file.create_dataset("MetaData", data=np.array(links, [("Source", TEXT), ("Link", TEXT), ("Destination", TEXT)]))
            file.create_dataset("Data/Surface/{6}", data=heights[:2])
        file.create_dataset("Data/Intensity/{8}", data=HEIGHTS.astype("<u2"))
        surface.attrs["No Data"] = [np.finfo(float).max]
        surface.attrs.create("Unit", [unit], dtype=TEXT)
        for axis, category, base, parameters in [
            ("X", "LateralCat", "Pixels", [0, 2e-6, 0, 0]),
            ("Y", "LateralCat", "Pixels", [0, 3e-6, 0, 0]),
            ("Z", "HeightCat", unit, [0, 0.5, 500e-9, 1.25]),
        ]:
            value = np.empty(1, converter)
            value[0] = (category, base, np.array(parameters))
            surface.attrs.create(f"{axis} Converter", value, dtype=converter)


def scales():
    """A map along x and y whose coordinates fall along x, as NetCDF-4 describes them, with a mask, and an uneven profile."""
    with h5py.File(FOLDER / "scales.nc", "w", libver="latest") as file:
        file.attrs["_NCProperties"] = "version=2"
        for name, values, unit in [
            ("x", 8.0 - 2 * np.arange(COLUMNS), "um"),
            ("y", 0.003 * np.arange(ROWS), "mm"),
            ("s", np.array([0.0, 1.0, 3.0]), "um"),
        ]:
            file[name] = values
            file[name].make_scale(name)
            file[name].attrs["units"] = unit
        void = np.zeros((ROWS, COLUMNS))
        void[VOID] = 1
        file["heights"] = np.ascontiguousarray(HEIGHTS[:, ::-1].T)
        file["mask"] = np.ascontiguousarray(void[:, ::-1].T).astype("i1")
        file["profile"] = np.array([1.0, 9.969209968386869e36, 3.0])
        for name, axes, unit in [("heights", "xy", "nm"), ("mask", "xy", ""), ("profile", "s", "um")]:
            file[name].attrs["units"] = unit
            for axis, scale in enumerate(axes):
                file[name].dims[axis].attach_scale(file[scale])


def huge():
    """A trillion points in a short file."""
    with h5py.File(FOLDER / "huge.h5", "w", libver="latest") as file:
        file.create_dataset("z", (10**6, 10**6), "<f4", chunks=(64, 64))


plain()
packed()
zygo("nanometres.datx", "NanoMeters", marked(HEIGHTS, np.finfo(float).max, "<f8"), linked=True)
zygo("fringes.datx", "Fringes", marked(HEIGHTS / (0.5 * 500 * 1.25), np.finfo(float).max, "<f8"), linked=False)
scales()
huge()
