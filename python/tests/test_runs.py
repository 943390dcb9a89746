"""Callbacks, Ctrl-C, and the lock of the interpreter."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import asperity as asp

KEYS = dict(hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)


def problem() -> asp.Problem:
    return asp.Problem(asp.Surface.rough(512, 1.0, **KEYS), reduced_pressure=0.1)


def test_a_callback_sees_every_step_and_its_fields() -> None:
    seen: list[tuple[int, float, float, float]] = []

    def look(step: asp.Step) -> None:
        assert step.pressure.shape == step.gap.shape == step.displacement.shape == (512,)
        assert step.measures["kappa_r"] == step.kappa_r
        seen.append((step.iteration, step.error, step.kappa_r, step.pressure.mean()))

    contact = problem().solve(solver="polonsky-keer", callback=look)
    assert [step for step, *_ in seen] == list(range(contact.work.iterations + 1))
    assert seen[-1][1] <= 1e-8 < seen[0][1]
    assert seen[-1][2] == pytest.approx(contact.measures["kappa_r"])
    assert all(mean == pytest.approx(contact.mean_pressure) for *_, mean in seen)


def test_steps_of_coarser_grids_have_fewer_nodes() -> None:
    sizes: set[tuple[int, int]] = set()
    problem().solve(callback=lambda step: sizes.add((step.level, step.pressure.size)))
    assert (0, 512) in sizes and (1, 256) in sizes


def test_a_watched_run_is_the_same_to_the_last_bit() -> None:
    plain, watched = problem().solve(), problem().solve(callback=lambda step: None)
    assert np.array_equal(plain.pressure, watched.pressure)


def test_a_callback_that_returns_false_ends_the_run() -> None:
    contact = problem().solve(solver="polonsky-keer", callback=lambda step: step.iteration < 5)
    assert contact.work.iterations == 5 and not contact.converged
    assert contact.status == "stopped by the observer"


@pytest.mark.parametrize("solver", ["multilevel", "polonsky-keer", "gfmd"])
def test_a_run_can_end_at_an_error_on_the_finest_grid(solver: str) -> None:
    contact = problem().solve(solver=solver, callback=lambda step: step.error > 1e-4)
    assert contact.status == "stopped by the observer" and 1e-8 < contact.certificate.eta <= 1e-4
    levels: dict[int, list[float]] = {}
    problem().solve(solver=solver, callback=lambda step: levels.setdefault(step.level, []).append(step.error))
    assert np.isfinite(levels.pop(0)).all() and all(np.isinf(errors).all() for errors in levels.values())


def test_what_a_callback_raises_comes_out() -> None:
    def fail(step: asp.Step) -> None:
        if step.iteration == 3:
            raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        problem().solve(solver="polonsky-keer", callback=fail)


def test_a_step_that_is_over_says_so() -> None:
    kept: list[asp.Step] = []
    problem().solve(solver="polonsky-keer", callback=kept.append)
    assert kept[0].iteration == 0 and kept[0].error > 0
    with pytest.raises(asp.AsperityError, match="over"):
        kept[0].pressure


def test_a_callback_may_solve_another_contact() -> None:
    inner = []
    problem().solve(solver="polonsky-keer", callback=lambda step: inner.append(problem().solve().converged) or step.iteration < 2)
    assert inner == [True, True, True]


def test_other_threads_run_on_while_one_solves() -> None:
    surface = asp.Surface.rough((256, 256), 1.0, **(KEYS | {"short_cutoff": 0.03}))
    pressed = asp.Problem(surface, reduced_pressure=0.1)
    done, beats = threading.Event(), []

    def beat() -> None:
        while not done.is_set():
            beats.append(time.perf_counter())
            time.sleep(0.001)

    other = threading.Thread(target=beat)
    other.start()
    began = time.perf_counter()
    pressed.solve(solver="polonsky-keer", tolerance=1e-10)
    ended = time.perf_counter()
    done.set()
    other.join()
    during = [at for at in beats if began < at < ended]
    # while the lock is held there is not a single beat
    assert len(during) > 10


def test_ctrl_c_ends_a_solve() -> None:
    code = """
import asperity as asp, sys
surface = asp.Surface.rough((256, 256), 1.0, hurst=0.8, rolloff_wavelength=0.5, short_cutoff=0.02, rms_gradient=0.1)
print("solving", flush=True)
try:
    asp.solve(surface, reduced_pressure=0.05, solver={"method": "gfmd", "damping": 1000.0}, tolerance=1e-30, max_iterations=10**9)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(7)
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None and run.stdout.readline() == "solving\n"
        time.sleep(0.5)
        run.send_signal(signal.SIGINT)
        out, _ = run.communicate(timeout=60)
    assert (run.returncode, out) == (7, "interrupted\n")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_a_forked_process_says_that_it_cannot_solve_and_a_spawned_one_solves(tmp_path: Path) -> None:
    code = """
import asperity as asp, multiprocessing, sys
def solve(seed):
    surface = asp.Surface.rough(512, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1, seed=seed)
    return asp.solve(surface, reduced_pressure=0.1).mean_gap
if __name__ == "__main__":
    here = solve(1)
    try:
        with multiprocessing.get_context(sys.argv[1]).Pool(1) as pool:
            print(pool.map(solve, [1]) == [here])
    except asp.AsperityError as refusal:
        print(refusal)
"""
    script = tmp_path / "workers.py"
    script.write_text(code)
    said = [
        subprocess.run([sys.executable, script, way], capture_output=True, text=True, timeout=60).stdout
        for way in ("fork", "spawn")
    ]
    assert "start workers by spawn" in said[0] and said[1] == "True\n"


def test_a_run_can_be_diagnosed() -> None:
    surface = asp.Surface.indenter("sine", 256, 1.0, amplitude=0.01)
    contact = asp.solve(surface, reduced_pressure=0.1, solver={"method": "gfmd", "damping": 50.0}, diagnose=True)
    assert contact.diagnosis is not None and "damping" in contact.diagnosis
    assert asp.solve(surface, reduced_pressure=0.1).diagnosis is None
