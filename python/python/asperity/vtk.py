"""Fields as files of VTK, which ParaView and pyvista open."""

from __future__ import annotations

import os
from base64 import b64encode
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from asperity._asperity import AsperityError, Contact, Surface

FIELDS = ("height", "pressure", "gap", "displacement", "contact")
"""The fields of a contact."""


def to_vtk(what: Surface | Contact | Mapping[str, Any], path: os.PathLike[str] | str) -> None:
    """Writes a surface, a contact, or the stress below one to a file of VTK.

    A surface or a contact makes an image (.vti): its fields at the nodes, x along the first axis and y along the second one. In ParaView the filter
    "Warp By Scalar" lifts it by its height. As a mesh (.vtp) it has its height as z, with the same fields. A stress, the dictionary of Contact.stress, makes a grid (.vtr) over x and z, which is minus the depth.
    Lengths and pressures have the units of the problem.
    """
    endings = [".vtr"] if isinstance(what, Mapping) else [".vti", ".vtp"]
    ending = Path(path).suffix.lower()
    if ending not in endings:
        raise AsperityError(f"cannot write {path}: give a name that ends in {' or '.join(endings)}")
    if isinstance(what, Mapping):
        text = _stress(what)
    elif isinstance(what, (Surface, Contact)):
        text = _image(what) if ending == ".vti" else _mesh(what)
    else:
        raise TypeError(f"to_vtk writes a Surface, a Contact or the dictionary of Contact.stress, not {type(what).__name__}")
    # a file appears as a whole or not at all
    draft = Path(path).with_name(f".{Path(path).name}.{os.getpid()}")
    try:
        draft.write_text(text, encoding="utf-8")
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def _fields(what: Surface | Contact) -> dict[str, Any]:
    return {"height": what.height} if isinstance(what, Surface) else {name: getattr(what, name) for name in FIELDS}


def _image(what: Surface | Contact) -> str:
    points = (*what.height.shape[::-1], 1)[:2]
    steps = (float(what.x[1] - what.x[0]), float(what.y[1] - what.y[0]) if what.height.ndim == 2 else 1.0)
    extent = f"0 {points[0] - 1} 0 {points[1] - 1} 0 0"
    head = f'<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="{steps[0]!r} {steps[1]!r} 1">'
    return _file("ImageData", f'{head}<Piece Extent="{extent}">{_points(_fields(what))}</Piece></ImageData>')


def _mesh(what: Surface | Contact) -> str:
    """The nodes at their heights, joined to rectangles, or those of a line to one line."""
    height = np.atleast_2d(what.height)
    y = what.y if what.height.ndim == 2 else np.zeros(1)
    places = np.stack(np.broadcast_arrays(what.x, np.asarray(y)[:, None], height), axis=-1)
    node: Any = np.arange(height.size).reshape(height.shape)
    corners = [node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]]
    kind, cells = ("Lines", node) if len(height) == 1 else ("Polys", np.stack(corners, axis=-1).reshape(-1, 4))
    ends = cells.shape[1] * np.arange(1, len(cells) + 1)
    counts = f'NumberOfPoints="{height.size}" NumberOf{kind}="{len(cells)}"'
    nodes = f"<Points>{_array('places', places, 3)}</Points>"
    joined = f"<{kind}>{_array('connectivity', cells)}{_array('offsets', ends)}</{kind}>"
    return _file("PolyData", f"<PolyData><Piece {counts}>{nodes}{joined}{_points(_fields(what))}</Piece></PolyData>")


def _stress(stress: Mapping[str, Any]) -> str:
    if "depth" not in stress or "x" not in stress:
        raise AsperityError("this is no stress, which has x and depth: give the dictionary of Contact.stress")
    x, depth = np.asarray(stress["x"], dtype=float), np.asarray(stress["depth"], dtype=float)
    shape = (len(depth), len(x))
    # z rises, so that the deepest row is the first one
    fields = {name: np.asarray(it)[::-1] for name, it in stress.items() if np.shape(it) == shape}
    extent = f"0 {len(x) - 1} 0 0 0 {len(depth) - 1}"
    places = "".join(_array(name, it) for name, it in (("x", x), ("y", np.zeros(1)), ("z", -depth[::-1])))
    grid = f'<Piece Extent="{extent}"><Coordinates>{places}</Coordinates>{_points(fields)}</Piece>'
    return _file("RectilinearGrid", f'<RectilinearGrid WholeExtent="{extent}">{grid}</RectilinearGrid>')


def _file(kind: str, content: str) -> str:
    head = f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">'
    return f'<?xml version="1.0"?>\n{head}{content}</VTKFile>\n'


def _points(fields: Mapping[str, Any]) -> str:
    arrays = "".join(_array(name, field) for name, field in fields.items())
    return f"<PointData Scalars={quoteattr(next(iter(fields)))}>{arrays}</PointData>"


_KINDS = {"b": ("UInt8", "u1"), "i": ("Int64", "<i8")}


def _array(name: str, values: Any, components: int = 1) -> str:
    """An array of doubles, of integers, or of bytes for truth values, the last axis first."""
    array = np.ascontiguousarray(values)
    kind, stored = _KINDS.get(array.dtype.kind, ("Float64", "<f8"))
    array = array.astype(stored)
    data = array.tobytes()
    text = b64encode(len(data).to_bytes(8, "little") + data).decode("ascii")
    several = f' NumberOfComponents="{components}"' if components > 1 else ""
    return f'<DataArray type="{kind}" Name={quoteattr(name)}{several} format="binary">{text}</DataArray>'
