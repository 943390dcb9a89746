"""Bars of progress."""

import pytest

import asperity as asp

pytest.importorskip("tqdm")
ROUGH = dict(hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)


def test_a_bar_follows_the_certificate_and_changes_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    surface = asp.Surface.rough(2048, 1.0, **ROUGH)
    plain = asp.solve(surface, reduced_pressure=0.1, solver="polonsky-keer")
    seen: list[int] = []
    shown = asp.solve(
        surface, reduced_pressure=0.1, solver="polonsky-keer", progress=True, callback=lambda step: seen.append(step.iteration)
    )
    assert shown == plain and seen[-1] == plain.work.iterations
    bar = capsys.readouterr().err.split("\r")[-1]
    assert "100%" in bar and f"step {plain.work.iterations}, eta" in bar
    stopped = asp.solve(surface, reduced_pressure=0.1, solver="polonsky-keer", progress=True, callback=lambda step: step.iteration < 3)
    assert stopped.work.iterations == 3


def test_a_bar_begins_again_with_each_solve(capsys: pytest.CaptureFixture[str]) -> None:
    surface = asp.Surface.rough(512, 1.0, **ROUGH)
    keys = dict(reduced_pressure=0.05, viscoelastic={"creep": [9.0, 1.0]}, path={"time": 1.0, "steps": 3})
    shown = asp.solve(surface, progress=True, **keys)
    bars = capsys.readouterr().err
    assert shown == asp.solve(surface, **keys) and "solve 3, step" in bars and "nan" not in bars


def test_a_bar_counts_the_rows_of_a_study(capsys: pytest.CaptureFixture[str]) -> None:
    study = dict(surface={"spectrum": ROUGH, "seed": "1-4"}, grid={"points": 1024, "size": 1.0}, load={"reduced_pressure": 0.1})
    asp.study(study, progress=True)
    assert "4/4" in capsys.readouterr().err.split("\r")[-1]
