"""The programs of the guide, run as a reader runs them: each block `python` that begins with its file name, page by page, in one folder and in order.

A block `toml` that begins with its file name is written to that file. A program does the task of the commands before it. Where a block `text` shows what
these print, each number that the program prints must stand in it.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

GUIDE = Path(__file__).parents[2] / "assets" / "guide"

NEEDS = {".plot(": "matplotlib", ".to_pandas(": "pandas"}
"""What a program needs besides numpy, by the call that needs it."""

WITHOUT_PROGRAMS = {"explorer", "from-contact-mechanics", "from-tamaas", "gallery", "how-it-works", "words"}
"""Pages that show no task, or whose programs other tests run."""

UNITS = {"nm": 1e-9, "µm": 1e-6, "mm": 1e-3, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "%": 1e-2}
"""Units on the pages. Programs print numbers in SI."""

TOLERANCE = 0.01
"""The largest relative difference between a number on a page and the one that is printed."""


def blocks(page: Path) -> list[tuple[str, str]]:
    """The fenced blocks of a page: the words after the fence, and the lines."""
    return re.findall(r"^```(.*?)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def file_name(text: str) -> str | None:
    """The file that a block is to be written to."""
    found = re.match(r"# (\S+\.(?:py|toml))\b", text)
    return found[1] if found else None


def numbers(text: str) -> list[tuple[float, float]]:
    """The words of a text that are numbers, in SI where a unit follows, and half a unit of their last decimals."""
    found = []
    words = [word.strip("(),;:[]") for word in text.split()]
    for word, unit in zip(words, [*words[1:], ""]):
        if number := re.fullmatch(r"([-+]?\d+(?:\.(\d+))?)(e[-+]?\d+)?", word):
            scale = UNITS.get(unit, 1.0)
            last = 10.0 ** -len(number[2]) if number[2] else 0.0
            found.append((scale * float(word), 0.5 * scale * last * float("1" + (number[3] or "e0"))))
    return found


def missing(printed: str, page: str) -> list[float]:
    """The numbers of what was printed that are not on the page."""
    shown = numbers(page)
    return [
        it for it, _ in numbers(printed)
        if not any(abs(it - other) <= max(TOLERANCE * max(abs(it), abs(other)), rounding) for other, rounding in shown)
    ]


def run(name: str, folder: Path) -> str:
    """What a program prints. It must succeed, without a warning."""
    environment = os.environ | {"MPLBACKEND": "agg"}
    done = subprocess.run([sys.executable, name], cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, f"{name}: {done.stderr}"
    # small grids are quick, and say what they cost
    others = [line for line in done.stderr.splitlines() if "Warning: " in line and "on this grid" not in line]
    assert not others, f"{name}: {done.stderr}"
    return done.stdout


@pytest.mark.parametrize("page", sorted(path.stem for path in GUIDE.glob("*.md") if path.stem not in WITHOUT_PROGRAMS))
def test_programs_of_the_guide_run(page: str, tmp_path: Path) -> None:
    programs = 0
    shown = None
    found = blocks(GUIDE / f"{page}.md")
    for call, module in NEEDS.items():
        if any(info == "python" and call in text for info, text in found):
            pytest.importorskip(module)
    for info, text in found:
        name = file_name(text) if info in ("python", "toml") else None
        if name is not None:
            (tmp_path / name).write_text(text, encoding="utf-8")
        if name is not None and name.endswith(".py"):
            programs += 1
            printed = run(name, tmp_path)
            if shown is not None:
                assert numbers(printed), f"{name} prints no number of what the command prints"
                assert not missing(printed, shown), f"{name} prints\n{printed}\nbut the page has\n{shown}"
        if info == "text" or info.startswith("sh"):
            shown = text if info == "text" else None
    assert programs > 0, "no program on this page"


def test_numbers_are_held_against_the_page() -> None:
    page = "  relative area   0.1000 (counted 0.1100)\n  grid error   area 0.47 %, kappa_r 0.09 %, 22.2 kPa\n"
    assert not missing("0.1001 22.2e3\n[0.11, 0.004701, 0.000939]", page)
    assert missing("0.1012 22.2 21.9e3 0.00084", page) == [0.1012, 22.2, 21.9e3, 0.00084]
