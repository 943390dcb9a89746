"""Contacts against closed forms and against each other."""

import gc
import math
import weakref

import numpy as np
import pytest

import asperity as asp


def cosine(points: int, amplitude: float = 0.01) -> np.ndarray:
    return amplitude * np.cos(2 * np.pi * np.arange(points) / points)


def test_a_cylinder_is_that_of_hertz() -> None:
    # van Dokkum et al. (2018), Eq. 7: kappa_r = 8 / (pi sqrt 3); the cell is so long that its images hardly matter
    n, length, radius = 8192, 8.0, 1.0
    x = (np.arange(n) - n // 2) * length / n
    hertz = asp.theory.cylinder(radius)
    load = hertz.load(0.1)
    assert load == pytest.approx(math.pi * 0.1**2 / (4 * radius), rel=1e-14)
    contact = asp.solve(-x * x / (2 * radius), length, solid=1.0, mean_pressure=load / length, solver="multilevel")
    assert contact.converged and contact.certificate.eta <= 1e-8
    assert contact.pressure.max() == pytest.approx(hertz.pressure(0.1, 0.0), rel=2e-3)
    assert contact.measures["kappa_r"] == pytest.approx(8 / (math.pi * math.sqrt(3)), rel=5e-3)
    inside = np.abs(x) < 0.09
    assert np.allclose(contact.pressure[inside], hertz.pressure(0.1, x[inside]), rtol=0.01)


def test_a_sphere_is_that_of_hertz() -> None:
    surface = asp.Surface.indenter("sphere", (128, 128), 1.0, radius=1.0, boundary="free")
    hertz = asp.theory.sphere(1.0)
    contact = asp.solve(surface, solid=1.0, force=hertz.load(0.1))
    assert contact.pressure.shape == (128, 128)
    assert contact.pressure.max() == pytest.approx(hertz.pressure(0.1, 0.0), rel=0.01)
    assert contact.approach == pytest.approx(hertz.approach(0.1), rel=0.01)
    exact = asp.theory.exact(contact.problem)
    assert exact is not None and exact["relative_area"] == pytest.approx(math.pi * 0.01)


@pytest.mark.parametrize("solver", ["multilevel", "polonsky-keer", {"method": "gfmd", "damping": 1.0}])
def test_every_solver_finds_the_sine_of_westergaard(solver: object) -> None:
    sine = asp.theory.Westergaard(0.01, 1.0)
    contact = asp.solve(cosine(1024), 1.0, solid=1.0, mean_pressure=0.3 * sine.full_pressure, solver=solver, tolerance=1e-9)
    assert contact.converged
    assert contact.measures["relative_area"] == pytest.approx(sine.relative_area(0.3 * sine.full_pressure), rel=1e-3)
    assert contact.mean_gap == pytest.approx(sine.mean_gap(0.3 * sine.full_pressure), rel=1e-3)


def test_loads_solids_laws_and_boundaries_are_those_of_a_scene() -> None:
    height = cosine(256)
    pressed = asp.solve(height, 1.0, solid={"young": 0.91, "poisson": 0.3}, mean_pressure=0.01)
    assert pressed.problem.contact_modulus == pytest.approx(1.0)
    apart = asp.solve(height, 1.0, solid=1.0, mean_gap=pressed.mean_gap)
    assert apart.mean_pressure == pytest.approx(0.01, rel=1e-3)
    soft = asp.solve(height, 1.0, solid=1.0, mean_pressure=0.01, law={"hardness": 0.02})
    assert soft.pressure.max() == pytest.approx(0.02)
    layer = asp.solve(height, 1.0, solid={"contact_modulus": 1.0, "poisson": 0.3, "layer": 0.05}, mean_pressure=0.01)
    assert layer.mean_gap > pressed.mean_gap
    with_units = asp.solve(height, "1 mm", solid="1 GPa", mean_pressure="1 MPa")
    assert with_units.problem.contact_modulus == 1e9 and with_units.mean_pressure == pytest.approx(1e6)


def test_a_run_starts_from_a_pressure_that_is_given() -> None:
    surface = asp.Surface.rough(1024, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1, seed=3)
    problem = asp.Problem(surface, reduced_pressure=0.05)
    first = problem.solve(solver="polonsky-keer")
    again = problem.solve(solver="polonsky-keer", start=first.pressure)
    assert again.work.iterations < first.work.iterations / 4
    more = problem.with_load(reduced_pressure=0.1).solve()
    assert more.measures["relative_area"] > first.measures["relative_area"]


def test_fields_share_the_memory_of_the_contact_and_outlive_its_name() -> None:
    contact = asp.solve(cosine(256), 1.0, reduced_pressure=0.1)
    one, other = contact.pressure, contact.pressure
    assert one.ctypes.data == other.ctypes.data and one.base is not None
    assert not one.flags.writeable and not one.flags.owndata
    assert contact.problem.surface.height.ctypes.data == contact.height.ctypes.data
    with pytest.raises(ValueError):
        one[0] = 1.0
    with pytest.raises(ValueError):
        one.flags.writeable = True
    expected = one.copy()
    del contact, other
    gc.collect()
    assert np.array_equal(one, expected)


def test_what_is_given_is_not_changed_and_may_be_anything_that_numpy_takes() -> None:
    height = cosine(64)
    kept = height.copy()
    base = asp.solve(height, 1.0, reduced_pressure=0.1).pressure
    assert np.array_equal(height, kept)
    assert np.array_equal(asp.solve(list(height), 1.0, reduced_pressure=0.1).pressure, base)
    assert np.array_equal(asp.solve(np.repeat(height, 2)[::2], 1.0, reduced_pressure=0.1).pressure, base)
    rough = np.random.default_rng(1).normal(size=(16, 32))
    turned = asp.solve(np.asfortranarray(rough), (1.0, 2.0), reduced_pressure=0.1)
    assert np.array_equal(turned.pressure, asp.solve(rough, (1.0, 2.0), reduced_pressure=0.1).pressure)
    assert asp.solve(rough.astype(np.float32), (1.0, 2.0), reduced_pressure=0.1).pressure.shape == (16, 32)


def test_patches_edges_and_distributions_add_up() -> None:
    surface = asp.Surface.rough((64, 64), 1.0, hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.1, rms_gradient=0.1)
    contact = asp.solve(surface, solid=1.0, reduced_pressure=0.2)
    patches, measures = contact.patches(), contact.measures
    assert len(patches["nodes"]) == measures["patches"]
    assert patches["load"].sum() == pytest.approx(contact.mean_pressure)
    assert patches["area"].sum() == pytest.approx(measures["relative_area_counted"])
    edges = contact.edges()
    beyond = (edges["weight"] * (edges["place"] - 0.5)).sum() / contact.pressure.size
    assert measures["relative_area_counted"] + beyond == pytest.approx(measures["relative_area"], rel=1e-2)
    for bins, density in (contact.pressure_distribution(20), contact.gap_distribution(20)):
        assert len(bins) == 21 and len(density) == 20
    bins, density = contact.pressure_distribution(20)
    assert (density * np.diff(bins)).sum() == pytest.approx(measures["relative_area_counted"])
    assert contact.stiffness() > 0 and contact.elastic_energy > 0
    names = {row["name"] for row in asp.observables()}
    # without a hardness nothing yields, and at rest the modulus is that of the solid
    absent = {"plastic_load_share", "plastic_overlap", "effective_modulus"}
    assert names - set(measures) == absent and set(measures) <= names


def test_a_surface_tells_its_statistics_and_keeps_its_seed() -> None:
    keys = dict(hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)
    one, other = asp.Surface.rough(1024, 1.0, seed=1, **keys), asp.Surface.rough(1024, 1.0, seed=2, **keys)
    assert one.statistics["rms_gradient"] == pytest.approx(0.1)
    assert not np.array_equal(one.height, other.height)
    wavenumber, density = one.spectrum()
    assert wavenumber[0] == pytest.approx(2 * np.pi) and density.shape == wavenumber.shape
    both = one + asp.Surface.indenter("cylinder", 1024, 1.0, radius=5.0)
    assert both.shape == (1024,) and both.height.std() > one.height.std()


def test_heights_come_from_files(tmp_path: object) -> None:
    path = tmp_path / "height.npy"  # type: ignore[operator]
    np.save(path, cosine(64) + 1.0)
    contact = asp.solve(path, 1.0, reduced_pressure=0.1)
    assert np.allclose(contact.height, cosine(64)) and asp.Surface.read(path, size=1.0).mean_height == pytest.approx(1.0)
    assert "height.npy" in contact.setup.to_toml()
    assert asp.Surface.read(path, size=1.0, prepare="auto").shape[0] >= 64


def test_surfaces_are_freed() -> None:
    class Owner:
        pass

    owner = Owner()
    seen = weakref.ref(owner)

    def keep(step: asp.Step, owner: Owner = owner) -> None:
        assert step.iteration >= 0

    asp.solve(cosine(64), 1.0, reduced_pressure=0.1, callback=keep)
    del keep, owner
    gc.collect()
    assert seen() is None
