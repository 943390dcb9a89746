"""Saved results come back as they were, or unchecked."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity as asp

ROUGH = asp.Surface.rough(512, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)
X = np.arange(256) / 256
WAVES = 0.01 * np.cos(2 * np.pi * X) + 2e-3 * np.cos(10 * np.pi * X)


def saved(it: Any, folder: Path) -> Any:
    it.save(folder / "it.npz")
    return asp.load(folder / "it.npz")


def check_same(again: asp.Contact, contact: asp.Contact) -> None:
    for name in ("pressure", "gap", "displacement", "contact"):
        assert np.array_equal(getattr(again, name), getattr(contact, name)), name
    assert again.measures.keys() == contact.measures.keys()
    for name, value in contact.measures.items():
        assert again.measures[name] == pytest.approx(value, rel=0.0, abs=0.0, nan_ok=True), name
    assert (again.setup, again.status, again.solver) == (contact.setup, contact.status, contact.solver)
    assert again.work.iterations == contact.work.iterations and np.allclose(again.height, contact.height, atol=1e-15)


def test_a_contact_comes_back(tmp_path: Path) -> None:
    for contact in (
        asp.solve(ROUGH, reduced_pressure=0.05),
        asp.solve(WAVES, 1.0, solid=1.0, mean_gap=0.004, solver="polonsky-keer"),
        asp.solve(np.add.outer(WAVES[::8], WAVES[::4]), (1.0, 2.0), reduced_pressure=0.05, boundary=("free", "periodic")),
        asp.solve(asp.Surface(np.round(WAVES, 3), 1.0, refine=4), reduced_pressure=0.05),
        asp.solve(ROUGH, solid=1.0, mean_pressure=2e-3, law={"hardness": 0.05}, flow={"leakage": True}),
        asp.solve(ROUGH, reduced_pressure=0.05, viscoelastic={"creep": [9.0, 1.0]}, sliding={"speed": 0.01}),
    ):
        check_same(saved(contact, tmp_path), contact)
    stiff = asp.solve(ROUGH, reduced_pressure=0.05)
    assert saved(stiff, tmp_path).measures["stiffness"] != stiff.stiffness()
    assert saved(stiff, tmp_path).measures["stiffness"] == stiff.stiffness()


def test_slip_comes_back(tmp_path: Path) -> None:
    contact = asp.solve(ROUGH, solid=1.0, mean_pressure=2e-3, friction={"coefficient": 0.5, "tangential": 5e-4})
    again = saved(contact, tmp_path)
    check_same(again, contact)
    assert np.allclose(again.slip.traction, contact.slip.traction, rtol=1e-9) and np.array_equal(again.slip.stick, contact.slip.stick)
    assert again.slip.stick_area == pytest.approx(contact.slip.stick_area, rel=1e-9)


@pytest.mark.parametrize("law", [None, {"hardness": 0.06}])
def test_a_load_curve_comes_back(law: dict[str, float] | None, tmp_path: Path) -> None:
    loads = [1e-3, 4e-3, 2e-3]
    curve = asp.solve(ROUGH, solid=1.0, mean_pressure=loads, law=law)
    again = saved(curve, tmp_path)
    assert isinstance(again, asp.History) and list(again.loads) == loads and again.converged and again.setup == curve.setup
    for there, here in zip(again, curve):
        check_same(there, here)


HISTORIES = {
    "creep": dict(viscoelastic={"creep": [9.0, 1.0]}, path={"time": [0.0, 1.0, 2.0], "load": [0.0, 0.005, 0.0]}),
    "slip": dict(friction={"coefficient": 0.5}, path={"tangential": [5e-4, -5e-4, 5e-4], "steps": 2}),
    "sliding": dict(viscoelastic={"creep": [9.0, 1.0]}, sliding={"speed": [0.01, 0.1]}),
    "rolling": dict(friction={"coefficient": 0.5}, rolling={"creepage": [1e-4, 2e-4]}),
    "adhesion": dict(adhesion={"work": 1e-5, "range": 1e-3}, path={"load": [2e-3, 0.0], "steps": 4}),
}


@pytest.mark.parametrize("process", HISTORIES)
def test_a_history_comes_back(process: str, tmp_path: Path) -> None:
    keys: dict[str, Any] = HISTORIES[process]
    history = asp.solve(ROUGH, solid=1.0, mean_pressure=2e-3, **keys)
    again = saved(history, tmp_path)
    assert isinstance(again, asp.History) and again.process == process and again.claims == history.claims
    assert again.adhesion == history.adhesion and np.array_equal(again.energy_per_cycle, history.energy_per_cycle)
    for there, here in ((again.numbers, history.numbers), (again.fields, history.fields)):
        assert there.keys() == here.keys()
        for name, values in here.items():
            assert np.array_equal(there[name], values, equal_nan=True), name
    for there, here in zip(again, history):
        assert np.array_equal(there.pressure, here.pressure) and np.array_equal(there.gap, here.gap)
        assert there.measures.keys() == here.measures.keys()
    history[-1].save(tmp_path / "one.npz")
    with pytest.raises(asp.AsperityError, match="one state of a history"):
        asp.load(tmp_path / "one.npz")


def test_results_of_the_command_line_are_read(tmp_path: Path) -> None:
    contact = asp.solve(ROUGH, reduced_pressure=0.05)
    contact.setup.write(tmp_path / "scene.toml")
    words = ["solve", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "there.npz")]
    subprocess.run([sys.executable, "-m", "asperity", *words], check=True, capture_output=True)
    assert asp.load(tmp_path / "there.npz") == contact


def test_a_pressure_that_was_changed_is_recognised(tmp_path: Path) -> None:
    contact = asp.solve(ROUGH, reduced_pressure=0.05)
    contact.save(tmp_path / "it.npz")
    with np.load(tmp_path / "it.npz") as archive:
        arrays = dict(archive)
    arrays["pressure"] = 1.01 * arrays["pressure"]
    np.savez(tmp_path / "changed.npz", **arrays)
    with pytest.warns(asp.AsperityWarning, match="is not as it was written"):
        changed = asp.load(tmp_path / "changed.npz")
    assert not changed.converged
    told = asp.certify(ROUGH, reduced_pressure=0.05, pressure=changed.pressure)
    assert not told.holds and told.certificate.eta > 1e-4 > contact.certificate.eta


def changed(contact: Any, folder: Path, **arrays: Any) -> Any:
    """The result that is read from a file in which some arrays are other ones."""
    contact.save(folder / "it.npz")
    with np.load(folder / "it.npz") as archive:
        all_arrays = {**archive, **{name: np.asarray(array) for name, array in arrays.items()}}
    np.savez(folder / "changed.npz", **all_arrays)
    return asp.load(folder / "changed.npz")


def test_what_was_changed_is_not_converged(tmp_path: Path) -> None:
    light, heavy = (asp.solve(ROUGH, solid=1.0, mean_pressure=p) for p in (1e-3, 3e-3))
    setup = np.frombuffer(heavy.setup.to_toml().encode(), dtype=np.uint8)
    with pytest.warns(asp.AsperityWarning, match="is not as it was written"):
        other = changed(light, tmp_path, setup=setup)
    assert not other.converged and other.status == "not confirmed by its file"
    with pytest.raises(asp.NotConverged, match="not confirmed by its file"):
        other.raise_if_not_converged()
    with pytest.warns(asp.AsperityWarning, match="The heights in .* are not those of its setup"):
        changed(light, tmp_path, height=1.1 * light.height)
    history = asp.solve(ROUGH, solid=1.0, mean_pressure=2e-3, **HISTORIES["creep"])
    with pytest.warns(asp.AsperityWarning, match="is not as it was written"):
        creep = changed(history, tmp_path, stored_strain=0.9 * history.fields["stored_strain"])
    assert not creep.converged and set(creep.claims) == {"unchecked"}


def test_what_flows_comes_back(tmp_path: Path) -> None:
    surface = asp.Surface.rough((32, 32), (1.0, 1.0), hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.1, rms_gradient=0.1)
    contact = asp.solve(surface, reduced_pressure=0.05, flow={"leakage": True})
    contact.save(tmp_path / "it.npz")
    asp.load(tmp_path / "it.npz").save(tmp_path / "again.npz")
    with np.load(tmp_path / "it.npz") as own, np.load(tmp_path / "again.npz") as there:
        for name in ("flux_x", "flux_y", "fluid_pressure_x", "fluid_pressure_y"):
            assert np.array_equal(own[name], there[name], equal_nan=True), name


def test_a_height_file_that_was_edited_is_told(tmp_path: Path) -> None:
    np.save(tmp_path / "h.npy", WAVES)
    contact = asp.solve(asp.Surface.read(tmp_path / "h.npy", size=1.0), reduced_pressure=0.05)
    contact.save(tmp_path / "it.npz")
    assert asp.load(tmp_path / "it.npz").converged
    np.save(tmp_path / "h.npy", 1.01 * WAVES)
    with pytest.warns(asp.AsperityWarning, match="The heights in .* are not those of its setup"):
        assert asp.load(tmp_path / "it.npz").converged


def test_files_that_are_read_are_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "att.csv").write_text("gap,traction\n0,0.02\n0.002,0.01\n0.008,0\n")
    (tmp_path / "path.csv").write_text("load\n0.002\n0.001\n")
    before = {name: (tmp_path / name).read_bytes() for name in ("att.csv", "path.csv")}
    history = asp.solve(
        WAVES, 1.0, solid=1.0, mean_pressure=2e-3, adhesion={"table": str(tmp_path / "att.csv")}, path=str(tmp_path / "path.csv")
    )
    (tmp_path / "link.csv").hardlink_to(tmp_path / "att.csv")
    for name in ("att.csv", "path.csv", "link.csv"):
        with pytest.raises(asp.AsperityError, match="it is also an input file and would be lost"):
            history.save(tmp_path / name)
    assert all((tmp_path / name).read_bytes() == content for name, content in before.items())
    history.save(tmp_path / "own.csv")


def test_other_files_are_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "h.npy", WAVES)
    with pytest.raises(asp.AsperityError, match="is not a saved result"):
        asp.load(tmp_path / "h.npy")
    with pytest.raises(FileNotFoundError):
        asp.load(tmp_path / "nowhere.npz")
    np.savez(tmp_path / "other.npz", height=WAVES)
    with pytest.raises(asp.AsperityError, match="setup"):
        asp.load(tmp_path / "other.npz")
