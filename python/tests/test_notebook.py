"""Executes the notebooks in python/examples: all cells in order, in one interpreter, without Jupyter."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import pytest

NOTEBOOKS = sorted((Path(__file__).parents[1] / "examples").glob("*.ipynb"))


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_all_cells_of_a_notebook_run(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    notebook = json.loads(file.read_text())
    assert notebook["nbformat"] == 4
    names: dict[str, Any] = {"__name__": "__main__"}
    figures = 0
    for number, cell in enumerate(notebook["cells"]):
        assert cell["source"] and all(line.endswith("\n") for line in cell["source"][:-1])
        if cell["cell_type"] != "code":
            continue
        assert cell["outputs"] == [] and cell["execution_count"] is None, "the notebook in the tree contains outputs"
        exec(compile("".join(cell["source"]), f"{file.name}, cell {number}", "exec"), names)
        for figure in map(plt.figure, plt.get_fignums()):  # draws them, as a notebook does
            figure.canvas.draw()
            figures += 1
        plt.close("all")
    assert figures >= 1
    assert {path.name for path in (tmp_path / "runs" / "notebook").iterdir()} == {"kios", "patrol"}


def test_there_are_notebooks() -> None:
    assert [file.name for file in NOTEBOOKS] == ["compare.ipynb"]
