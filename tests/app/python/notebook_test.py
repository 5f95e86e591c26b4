"""Runs the example notebook, cell by cell, with Jupyter's kernel."""

import os
from pathlib import Path

import nbclient
import nbformat
import pytest

NOTEBOOKS = Path(os.environ["MAPPROOF_SOURCE_DIR"]) / "examples/notebooks"


@pytest.fixture(scope="module")
def cells():
    notebook = nbformat.read(NOTEBOOKS / "hall.ipynb", as_version=4)
    nbclient.NotebookClient(
        notebook, timeout=300, resources={"metadata": {"path": str(NOTEBOOKS)}}).execute()
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def shown(cell):
    return [output.data for output in cell.outputs if output.output_type == "execute_result"]


def test_the_map_is_shown_as_svg(cells):
    assert "<svg" in shown(cells[1])[0]["image/svg+xml"]


def test_tables_are_shown(cells):
    for cell in cells[2:]:
        assert "<table" in shown(cell)[0]["text/html"]
