"""Heights in formats that only the package SurfaceTopography reads."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np


def read(path: str, channel: str | None) -> tuple[Any, tuple[float, ...], str] | None:
    """Heights and lengths in metres, and a sentence that says how they were read; None where the package is not installed or does not read them.

    Heights have the shape (n) or (ny, nx), and are nan where they are missing.
    """
    try:
        import SurfaceTopography
        from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor
    except ImportError:
        return None
    try:
        with SurfaceTopography.open_topography(path) as file:
            names = [it.name for it in file.channels]
            found = file.topography() if channel is None else file.topography(channel_index=names.index(channel))
            heights: Any = np.ma.filled(np.ma.asarray(found.heights(), dtype=float), np.nan).T
            metre = 1.0 if found.unit is None else get_unit_conversion_factor(found.unit, "m")
            lengths = tuple(float(length) * metre for length in found.physical_sizes[::-1])
            kind = file.format()
    except Exception:  # whatever goes wrong there, the error of this package is the one to be told
        return None
    version = SurfaceTopography.__version__
    units = "whose heights have no unit" if found.unit is None else "with its units"
    sentence = f"{Path(path).name} was read by SurfaceTopography {version} as a file of the format {kind!r}, {units}"
    return heights * metre, lengths, sentence
