"""Solids that are given by the stiffness of their waves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Callable, Sequence

import numpy as np

from asperity._asperity import AsperityError

if TYPE_CHECKING:
    from asperity._asperity import Array

PER_DECADE = 400
"""Wavenumbers per decade at which a function is taken. Between them the package interpolates with a relative error of about 2e-10."""
ALIKE = 1e-9
"""Relative difference of wavenumbers, or of stiffnesses of waves of one wavenumber, that is rounding."""


def sampled(solid: Any, shape: Sequence[int], size: Sequence[float]) -> Any:
    """The solid with its stiffness as values over wavenumbers. Other solids are returned as they are.

    A stiffness is a function k(q) of an array of wavenumbers `2 pi / wavelength`, or an array: over the array `wavenumber`, or of a line over the
    waves of numpy.fft.rfft. Values at the wavenumber 0 are the stiffness under a uniform pressure.
    """
    if callable(solid):
        solid = {"stiffness": solid}
    if not isinstance(solid, Mapping) or "stiffness" not in solid:
        return solid
    stiffness, given = solid["stiffness"], solid.get("wavenumber")
    if callable(stiffness):
        if given is not None:
            raise AsperityError("the stiffness is a function, and wavenumber is given: leave wavenumber out")
        q, k = _of_function(stiffness, shape, size)
    else:
        q, k = _of_arrays(_line_waves(shape, size) if given is None else given, stiffness)
    keys = {name: value for name, value in solid.items() if name not in ("stiffness", "wavenumber")}
    is_uniform = q == 0
    if is_uniform.any() and np.all(k[is_uniform] > 0):
        keys.setdefault("uniform_stiffness", float(k[is_uniform][0]))
    q, k = _by_wavenumber(q[~is_uniform], k[~is_uniform])
    return {**keys, "wavenumber": q.tolist(), "stiffness": k.tolist()}


def _of_function(stiffness: Callable[[Array], Any], shape: Sequence[int], size: Sequence[float]) -> tuple[Array, Array]:
    """The values of a function from the longest to the shortest wave of a grid."""
    first = 2 * np.pi / max(size)
    last = float(np.hypot.reduce([np.pi * n / length for n, length in zip(shape, size)]))
    q = np.geomspace(first, last, 2 + int(PER_DECADE * np.log10(last / first)))
    k = np.asarray(stiffness(q), dtype=float)
    if k.shape != q.shape:
        raise AsperityError(f"the stiffness of {q.shape} wavenumbers has the shape {k.shape}: return one value for each wavenumber")
    return q, k


def _of_arrays(wavenumber: Any, stiffness: Any) -> tuple[Array, Array]:
    q, k = np.asarray(wavenumber, dtype=float), np.asarray(stiffness, dtype=float)
    if q.shape != k.shape:
        raise AsperityError(f"the stiffness has the shape {k.shape}, but there are wavenumbers of the shape {q.shape}: give as many of both")
    return q.ravel(), k.ravel()


def _line_waves(shape: Sequence[int], size: Sequence[float]) -> Array:
    """The wavenumbers of numpy.fft.rfft of a line."""
    if len(shape) != 1:
        raise AsperityError("the stiffness of a surface is given without its wavenumbers: give them as wavenumber, an array of the same shape")
    return np.asarray(2 * np.pi * np.arange(shape[0] // 2 + 1) / size[0], dtype=float)


def _by_wavenumber(q: Array, k: Array) -> tuple[Array, Array]:
    """Ascending wavenumbers with their stiffness. Waves of one wavenumber must have one stiffness."""
    order = np.argsort(q, kind="stable")
    q, k = q[order], k[order]
    if not len(q):
        return q, k
    is_new = np.diff(q, prepend=-np.inf) > ALIKE * q
    group = np.cumsum(is_new) - 1
    apart = np.abs(k - k[is_new][group]) > ALIKE * np.abs(k)
    if apart.any():
        at = q[np.argmax(apart)]
        raise AsperityError(f"waves of the wavenumber {at:.6g} have several stiffnesses: a solid must be the same in all directions")
    return q[is_new], k[is_new]
