"""Studies: the same tables here, on executors and on workers of Dask, also where these die."""

import multiprocessing
import os
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any, Iterator

import numpy as np
import pytest

import asperity as asp

SPECTRUM = {"hurst": [0.3, 0.8], "rolloff_wavelength": 0.125, "short_cutoff": 0.02, "rms_gradient": 0.1}
STUDY = asp.Study(
    surface={"spectrum": SPECTRUM, "seed": "1-10"},
    grid={"points": [[256], [1024]], "size": 1.0},
    load={"reduced_pressure": [0.01, 0.1]},
)
LONG = asp.Study(
    surface={"spectrum": SPECTRUM, "seed": "1-60"},
    grid={"points": 16384, "size": 1.0},
    load={"reduced_pressure": [0.01, 0.1]},
)


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The table of the command line, on one thread."""
    folder = tmp_path_factory.mktemp("alone")
    (folder / "study.toml").write_text(STUDY.to_toml())
    command = [sys.executable, "-m", "asperity", "study", "study.toml", "--threads", "1", "--quiet"]
    subprocess.run(command, cwd=folder, check=True)
    return folder / "study.csv"


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            yield client


def same(out: Path, alone: Path) -> bool:
    return out.read_bytes() == alone.read_bytes() and (
        out.with_suffix(".parquet").read_bytes() == alone.with_suffix(".parquet").read_bytes()
    )


def test_a_study_has_rows_and_setups_and_says_what_they_take() -> None:
    assert (STUDY.rows, STUDY.realisations) == (80, 40)
    setup = STUDY.setup(79)
    assert setup.to_dict()["surface"]["seed"] == 10 and setup.to_dict()["load"] == {"reduced-pressure": 0.1}
    expenses = STUDY.expenses()
    assert [it["values"] for it in expenses] == [
        f"hurst {hurst}, points {points}" for hurst in (0.3, 0.8) for points in (256, 1024)
    ]
    assert all(it["realisations"] == 10 and it["bytes"] > 256 * 8 for it in expenses)
    assert expenses[1]["seconds"] > expenses[0]["seconds"] > 0


def test_here_and_on_the_command_line_tables_are_the_same(alone: Path, tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    table = asp.study(STUDY, out=tmp_path / "study.csv", workers=2, progress=lambda known, rows: seen.append((known, rows)))
    assert same(tmp_path / "study.csv", alone)
    assert seen[-1] == (80, 80) and [known for known, _ in seen] == sorted(known for known, _ in seen)
    assert (tmp_path / "study.svg").exists() and (tmp_path / "study.png").exists()
    # once more it is only read, and in memory it is the same
    asp.study(STUDY, out=tmp_path / "study.csv", progress=lambda known, rows: pytest.fail("it solved again"))
    again = asp.study(asp.Study.from_toml(STUDY.to_toml()), threads=2)
    assert all(np.array_equal(again[name], table[name]) for name in ("kappa_r", "relative_area", "mean_gap", "scene"))


@pytest.mark.parametrize("pool", [lambda: ThreadPoolExecutor(3), lambda: ProcessPoolExecutor(2, multiprocessing.get_context("spawn"))])
def test_any_executor_makes_the_same_table(pool: Any, alone: Path, tmp_path: Path) -> None:
    with pool() as executor:
        asp.study(STUDY, out=tmp_path / "study.csv", client=executor)
    assert same(tmp_path / "study.csv", alone)


def test_workers_of_dask_make_the_same_table(client: Any, alone: Path, tmp_path: Path) -> None:
    asp.study(STUDY, out=tmp_path / "study.csv", client=client)
    assert same(tmp_path / "study.csv", alone)


def test_a_worker_that_dies_is_survived(client: Any, tmp_path: Path) -> None:
    killed: list[int] = []

    def kill(known: int, rows: int) -> None:
        if not killed and known >= 20:
            first = client.run(os.getpid)
            killed.append(next(iter(first.values())))
            os.kill(killed[0], signal.SIGKILL)

    table = asp.study(LONG, client=client, progress=kill)
    assert killed and killed[0] not in client.run(os.getpid).values()
    here = asp.study(LONG, out=tmp_path / "here.csv")
    assert list(table) == list(here) and len(table) == len(here) == 240
    for name in table:
        if table[name].dtype == object:
            assert list(table[name]) == list(here[name]), name
        else:
            assert table[name].tobytes() == here[name].tobytes(), name


def test_a_study_that_was_ended_goes_on_where_it_was(tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text(LONG.to_toml())
    code = "import asperity as asp; print('begun', flush=True); asp.study('study.toml', out='study.csv')"
    with subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path, stderr=subprocess.PIPE, text=True) as run:
        unfinished, until = tmp_path / "study.unfinished", time.monotonic() + 60
        while not (unfinished.exists() and unfinished.read_text().count("\n") >= 20):
            assert time.monotonic() < until and run.poll() is None
            time.sleep(0.005)
        run.send_signal(signal.SIGINT)
        began = time.monotonic()
        _, said = run.communicate(timeout=60)
    assert run.returncode != 0 and re.search(r"KeyboardInterrupt: \d+ of 240 rows were solved, and they are in study.unfinished: call study\(\)", said)
    assert not (tmp_path / "study.csv").exists() and time.monotonic() - began < 30
    known = asp.Ledger(asp.Study.read(tmp_path / "study.toml"), tmp_path / "study.csv").completed
    assert 20 <= known < 240
    first: list[int] = []
    asp.study(tmp_path / "study.toml", out=tmp_path / "study.csv", progress=lambda known, rows: first.append(known))
    assert first[0] > known
    asp.study(LONG, out=tmp_path / "whole.csv")
    assert same(tmp_path / "study.csv", tmp_path / "whole.csv")


def test_a_table_speaks_numpy_pandas_and_arrow(alone: Path) -> None:
    table = asp.study(STUDY)
    assert len(table) == 80 and list(dict(table)) == table.columns
    assert table["row"].dtype == np.int64 and table["kappa_r"].dtype == np.float64
    assert set(table["surface.seed"]) == set(range(1, 11)) and set(table["load.reduced-pressure"]) == {0.01, 0.1}
    setup = asp.Setup.from_toml(table["scene"][5])
    assert setup.solve().measures["kappa_r"] == pytest.approx(table["kappa_r"][5], rel=1e-7)
    with pytest.raises(KeyError, match="there is no column .kapa.: did you mean .kappa."):
        table["kapa"]
    with pytest.raises(KeyError, match="there is no column .zzz.: give one of row, "):
        table["zzz"]
    assert asp.Setup.from_toml(table["scene"][5]) == STUDY.setup(5) and table["row"][5] == 6
    pyarrow, pandas = pytest.importorskip("pyarrow"), pytest.importorskip("pandas")
    arrow, frame, read = pyarrow.table(table), table.to_pandas(), pandas.read_parquet(alone.with_suffix(".parquet"))
    assert arrow.num_rows == 80 and arrow.column_names == table.columns == list(frame.columns) == list(read.columns)
    for name in ("row", "kappa_r", "relative_area", "surface.spectrum.hurst"):
        assert np.array_equal(arrow[name].to_numpy(), table[name], equal_nan=True)
        assert np.array_equal(frame[name], table[name], equal_nan=True) and np.array_equal(read[name], table[name], equal_nan=True)
    assert list(arrow["scene"].to_pylist()) == list(table["scene"]) == list(frame["scene"])


def test_numbers_that_are_not_there_are_not_zero() -> None:
    sine = {"indenter": {"shape": "sine", "amplitude": 0.01}}
    table = asp.study(dict(surface=sine, grid={"points": 256, "size": 1.0}, load={"reduced_pressure": [0.1, 0.2]}))
    assert np.isnan(table["hurst"]).all() and np.isnan(table["seed"]).all()
    pyarrow = pytest.importorskip("pyarrow")
    assert pyarrow.table(table)["seed"].null_count == 2


def test_a_height_file_is_found_beside_its_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    np.save(tmp_path / "profile.npy", np.cos(2 * np.pi * np.arange(256) / 256))
    (tmp_path / "study.toml").write_text(
        "surface = { height = 'profile.npy' }\ngrid.size = 1.0\nsolid = { contact-modulus = 1.0 }\nload = { mean-pressure = [0.1, 0.2] }\n"
    )
    study = asp.Study.read(tmp_path / "study.toml")
    monkeypatch.chdir(tmp_path.parent)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as executor:
        table = asp.study(study, client=executor)
    assert list(table["mean_pressure"]) == pytest.approx([0.1, 0.2])


def test_what_cannot_be_solved_is_refused_before_anything_is(tmp_path: Path) -> None:
    for keywords, sentence in (
        ({"workers": 0}, "workers is 0: give at least 1"),
        ({"threads": -1}, "threads is -1: give at least 1"),
        ({"memory": 1e3}, "a realisation needs .* GB, but only 1e-06 GB may be used: allow more"),
        ({"client": 3}, "client is 3: give a client of dask.distributed"),
        ({"out": tmp_path / "table.txt"}, "table.txt"),
    ):
        with pytest.raises(asp.AsperityError, match=sentence):
            asp.study(STUDY, **keywords)  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())
    with pytest.raises(asp.AsperityError, match="line 1, surface.seed: `9-3` is not a range"):
        asp.Study.from_toml("surface = { spectrum = { hurst = 0.5, rolloff-wavelength = 1, rms-gradient = 1 }, seed = '9-3' }\ngrid = { points = 64, size = 1 }")
    with pytest.raises(IndexError, match="there is no row 80: give one from 0 to 79"):
        STUDY.setup(80)
    with pytest.raises(IndexError, match="there is no realisation 40: give one from 0 to 39"):
        STUDY.solve([40])
    ledger = asp.Ledger(STUDY)
    with pytest.raises(asp.AsperityError, match="points of .* were returned for hurst 0.3, points 256, seed 1"):
        ledger.add([0], STUDY.solve([1]))
    with pytest.raises(asp.AsperityError, match="80 of 80 rows"):
        ledger.finish()
    cancel = asp.CancelToken()
    cancel.cancel()
    with pytest.raises(asp.AsperityError, match="cancelled"):
        STUDY.solve([0], cancel=cancel)


def test_batches_are_packed_by_memory_and_the_largest_come_first() -> None:
    from asperity import studies

    class Batch:
        def __init__(self, bytes: float) -> None:
            self.bytes = bytes

    waiting: list[Any] = [Batch(it) for it in (6.0, 5.0, 4.0, 1.0)]
    places = [studies._Place(ThreadPoolExecutor(1), 3, 10.0), studies._Place(ThreadPoolExecutor(1), 1, 3.0)]
    assigned = [(places.index(place), batch.bytes) for place, batch in studies._assign(waiting, places)]
    assert assigned == [(0, 6.0), (0, 4.0), (1, 1.0)] and [batch.bytes for batch in waiting] == [5.0]
    assert [place.free for place in places] == [0.0, 2.0]


def test_rows_that_did_not_converge_are_told() -> None:
    hasty = dict(surface={"spectrum": SPECTRUM, "seed": 1}, grid={"points": 256, "size": 1.0}, load={"reduced_pressure": 0.1})
    with pytest.warns(asp.AsperityWarning, match="2 of 2 rows did not converge. See their status"):
        table = asp.study(hasty | {"solver": {"method": "polonsky-keer"}, "stop": {"max_iterations": 2}})
    assert "converged" not in table["status"]


def test_a_study_with_adhesion_has_the_pull_off_of_each_history() -> None:
    sections: dict[str, Any] = dict(
        surface={"indenter": {"shape": "sine", "amplitude": "1 um"}},
        grid={"points": 512, "size": "20 um"},
        solid={"contact_modulus": "1 MPa"},
        load={"mean_pressure": "0 Pa"},
        path={"load": ["0 Pa", "-20 kPa"], "steps": 5},
    )
    works = ["5 mJ/m^2", "10 mJ/m^2"]
    table = asp.study(asp.Study(adhesion={"work": works, "range": "80 nm"}, **sections))
    assert table["separated"].tolist() == ["true", "true"] and table["stable"].tolist() == ["true", "true"]
    alone = [asp.Setup(adhesion={"work": work, "range": "80 nm"}, **sections).solve() for work in works]
    assert table["lowest_pressure"].tolist() == [history.adhesion["lowest_pressure"] for history in alone]
    assert table["lowest_pressure"][1] < table["lowest_pressure"][0] < 0
    assert "relative_area" not in table.columns


def test_rows_on_a_grid_that_is_too_coarse_give_one_warning() -> None:
    coarse = {
        "surface": {"spectrum": {"hurst": 0.8, "rolloff_wavelength": 0.25, "short_cutoff": 0.05, "rms_gradient": 0.1}, "seed": "1-3"},
        "grid": {"points": [48, 48], "size": 1.0},
        "load": {"reduced_pressure": [0.001, 0.01]},
    }
    with pytest.warns(asp.AsperityWarning, match=r"too coarse for \d of 6 rows") as warned:
        asp.study(coarse)
    assert sum("too coarse" in str(it.message) for it in warned) == 1
    assert all(it.filename == __file__ for it in warned)


@pytest.mark.parametrize(("out", "words"), [("study.csv", "they are in study.unfinished"), (None, r"they are lost: give a file \(out\)")])
def test_an_interruption_says_where_the_rows_are(out: str | None, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)

    def interrupt(known: int, rows: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt, match=rf"\d+ of 240 rows were solved, and {words}"):
        asp.study(LONG, out=out, progress=interrupt)
