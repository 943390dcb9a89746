"""The calls of other packages beside ours, as the guide lists them: each page is run as one program, row by row, and the results are compared."""

import ast
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

GUIDE = Path(__file__).parents[2] / "assets" / "guide"
PAGES = {"from-tamaas": ["tamaas"], "from-contact-mechanics": ["ContactMechanics", "SurfaceTopography"]}
TIGHT = 1e-6
"""The largest difference of the pressures of both programs of a page, over the largest pressure."""

Row = tuple[str, str, str, str]


def programs(page: str) -> dict[str, str]:
    blocks = [rest.split("```")[0] for rest in page.split("```python\n")[1:]]
    return {block.split("\n")[0].removeprefix("# "): block for block in blocks}


def rows(page: str) -> list[Row]:
    """The rows of the table of calls: task, theirs, ours, and how far both agree."""
    table = page.split("| agree to |\n")[1].split("\n\n")[0].splitlines()[1:]
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in table]
    assert all(len(row) == 4 for row in cells), [row for row in cells if len(row) != 4]
    return [(row[0].strip(), row[1], row[2], row[3].strip()) for row in cells]


def run(cell: str, names: dict[str, Any]) -> Any:
    """Runs the code of a cell, and returns the value of its last expression."""
    code = re.fullmatch(r"`(.+)`", cell)
    if code is None:
        assert cell == "not there", cell
        return None
    *statements, last = ast.parse(code[1]).body
    if not isinstance(last, ast.Expr):
        statements.append(last)
    exec(compile(ast.Module(statements, []), cell, "exec"), names)
    return eval(compile(ast.Expression(last.value), cell, "eval"), names) if isinstance(last, ast.Expr) else None


def difference(theirs: Any, ours: Any) -> float:
    """The largest difference over the largest value."""
    theirs, ours = (np.asarray(it, dtype=float) for it in (theirs, ours))
    assert theirs.shape == ours.shape and np.isfinite(theirs).all() and np.isfinite(ours).all()
    return float(abs(theirs - ours).max() / abs(ours).max())


@pytest.mark.parametrize("name", PAGES)
def test_the_calls_of_a_page_run_and_agree(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for package in PAGES[name]:
        pytest.importorskip(package)
    monkeypatch.chdir(tmp_path)
    page = (GUIDE / f"{name}.md").read_text(encoding="utf-8")
    table = rows(page)
    assert len(table) >= 15
    start: dict[str, Any] = {}
    exec(programs(page)["start.py"], start)
    their_names, our_names = dict(start), dict(start)
    wrong = []
    for task, their_cell, our_cell, allowed in table:
        # each side has names of its own, besides our contact of the rows before
        their_names["contact"] = our_names.get("contact")
        theirs, ours = run(their_cell, their_names), run(our_cell, our_names)
        if allowed != "-":
            found = difference(theirs, ours)
            print(f"{task}: {found:.1e}, allowed {allowed}")
            if not found <= float(allowed):
                wrong.append(f"{task}: {found:.1e} is above {allowed}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("name", PAGES)
def test_both_programs_of_a_page_find_the_same_pressures(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for package in PAGES[name]:
        pytest.importorskip(package)
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    (_, their_program), (_, our_program) = list(programs((GUIDE / f"{name}.md").read_text(encoding="utf-8")).items())[1:]
    exec(their_program, names)
    exec(our_program, names)
    assert names["ours"].shape == (256, 256)
    found = difference(names["theirs"], names["ours"])
    print(f"{name}: {found:.1e}")
    assert found < TIGHT
