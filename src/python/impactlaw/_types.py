"""Names of types."""

import os
from collections.abc import Sequence
from typing import Any, TypeAlias, TypedDict

import numpy as np

Floats: TypeAlias = np.ndarray[Any, np.dtype[np.float64]]
Wholes: TypeAlias = np.ndarray[Any, np.dtype[np.int64]]
Column: TypeAlias = Floats | Wholes | list[str]
Given: TypeAlias = float | str
"""A number in SI units, or a text with its unit."""
Many: TypeAlias = np.ndarray[Any, Any] | Sequence[float] | Sequence[Sequence[float]]
Place: TypeAlias = str | os.PathLike[str]


class Theory(TypedDict):
    """A published model, as `theories` tells of it."""

    name: str
    summary: str
    papers: list[str]
    needs: list[str]
    gives_force: bool
    closed_form_restitution: bool
    checked: bool
