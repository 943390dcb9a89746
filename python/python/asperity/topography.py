"""Heights in formats that only the package SurfaceTopography reads."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

LEFT_OUT = ("asc", "xyz", "npy", "npz", "hgt")
"""Texts and arrays, of which this package says what is wrong, and a format that any bytes may be."""


def read(path: str, channel: str | None) -> tuple[Any, list[float] | None, str] | None:
    """Heights and lengths in metres, and a sentence that says how they were read; None where the package is not installed or does not read them.

    Heights have the shape (n) or (ny, nx), and are nan where they are missing. Lengths are along the same axes, and None if the file has none. Where
    the file has no units, both are as they are in it.
    """
    try:
        import SurfaceTopography
        from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor
    except ImportError:
        return None
    try:
        with SurfaceTopography.open_topography(path) as file:
            kind = file.format()
            if kind in LEFT_OUT:
                return None
            names = [it.name for it in file.channels]
            number = 0 if channel is None else names.index(channel)
            has_lengths = file.channels[number].physical_sizes is not None
            # the package takes no file without lengths
            lengths = {} if has_lengths else {"physical_sizes": (1.0,) * file.channels[number].dim}
            found = file.topography(channel_index=number, **lengths)
            heights: Any = np.ma.filled(np.ma.asarray(found.heights(), dtype=float), np.nan).T
            metre = 1.0 if found.unit is None else get_unit_conversion_factor(found.unit, "m")
            sizes = [float(length) * metre for length in found.physical_sizes[::-1]] if has_lengths else None
    except Exception:  # whatever goes wrong there, the error of this package is the one to be told
        return None
    units = "without units" if found.unit is None else "with its units"
    version = SurfaceTopography.__version__
    return heights * metre, sizes, f"{Path(path).name} was read by SurfaceTopography {version} as a file of the format {kind!r}, {units}"
