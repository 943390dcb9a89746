"""Solids and solvers that are written in Python."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import pytest

import asperity as asp
from asperity import Problem

if TYPE_CHECKING:
    from asperity._asperity import Array

LINE = asp.Surface.rough(512, 1.0, hurst=0.8, rolloff_wavelength=0.2, short_cutoff=0.02, rms_gradient=0.1)
MAP = asp.Surface.rough((64, 64), 1.0, hurst=0.8, rolloff_wavelength=0.4, short_cutoff=0.1, rms_gradient=0.1)
MEAN = 0.01


def skin(q: Array) -> Array:
    """A soft skin on a body that is twice as stiff."""
    return q / 2 * (2 + 0.01 * q) / (1 + 0.01 * q)


def wavenumbers(problem: Problem) -> Array:
    """The wavenumber of each wave of the real transform of numpy."""
    shape, size = problem.surface.shape, problem.surface.size
    axes = [2 * np.pi * np.fft.fftfreq(n, length / n) for n, length in zip(shape[:-1], size[:-1])]
    axes.append(2 * np.pi * np.fft.rfftfreq(shape[-1], size[-1] / shape[-1]))
    return np.sqrt(sum(q**2 for q in np.meshgrid(*axes, indexing="ij")))


def apart(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max() / np.abs(other).max())


@pytest.mark.parametrize("surface", [LINE, MAP])
def test_a_function_is_the_stiffness_of_each_wave(surface: asp.Surface) -> None:
    problem = asp.Problem(surface, solid=skin, mean_pressure=MEAN)
    q = wavenumbers(problem)
    assert problem.stiffness.shape == q.shape
    assert np.abs(problem.stiffness[q > 0] / skin(q[q > 0]) - 1).max() < 1e-9
    pressure = np.random.default_rng(1).random(surface.shape)
    axes = tuple(range(len(surface.shape)))
    waves = np.fft.rfftn(pressure, axes=axes) * np.divide(1, skin(q), out=np.zeros_like(q), where=q > 0)
    assert apart(problem.displacement(pressure), np.fft.irfftn(waves, surface.shape, axes)) < 1e-9


@pytest.mark.parametrize("surface", [LINE, MAP])
def test_a_function_of_a_half_space_makes_its_contact(surface: asp.Surface) -> None:
    ours = asp.solve(surface, solid=3.0, mean_pressure=MEAN, tolerance=1e-12)
    own = asp.solve(surface, solid=lambda q: 1.5 * q, mean_pressure=MEAN, tolerance=1e-12)
    assert apart(own.pressure, ours.pressure) < 1e-8
    assert own.problem.contact_modulus == pytest.approx(3.0, rel=1e-12)


@pytest.mark.parametrize("solver", ["multilevel", "polonsky-keer", "gfmd"])
def test_all_solvers_find_the_contact_on_a_skin(solver: str) -> None:
    contact = asp.solve(LINE, solid=skin, mean_pressure=MEAN, solver=solver, tolerance=1e-10)
    gap = contact.problem.displacement(contact.pressure) - LINE.height
    gap -= gap.min()
    assert contact.converged and contact.pressure.min() >= 0 and contact.pressure.mean() == pytest.approx(MEAN)
    assert (contact.pressure * gap).mean() < 1e-7 * MEAN * contact.problem.rms_height


def test_arrays_over_the_waves_of_numpy_are_a_layer() -> None:
    for surface in (LINE, MAP):
        layer = asp.solve(surface, solid={"contact_modulus": 1.0, "poisson": 0.3, "layer": 0.1}, mean_pressure=MEAN, tolerance=1e-11)
        solid = {"stiffness": layer.problem.stiffness, "wavenumber": wavenumbers(layer.problem)}
        own = asp.solve(surface, solid=solid, mean_pressure=MEAN, tolerance=1e-11)
        assert apart(own.pressure, layer.pressure) < 1e-8
    # a line needs no wavenumbers
    solid = {"stiffness": asp.Problem(LINE, solid=skin, mean_pressure=MEAN).stiffness}
    assert asp.solve(LINE, solid=solid, mean_pressure=MEAN).converged


def test_a_uniform_stiffness_allows_an_approach() -> None:
    solid = {"stiffness": lambda q: q / 2 + 5, "uniform_stiffness": 5.0}
    contact = asp.solve(LINE, solid=solid, approach=0.01)
    assert contact.approach == pytest.approx(0.01)
    with pytest.raises(asp.AsperityError, match="approach"):
        asp.solve(LINE, solid=skin, approach=0.01)


def test_the_setup_repeats_a_solid_of_ones_own() -> None:
    problem = asp.Problem(LINE, solid=skin, mean_pressure=MEAN)
    again = asp.Setup.from_toml(problem.setup.to_toml()).problem()
    assert (again.stiffness == problem.stiffness).all()


def projected_gradient(problem: Problem) -> Iterator[Array]:
    height, load = problem.surface.height, problem.mean_pressure
    assert load is not None
    pressure = np.full(height.shape, load)
    step = problem.stiffness.ravel()[1:].min()
    while True:
        gap = problem.displacement(pressure) - height
        pressure = np.maximum(pressure - step * (gap - gap[pressure > 0].mean()), 0)
        pressure *= load / pressure.mean()
        yield pressure


@pytest.mark.parametrize("surface", [LINE, MAP])
def test_a_function_that_yields_pressures_is_a_solver(surface: asp.Surface) -> None:
    errors: list[float] = []
    contact = asp.solve(
        surface, solid=1.0, mean_pressure=0.1, solver=projected_gradient, tolerance=1e-4, callback=lambda step: errors.append(step.error)
    )
    assert contact.converged and contact.solver == "projected_gradient" and contact.work.iterations == len(errors) - 1
    assert errors[-1] <= 1e-4 < min(errors[:-1]) and contact.certificate.eta == pytest.approx(errors[-1])
    ours = asp.solve(surface, solid=1.0, mean_pressure=0.1, tolerance=1e-12)
    assert apart(contact.pressure, ours.pressure) < 0.05


def test_a_solver_in_python_ends_as_others_do(tmp_path: object) -> None:
    record = f"{tmp_path}/mine.rrd"
    with pytest.warns(asp.AsperityWarning, match="iteration cap"):
        contact = asp.solve(LINE, solid=1.0, mean_pressure=0.1, solver=projected_gradient, max_iterations=5, record=record)
    assert contact.work.iterations == 5
    with pytest.warns(asp.AsperityWarning):
        ended = asp.solve(LINE, solid=1.0, mean_pressure=0.1, solver=lambda problem: [np.full(512, 0.1)])
    assert not ended.converged and ended.status == "no more steps"

    def broken(problem: Problem) -> Iterator[Array]:
        yield np.full(512, 0.1)
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        asp.solve(LINE, solid=1.0, mean_pressure=0.1, solver=broken)


@pytest.mark.parametrize(
    ("solid", "sentence"),
    [
        (lambda q: -q, "is -6.28"),
        (lambda q: 3.0, "return one value for each wavenumber"),
        ({"stiffness": np.ones(3)}, "give as many of both"),
        ({"stiffness": np.ones(3), "wavenumber": [1, 2, 3]}, "give it for all of them"),
        ({"stiffness": lambda q: q, "wavenumber": [1, 2, 3]}, "leave wavenumber out"),
        ({"stiffness": lambda q: q, "layer": 1.0}, "give only the stiffness"),
    ],
)
def test_solids_that_cannot_be_are_refused(solid: object, sentence: str) -> None:
    with pytest.raises(asp.AsperityError, match=sentence):
        asp.solve(LINE, solid=solid, mean_pressure=MEAN)  # type: ignore[call-overload]


def test_a_solid_must_be_the_same_in_all_directions() -> None:
    solid = {"stiffness": 1 + np.random.default_rng(1).random((64, 33)), "wavenumber": wavenumbers(asp.Problem(MAP, solid=1.0, mean_pressure=MEAN))}
    with pytest.raises(asp.AsperityError, match="the same in all directions"):
        asp.solve(MAP, solid=solid, mean_pressure=MEAN)
    with pytest.raises(asp.AsperityError, match="without its wavenumbers"):
        asp.solve(MAP, solid={"stiffness": np.ones((64, 33))}, mean_pressure=MEAN)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [({"diagnose": True}, "Recorder"), ({"start": np.ones(512)}, "start your function"), ({"refine": "auto"}, "Surface")],
)
def test_what_a_solver_in_python_cannot_do_is_refused(options: dict[str, object], sentence: str) -> None:
    with pytest.raises(asp.AsperityError, match=sentence):
        asp.solve(LINE, solid=1.0, mean_pressure=0.1, solver=projected_gradient, **options)  # type: ignore[call-overload]
    with pytest.raises(asp.AsperityError, match="yield one pressure"):
        asp.solve(LINE, solid=1.0, mean_pressure=0.1, solver=lambda problem: 3)  # type: ignore[call-overload, arg-type, return-value]
