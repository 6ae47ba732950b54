"""Studies, comparisons and costs as tables."""

import os
from pathlib import Path

import impactlaw
import numpy as np
import pytest
from conftest import COPPER, Program

STUDY = """
[particle]
radius = "1 mm"
[impact]
rho_V2_over_Y = [0.05, 0.2]
[accuracy]
tolerance = 0.1
[[case]]
name = "soft"
material = { density = "2700 kg/m3", young_modulus = "70 GPa", yield_strength = "100 MPa", poisson_ratio = 0.345 }
"""


def test_studies_are_the_program_s_results(program: Program, tmp_path: Path) -> None:
    path = tmp_path / "small.toml"
    path.write_text(STUDY)
    table = impactlaw.study(path, out=tmp_path / "python")
    done = program("study", path, "--out", tmp_path / "program")
    assert done.returncode == 0 and table.met, done.stderr
    named = [line for line in (tmp_path / "program/results.csv").read_text().splitlines() if line[0] != "#"]
    assert ",".join(table) == named[0] and len(named) == 3
    own = [line for line in table.path.read_text().splitlines() if line[0] != "#"]
    assert own == named
    e = np.asarray(table["restitution"], dtype=float)
    assert ((e > 0) & (e < 0.3)).all()


def test_comparisons_are_the_program_s_file(copper: Path, tmp_path: Path) -> None:
    runs = impactlaw.Case.from_toml(copper).impact()
    runs.save(tmp_path / "saved")
    runs.fit().save(tmp_path / "saved/law.toml")
    table = impactlaw.compare(copper, impacts=tmp_path / "saved")
    assert table.path.is_file()
    own = runs.compare(impactlaw.Law(tmp_path / "saved/law.toml"))
    assert list(table) == list(own)
    for name, column in own.items():
        if isinstance(column, list):
            assert table[name] == column
        else:
            assert np.array_equal(np.asarray(table[name]), column, equal_nan=True), name
    assert "<table>" in table._repr_html_()


def test_tables_become_data_frames(copper: Path, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    runs = impactlaw.Case.from_toml(copper).impact()
    runs.save(tmp_path / "saved")
    frame = impactlaw.compare(copper, impacts=tmp_path / "saved", law="atlas").to_pandas()
    assert isinstance(frame, pandas.DataFrame) and len(frame) > 3


@pytest.mark.skipif("IMPACTLAW_SLOW" not in os.environ, reason="takes a minute: set IMPACTLAW_SLOW")
def test_the_cost_of_accuracy_is_the_program_s_file(tmp_path: Path) -> None:
    path = tmp_path / "soft.toml"
    path.write_text(COPPER.replace("0.05", "0.2").replace('"4 m/s", "10 m/s"', '"2.5 m/s"'))
    table = impactlaw.cost(path, quick=True, ladders=["cells, degree 2"], out=tmp_path / "out")
    assert table.path.name == "cost_V2.5.csv" and len(table["ladder"]) >= 3
    assert "cells, degree 2" in table["ladder"]
