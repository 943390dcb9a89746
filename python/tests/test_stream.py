"""A recording that goes out in pieces while it grows."""

import asyncio
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.notebook import has_viewer

N = 256
HEAD = 12
"""Bytes before the first message of a stream."""
END = (0).to_bytes(8, "little")
"""Head of the message after which only an index comes."""


def problem() -> asp.Problem:
    surface = asp.Surface.rough(N, 1.0, hurst=0.8, rolloff_wavelength=0.25, short_cutoff=0.02, rms_gradient=0.1)
    return asp.Problem(surface, reduced_pressure=0.05)


def flat() -> np.ndarray:
    return np.full(N, problem().mean_pressure)


def run(to: Callable[[bytes], object], path: Path | None = None, steps: int = 40) -> None:
    with asp.Recorder(problem(), path, stream=to) as recorder:
        for _ in range(steps):
            recorder.step(flat())


def assert_is_whole(pieces: list[bytes], path: Path) -> None:
    """The pieces are the file beside them, to its last message."""
    whole = path.read_bytes()
    assert all(piece[:HEAD] == whole[:HEAD] and len(piece) > HEAD for piece in pieces)
    messages = b"".join(piece[HEAD:] for piece in pieces)
    assert whole[HEAD:].startswith(messages)
    assert whole[HEAD + len(messages) :].startswith(END)


def test_the_pieces_are_the_recording_of_a_loop(tmp_path: Path) -> None:
    pieces: list[bytes] = []
    run(pieces.append, tmp_path / "mine.rrd")
    assert_is_whole(pieces, tmp_path / "mine.rrd")


def test_the_pieces_are_the_recording_of_our_own_solver(tmp_path: Path) -> None:
    pieces: list[bytes] = []
    contact = problem().solve(record=tmp_path / "ours.rrd", stream=pieces.append)
    assert_is_whole(pieces, tmp_path / "ours.rrd")
    joined = tmp_path / "joined.rrd"
    joined.write_bytes(b"".join(pieces))
    assert asp.Setup.read(joined) == contact.setup


def test_a_piece_comes_before_the_loop_ends() -> None:
    pieces: list[bytes] = []
    with asp.Recorder(problem(), stream=pieces.append) as recorder:
        for _ in range(1_000_000):
            recorder.step(flat())
            if len(pieces) > 1:
                break
        early = len(pieces)
    assert early > 1 and len(pieces) > early


def test_the_reader_of_the_sdk_finds_every_step_in_the_pieces(tmp_path: Path) -> None:
    pytest.importorskip("rerun")
    try:
        from rerun.chunk import RrdReader
    except ImportError:  # up to 0.37
        from rerun.experimental import RrdReader
    pieces: list[bytes] = []
    count = 0
    with asp.Recorder(problem(), stream=pieces.append) as recorder:
        while len(pieces) < 2 and count < 1_000_000:
            recorder.step(flat())
            count += 1

    def steps_in(recording: bytes) -> set[int]:
        path = tmp_path / "joined.rrd"
        path.write_bytes(recording)
        chunks = RrdReader(path).stream().filter(content="/contact/trace/kappa_r_counted", has_timeline="step").to_chunks()
        return {int(step) for chunk in chunks for step in chunk.to_record_batch().column("step").to_pylist()}

    def joined(pieces: list[bytes]) -> bytes:
        # this reader, unlike the viewer, takes one head only
        return pieces[0] + b"".join(piece[HEAD:] for piece in pieces[1:])

    assert steps_in(joined(pieces)) == set(range(count))
    assert steps_in(joined(pieces[:-1])) < set(range(count))


def test_what_the_stream_raises_ends_the_run_and_comes_out() -> None:
    given: list[bytes] = []

    def fail(piece: bytes) -> None:
        given.append(piece)
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        run(fail)
    with pytest.raises(ZeroDivisionError):
        # a run that would go on for ever
        problem().solve(solver="gfmd", tolerance=1e-30, max_iterations=10**9, stream=fail)
    assert len(given) == 2


def test_what_the_loop_raises_loses_nothing(tmp_path: Path) -> None:
    pieces: list[bytes] = []
    path = tmp_path / "broken.rrd"
    with pytest.raises(ZeroDivisionError), asp.Recorder(problem(), path, stream=pieces.append) as recorder:
        recorder.step(flat())
        1 / 0
    assert_is_whole(pieces, path)


def test_what_is_no_stream_is_refused() -> None:
    with pytest.raises(TypeError, match="callable"):
        asp.Recorder(problem(), stream="mine.rrd")  # type: ignore[arg-type]
    with pytest.raises(asp.AsperityError, match="not both"):
        problem().solve(live=True, stream=print)


@pytest.mark.skipif(not has_viewer(), reason="rerun-notebook is not installed")
def test_the_viewer_of_a_notebook_gets_every_piece(monkeypatch: pytest.MonkeyPatch) -> None:
    viewer = asp.notebook.Viewer()
    shown: list[bytes] = []
    monkeypatch.setattr(viewer._widget, "send_rrd", shown.append)
    assert asyncio.run(viewer.ready(timeout=0.0)) is viewer
    run(viewer)
    assert shown and all(piece[:3] == b"RRF" for piece in shown)
