"""The same contacts by other codes, where they are installed."""

import numpy as np
import pytest

import asperity as asp

N, MEAN = 64, 0.02
ROUGH = dict(hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.1, rms_gradient=0.1, seed=4)


def surface() -> asp.Surface:
    return asp.Surface.rough((N, N), 1.0, **ROUGH)


def test_tamaas_finds_the_same_pressure_and_is_certified() -> None:
    tamaas = pytest.importorskip("tamaas")
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [N, N])
    model.E, model.nu = 1.0, 0.0
    heights = np.array(surface().height)
    solver = tamaas.PolonskyKeerRey(model, heights, 1e-12)
    solver.solve(MEAN)
    theirs = np.array(model.traction)
    ours = asp.solve(surface(), solid=1.0, mean_pressure=MEAN, tolerance=1e-12)
    assert np.abs(theirs - ours.pressure).max() < 1e-3 * ours.pressure.max()
    certification = ours.problem.certify(pressure=theirs)
    assert certification.certificate.eta < 1e-6, certification


def test_contact_mechanics_finds_the_same_pressure_and_is_certified() -> None:
    contact_mechanics = pytest.importorskip("ContactMechanics")
    topography = pytest.importorskip("SurfaceTopography")
    heights = np.array(surface().height)
    system = contact_mechanics.make_system(
        interface="hardwall",
        substrate=contact_mechanics.PeriodicFFTElasticHalfSpace((N, N), 1.0, (1.0, 1.0)),
        surface=topography.Topography(heights, (1.0, 1.0)),
    )
    result = system.minimize_proxy(external_force=MEAN, pentol=1e-12, maxiter=5000)
    assert result.success, result.message
    theirs = np.array(result.jac) * N * N  # forces of nodes
    ours = asp.solve(surface(), solid=1.0, mean_pressure=MEAN, tolerance=1e-12)
    assert np.abs(theirs - ours.pressure).max() < 1e-3 * ours.pressure.max()
    assert ours.problem.certify(pressure=theirs).certificate.eta < 1e-5


def theirs_after(steps: int, moduli: list[float], times: list[float]) -> np.ndarray:
    """Pressures by Tamaas after a time of 1 under a held load, on a solid whose relaxed shear modulus is 1."""
    import tamaas

    model = tamaas.Model(tamaas.model_type.basic_2d, [1.0, 1.0], [N, N])
    model.E, model.nu = 2 * (1 + 0.3), 0.3
    solver = tamaas.MaxwellViscoelastic(model, np.array(surface().height), 1e-12, 1 / steps, moduli, times)
    solver.reset()
    for _ in range(steps):
        solver.solve(MEAN)
    return np.array(model.traction)


def test_tamaas_finds_the_same_creep() -> None:
    pytest.importorskip("tamaas")
    moduli, times = [2.0, 4.0], [0.5, 5.0]
    glassy = 1 + sum(moduli)
    shares = [modulus / glassy for modulus in moduli]
    solid = {"young": 2 * (1 + 0.3) * glassy, "poisson": 0.3}
    relaxation = [value for pair in zip(shares, times) for value in pair]
    history = asp.solve(
        surface(),
        solid=solid,
        viscoelastic={"relaxation": relaxation},
        mean_pressure=MEAN,
        path={"time": 1.0, "steps": 50},
        tolerance=1e-12,
    )
    ours = history[-1].pressure
    coarse, fine = theirs_after(50, moduli, times), theirs_after(100, moduli, times)
    # they are of first order in the step: twice the finer one less the coarser one is that of short steps
    assert np.abs(2 * fine - coarse - ours).max() < 0.1 * np.abs(fine - ours).max() < 1e-3 * ours.max()
