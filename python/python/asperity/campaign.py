"""Studies solved by threads of this process, by the workers of Dask, or by any executor of `concurrent.futures`."""

from __future__ import annotations

import os
import time
import warnings
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from typing import Any, Callable, Iterator, Mapping

from asperity._asperity import AsperityError, AsperityWarning, Batch, Halt, Ledger, Study, Table, free_memory
from asperity._asperity import threads as threads_here

MEMORY = 0.8
"""The share of what is free, or of the limit of a worker, that realisations may fill."""
REFRESH = 1.0
"""Seconds between two looks at which workers there are."""

Rows = Future[list[str]]
"""The rows of a batch, once they are there."""


def study(
    study: Study | Mapping[str, Any] | os.PathLike[str] | str,
    *,
    out: os.PathLike[str] | str | None = None,
    client: Any = None,
    workers: int | None = None,
    threads: int = 1,
    memory: float | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Table:
    """Solves a study, a setup with lists, and returns the table of its rows: the same to the last bit wherever they are solved.

    study: a Study, the file of one, or a dictionary of its sections.
    out: a file .csv for the table, beside which NAME.parquet, NAME.svg and NAME.png come. What it holds already is not solved again, so that a
        study that was ended goes on where it was.
    client: a client of dask.distributed, or an executor of concurrent.futures with its workers in other processes; without one the study is
        solved by threads of this process. Workers of Dask that die are survived, and those that come are used. Height files must be found
        at the same paths everywhere.
    workers: realisations that are solved at a time, or with Dask the workers that are used; as many as there are if it is not given.
    threads: threads that each realisation is solved on; more than one is worth it where realisations are large and few.
    memory: bytes that realisations may take together, on each worker of Dask or on this machine; four fifths of its limit, or of what is
        free, if it is not given.
    progress: called with the rows that are known and those that there are, whenever some come in.

    Raises AsperityError for what makes no study, and for a realisation that no worker has the memory for. Rows that did not converge are
    kept, their status says so, and an AsperityWarning tells how many they are. Ctrl-C ends it.
    """
    if not isinstance(study, Study):
        study = Study(**study) if isinstance(study, Mapping) else Study.read(study)
    for name, count in (("workers", workers), ("threads", threads)):
        if count is not None and count < 1:
            raise AsperityError(f"{name} is {count}: give at least 1")
    ledger = Ledger(study, out)
    engine = _engine(client, workers, threads, memory)
    try:
        _carry_out(study, ledger, engine, {"threads": threads, **engine.keywords}, progress)
    finally:
        engine.close()
    table = ledger.finish()
    if unsettled := sum(status != "converged" for status in table["status"]):
        warnings.warn(f"{unsettled} of {len(table)} rows did not converge: see their status", AsperityWarning, stacklevel=2)
    return table


class _Place:
    """Where batches are solved: by which executor, how many more of them at a time, and in how many bytes."""

    def __init__(self, executor: Executor, slots: int, memory: float) -> None:
        self.executor, self.slots, self.memory, self.free = executor, slots, memory, memory

    def take(self, batch: Batch) -> None:
        self.slots, self.free = self.slots - 1, self.free - batch.bytes

    def give_back(self, batch: Batch) -> None:
        self.slots, self.free = self.slots + 1, self.free + batch.bytes


class _Here:
    """One place: an executor, or threads of this process, whose runs can be ended."""

    def __init__(self, executor: Executor | None, slots: int, memory: float | None) -> None:
        self.halt = None if executor else Halt()
        self.keywords = {"halt": self.halt} if self.halt else {}
        free = free_memory()
        limit = memory or (MEMORY * free if free else float("inf"))
        self.place = _Place(executor or ThreadPoolExecutor(slots), slots, limit)

    def places(self) -> list[_Place]:
        return [self.place]

    def close(self) -> None:
        if self.halt:
            self.halt.pull()
            self.place.executor.shutdown(cancel_futures=True)


class _Dask:
    """A place for each worker of a client of Dask, as they come and go."""

    keywords: Mapping[str, Any] = {}

    def __init__(self, client: Any, workers: int | None, memory: float | None) -> None:
        self.client, self.workers, self.memory = client, workers, memory
        self.known: dict[str, _Place] = {}
        self.looked = float("-inf")
        if not self.places():
            raise AsperityError("the client has no workers: start some, or wait for them with client.wait_for_workers(1)")

    def places(self) -> list[_Place]:
        if time.monotonic() - self.looked > REFRESH:
            told = self.client.scheduler_info(n_workers=-1)["workers"]
            self.known = {address: self.known.get(address) or self._place(address, it) for address, it in told.items()}
            self.looked = time.monotonic()
        return list(self.known.values())[: self.workers]

    def _place(self, address: str, told: Mapping[str, Any]) -> _Place:
        # what was meant for a worker that dies is solved by others; one batch more waits at each, so that none is idle
        executor = self.client.get_executor(workers=[address], allow_other_workers=True, pure=False)
        limit = told["memory_limit"]
        return _Place(executor, told["nthreads"] + 1, self.memory or (MEMORY * limit if limit else float("inf")))

    def close(self) -> None:
        for place in self.known.values():
            place.executor.shutdown(wait=False)


def _engine(client: Any, workers: int | None, threads: int, memory: float | None) -> _Here | _Dask:
    if client is None:
        return _Here(None, workers or max(threads_here() // threads, 1), memory)
    if isinstance(client, Executor):
        return _Here(client, workers or getattr(client, "_max_workers", None) or threads_here(), memory)
    if hasattr(client, "scheduler_info"):
        return _Dask(client, workers, memory)
    raise AsperityError(f"client is {client!r}: give a client of dask.distributed, or an executor of concurrent.futures")


def _carry_out(
    study: Study,
    ledger: Ledger,
    engine: _Here | _Dask,
    keywords: Mapping[str, Any],
    progress: Callable[[int, int], object] | None,
) -> None:
    """Has all solved that is missing, the largest first, as far as memory goes."""
    places = engine.places()
    waiting = ledger.batches(sum(place.slots for place in places))
    _check_memory(waiting, places)
    running: dict[Rows, tuple[_Place, Batch]] = {}
    while waiting or running:
        for place, batch in _assign(waiting, engine.places()):
            running[place.executor.submit(study.solve, batch.realisations, **keywords)] = place, batch
        if not running:
            time.sleep(REFRESH)  # until there are workers again
        for future in wait(running, timeout=REFRESH, return_when=FIRST_COMPLETED).done:
            place, batch = running.pop(future)
            ledger.enter(batch.realisations, _rows(future, batch))
            place.give_back(batch)
            if progress:
                progress(ledger.known, ledger.rows)


def _assign(waiting: list[Batch], places: list[_Place]) -> Iterator[tuple[_Place, Batch]]:
    """Takes one batch after the other out of those that wait, the first that fits where most are free, until none fits anywhere."""
    while places := [place for place in places if place.slots > 0]:
        place = max(places, key=lambda it: (it.slots, it.free))
        fitting = (number for number, batch in enumerate(waiting) if batch.bytes <= place.free)
        number = next(fitting, None)
        if number is None:
            places.remove(place)
            continue
        batch = waiting.pop(number)
        place.take(batch)
        yield place, batch


def _rows(future: Rows, batch: Batch) -> list[str]:
    try:
        return future.result()
    except Exception as error:
        # the class is that of a package that need not be here
        if type(error).__name__ != "KilledWorker":
            raise
        raise AsperityError(
            f"one worker after the other died of {len(batch.realisations)} realisations that should take {batch.bytes / 1e9:.2g} GB: "
            "see what their logs say, or give each more memory"
        ) from error


def _check_memory(batches: list[Batch], places: list[_Place]) -> None:
    needed = max((batch.bytes for batch in batches), default=0.0)
    most = max(place.memory for place in places)
    if needed > most:
        raise AsperityError(
            f"a realisation needs {needed / 1e9:.2g} GB, and may have {most / 1e9:.2g} GB: allow more (memory), or give fewer points"
        )
