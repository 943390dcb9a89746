"""The notebooks run from top to bottom, with the viewer inside where it is installed, and pictures where it is not."""

from pathlib import Path

import pytest

from asperity.notebook import has_viewer

FOLDER = Path(__file__).parent.parent / "notebooks"


@pytest.mark.parametrize("name", ["first_hour", "hertz_against_rough", "why_is_my_solver_slow"])
def test_a_notebook_runs_from_top_to_bottom(name: str, tmp_path: Path) -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    notebook = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    shown = [kind for cell in cells for output in cell.outputs for kind in output.get("data", {})]
    assert "image/png" in shown
    assert ("application/vnd.jupyter.widget-view+json" in shown) == has_viewer()
    text = "".join(output.get("text", "") for cell in cells for output in cell.outputs)
    words = {"first_hour": "whole surface", "hertz_against_rough": "patches:", "why_is_my_solver_slow": "multilevel:"}
    assert words[name] in text
