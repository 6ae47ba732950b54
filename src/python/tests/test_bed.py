"""Beds by hand have the bits of `impactlaw bed`, and their views are safe."""

import csv
import gc
from pathlib import Path

import impactlaw
import numpy as np
import pytest
from conftest import BEADS, ROOT, Program


def test_a_bed_by_hand_has_the_rows_of_the_program(beads: Path, program: Program, tmp_path: Path) -> None:
    done = program("bed", beads, "--out", tmp_path / "out")
    assert done.returncode in (0, 1), done.stderr
    bed = impactlaw.Bed(beads, law="thornton")
    strides = [1, 2, 77, 500]
    while not bed.is_over:
        bed.step(strides[bed.steps % 4])
    for name, packing in (("packing", True), ("thornton", False)):
        lines = (tmp_path / "out/bed" / name / "bed.csv").read_text().splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        columns = bed.rows(packing=packing)
        assert len(rows) > 5
        for key, column in columns.items():
            cells = [row[key] for row in rows]
            found = list(column) if isinstance(column, list) else [float(x) for x in column]
            assert (cells if isinstance(column, list) else [float(x) for x in cells]) == found, key
    assert bed.step(10) == 0 and bed.stage == "end"


def test_views_are_the_memory_of_the_bed_and_stay_when_it_moves_on() -> None:
    bed = impactlaw.Bed(BEADS, law="hertz")
    bed.step(200)
    places, again = bed.positions, bed.positions
    assert places.shape == (len(bed), 3) and np.shares_memory(places, again)
    assert places.strides == (32, 8) and bed.radii.shape == (len(bed),)
    assert not places.flags.writeable and not places.flags.owndata
    with pytest.raises(ValueError, match="WRITEABLE|read-only"):
        places.flags.writeable = True
    before = places.copy()
    speeds = bed.velocities
    bed.step(200)
    assert (places == before).all() and not (bed.positions == before).all()
    assert not np.shares_memory(places, bed.positions)
    last, copy = bed.positions, bed.positions.copy()
    del bed
    gc.collect()
    noise = [np.full(6400, float(i)) for i in range(200)]
    assert (last == copy).all() and (places == before).all() and np.isfinite(speeds).all() and noise


def test_bits_do_not_depend_on_views() -> None:
    plain, watched = (impactlaw.Bed(BEADS, law="thornton") for _ in range(2))
    plain.run()
    while not watched.is_over:
        held = watched.positions, watched.velocities, watched.radii
        watched.step(20)
        assert held[0].shape[1] == 3
    assert (plain.positions == watched.positions).all() and (plain.velocities == watched.velocities).all()
    one, other = plain.contacts(), watched.contacts()
    assert len(one["grain"]) > 100 and (one["force_N"] == other["force_N"]).all()
    assert one["position_m"].shape == (len(one["grain"]), 3)


def test_beds_take_fitted_laws_and_refuse_what_the_program_refuses() -> None:
    case = impactlaw.Case(
        radius=1e-3, density=2500, young_modulus=20e6, poisson_ratio=0.25, yield_strength=0.2e6, velocities=1.0, tolerance=0.05
    )
    law = case.atlas()
    scene = BEADS.replace('"hertz", "thornton"', '"fitted"')
    bed = impactlaw.Bed(scene, fitted=law)
    assert bed.step(50) == 50
    with pytest.raises(impactlaw.Error, match="the scene asks for the law"):
        impactlaw.Bed(scene)
    with pytest.raises(impactlaw.Error, match="must be one of fitted"):
        impactlaw.Bed(scene, law="hertz", fitted=law)
    other = impactlaw.Law(ROOT / "models/sac305-solder.toml")
    with pytest.raises(impactlaw.Error):
        impactlaw.Bed(scene, fitted=other)
