"""Errors, panics, interrupts, threads and memory at the border between Python and Rust."""

import gc
import multiprocessing
import os
import random
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import impactlaw
import numpy as np
import pytest
from conftest import COPPER, ROOT, Program

SOLDER = ROOT / "models/sac305-solder.toml"

SLIPS = {
    "negative radius": COPPER.replace('"250 um"', '"-1 um"'),
    "no unit": COPPER.replace('"250 um"', '"250"'),
    "wrong unit": COPPER.replace('"250 um"', '"250 kg"'),
    "poisson": COPPER.replace("0.343", "0.5"),
    "unknown key": COPPER.replace("poisson_ratio", "poison_ratio"),
    "no speeds": COPPER.replace('["1 m/s", "4 m/s", "10 m/s"]', "[]"),
    "a speed twice": COPPER.replace('"4 m/s"', '"1 m/s"'),
    "tolerance": COPPER.replace("0.05", "0.5"),
    "slip of a unit": COPPER.replace("162 MPa", "162 Pa"),
    "no table": COPPER.replace("[accuracy]", "[acuracy]"),
    "no TOML": COPPER.replace("[material]", "[material"),
    "yield over modulus": COPPER.replace("162 MPa", "162 GPa"),
    "a scene": "[[stage]]\nkind = 'settle'\n",
}


@pytest.mark.parametrize("slip", SLIPS)
def test_errors_of_cases_have_the_text_of_the_program(slip: str, program: Program, tmp_path: Path) -> None:
    path = tmp_path / "slip.toml"
    path.write_text(SLIPS[slip])
    with pytest.raises(impactlaw.Error) as error:
        impactlaw.Case.from_toml(path)
    done = program("impact", path, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert str(error.value) in done.stderr
    assert error.value.report == done.stderr


def test_other_errors_have_the_text_of_the_program(program: Program, tmp_path: Path) -> None:
    missing = tmp_path / "missing.toml"
    law: Callable[..., object] = impactlaw.Law
    tries: list[tuple[Callable[[], object], list[object]]] = [
        (lambda: impactlaw.Law(missing), ["law", "eval", missing, "--body", "1 mm", "--displacements", "1 um"]),
        (lambda: law(SOLDER, "cubic"), []),
        (lambda: impactlaw.Case.from_toml(COPPER).theory("thorton"), []),
        (lambda: impactlaw.Bed(missing), ["bed", missing]),
        (lambda: impactlaw.study(missing, out=tmp_path / "s"), ["study", missing]),
        (lambda: impactlaw.compare(missing, out=tmp_path / "s"), ["compare", missing]),
        (lambda: impactlaw.cost(missing, out=tmp_path / "s"), ["cost", missing]),
    ]
    for work, words in tries:
        with pytest.raises(impactlaw.Error) as error:
            work()
        if words:
            assert str(error.value) in program(*words).stderr
    with pytest.raises(impactlaw.Error, match="must be one of .*thornton"):
        impactlaw.Case.from_toml(COPPER).theory("thorton")
    with pytest.raises(impactlaw.Error, match="must be one of .*liggghts"):
        impactlaw.Law(SOLDER).export("ligghts", tmp_path)
    with pytest.raises(impactlaw.Error, match="a body that is flattened, not gone"):
        impactlaw.Law(SOLDER).force(1.0)
    with pytest.raises(impactlaw.Error, match="on the way back no displacement is larger"):
        impactlaw.Law(SOLDER).unload("2 um", "1 um")
    with pytest.raises(impactlaw.Error, match="must be one of radius"):
        impactlaw.Case(radus=1e-3)
    with pytest.raises(impactlaw.Error, match="has no law file"):
        impactlaw.Case.from_toml(COPPER).theory("hertz").save(tmp_path / "hertz.toml")
    assert not (tmp_path / "hertz.toml").exists()


def test_no_argument_makes_the_library_fall(tmp_path: Path) -> None:
    chance = random.Random(19)
    values: list[object] = [
        None, True, 0, -1, 1, 10**40, 0.0, -0.0, 1e-300, 1e300, float("nan"), float("inf"), -float("inf"), "", "1", "1 m",
        "1 m/s", "-3 um", "nan m", "inf m", "1e400 m", "\0", "ü µm", "\ud800", "a\nb", b"1 m", [], [1.0], [[1.0], [2.0, 3.0]], [None],
        {}, {"radius": 1}, {1: 2}, (), object(), np.zeros(0), np.zeros((2, 0)), np.array("x"), np.float32(1), np.int8(3),
        np.array([1 + 2j]), np.arange(6).reshape(2, 3)[:, ::-1], np.array([np.nan, np.inf]), tmp_path, Path("\n"), SOLDER, COPPER,
    ]  # fmt: skip
    case, law = impactlaw.Case.from_toml(COPPER), impactlaw.Law(SOLDER)
    theory = case.theory("thornton")
    keys = [
        "radius", "density", "young_modulus", "poisson_ratio", "yield_strength", "velocities", "tolerance", "material",
        "shape", "length", "angle", "friction", "wall", "scheme", "bed", "unusual", "name", "preset", "hardening_modulus", "x y",
    ]  # fmt: skip
    anything: list[Callable[..., object]] = [
        impactlaw.Case.from_toml, impactlaw.Law, impactlaw.Bed, case.theory, law.force, law.unload, law.rebound,
        law.trajectory, theory.force, theory.rebound, theory.unload, law.export, law.save, impactlaw.atlas,
        impactlaw._impactlaw.columns_of, impactlaw._impactlaw.verb,
    ]  # fmt: skip
    allowed = (impactlaw.Error, TypeError, ValueError, OverflowError, UnicodeError, RuntimeError)
    begun, outcomes = time.monotonic(), {True: 0, False: 0}
    before = os.getcwd()
    os.chdir(tmp_path)
    try:
        for _ in range(4000):
            if time.monotonic() - begun > 20:
                break
            if chance.random() < 0.5:
                given: dict[str, Any] = {chance.choice(keys): chance.choice(values) for _ in range(chance.randint(0, 8))}
                work: Callable[[], object] = lambda: impactlaw.Case(**given)  # noqa: B023
            else:
                call = chance.choice(anything)
                plain = [chance.choice(values) for _ in range(chance.randint(0, 3))]
                named = {"radius": chance.choice(values)} if chance.random() < 0.3 else {}
                work = lambda: call(*plain, **named)  # noqa: B023
            try:
                work()
                outcomes[True] += 1
            except allowed as error:
                assert "a fault that should be reported" not in str(error), error
                outcomes[False] += 1
    finally:
        os.chdir(before)
    assert outcomes[True] > 20 and outcomes[False] > 500, outcomes


def test_a_fault_of_the_library_is_an_error_and_no_panic() -> None:
    with pytest.raises(impactlaw.Error, match="a fault that should be reported: on purpose"):
        impactlaw._impactlaw.fall("on purpose")
    with pytest.raises(impactlaw.Error, match="again"):
        impactlaw._impactlaw.fall("again")


def resident() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc: memory is NOT measured")
def test_memory_stays_flat_over_ten_thousand_calls() -> None:
    law, delta = impactlaw.Law(SOLDER), np.linspace(0, 1e-5, 1000)

    def once() -> None:
        law.force(delta)
        law.unload(delta, "20 um")
        assert isinstance(law.rebound(1.0).restitution, float)
        _ = law.material, law.velocities
        impactlaw.Case.from_toml(COPPER)
        with pytest.raises(impactlaw.Error):
            law.force(1.0)

    for _ in range(500):
        once()
    gc.collect()
    before = resident()
    for _ in range(2000):
        once()
    gc.collect()
    grown = resident() - before
    # 10 000 calls into the library and more: one array of each kept would be 32 MB
    assert grown < 2_000_000, grown


def test_threads_get_the_same_bits_side_by_side() -> None:
    case = impactlaw.Case.from_toml(COPPER)
    found: list[str] = []

    def work() -> None:
        found.append(case.impact().fit().toml)

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 2 and found[0] == found[1] == case.impact().fit().toml


def test_other_threads_go_on_while_an_impact_runs() -> None:
    case, counted, over = impactlaw.Case.from_toml(COPPER), [0], threading.Event()

    def count() -> None:
        while not over.is_set():
            counted[0] += 1
            time.sleep(1e-3)

    thread = threading.Thread(target=count)
    thread.start()
    begun = time.perf_counter()
    case.impact()
    seconds, steps = time.perf_counter() - begun, counted[0]
    over.set()
    thread.join()
    assert steps > 50 * seconds, (steps, seconds)


LONG = """
import impactlaw, signal, sys
# who started the tests in the background ignores interrupts, and so would this
signal.signal(signal.SIGINT, signal.default_int_handler)
case = impactlaw.Case(radius=1e-3, density=8000, young_modulus=1e11, poisson_ratio=0.3, yield_strength=2e8,
    velocities=[1, 2, 3, 4, 5], tolerance=0.002)
assert case.plan()["impacts"][0]["predicted_core_s"] > 5
print("begun", flush=True)
try:
    case.impact()
except KeyboardInterrupt:
    print("interrupted", flush=True)
    print(case.atlas().rebound(1.0).restitution > 0, flush=True)
"""


def test_ctrl_c_ends_impacts_and_the_session_goes_on() -> None:
    process = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    time.sleep(1.0)
    begun = time.perf_counter()
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=60)
    assert said == "interrupted\nTrue\n"
    assert time.perf_counter() - begun < 3


def fitted(text: str) -> str:
    return impactlaw.Case.from_toml(text).impact().fit().toml


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork here")
def test_a_forked_process_has_threads_of_its_own() -> None:
    here = fitted(COPPER)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(fitted, (COPPER,)).get(timeout=120) == here


def test_the_command_line_is_the_program(program: Program, copper: Path, tmp_path: Path) -> None:
    own = [sys.executable, "-m", "impactlaw"]

    def run(*words: str) -> "subprocess.CompletedProcess[str]":
        return subprocess.run([*own, *words], capture_output=True, text=True, check=False)

    assert run("--version").stdout == program("--version").stdout != ""
    assert run("plan", str(copper)).stdout == program("plan", copper).stdout
    wrong = run("plan", str(tmp_path / "none.toml"))
    assert wrong.returncode == 2 and wrong.stderr == program("plan", tmp_path / "none.toml").stderr
    assert run("pla").returncode == program("pla").returncode == 2
