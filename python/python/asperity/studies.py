"""Studies solved by threads of this process, by the workers of Dask, or by any executor of `concurrent.futures`."""

from __future__ import annotations

import os
import time
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping

from asperity._asperity import AsperityError, Batch, CancelToken, Ledger, Study, Table, free_memory
from asperity._asperity import threads as threads_here
from asperity.progress import show_rows

MEMORY = 0.8
"""The share of the free memory, or of the limit of a worker, that realisations may use."""
REFRESH = 1.0
"""Seconds between two queries for the workers."""

Rows = Future[list[str]]
"""The rows of a batch."""


def study(
    study: Study | Mapping[str, Any] | os.PathLike[str] | str,
    *,
    out: os.PathLike[str] | str | None = None,
    client: Any = None,
    workers: int | None = None,
    threads: int = 1,
    memory: float | None = None,
    progress: Callable[[int, int], object] | bool = False,
) -> Table:
    """Solves a study, which is a setup with lists, and returns the table of its rows. The table is the same to the last bit on all engines.

    study: a Study, the file of one, or a dictionary of its sections.
    out: a file .csv for the table; NAME.parquet, NAME.svg and NAME.png are written beside it. Rows that it already holds are not solved again, so
        a study that was stopped continues.
    client: a client of dask.distributed, or an executor of concurrent.futures with workers in other processes. Without one, threads of this
        process solve the study. The study survives the death of Dask workers and uses new ones. All workers must find height files at the same
        paths.
    workers: realisations that are solved at the same time, or with Dask the workers that are used; all of them if it is not given.
    threads: threads for each realisation. More than one helps if realisations are large and few.
    memory: bytes that all realisations together may use on each worker of Dask or on this machine; 80 % of its limit, or of the free memory, if
        it is not given.
    progress: called with the numbers of solved rows and of all rows after each batch; True shows a bar by tqdm.

    Raises AsperityError for an invalid study, and for a realisation that no worker has the memory for. Rows that did not converge stay in the
    table with their status, and an AsperityWarning gives their number, as others do of rows that are not resolved and of rows whose grid is too
    coarse. Ctrl-C stops the study; the KeyboardInterrupt says where the rows are.
    """
    if not isinstance(study, Study):
        study = Study(**study) if isinstance(study, Mapping) else Study.read(study)
    for name, count in (("workers", workers), ("threads", threads)):
        if count is not None and count < 1:
            raise AsperityError(f"{name} is {count}: give at least 1")
    ledger = Ledger(study, out)
    engine = _engine(client, workers, threads, memory)
    try:
        with show_rows(progress, ledger.rows) as report:
            _solve(study, ledger, engine, {"threads": threads, **engine.keywords}, report)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(_after_interruption(ledger, out)) from None
    finally:
        engine.close()
    return ledger.finish()


def _after_interruption(ledger: Ledger, out: os.PathLike[str] | str | None) -> str:
    """Where the rows are that were solved before a study was stopped."""
    solved = f"{ledger.completed} of {ledger.rows} rows were solved"
    if out is None:
        return f"{solved}, and they are lost: give a file (out) to keep them"
    path = Path(out)
    kept = next((it for it in (path.with_suffix(".unfinished"), path) if it.is_file()), None)
    return f"{solved}, and they are in {kept}: call study() again with the same file to go on" if kept else solved


class _Place:
    """Where batches are solved: by which executor, how many more of them at a time, and in how many bytes."""

    def __init__(self, executor: Executor, slots: int, memory: float) -> None:
        self.executor, self.slots, self.memory, self.free = executor, slots, memory, memory

    def take(self, batch: Batch) -> None:
        self.slots, self.free = self.slots - 1, self.free - batch.bytes

    def give_back(self, batch: Batch) -> None:
        self.slots, self.free = self.slots + 1, self.free + batch.bytes


class _Here:
    """One place: an executor, or threads of this process, whose runs can be cancelled."""

    def __init__(self, executor: Executor | None, slots: int, memory: float | None) -> None:
        self.cancel = None if executor else CancelToken()
        self.keywords = {"cancel": self.cancel} if self.cancel else {}
        free = free_memory()
        limit = memory or (MEMORY * free if free else float("inf"))
        self.place = _Place(executor or ThreadPoolExecutor(slots), slots, limit)

    def places(self) -> list[_Place]:
        return [self.place]

    def close(self) -> None:
        if self.cancel:
            self.cancel.cancel()
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
            workers = self.client.scheduler_info(n_workers=-1)["workers"]
            self.known = {address: self.known.get(address) or self._place(address, it) for address, it in workers.items()}
            self.looked = time.monotonic()
        return list(self.known.values())[: self.workers]

    def _place(self, address: str, worker: Mapping[str, Any]) -> _Place:
        # other workers solve the batches of one that dies; one more batch waits at each, so that none is idle
        executor = self.client.get_executor(workers=[address], allow_other_workers=True, pure=False)
        limit = worker["memory_limit"]
        return _Place(executor, worker["nthreads"] + 1, self.memory or (MEMORY * limit if limit else float("inf")))

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


def _solve(
    study: Study,
    ledger: Ledger,
    engine: _Here | _Dask,
    keywords: Mapping[str, Any],
    progress: Callable[[int, int], object] | None,
) -> None:
    """Solves all missing realisations, the largest first, as far as memory allows."""
    places = engine.places()
    waiting = ledger.batches(sum(place.slots for place in places))
    _check_memory(waiting, places)
    running: dict[Rows, tuple[_Place, Batch]] = {}
    while waiting or running:
        for place, batch in _assign(waiting, engine.places()):
            running[place.executor.submit(study.solve, batch.realisations, **keywords)] = place, batch
        if not running:
            time.sleep(REFRESH)  # until new workers come
        for future in wait(running, timeout=REFRESH, return_when=FIRST_COMPLETED).done:
            place, batch = running.pop(future)
            ledger.add(batch.realisations, _rows(future, batch))
            place.give_back(batch)
            if progress:
                progress(ledger.completed, ledger.rows)


def _assign(waiting: list[Batch], places: list[_Place]) -> Iterator[tuple[_Place, Batch]]:
    """Assigns waiting batches, each the first that fits in the place with the most free slots, until none fits anywhere."""
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
        # the class belongs to a package that may not be installed
        if type(error).__name__ != "KilledWorker":
            raise
        raise AsperityError(
            f"several workers died while solving {len(batch.realisations)} realisations, which should take {batch.bytes / 1e9:.2g} GB: "
            "read the logs of the workers, or give each of them more memory"
        ) from error


def _check_memory(batches: list[Batch], places: list[_Place]) -> None:
    needed = max((batch.bytes for batch in batches), default=0.0)
    most = max(place.memory for place in places)
    if needed > most:
        raise AsperityError(
            f"a realisation needs {needed / 1e9:.2g} GB, but only {most / 1e9:.2g} GB may be used: allow more (memory), or give fewer points"
        )
