"""The programs of the guide, run as a reader runs them: each block that begins with its file name, in one folder and in order."""

import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).parents[2] / "assets" / "guide" / "python.md"


def programs():
    blocks = [rest.split("```")[0] for rest in PAGE.read_text(encoding="utf-8").split("```python\n")[1:]]
    return {block.split("\n")[0].removeprefix("# "): block for block in blocks}


def test_programs_of_the_guide_run(tmp_path):
    found = programs()
    assert all(name.endswith(".py") for name in found) and len(found) >= 4
    for name, program in found.items():
        (tmp_path / name).write_text(program, encoding="utf-8")
        done = subprocess.run([sys.executable, name], cwd=tmp_path, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, f"{name}: {done.stderr}"
        assert "Warning" not in done.stderr, f"{name}: {done.stderr}"
