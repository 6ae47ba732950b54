"""How things look in a notebook."""

from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np

from ._impactlaw import Impacts, Law

MOST_ROWS = 30
LOADING, BACK = "#1f5fa8", "#b5482f"


def _cell(value: object) -> str:
    if isinstance(value, (float, np.floating)):
        return f"{value:.5g}"
    return escape(str(value))


def _rows(names: list[str], rows: list[list[object]]) -> str:
    head = "".join(f"<th>{escape(name)}</th>" for name in names)
    body = "".join("<tr>" + "".join(f"<td>{_cell(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def table_html(columns: Mapping[str, Any]) -> str:
    """The first rows of a table of columns."""
    names = list(columns)
    length = max((len(columns[name]) for name in names), default=0)
    rows = [[columns[name][i] for name in names] for i in range(min(length, MOST_ROWS))]
    more = f"<p>{length - MOST_ROWS} rows more</p>" if length > MOST_ROWS else ""
    return _rows(names, rows) + more


def law_html(law: Law) -> str:
    """What there is to say of a law."""
    said: list[list[object]] = [
        ["form", law.form],
        ["radius of the impacts, m", law.radius],
        ["largest delta/R", law.valid_to],
    ]
    if law.velocities is not None:
        said.append(["speeds, m/s", f"{law.velocities[0]:.5g} to {law.velocities[1]:.5g}"])
    if law.worst_error is not None:
        said.append(["largest error of F*, delta*, e", law.worst_error])
    said += [[name, value] for name, value in law.material.items()]
    said += [["warning", text] for text in law.warnings]
    return _rows([f"law {law.name}", ""], said)


def plot_law(law: Law, *, speeds: int = 40) -> Any:
    """Force against displacement, first loading and ways back, and restitution against speed; a figure of matplotlib."""
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    most = min(law.valid_to, 0.5) * law.radius
    delta = np.linspace(0.0, most, 400)
    left.plot(1e6 * delta, law.force(delta), color=LOADING, label="first loading")
    for share in (0.25, 0.5, 1.0):
        largest = share * most
        back = np.linspace(0.0, largest, 400)
        label = "way back" if share == 1.0 else None
        left.plot(1e6 * back, law.unload(back, largest), color=BACK, linewidth=1, label=label)
    left.set(xlabel="displacement, um", ylabel="force, N", title=law.name)
    left.legend()
    low, high = (0.01, 100.0) if law.velocities is None else law.velocities
    velocity = np.geomspace(low, max(high, 1.01 * low), speeds)
    right.semilogx(velocity, law.rebound(velocity).restitution, color=LOADING)
    right.set(xlabel="speed, m/s", ylabel="restitution", ylim=(0, 1.02))
    return figure


SHOWN = ["velocity_m_s", "restitution", "max_force_N", "max_displacement_m", "residual_displacement_m", "contact_time_s"]


def impacts_html(runs: Impacts) -> str:
    """Figures of every impact."""
    return _rows([*SHOWN, "status"], [[*(one.figures[name] for name in SHOWN), one.status] for one in runs])


def plot_impacts(runs: Impacts, law: Law | None = None) -> Any:
    """Force against displacement of every impact, and under a law; a figure of matplotlib."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 4), constrained_layout=True)
    for one in runs:
        columns = one.columns
        axes.plot(1e6 * columns["displacement_m"], columns["force_N"], color=LOADING, linewidth=1)
        if law is not None:
            path = law.trajectory(one.velocity)
            axes.plot(1e6 * path["displacement_m"], path["force_N"], color=BACK, linewidth=1, linestyle="--")
    axes.set(xlabel="displacement, um", ylabel="force, N", title="impacts" if law is None else f"impacts, and law {law.name} (dashed)")
    return figure
