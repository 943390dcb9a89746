"""Lists of loads, which are solved one after the other."""

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

SURFACE = asp.Surface.rough(2048, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)
LOADS = [0.01, 0.05, 0.2]


def test_a_list_of_loads_is_the_curve_of_the_command_line(tmp_path: Path) -> None:
    curve = asp.solve(SURFACE, reduced_pressure=LOADS)
    assert len(curve) == 3 and list(curve.loads) == LOADS and curve.converged
    assert curve.totals["states"] == 3 and curve.totals["largest_area"] == curve.measures["relative_area"].max()
    assert [contact.measures["reduced_pressure"] for contact in curve] == pytest.approx(LOADS)
    curve.setup.write(tmp_path / "scene.toml")
    command = [sys.executable, "-m", "asperity", "solve", "scene.toml", "--out", "curve.npz"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    curve.save(tmp_path / "own.npz")
    with np.load(tmp_path / "curve.npz") as there, np.load(tmp_path / "own.npz") as own:
        assert set(own) == set(there)
        for name in ("pressure", "gap", "kappa_r", "mean_gap"):
            assert np.array_equal(own[name], there[name]), name
        assert np.array_equal(curve.measures["mean_gap"], there["mean_gap"])
        assert np.array_equal(curve[2].pressure, there["pressure"][2])
    again = asp.Setup.read(tmp_path / "scene.toml").solve()
    assert isinstance(again, asp.History) and again == curve


def test_lists_may_be_tuples_arrays_and_texts_with_units() -> None:
    expected = [contact.mean_gap for contact in asp.solve(SURFACE, reduced_pressure=LOADS)]
    for loads in (tuple(LOADS), np.array(LOADS), [np.float32(0.01), 0.05, 0.2]):
        found = [contact.mean_gap for contact in asp.solve(SURFACE, reduced_pressure=loads)]
        assert found == pytest.approx(expected, rel=1e-6)
    curve = asp.solve(SURFACE, solid="1 GPa", mean_pressure=["1 MPa", "2 MPa"])
    assert list(curve.loads) == [1e6, 2e6] and curve[1].mean_pressure == pytest.approx(2e6)
    array = asp.Surface(SURFACE.height, 1.0)
    assert [contact.mean_gap for contact in asp.solve(array, reduced_pressure=LOADS)] == pytest.approx(expected)
    assert asp.solve(SURFACE, reduced_pressure=0.05).problem.with_load(reduced_pressure=LOADS).solve()[2].mean_gap == expected[2]


def test_what_has_yielded_stays_on_the_way_back() -> None:
    cylinder = asp.Surface.indenter("cylinder", 1024, 4.0, radius=1.0)
    curve = asp.solve(cylinder, solid=1.0, law={"hardness": 0.05}, mean_pressure=[0.001, 0.004, 0.001])
    assert curve[1].pressure.max() == pytest.approx(0.05)
    assert curve[2].measures["relative_area"] > curve[0].measures["relative_area"]
    assert curve[2].mean_gap < curve[0].mean_gap
    with pytest.raises(asp.AsperityError, match="yielded"):
        pickle.dumps(curve[2])


def test_a_curve_is_a_sequence_a_table_and_a_pickle() -> None:
    curve = asp.solve(SURFACE, reduced_pressure=LOADS)
    assert curve[-1] == curve[2] and list(curve)[0] == curve[0] and len(curve[:2]) == 2
    with pytest.raises(IndexError):
        curve[3]
    again = pickle.loads(pickle.dumps(curve))
    assert again == curve and np.array_equal(again[1].gap, curve[1].gap)
    assert repr(curve) == "History(loads, 3 states)"
    pytest.importorskip("pandas")
    assert list(curve.to_pandas()["kappa_r"]) == list(curve.measures["kappa_r"])


def test_a_callback_sees_all_loads_and_may_end_the_curve() -> None:
    seen: list[float] = []
    asp.solve(SURFACE, reduced_pressure=LOADS, callback=lambda step: seen.append(step.pressure.mean()))
    assert {round(load / LOADS[-1], 3) for load in LOADS} <= {round(mean / seen[-1], 3) for mean in seen}
    first = asp.solve(SURFACE, reduced_pressure=LOADS, solver="polonsky-keer")[0].work.iterations
    count: list[int] = []
    curve = asp.solve(
        SURFACE, reduced_pressure=LOADS, solver="polonsky-keer", callback=lambda step: count.append(1) or len(count) < first + 5
    )
    assert len(curve) == 2 and curve[0].converged and curve[1].status == "stopped by the observer"


def test_rows_that_do_not_converge_give_one_warning() -> None:
    with pytest.warns(asp.AsperityWarning, match="did not converge under 3 of 3 loads"):
        curve = asp.solve(SURFACE, reduced_pressure=LOADS, solver="polonsky-keer", max_iterations=1)
    assert not curve.converged


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"reduced_pressure": []}, "the list is empty"),
        ({"reduced_pressure": [0.1, -0.1]}, "-0.1"),
        ({"reduced_pressure": LOADS, "diagnose": True}, "diagnose needs one load"),
        ({"reduced_pressure": LOADS, "stream": len}, "live and stream show one load"),
        ({"reduced_pressure": LOADS, "record": "steps.rrd", "recording": {"what": ["waterfall"]}}, "the recording part waterfall"),
        ({"reduced_pressure": LOADS, "start": np.ones(2048)}, "start needs one load"),
        ({"reduced_pressure": LOADS, "refine": "auto"}, "refine='auto' needs one load"),
    ],
)
def test_lists_that_cannot_be_are_refused(keys: dict[str, object], sentence: str) -> None:
    with pytest.raises(asp.AsperityError, match=sentence):
        asp.solve(SURFACE, **keys)


def test_a_curve_is_recorded_and_written_as_a_table(tmp_path: Path) -> None:
    curve = asp.solve(SURFACE, reduced_pressure=LOADS, record=tmp_path / "curve.rrd")
    assert (tmp_path / "curve.rrd").stat().st_size > 50_000
    curve.save(tmp_path / "curve.csv")
    scene = curve.setup
    scene.write(tmp_path / "scene.toml")
    words = ["solve", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "same.csv")]
    subprocess.run([sys.executable, "-m", "asperity", *words], check=True, capture_output=True)
    assert (tmp_path / "curve.csv").read_text() == (tmp_path / "same.csv").read_text()
    with pytest.raises(asp.AsperityError, match="give a name that ends in .npz or .csv"):
        curve.save(tmp_path / "curve.txt")


def test_results_of_several_loads_are_neither_certified_nor_recorded() -> None:
    problem = asp.Problem(SURFACE, reduced_pressure=LOADS)
    with pytest.raises(asp.AsperityError, match="one load"):
        problem.certify(pressure=np.ones(2048))
    with pytest.raises(asp.AsperityError, match="one load"):
        asp.Recorder(problem)
