"""Closed forms against printed numbers."""

import math

import numpy as np
import pytest

import asperity as asp


def test_hertz() -> None:
    # Johnson (1985), section 4.2: F = 4 E* a^3 / (3 R), approach a^2 / R, p0 = 2 E* a / (pi R)
    sphere = asp.theory.sphere(2.0, 3.0)
    assert sphere.load(0.1) == pytest.approx(4 * 3 * 0.1**3 / (3 * 2))
    assert sphere.half_width(sphere.load(0.1)) == pytest.approx(0.1)
    assert sphere.approach(0.1) == pytest.approx(0.1**2 / 2)
    assert sphere.pressure(0.1, 0.0) == pytest.approx(2 * 3 * 0.1 / (math.pi * 2))
    assert sphere.kappa_r == pytest.approx(3 * math.pi / (4 * math.sqrt(2)))
    assert math.isnan(asp.theory.cylinder(1.0).approach(0.1))


def test_numbers_give_numbers_and_arrays_arrays() -> None:
    sphere = asp.theory.sphere(1.0)
    assert isinstance(sphere.load(0.1), float)
    a = np.array([[0.1, 0.2], [0.3, 0.4]])
    assert sphere.load(a).shape == (2, 2) and sphere.load(a)[1, 0] == sphere.load(0.3)


def test_persson_and_greenwood_williamson() -> None:
    assert asp.theory.persson_relative_area(1e-4) / 1e-4 == pytest.approx(math.sqrt(8 / math.pi))
    p = np.linspace(0, 5, 20001)
    density = asp.theory.persson_pressure_density(p, 0.1, 1.0)
    assert np.trapezoid(density, p) == pytest.approx(asp.theory.persson_relative_area(0.1), rel=1e-6)
    assert np.trapezoid(p * density, p) == pytest.approx(0.1, rel=1e-6)
    model = asp.theory.greenwood_williamson([3.0], 1.0, 1.0, 1.0, heights="exponential")
    assert model["kappa_r"][0] == pytest.approx(math.sqrt(math.pi))


def test_counting() -> None:
    assert asp.theory.counting_excess(0.0) == pytest.approx(0.1900095, abs=1e-5)


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(asp.AsperityError, match="radius is -1"):
        asp.theory.sphere(-1.0)
    with pytest.raises(asp.AsperityError, match="line or point"):
        asp.theory.PowerLaw("sphere", 1.0, 2.0)  # type: ignore[arg-type]
