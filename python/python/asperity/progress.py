"""Bars of progress by tqdm."""

from __future__ import annotations

from contextlib import contextmanager
from math import isfinite, log10
from typing import Any, Callable, Iterator

from asperity._asperity import AsperityError, Step


def _bar(**keywords: Any) -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError as error:
        raise AsperityError("progress=True needs tqdm: install it with `pip install tqdm`, or leave progress out") from error
    return tqdm(**keywords)


@contextmanager
def show_rows(progress: Callable[[int, int], object] | bool, rows: int) -> Iterator[Callable[[int, int], object] | None]:
    """The callback of a study: that which is given, or one that moves a bar."""
    if callable(progress) or not progress:
        yield progress or None
        return
    with _bar(total=rows, unit="row") as bar:

        def move(completed: int, _rows: int) -> None:
            bar.update(completed - bar.n)

        yield move


@contextmanager
def show_steps(
    callback: Callable[[Step], bool | None] | None, tolerance: float | None
) -> Iterator[Callable[[Step], bool | None]]:
    """A callback of a solve that moves a bar by the decades of the certificate, after the one that is given.

    Where there are several solves, as for a list of loads and in histories, the bar begins again with each, and shows its number.
    """
    if callback is not None and not callable(callback):
        raise TypeError(f"callback must be a callable that takes a Step, not {type(callback).__name__}")
    first: list[float] = []
    last, solve = -1, 1
    goal = log10(tolerance or 1e-8)
    with _bar(total=1.0, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}") as bar:

        def show(step: Step) -> bool | None:
            nonlocal last, solve
            if step.iteration < last:
                first.clear()
                solve += 1
                bar.reset()
            last = step.iteration
            if step.level == 0 and isfinite(step.error) and step.error > 0.0:
                decade = log10(step.error)
                first.append(decade)
                done = (first[0] - decade) / max(first[0] - goal, 1e-3)
                bar.update(max(min(done, 1.0) - bar.n, 0.0))
            number = f"solve {solve}, " if solve > 1 else ""
            eta = f", eta {step.error:.1e}" if isfinite(step.error) else ""
            bar.set_description(f"{number}step {step.iteration}{eta}")
            return callback(step) if callback else None

        yield show
