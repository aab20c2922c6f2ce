"""The example notebook runs from beginning to end in the folder it stands in, and is kept without results."""

from pathlib import Path

import pytest

import rocking

PATH = Path(rocking.__file__).parents[1] / "docs" / "example.ipynb"


@pytest.fixture(scope="module")
def notebook():
    nbformat = pytest.importorskip("nbformat", reason="nbformat, of the extra test, reads the notebook")
    return nbformat.read(PATH, as_version=4)


def test_it_is_kept_without_results_and_small(notebook):
    assert PATH.stat().st_size < 20_000
    for cell in notebook.cells:
        assert cell.cell_type != "code" or (cell.outputs == [] and cell.execution_count is None)


@pytest.mark.slow
def test_every_cell_runs_and_shows_what_it_promises(notebook, monkeypatch):
    """A failing cell raises; a figure, a frame and a result that can be read are among what is shown."""
    nbclient = pytest.importorskip("nbclient", reason="nbclient, of the extra test, runs the notebook")
    pytest.importorskip("ipykernel", reason="ipykernel, of the extra test, runs the cells")
    monkeypatch.setenv("PYTHONPATH", str(PATH.parents[1]))
    client = nbclient.NotebookClient(
        notebook, timeout=900, kernel_name="python3", resources={"metadata": {"path": str(PATH.parent)}}
    )
    client.execute()
    shown = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert not [output for output in shown if output.output_type == "stream" and output.name == "stderr"]
    data = [output.data for output in shown if "data" in output]
    assert sum("image/png" in part for part in data) >= 5
    assert any("text/html" in other_part and "period_s" in other_part["text/html"] for other_part in data)
    texts = "".join(one_part.get("text/plain", "") for one_part in data)
    assert "Accelerogram(" in texts and "Mechanism(" in texts
