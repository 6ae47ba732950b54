"""Cases, impacts and laws are the program's, bit for bit."""

import csv
import io
import json
import pickle
import time
from pathlib import Path

import impactlaw
import numpy as np
import pytest
from conftest import COPPER, ROOT, Program


def test_the_first_law_takes_five_lines_and_less_than_ten_seconds() -> None:
    begun = time.perf_counter()
    case = impactlaw.Case(
        radius="250 um", density=8960, young_modulus="128 GPa", poisson_ratio=0.343, yield_strength=162e6,
        velocities=[1, 4, 10], tolerance=0.05,
    )  # fmt: skip
    runs = case.impact()
    law = runs.fit()
    e = law.rebound(10.0).restitution
    assert abs(e - runs.figures["restitution"][2]) < 0.03
    assert time.perf_counter() - begun < 10


def test_law_curves_and_figures_are_those_of_the_program(copper: Path, program: Program, tmp_path: Path) -> None:
    done = program("run", copper, "--out", tmp_path / "out")
    assert done.returncode in (0, 1), done.stderr
    runs = impactlaw.Case.from_toml(copper).impact()
    runs.fit().save(tmp_path / "python.toml")
    assert (tmp_path / "python.toml").read_bytes() == (tmp_path / "out/law.toml").read_bytes()
    for impact in runs:
        folder = tmp_path / "out" / f"impact_V{impact.velocity:g}"
        lines = (folder / "curve.csv").read_text().splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        for name, column in impact.columns.items():
            assert [float(row[name]) for row in rows] == column.tolist(), name
        summary = json.loads((folder / "summary.json").read_text())
        del summary["sha256"]  # the sum of the file
        assert {**impact.figures, "wall_s": 0} == {**summary, "wall_s": 0}
        assert impact.status == "ok" and len(impact.particle("compressed")["r_m"]) > 100


def test_saved_impacts_are_fitted_by_the_program(copper: Path, program: Program, tmp_path: Path) -> None:
    runs = impactlaw.Case.from_toml(copper).impact()
    runs.save(tmp_path / "saved")
    done = program("fit", copper, "--impacts", tmp_path / "saved", "--out", tmp_path / "law.toml")
    assert done.returncode in (0, 1), done.stderr
    assert (tmp_path / "law.toml").read_text() == runs.fit().toml


def column(text: str, name: str) -> list[float]:
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return [float(row[name]) for row in csv.DictReader(io.StringIO("\n".join(lines)))]


SOLDER = ROOT / "models/sac305-solder.toml"


def test_forces_are_those_of_law_eval(program: Program) -> None:
    law = impactlaw.Law(SOLDER)
    micrometres = [0.0, 0.25, 1.0, 3.5, 8.0]
    texts = [f"{x} um" for x in micrometres]
    pressed = program("law", "eval", SOLDER, "--body", "0.3 mm", "--displacements", *texts)
    delta = np.array(micrometres) * 1e-6
    exact = column(pressed.stdout, "displacement_m")
    assert law.force(exact, radius="0.3 mm").tolist() == column(pressed.stdout, "force_N")
    assert np.allclose(law.force(delta, radius=3e-4), column(pressed.stdout, "force_N"))
    released = program(
        "law", "eval", SOLDER, "--body", "0.3 mm", "--displacements", *texts, "--max-displacement", "9 um"
    )
    back = law.unload(np.array(exact).reshape(1, 5), "9 um", radius="0.3 mm")
    assert back.shape == (1, 5)
    assert back.ravel().tolist() == column(released.stdout, "force_N")
    assert law.force("1 um", radius="0.3 mm") == column(pressed.stdout, "force_N")[2]


def test_theories_are_those_of_the_program(copper: Path, program: Program) -> None:
    case = impactlaw.Case.from_toml(copper)
    names = [theory["name"] for theory in impactlaw.theories() if theory["gives_force"]]
    assert len(names) >= 10 and set(case.theories()) == set(names)
    for name in ("hertz", "thornton", "jackson-green"):
        name = name if name in names else name.replace("-", "_")
        law = case.theory(name)
        done = program("theory", name, copper, "--velocities", "1 m/s", "5 m/s")
        assert law.rebound([1.0, 5.0]).restitution.tolist() == column(done.stdout, "restitution")
        done = program("theory", name, copper, "--displacements", "1 um", "2 um")
        assert law.force(column(done.stdout, "displacement_m")).tolist() == column(done.stdout, "force_N")


def test_the_atlas_is_that_of_the_program(program: Program, tmp_path: Path) -> None:
    law = impactlaw.atlas(young="128 GPa", yield_=162e6, poisson=0.343, density=8960, radius="250 um", name="cu")
    law.save(tmp_path / "python.toml")
    done = program(
        "law", "--young", "128GPa", "--yield", "162MPa", "--poisson", "0.343", "--density", "8960kg/m3",
        "--radius", "250um", "--name", "cu", "--out", tmp_path / "program.toml",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "python.toml").read_bytes() == (tmp_path / "program.toml").read_bytes()
    assert impactlaw.Law(tmp_path / "python.toml").rebound(3.0).restitution == law.rebound(3.0).restitution


def test_exports_are_those_of_the_program(program: Program, tmp_path: Path) -> None:
    files = impactlaw.Law(SOLDER).export("liggghts", tmp_path / "python")
    done = program("export", SOLDER, "--to", "liggghts", "--out", tmp_path / "program")
    assert done.returncode == 0, done.stderr
    assert files
    for file in files:
        other = tmp_path / "program" / Path(file).relative_to(tmp_path / "python")
        assert Path(file).read_bytes() == other.read_bytes()


def test_plans_are_those_of_the_program(copper: Path, program: Program) -> None:
    case = impactlaw.Case.from_toml(copper)
    assert case.plan() == json.loads(program("plan", copper, "--json").stdout)
    assert case.plan_text() == program("plan", copper).stdout


def test_comparisons_have_theories_and_the_law() -> None:
    runs = impactlaw.Case.from_toml(COPPER).impact()
    rows = runs.compare(runs.fit())
    laws = rows["law"] if "law" in rows else rows["model"]
    assert {"thornton", "hertz"} <= set(map(str, laws))


def test_keywords_text_and_files_are_one_case() -> None:
    from_text = impactlaw.Case.from_toml(COPPER)
    from_words = impactlaw.Case(
        radius=2.5e-4, density="8960 kg/m3", young_modulus=128e9, poisson_ratio=np.float64(0.343),
        yield_strength=162e6, velocities=np.array([10.0, 4.0, 1.0]), tolerance=0.05,
    )  # fmt: skip
    assert from_words.velocities.tolist() == from_text.velocities.tolist() == [1.0, 4.0, 10.0]
    assert from_words.material == from_text.material
    assert from_words.radius == from_text.radius
    named = impactlaw.Case(material="ofhc-copper", radius=1e-3, velocities="2 m/s", tolerance=0.05)
    assert named.material["young_modulus_Pa"] > 1e11
    nested = impactlaw.Case(
        particle={"radius": 2.5e-4}, material={"density": 8960, "young_modulus": "128 GPa", "poisson_ratio": 0.343,
        "yield_strength": 162e6}, velocities=[1, 4, 10], tolerance=0.05,
    )  # fmt: skip
    assert nested.material == from_text.material and nested.radius == from_text.radius


def test_trajectories_end_in_the_rebound() -> None:
    law = impactlaw.Law(SOLDER)
    path, end = law.trajectory(5.0), law.rebound(5.0)
    assert path["displacement_m"].max() == end.max_displacement
    assert path["velocity_m_s"][-1] == pytest.approx(-5.0 * end.restitution)


def test_forces_beyond_the_law_are_warned_of() -> None:
    law = impactlaw.Law(SOLDER)
    with pytest.warns(UserWarning, match="1 of the displacements lie beyond"):
        law.force([1e-6, 0.9 * law.radius])


def test_quantities_of_pint_are_taken_with_their_units() -> None:
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    law = impactlaw.Law(SOLDER)
    delta = np.array([0.5, 1.0]) * unit.um
    assert np.allclose(law.force(delta), law.force([5e-7, 1e-6]), rtol=1e-14)
    assert law.rebound(100 * unit.cm / unit.s).restitution == law.rebound(1.0).restitution
    case = impactlaw.Case(
        radius=0.25 * unit.mm, density=8.96 * unit.g / unit.cm**3, young_modulus=128 * unit.GPa, poisson_ratio=0.343,
        yield_strength=162 * unit.MPa, velocities=[1 * unit.m / unit.s, 4, "10 m/s"], tolerance=0.05,
    )  # fmt: skip
    assert case.radius == pytest.approx(2.5e-4) and case.velocities.tolist() == [1.0, 4.0, 10.0]
    assert case.material["density_kg_m3"] == pytest.approx(8960)
    with pytest.raises(impactlaw.Error, match="displacement: .*must be a length"):
        law.force(1 * unit.kg)
    with pytest.raises(impactlaw.Error, match="radius: .*must be a length"):
        impactlaw.Case(radius=1 * unit.s)


def test_notebooks_are_shown_tables() -> None:
    runs = impactlaw.Case.from_toml(COPPER).impact()
    assert runs._repr_html_().count("<tr>") == 4
    assert "case" in impactlaw.Case.from_toml(COPPER).atlas()._repr_html_()


def test_cases_and_laws_go_to_other_processes() -> None:
    case = impactlaw.Case.from_toml(COPPER, name="cu")
    again = pickle.loads(pickle.dumps(case))
    assert again.toml == case.toml and again.name == "cu"
    law = case.atlas()
    assert pickle.loads(pickle.dumps(law)).toml == law.toml
    with pytest.raises(impactlaw.Error, match="has no law file"):
        pickle.dumps(case.theory("hertz"))
