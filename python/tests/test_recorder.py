"""The recorder, inside a loop that knows nothing of asperity."""

from pathlib import Path

import numpy as np
import pytest

import asperity as asp

N = 256
HEIGHT = 0.01 * np.cos(2 * np.pi * np.arange(N) / N)
MEAN = 0.01


def steps(count: int):
    """Projected gradient descent on a half-space, as anybody would write it."""
    q = 2 * np.pi * np.fft.rfftfreq(N, 1 / N)
    compliance = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0)
    pressure = np.full(N, MEAN)
    for _ in range(count):
        yield pressure
        gap = np.fft.irfft(compliance * np.fft.rfft(pressure), N) - HEIGHT
        pressure = np.maximum(pressure - 2.0 * (gap - gap.mean()), 0.0)
        pressure *= MEAN / pressure.mean()


def problem() -> asp.Problem:
    return asp.Problem(asp.Surface(HEIGHT, 1.0), solid=1.0, mean_pressure=MEAN)


def test_a_loop_is_certified_compared_and_recorded(tmp_path: Path) -> None:
    path = tmp_path / "mine.rrd"
    with asp.Recorder(problem(), path, name="descent") as recorder:
        for pressure in steps(60):
            recorder.step(pressure)
    distances = recorder.distances
    assert list(distances["step"]) == list(range(60))
    assert (np.diff(distances["seconds"]) >= 0).all() and distances["seconds"][-1] > 0
    assert distances["certificate"][-1] < 0.2 * distances["certificate"][0]
    assert distances["pressure_error"][-1] < 0.5 * distances["pressure_error"][0]
    assert recorder.contact.solver == "descent" and not recorder.contact.converged
    assert recorder.diagnosis
    assert path.read_bytes()[:3] == b"RRF" and path.stat().st_size > 10_000


def test_the_last_step_is_what_certify_says_of_it() -> None:
    *_, last = steps(60)
    with asp.Recorder(problem(), reference=False) as recorder:
        recorder.step(last, seconds=12.0)
    certification = problem().certify(pressure=last)
    assert recorder.contact.certificate.eta == pytest.approx(certification.contact.certificate.eta)
    assert recorder.contact.work.seconds == 12.0 and len(recorder.distances["step"]) == 0


def test_a_gap_will_do_as_well() -> None:
    contact = problem().solve(tolerance=1e-12)
    with asp.Recorder(problem(), quantity="gap") as recorder:
        recorder.step(contact.gap)
    assert recorder.distances["pressure_error"][0] < 1e-3


def test_what_does_not_fit_is_refused_and_the_loop_goes_on() -> None:
    with asp.Recorder(problem()) as recorder:
        with pytest.raises(asp.AsperityError, match="does not fit"):
            recorder.step(np.zeros(N // 2))
        with pytest.raises(asp.AsperityError, match="finite"):
            recorder.step(np.full(N, np.nan))
        with pytest.raises(asp.AsperityError, match="with"):
            recorder.distances
        recorder.step(np.full(N, MEAN))
    assert len(recorder.distances["step"]) == 1
    with pytest.raises(asp.AsperityError, match="not running"):
        recorder.step(np.full(N, MEAN))


def test_what_the_loop_raises_comes_out_and_the_recording_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "broken.rrd"
    with pytest.raises(ZeroDivisionError), asp.Recorder(problem(), path) as recorder:
        recorder.step(np.full(N, MEAN))
        1 / 0
    assert recorder.distances["step"].size == 1 and path.read_bytes()[:3] == b"RRF"


def test_places_where_nothing_can_be_written_are_refused(tmp_path: Path) -> None:
    with pytest.raises(asp.AsperityError, match="rrd"):
        asp.Recorder(problem(), tmp_path / "mine.txt")
    with pytest.raises(asp.AsperityError, match="nowhere"):
        with asp.Recorder(problem(), tmp_path / "nowhere" / "mine.rrd") as recorder:
            for pressure in steps(10):
                recorder.step(pressure)


def test_a_viewer_that_is_not_there_is_missed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(asp.AsperityError, match="viewer"):
        problem().solve(live=True)


def test_our_own_solvers_are_recorded_with_their_setup(tmp_path: Path) -> None:
    path = tmp_path / "ours.rrd"
    surface = asp.Surface.rough(512, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)
    contact = asp.solve(surface, reduced_pressure=0.05, record=path)
    assert asp.Setup.read(path) == contact.setup


def test_steps_are_compared_with_a_pressure_that_is_given() -> None:
    solution = problem().solve(tolerance=1e-12).pressure
    found = {}
    for name, reference in (("solved", True), ("given", solution), ("other", np.full(N, MEAN))):
        with asp.Recorder(problem(), reference=reference) as recorder:
            for pressure in steps(10):
                recorder.step(pressure)
        found[name] = recorder.distances["pressure_error"]
    assert np.allclose(found["given"], found["solved"], rtol=1e-4) and found["other"][0] < 1e-12 < found["other"][-1]
    with pytest.raises(asp.AsperityError, match="does not fit"):
        asp.Recorder(problem(), reference=np.ones(3))
