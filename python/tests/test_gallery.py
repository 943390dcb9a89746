"""The scripts of the gallery, run as a reader runs them: each prints its key numbers and draws one picture."""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Callable

import numpy as np
import pytest

FOLDER = Path(__file__).parents[1] / "gallery"
PICTURES = Path(__file__).parents[2] / "assets" / "gallery"

Numbers = Callable[[str], list[float]]
"""The numbers in the first printed line that begins with some words."""


def hertz(numbers: Numbers) -> None:
    assert numbers("contact radius")[-1] < 2e-3 and numbers("approach")[-1] < 2e-4 and numbers("largest pressure")[-1] < 2e-4


def rough_line(numbers: Numbers) -> None:
    area, persson, _ = numbers("relative area")
    assert persson < area < 2 * persson
    assert numbers("certificate")[0] < 1e-8


def measured_map(numbers: Numbers) -> None:
    (raw, raw_error, doubts), (prepared, _, _), (best, error, none) = map(numbers, ("raw", "prepared:", "prepared, refined"))
    assert doubts >= 1 and none == 0 and error < 1.0 < raw_error
    assert raw < 0.8 * best and abs(prepared / best - 1) < 0.05


def study_on_dask(numbers: Numbers) -> None:
    assert numbers("300 rows") == [300, 300]
    for hurst in ("0.3", "0.8"):
        mean, spread = numbers(f"Hurst exponent {hurst}")[-2:]
        assert 1.6 < mean < 4 and spread < 0.3 * mean


def hardness(numbers: Numbers) -> None:
    limited, elastic = numbers("largest pressure / hardness")
    assert limited == 1.0 < elastic
    share, ratio = numbers("largest load")
    assert 0 < share < 1 <= ratio
    up, down = numbers("at the third load")
    assert down > 1.5 * up


def layer(numbers: Numbers) -> None:
    for base in ("sliding", "bonded"):
        thin, thick = numbers(base)
        assert thin < 0.03 and thick < 2e-3


def partial_slip(numbers: Numbers) -> None:
    for share in (0.1, 0.5, 0.9):
        _, stick, exact, error = numbers(f"Q/(mu P) = {share}")
        assert abs(stick - exact) < 3e-3 and error < 0.02


def creep(numbers: Numbers) -> None:
    first, last, _ = numbers("relative area")
    assert last > 5 * first
    assert numbers("largest difference")[0] < 1e-6


def adhesion(numbers: Numbers) -> None:
    lowest, johnson = numbers("lowest mean pressure")
    assert abs(lowest / johnson - 1) < 0.02
    gap, energy = numbers("jump")
    assert 1.0 < gap < 1.25 and energy > 0


def leakage(numbers: Numbers) -> None:
    assert 0.3 < numbers("seals")[1] < 0.55
    light, last = numbers("as between plates")
    assert light > 10 * last
    assert numbers("largest ratio")[0] < 1 and numbers("largest distance")[0] < 1e-3


def certify_another_code(numbers: Numbers) -> None:
    assert numbers("as it is")[0] < 1e-8 and numbers("largest difference")[0] < 1e-8
    for mistake in ("forces of nodes", "transposed", "half a cell off"):
        assert numbers(mistake)[0] > 0.1 and numbers(mistake)[-1] < 1e-8


def own_solver(numbers: Numbers) -> None:
    slow, fast = numbers("projected gradient")[0], numbers("multilevel")[0]
    assert fast < 1e-8 < 1e-4 < slow


CHECKS = [hertz, rough_line, measured_map, study_on_dask, hardness, layer, partial_slip, creep, adhesion, leakage, certify_another_code, own_solver]


def numbers_of(printed: str) -> Numbers:
    def numbers(words: str) -> list[float]:
        line = next(line for line in printed.splitlines() if line.startswith(words))
        return [float(number) for number in re.findall(r"(?<![\w.*^])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", line)]

    return numbers


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
def test_a_script_draws_its_picture_and_prints_what_is_true(check: Callable[[Numbers], None], tmp_path: Path) -> None:
    image = pytest.importorskip("matplotlib.image")
    if check is study_on_dask:
        pytest.importorskip("distributed")
    done = subprocess.run(
        [sys.executable, FOLDER / f"{check.__name__}.py"],
        cwd=tmp_path,
        env=os.environ | {"MPLBACKEND": "Agg", "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        encoding="utf-8",
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    # small grids are quick, and say what they cost
    others = [line for line in done.stderr.splitlines() if "Warning: " in line and "on this grid" not in line]
    assert not others, done.stderr
    assert [path.name for path in tmp_path.glob("*.png")] == [f"{check.__name__}.png"]
    pixels = image.imread(tmp_path / f"{check.__name__}.png")
    assert len(np.unique(pixels.reshape(-1, pixels.shape[-1]), axis=0)) > 20
    check(numbers_of(done.stdout))


def test_the_gallery_has_a_script_and_a_small_picture_for_each_check() -> None:
    names = {check.__name__ for check in CHECKS}
    assert {path.stem for path in FOLDER.glob("*.py")} == names
    assert {path.stem for path in PICTURES.glob("*.png")} == names
    assert all(path.stat().st_size < 60_000 for path in PICTURES.glob("*.png"))
