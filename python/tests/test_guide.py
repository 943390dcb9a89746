"""The programs of the guide, run as a reader runs them: each block `python` that begins with its file name, page by page, in one folder and in order.

A block `toml` that begins with its file name is written to that file. Where a block `text` stands directly before a program, that is, what a command
prints for the same task, each number that the program prints must stand in it.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

GUIDE = Path(__file__).parents[2] / "assets" / "guide"

WITHOUT_PROGRAMS = {"explorer", "how-it-works", "words"}
"""Pages that show no task."""

TOLERANCE = 0.01
"""The largest relative difference between a number on a page and the one that is printed."""


def blocks(page: Path) -> list[tuple[str, str]]:
    """The fenced blocks of a page: the words after the fence, and the lines."""
    found = re.findall(r"^```(.*?)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return [(info, text) for info, text in found]


def file_name(text: str) -> str | None:
    """The file that a block is to be written to."""
    found = re.match(r"# (\S+\.(?:py|toml))\b", text)
    return found[1] if found else None


def numbers(text: str) -> list[tuple[float, float]]:
    """The words of a text that are numbers, and half a unit of their last decimals."""
    words = [re.fullmatch(r"([-+]?\d+(?:\.(\d+))?)(e[-+]?\d+)?", word.strip("(),;:%[]")) for word in text.split()]
    found = [(word[0], float("1" + (word[3] or "e0")), word[2]) for word in words if word]
    return [(float(number), 0.5 * scale * 10.0 ** -len(decimals) if decimals else 0.0) for number, scale, decimals in found]


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
    assert "Warning" not in done.stderr, f"{name}: {done.stderr}"
    return done.stdout


@pytest.mark.parametrize("page", sorted(path.stem for path in GUIDE.glob("*.md") if path.stem not in WITHOUT_PROGRAMS))
def test_programs_of_the_guide_run(page: str, tmp_path: Path) -> None:
    programs = 0
    text_before = None
    for info, text in blocks(GUIDE / f"{page}.md"):
        name = file_name(text) if info in ("python", "toml") else None
        if name is not None:
            (tmp_path / name).write_text(text, encoding="utf-8")
        if name is not None and name.endswith(".py"):
            programs += 1
            printed = run(name, tmp_path)
            if text_before is not None:
                assert numbers(printed), f"{name} prints no number of the text before it"
                assert not missing(printed, text_before), f"{name} prints\n{printed}\nbut the page has\n{text_before}"
        text_before = text if info == "text" else None
    assert programs > 0, "no program on this page"


def test_numbers_are_held_against_the_page() -> None:
    page = "  relative area   0.1000 (counted 0.1100)\n  grid error   area 0.47 %, kappa_r 0.09 %, 22.2 kPa\n"
    assert not missing("0.1001 22.2\n[0.11, 0.4701, 0.0939]", page)
    assert missing("0.1012 0.2 21.9 0.084", page) == [0.1012, 0.2, 21.9, 0.084]
