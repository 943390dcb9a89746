"""Histories: creep in time, slip cycles, sliding, rolling and adhesion."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

ROUGH = dict(hurst=0.8, rolloff_wavelength=0.125, short_cutoff=0.01, rms_gradient=0.1)


def rough() -> asp.Surface:
    return asp.Surface.rough(2048, 1.0, seed=1, **ROUGH)


def test_a_held_load_creeps_as_the_elastic_contact_under_its_effective_pressure() -> None:
    history = asp.solve(rough(), reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 3.0})
    assert isinstance(history, asp.History) and history.process == "creep" and history.converged
    time, effective = history.numbers["time"], history.numbers["effective_pressure"]
    assert time[0] == 0.0 and time[-1] == 3.0 and len(history) == len(time)
    # under a load that never falls, the effective pressure is that of the elastic contact under P J(t)
    assert effective[-1] == pytest.approx(effective[0] * (1 + 9 * (1 - math.exp(-3))), rel=1e-9)
    elastic = asp.solve(rough(), reduced_pressure=0.02 * (1 + 9 * (1 - math.exp(-3))))
    found = history[-1].pressure + history.fields["stored_strain"][-1]
    assert np.allclose(found, elastic.pressure, atol=1e-4 * elastic.pressure.max())
    assert history.numbers["relative_area"][-1] == pytest.approx(elastic.measures["relative_area"], rel=1e-3)
    assert "pressure" in asp.History.explain("effective_pressure")
    with pytest.raises(KeyError):
        asp.History.explain("nothing")


def test_a_slip_cycle_loses_the_same_energy_each_time(tmp_path: Path) -> None:
    cylinder = asp.Surface.indenter(shape="cylinder", points=512, size=4.0, radius=1.0)
    pulls = [0.25e-3, -0.25e-3, 0.25e-3, -0.25e-3, 0.25e-3]
    history = asp.solve(
        cylinder, solid=1.0, mean_pressure=1e-3, friction={"coefficient": 0.5}, path={"tangential": pulls}, record=tmp_path / "cycle.rrd"
    )
    assert history.process == "slip" and history.energy_per_cycle.shape == (2,)
    assert history.energy_per_cycle[0] == pytest.approx(history.energy_per_cycle[1], rel=1e-6)
    assert np.allclose(history.fields["traction"].mean(axis=1), pulls, rtol=1e-6)
    assert (tmp_path / "cycle.rrd").stat().st_size > 10_000
    history.save(tmp_path / "cycle.npz")
    with np.load(tmp_path / "cycle.npz") as saved:
        assert saved["traction"].shape == (5, 512) and saved["shift"].shape == (5,)
    frame = history.to_pandas() if _has("pandas") else None
    assert frame is None or list(frame["mean_traction"]) == pytest.approx(pulls)


def _has(module: str) -> bool:
    import importlib.util

    return importlib.util.find_spec(module) is not None


def test_one_speed_is_a_contact_and_several_are_a_history() -> None:
    rubber = dict(viscoelastic={"creep": [9.0, 1.0]}, reduced_pressure=0.05)
    one = asp.solve(rough(), sliding={"speed": 0.01}, **rubber)
    several = asp.solve(rough(), sliding={"speed": [0.001, 0.01, 1.0]}, **rubber)
    assert isinstance(one, asp.Contact) and isinstance(several, asp.History)
    assert several.numbers["friction"][1] == pytest.approx(one.measures["friction"], rel=1e-5)
    assert several.numbers["friction"][1] > several.numbers["friction"][[0, 2]].max()
    assert "bounded" in several.claim


def test_rolling_finds_the_force_of_a_creepage_and_back() -> None:
    cylinder = asp.Surface.indenter(shape="cylinder", points=256, size=0.5, radius=1.0, boundary="free")
    rolls = dict(solid=1.0, force=0.01, friction={"coefficient": 0.3})
    there = asp.solve(cylinder, rolling={"tangential": [0.001, 0.002]}, **rolls)
    back = asp.solve(cylinder, rolling={"creepage": list(there.numbers["creepage"])}, **rolls)
    assert np.allclose(back.numbers["friction"], [0.1, 0.2], rtol=1e-4)


def test_python_and_the_command_line_find_the_same_history(tmp_path: Path) -> None:
    setup = asp.Setup(
        surface={"spectrum": {"hurst": 0.8, "rolloff-wavelength": 0.125, "short-cutoff": 0.01, "rms-gradient": 0.1}, "seed": 1},
        grid={"points": 1024, "size": 1.0},
        load={"reduced-pressure": 0.02},
        viscoelastic={"relaxation": [0.9, 1.0]},
        path={"time": [0.0, 1.0, 2.0], "load": [0.02, 0.05, 0.0], "steps": 4},
    )
    setup.write(tmp_path / "scene.toml")
    history = setup.solve()
    assert isinstance(history, asp.History)
    printed = subprocess.run(
        [sys.executable, "-m", "asperity", "solve", str(tmp_path / "scene.toml"), "--json"], capture_output=True, check=True
    ).stdout
    states = json.loads(printed)["states"]
    assert len(states) == len(history)
    for name in ("time", "mean_pressure", "relative_area", "dissipated"):
        assert [state[name] for state in states] == list(history.numbers[name])


def test_what_cannot_be_is_refused_in_words_of_python() -> None:
    with pytest.raises(asp.AsperityError, match="creep without times of a path cannot be solved"):
        asp.solve(rough(), reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]})
    with pytest.raises(asp.AsperityError, match="creep and several loads outside a path cannot be combined"):
        asp.solve(rough(), reduced_pressure=[0.01, 0.02], viscoelastic={"creep": [9.0, 1.0]}, path={"time": 1.0})
    with pytest.raises(asp.AsperityError, match="leave it out of a history"):
        asp.solve(rough(), reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 1.0}, diagnose=True)


@pytest.mark.parametrize(
    ("keys", "solver", "sentence"),
    [
        ({"viscoelastic": {"creep": [9.0, 1.0]}, "path": {"time": 1.0}}, "gfmd", "gfmd cannot solve histories"),
        ({"viscoelastic": {"creep": [9.0, 1.0]}, "sliding": {"speed": 1.0}}, "polonsky-keer", "sliding and a solver other than multilevel cannot be combined"),
        ({"viscoelastic": {"creep": [9.0, 1.0]}, "sliding": {"speed": 1.0}}, "gfmd", "sliding and a solver other than multilevel cannot be combined"),
        ({"friction": {"coefficient": 0.3}, "rolling": {"creepage": 1e-4}}, "gfmd", "rolling and a solver other than multilevel cannot be combined"),
        ({"friction": {"coefficient": 0.3}, "path": {"tangential": [0.001, 0.0]}}, "gfmd", "gfmd cannot solve histories"),
        ({"adhesion": {"work": 0.01, "range": 0.1}}, "gfmd", "give gfmd as the method of the adhesion"),
        ({"adhesion": {"work": 0.01, "range": 0.1}}, "polonsky-keer", "adhesion and a solver other than multilevel cannot be combined"),
    ],
)
def test_a_solver_that_a_process_does_not_have_is_refused(keys: dict[str, dict[str, object]], solver: str, sentence: str) -> None:
    with pytest.raises(asp.AsperityError, match=sentence):
        asp.solve(rough(), solid=1.0, reduced_pressure=0.02, solver=solver, **keys)


def test_contacts_have_the_numbers_of_their_states(tmp_path: Path) -> None:
    creep = asp.solve(rough(), reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 3.0, "steps": 4})
    sticky = asp.solve(sine(), mean_gap="1 um", path={"load": ["1.2 um", "0.8 um"], "steps": 4}, **STICKY)
    pulled = asp.solve(rough(), solid=1.0, mean_pressure=2e-3, friction={"coefficient": 0.5}, path={"tangential": [5e-4, 0.0]})
    for history in (creep, sticky, pulled):
        assert isinstance(history, asp.History)
        for name, values in history.numbers.items():
            found = [contact.measures.get(name, math.nan) for contact in history]
            assert np.array_equal(found, values, equal_nan=True), (history.process, name)
    # what holds for an elastic contact only is absent, and stays with slip
    assert "kappa" in pulled[0].measures and "kappa" not in creep[0].measures
    assert not {"kappa", "kappa_r", "certificate", "elastic_energy"} & set(sticky[0].measures) and "kappa_r" not in sticky.numbers
    unit = sticky[-1].measures["rms_gradient"] * 1e6
    assert sticky[-1].measures["reduced_pressure"] == pytest.approx(sticky.numbers["mean_pressure"][-1] / unit)
    sticky.save(tmp_path / "sticky.npz")
    with np.load(tmp_path / "sticky.npz") as archive:
        assert archive["reduced_pressure"] == pytest.approx([it.measures["reduced_pressure"] for it in sticky])
        assert not {"kappa", "kappa_r", "elastic_energy", "reduced_pressure_contact"} & set(archive)
    assert sticky[-1].mean_pressure == sticky.numbers["mean_pressure"][-1] != sticky[-1].pressure.mean()
    assert math.isnan(creep[-1].elastic_energy) and "a state of creep" in repr(creep[-1])
    with pytest.raises(asp.AsperityError, match="without adhesion"):
        sticky[0].stiffness()
    with pytest.raises(asp.AsperityError, match="a state of creep"):
        creep[0].conductance(1.0)


def test_a_path_may_be_a_file(tmp_path: Path) -> None:
    (tmp_path / "press.csv").write_text("time,load\n0,0.01\n1,0.02\n")
    given = dict(reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]})
    of_file = asp.solve(rough(), path=tmp_path / "press.csv", **given)
    same = asp.solve(rough(), path={"time": [0.0, 1.0], "load": [0.01, 0.02]}, **given)
    assert isinstance(of_file, asp.History) and np.array_equal(of_file[-1].pressure, same[-1].pressure)


def test_a_history_is_written_as_the_table_of_the_command_line(tmp_path: Path) -> None:
    history = asp.solve(sine(), mean_gap="1 um", path={"load": ["1.2 um", "0.8 um"], "steps": 4}, **STICKY)
    history.save(tmp_path / "own.csv")
    history.setup.write(tmp_path / "scene.toml")
    words = ["solve", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "there.csv")]
    subprocess.run([sys.executable, "-m", "asperity", *words], check=True, capture_output=True)
    assert (tmp_path / "own.csv").read_text() == (tmp_path / "there.csv").read_text()


def test_a_callback_ends_a_history() -> None:
    seen = []

    def stop(step: asp.Step) -> bool:
        seen.append(step)
        return len(seen) < 200

    history = asp.solve(rough(), reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 10.0}, callback=stop)
    assert 0 < len(history) < 10 and len(seen) == 200


def sine() -> asp.Surface:
    return asp.Surface.indenter(shape="sine", points=512, size="20 um", amplitude="1 um")


STICKY = dict(solid="1 MPa", adhesion={"work": "10 mJ/m^2", "range": "80 nm"})


def test_a_sticky_sine_jumps_in_and_out(tmp_path: Path) -> None:
    history = asp.solve(sine(), mean_gap="1 um", path={"load": ["1.6 um", "0.4 um", "1.6 um"], "steps": 8}, **STICKY)
    assert isinstance(history, asp.History) and history.process == "adhesion" and history.converged
    assert set(history.claims) <= {"stable", "marginal"} and len(history.claims) == len(history)
    adhesion = history.adhesion
    assert adhesion is not None and not adhesion["separated"]
    assert (adhesion["work"], adhesion["range"]) == (0.01, 80e-9)
    into, out = adhesion["jumps"]
    assert into["mean_gap"][0] < out["mean_gap"][0] and into["energy"] > 0 and out["energy"] > 0
    assert adhesion["lost_in_jumps"] == pytest.approx(into["energy"] + out["energy"])
    assert 0 < adhesion["lost_error"] < 0.05 * adhesion["lost_in_jumps"]
    # the path is closed, so what the load did is what the jumps lost
    assert history.numbers["work_done"][-1] == pytest.approx(adhesion["lost_in_jumps"], rel=1e-3)
    pressure = history.numbers["mean_pressure"]
    # the lowest one may lie between two states that are shown
    assert 1.2 * pressure.min() < adhesion["lowest_pressure"] <= pressure.min()
    # the mean pressure is that of the contact less the attraction
    attraction = history.fields["attraction"]
    assert attraction.shape == (len(history), 512)
    touching = np.array([contact.pressure.mean() for contact in history])
    assert np.allclose(touching - attraction.mean(axis=1), pressure, atol=1e-6 * attraction.max())
    assert "equilibrium" in asp.History.explain("residual")
    history.save(tmp_path / "loop.npz")
    with np.load(tmp_path / "loop.npz") as saved:
        assert np.array_equal(saved["attraction"], attraction)


def test_a_pull_parts_the_surfaces() -> None:
    history = asp.solve(sine(), mean_pressure=0.0, path={"load": ["0 Pa", "-20 kPa"], "steps": 8}, **STICKY)
    assert history.claims[0] == "stable" and history.claims[-1] == "separated"
    assert history.adhesion is not None and history.adhesion["separated"]
    # Johnson's sine, whose range is zero
    assert history.adhesion["lowest_pressure"] == pytest.approx(-8.7e3, rel=0.05)


def test_adhesion_has_one_load_too_and_a_table(tmp_path: Path) -> None:
    table = tmp_path / "attraction.csv"
    table.write_text("gap, traction\n0 nm, 125 kPa\n160 nm, 0 kPa\n")
    problem = asp.Problem(sine(), solid="1 MPa", adhesion={"table": str(table)}, mean_pressure="-1 kPa")
    history = problem.solve()
    assert isinstance(history, asp.History) and len(history) == 1
    assert history.adhesion is not None and history.adhesion["work"] == pytest.approx(0.01)
    other = problem.with_load(mean_pressure="-2 kPa").solve()
    assert isinstance(other, asp.History) and other.numbers["mean_pressure"][0] == -2e3
    assert asp.solve(rough(), reduced_pressure=0.02, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 1.0, "steps": 1}).adhesion is None


def test_adhesion_that_cannot_be_is_refused() -> None:
    with pytest.raises(asp.AsperityError, match="needs the range"):
        asp.solve(sine(), solid="1 MPa", mean_gap="1 um", adhesion={"work": 0.01})
    with pytest.raises(asp.AsperityError, match="adhesion and friction cannot be combined"):
        asp.solve(sine(), mean_gap="1 um", friction={"coefficient": 0.3, "tangential": 0.0}, **STICKY)
    with pytest.raises(asp.AsperityError, match="form"):
        asp.solve(sine(), solid="1 MPa", mean_gap="1 um", adhesion={"work": 0.01, "range": "80 nm", "form": "linear"})
