"""What the tests share: cases, a scene, and the program that they compare with."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]

COPPER = """
[particle]
radius = "250 um"
[material]
density = "8960 kg/m3"
young_modulus = "128 GPa"
poisson_ratio = 0.343
yield_strength = "162 MPa"
[impact]
velocities = ["1 m/s", "4 m/s", "10 m/s"]
[accuracy]
tolerance = 0.05
"""

BEADS = """
seed = 3
laws = ["hertz", "thornton"]
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.25
yield_strength = "0.2 MPa"
[grains]
count = 200
radius = "1 mm"
spread = 0.1
stir = "0.1 m/s"
[contact]
friction = 0.4
restitution = 0.7
[box]
width = "12 mm"
depth = "12 mm"
height = "60 mm"
[[stage]]
kind = "settle"
longest = "0.1 s"
rest_speed = "5 mm/s"
[[stage]]
kind = "run"
duration = "5 ms"
[output]
rows = 20
"""

Program = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture(scope="session")
def program() -> Program:
    """Runs the program that was built without Python (`IMPACTLAW_PROGRAM`); where there is none, the one of the package."""
    name = os.environ.get("IMPACTLAW_PROGRAM") or shutil.which("impactlaw", path=str(Path(sys.executable).parent))
    assert name, "no program: set IMPACTLAW_PROGRAM"

    def run(*words: object, cwd: Path | None = None) -> "subprocess.CompletedProcess[str]":
        command = [name, *map(str, words)]
        return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False, timeout=300)

    return run


@pytest.fixture()
def copper(tmp_path: Path) -> Path:
    """A case file."""
    path = tmp_path / "copper.toml"
    path.write_text(COPPER)
    return path


@pytest.fixture()
def beads(tmp_path: Path) -> Path:
    """A scene file."""
    path = tmp_path / "beads.toml"
    path.write_text(BEADS)
    return path
