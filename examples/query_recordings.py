"""A folder of recordings as a table, by the properties that each of them carries.

    pip install "rerun-sdk[catalog]>=0.36"
    mkdir runs
    for p in 0.001 0.01 0.1; do asperity solve scene.toml --reduced-pressure $p --record runs/$p.rrd; done
    python query_recordings.py runs [SCENE]

The scene of `asperity solve` is `contact`.
"""

import sys
from pathlib import Path

from datafusion import col
from rerun.server import Server

COLUMNS = ["solver", "points", "hurst", "reduced_pressure", "relative_area", "kappa_r",
           "certificate", "iterations", "status"]


def properties(dataset, scene):
    """The properties of a scene, one row for each recording that has it and has ended."""
    table = dataset.segment_table()
    known = set(table.schema().names)
    columns = {name: f"property:{scene}:{name}" for name in COLUMNS}
    columns = {name: column for name, column in columns.items() if column in known}
    # a property is a list, here of one value
    table = table.select(*(col(f'"{column}"')[0].alias(name) for name, column in columns.items()))
    return table.filter(col("iterations").is_not_null()).sort(col("hurst"), col("reduced_pressure"), col("solver"))


def write(table):
    rows = [list(table), *zip(*table.values())]
    words = [[f"{value:.5g}" if isinstance(value, float) else str(value) for value in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*words)]
    for row in words:
        print("  ".join(word.rjust(width) for word, width in zip(row, widths)))


def main(folder, scene="contact"):
    if not any(Path(folder).glob("*.rrd")):
        sys.exit(f"{folder} has no recordings: give a folder of files that `asperity solve --record` wrote")
    with Server(datasets={"runs": folder}) as server:
        client = server.client()  # which must live as long as its tables
        write(properties(client.get_dataset("runs"), scene).to_pydict())


if __name__ == "__main__":
    main(*sys.argv[1:])
