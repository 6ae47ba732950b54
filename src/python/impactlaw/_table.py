"""Verbs whose files become tables: studies, comparisons, the cost of accuracy.

They run in a process of their own, so that Ctrl-C ends them at once; what was finished stays in the folder and is not run again.
"""

import json
import os
import subprocess
import sys
import tomllib
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._impactlaw import Case, Error, columns_of
from ._types import Column, Place


class Table(dict[str, Column]):
    """Columns by the names they have in the file, in its order; `path` is the file, `met` whether the program's thresholds are met."""

    path: Path
    met: bool

    def __init__(self, path: Path, met: bool) -> None:
        super().__init__(columns_of(path))
        self.path = path
        self.met = met

    def to_pandas(self) -> Any:
        """The same as a data frame of pandas, which has to be installed."""
        import pandas

        return pandas.DataFrame(dict(self))

    def _repr_html_(self) -> str:
        from ._show import table_html

        return table_html(self)


def _run(words: Sequence[str]) -> bool:
    """Runs a verb; False if it fails a stated threshold."""
    command = [sys.executable, "-m", "impactlaw._verb", *words]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    try:
        said = json.loads(done.stdout)
    except ValueError:
        raise Error(f"the program ended with code {done.returncode} before it said how it came out") from None
    for text in said["warnings"]:
        warnings.warn(text, stacklevel=3)
    if said["error"]:
        error = Error(said["error"])
        error.report = said["report"]
        raise error
    return bool(said["met"])


def _name(path: Place) -> str:
    return Path(path).stem


def study(file: Place, *, out: Place | None = None, refine: int = 0) -> Table:
    """Runs the cases of a study file that are not there yet; the columns of `results.csv`.

    `out` is the folder (by default `out/` and the study's name). Compare `impactlaw help study`.
    """
    folder = Path("out") / _name(file) if out is None else Path(out)
    met = _run(["study", os.fspath(file), "--out", str(folder), "--refine", str(refine)])
    return Table(folder / "results.csv", met)


def compare(
    case: Place,
    *,
    law: Place | None = None,
    impacts: Place | None = None,
    out: Place | None = None,
    unverified: bool = False,
) -> Table:
    """Compares a law and the theories with simulated impacts; the columns of `compare.csv`.

    `impacts` is the folder with the impacts (by default `out/` and the case's name). Compare `impactlaw help compare`.
    """
    words = ["compare", os.fspath(case)]
    source = Path("out") / _name(case) if impacts is None else Path(impacts)
    folder = source / "compare-python" if out is None else Path(out)
    words += ["--impacts", str(source), "--out", str(folder)]
    words += [] if law is None else ["--law", os.fspath(law)]
    words += ["--unverified"] if unverified else []
    met = _run(words)
    return Table(folder / "compare.csv", met)


def cost(
    case: Place,
    *,
    velocity: float | None = None,
    quick: bool = False,
    ladders: Sequence[str] = (),
    out: Place | None = None,
) -> Table:
    """What accuracy costs at a speed in m/s, by default the case's fastest: ladders of settings, their errors and times.

    The columns of `cost_V*.csv` of that speed; finished runs stay in the folder. Compare `impactlaw help cost`.
    """
    folder = Path("out") / _name(case) if out is None else Path(out)
    speed = float(Case.from_toml(Path(case)).velocities[-1]) if velocity is None else velocity
    words = ["cost", os.fspath(case), "--out", str(folder), "--velocity", f"{speed!r} m/s"]
    words += [word for ladder in ladders for word in ("--ladder", ladder)]
    words += ["--quick"] if quick else []
    met = _run(words)
    return Table(folder / "cost" / f"cost_V{np.format_float_positional(speed, trim='-')}.csv", met)


def inverse(
    measurements: Place,
    *,
    case: Place | None = None,
    out: Place | None = None,
    estimate: Sequence[str] = ("yield",),
    **options: float | str | bool,
) -> dict[str, Any]:
    """Yield strength, or that and hardening, from a table of measured impacts; what `inverse.toml` holds.

    Further options are those of `impactlaw help inverse` with `_` for `-`: `sigma_young=0.03`, `young="128 GPa"`, `refine=True`.
    """
    folder = Path("out") / _name(measurements) if out is None else Path(out)
    words = ["inverse", os.fspath(measurements), "--out", str(folder), "--estimate", ",".join(estimate)]
    words += [] if case is None else ["--case", os.fspath(case)]
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not False:
            words += [option, str(value)]
    _run(words)
    with (folder / "inverse.toml").open("rb") as file:
        return tomllib.load(file)
