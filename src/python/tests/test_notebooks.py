"""The cells of the notebooks run, one after the other."""

import ast
import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "src/python/notebooks").glob("*.ipynb"))


def test_there_are_notebooks() -> None:
    assert {path.stem for path in NOTEBOOKS} >= {"atlas", "bed", "copper", "inverse", "theories"}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_cells_run(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    names: dict[str, object] = {}
    cells = [cell for cell in json.loads(path.read_text())["cells"] if cell["cell_type"] == "code"]
    assert len(cells) >= 2
    for cell in cells:
        text = "".join(cell["source"])
        if "# needs matplotlib" in text and importlib.util.find_spec("matplotlib") is None:
            print(f"{path.stem}: matplotlib is not installed, its plot is NOT drawn")
            continue
        exec(compile(ast.parse(text), path.name, "exec"), names)
    if path.stem == "inverse":
        # measured at 500 MPa, with noise
        found: Any = names["found"]
        low, high = found["estimate"]["yield_strength_interval_Pa"]
        assert 0.8 * high < low < 500e6 < high
