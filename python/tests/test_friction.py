"""Tangential loads and stresses below contacts."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

CYLINDER = dict(shape="cylinder", points=4096, size=4.0, radius=1.0)
LOAD, COEFFICIENT, TANGENTIAL = 1e-3, 0.5, 0.36e-3
FRICTION = {"coefficient": COEFFICIENT, "tangential": TANGENTIAL}


def pulled() -> asp.Contact:
    return asp.solve(asp.Surface.indenter(**CYLINDER), solid=1.0, mean_pressure=LOAD, friction=FRICTION)


def test_the_stick_width_is_that_of_cattaneo_and_mindlin() -> None:
    contact = pulled()
    slip = contact.slip
    assert slip is not None
    width = slip.stick_area + slip.slip_area
    assert slip.stick_area / width == pytest.approx(math.sqrt(1 - TANGENTIAL / (COEFFICIENT * LOAD)), rel=2e-3)
    assert width == pytest.approx(contact.measures["relative_area"])
    # the traction carries the load, and is at its limit exactly where the contact slips
    assert slip.traction.mean() == pytest.approx(TANGENTIAL, rel=1e-6)
    slips = contact.contact & ~slip.stick
    assert np.allclose(slip.traction[slips], COEFFICIENT * contact.pressure[slips], rtol=1e-12)
    assert (slip.traction[slip.stick] < COEFFICIENT * contact.pressure[slip.stick]).all()
    assert slip.tangential_over_sliding == pytest.approx(TANGENTIAL / (COEFFICIENT * LOAD))
    assert asp.solve(contact.problem.surface, solid=1.0, mean_pressure=LOAD).slip is None


def test_every_way_and_the_command_line_find_the_same_traction(tmp_path: Path) -> None:
    setup = asp.Setup(
        surface={"indenter": {"shape": "cylinder", "radius": 1.0}},
        grid={"points": 4096, "size": 4.0},
        solid={"contact_modulus": 1.0},
        load={"mean_pressure": LOAD},
        friction=FRICTION,
    )
    setup.write(tmp_path / "scene.toml")
    command = [sys.executable, "-m", "asperity", "solve", "scene.toml", "--out", "run.npz"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    with np.load(tmp_path / "run.npz") as there:
        for contact in (setup.solve(), pulled()):
            assert contact.slip is not None and np.array_equal(contact.slip.traction, there["traction"])
            assert np.array_equal(contact.slip.stick, there["stick"])
    contact = pulled()
    contact.save(tmp_path / "own.npz")
    with np.load(tmp_path / "own.npz") as own:
        assert contact.slip is not None and np.array_equal(own["traction"], contact.slip.traction)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"mean_pressure": LOAD, "friction": {"coefficient": 0.1, "tangential": 0.2 * LOAD}}, "makes everything slide"),
        ({"mean_gap": 0.1, "friction": FRICTION}, "friction needs a given pressure"),
        ({"mean_pressure": LOAD, "law": {"hardness": 0.1}, "friction": FRICTION}, "and a hardness are given"),
        ({"mean_pressure": [LOAD, 2 * LOAD], "friction": FRICTION}, "several loads outside a path and friction cannot be combined"),
        ({"mean_pressure": LOAD, "friction": {"coefficent": 0.1, "tangential": 1.0}}, "did you mean 'coefficient'"),
    ],
)
def test_friction_that_cannot_be_is_refused(keys: dict[str, object], sentence: str) -> None:
    with pytest.raises(asp.AsperityError, match=sentence):
        asp.solve(asp.Surface.indenter(**CYLINDER), **({"solid": 1.0} | keys))
    problem = asp.Problem(asp.Surface.indenter(**CYLINDER), solid=1.0, mean_pressure=LOAD, friction=FRICTION)
    with pytest.raises(asp.AsperityError, match="makes everything slide"):
        problem.with_load(mean_pressure=LOAD / 2)


def test_a_study_refuses_what_it_does_not_solve() -> None:
    with pytest.raises(asp.AsperityError, match="a study has no tangential loads"):
        asp.Study(
            surface={"indenter": {"shape": "cylinder", "radius": 1.0}},
            grid={"points": 256, "size": 4.0},
            solid={"contact_modulus": 1.0},
            load={"mean_pressure": [LOAD, 2 * LOAD]},
            friction=FRICTION,  # type: ignore[call-arg]
        )


def test_the_largest_shear_stress_lies_below_the_surface_as_hertz_has_it() -> None:
    # Johnson (1985), section 4.2: below a cylinder tau_max = 0.300 p0 at the depth 0.786 a
    contact = asp.solve(asp.Surface.indenter(**CYLINDER), solid=1.0, mean_pressure=1e-4)
    hertz = asp.theory.cylinder(1.0)
    a = hertz.half_width(1e-4 * 4.0)
    stress = contact.stress(depths=np.linspace(0.5 * a, 1.1 * a, 61), poisson=0.3)
    depth, column = np.unravel_index(stress["tau_max"].argmax(), stress["tau_max"].shape)
    assert stress["tau_max"].max() == pytest.approx(0.300 * contact.pressure.max(), rel=1e-2)
    assert stress["depth"][depth] == pytest.approx(0.786 * a, abs=0.03 * a)
    assert stress["x"][column] == pytest.approx(2.0, abs=0.01)


def test_the_stress_is_that_of_the_command_line(tmp_path: Path) -> None:
    rough = asp.Surface.rough((32, 64), (1.0, 2.0), hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.2, rms_gradient=0.1)
    contact = asp.solve(rough, solid={"young": 1.0, "poisson": 0.4}, mean_pressure=0.01)
    contact.setup.write(tmp_path / "scene.toml")
    command = [sys.executable, "-m", "asperity", "solve", "scene.toml", "--stress", "stress.npz", "--stress-row", "7"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    stress = contact.stress(row=7)
    with np.load(tmp_path / "stress.npz") as there:
        for name in ("x", "depth", "pressure", "sigma_xx", "sigma_yy", "sigma_zz", "tau_xz", "tau_xy", "tau_yz", "tau_max", "von_mises"):
            assert np.array_equal(stress[name], there[name]), name
    assert stress["poisson"] == 0.4 and stress["row"] == 7
    assert contact.stress()["row"] == np.unravel_index(contact.pressure.argmax(), contact.pressure.shape)[0]
    with pytest.raises(IndexError, match="there is no row 32: give one from 0 to 31"):
        contact.stress(row=32)
    with pytest.raises(asp.AsperityError, match="a depth is -1"):
        contact.stress(depths=[-1.0])


def test_an_assumed_poisson_ratio_is_told() -> None:
    contact = asp.solve(asp.Surface.indenter(**CYLINDER), solid=1.0, mean_pressure=1e-3)
    with pytest.warns(asp.AsperityWarning, match=r"assumes a Poisson's ratio of 0.3.*\(solid=\{'poisson': \.\.\.\}\)"):
        contact.stress(depths=[0.1])
    layer = asp.solve(
        asp.Surface.indenter(**CYLINDER), solid={"contact_modulus": 1.0, "poisson": 0.3, "layer": 0.5}, mean_pressure=1e-3
    )
    with pytest.raises(asp.AsperityError, match="the stress can be computed in a half-space"):
        layer.stress()
