"""The compiled part of the package. Numbers are SI."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, final, overload

from ._types import Column, Floats, Given, Many, Place, Theory, Wholes

__all__ = [
    "Bed",
    "Case",
    "Error",
    "Impact",
    "Impacts",
    "Law",
    "Rebound",
    "columns_of",
    "fall",
    "main",
    "theories",
    "verb",
    "version",
]

class Error(Exception):
    """What the library or the program cannot do: the place, what was found, and what is allowed."""

    report: str
    """The text as the program prints it, with the line of the file."""

@final
class Case:
    """What is asked for: a particle, its material, speeds and accuracy, checked by the reader of case files.

    Keywords are the keys of a case file (`impactlaw help case`): those of its tables `[particle]`, `[material]`, `[impact]`, `[accuracy]`,
    `[wall]` and `[scheme]` by their own names, tables as dicts. A number gets the SI unit of its key.
    """

    def __new__(
        cls,
        *,
        name: str = "case",
        radius: Given | None = None,
        shape: Literal["sphere", "cylinder"] | None = None,
        length: Given | None = None,
        material: str | Mapping[str, Any] | None = None,
        density: Given | None = None,
        young_modulus: Given | None = None,
        poisson_ratio: float | None = None,
        yield_strength: Given | None = None,
        hardening_modulus: Given | None = None,
        velocities: Given | Sequence[Given] | Floats | None = None,
        angle: Given | None = None,
        friction: float | None = None,
        tolerance: float | None = None,
        unusual: Sequence[str] | None = None,
        **keywords: Any,
    ) -> Case: ...
    @staticmethod
    def from_toml(source: Place, *, name: str = "case") -> Case:
        """A case file, or its text: a str that holds a line break is a text, and `name` is the case's name."""

    @staticmethod
    def _of(text: str, path: Place) -> Case: ...

    @property
    def name(self) -> str: ...
    @property
    def toml(self) -> str:
        """Text of the case file."""

    @property
    def radius(self) -> float: ...
    @property
    def tolerance(self) -> float: ...
    @property
    def velocities(self) -> Floats: ...
    @property
    def material(self) -> dict[str, float]:
        """Constants by the names that law files give them."""

    def plan(self) -> dict[str, Any]:
        """What would be run and the predicted seconds: what `impactlaw plan --json` prints."""

    def plan_text(self) -> str:
        """The same as a person reads it, with reasons."""

    def impact(self) -> Impacts:
        """Simulates every speed, on all cores. Ctrl-C ends it. A run that did not end says so in its `status`."""

    def atlas(self) -> Law:
        """The law that the atlas has for the material, in milliseconds."""

    def theory(self, name: str) -> Law:
        """The law of a theory for the material."""

    def theories(self) -> list[str]:
        """Names of the theories that have a law of the material."""

@final
class Impacts:
    """Impacts of a case, slowest first."""

    def __len__(self) -> int: ...
    def __getitem__(self, index: int, /) -> Impact: ...
    def __iter__(self) -> Iterator[Impact]: ...
    @property
    def figures(self) -> dict[str, Floats]:
        """Figures that are numbers in all of them, as columns: `velocity_m_s`, `restitution`, `max_force_N`, ..."""

    def fit(self) -> Law:
        """Law fitted to all of them: what `impactlaw run` and `fit` write to `law.toml`."""

    def compare(self, law: Law | None = None, *, unverified: bool = False) -> dict[str, Column]:
        """Rows of `compare.csv` as columns: the impacts, theories, and `law` if it has a law file."""

    def plot(self, law: Law | None = None) -> Any:
        """Force against displacement of every impact, and under `law`, as a figure of matplotlib, which has to be installed."""

    def _repr_html_(self) -> str: ...
    def save(self, folder: Place) -> None:
        """Writes the folders `impact_V*` that `impactlaw fit` and `compare` read."""

@final
class Impact:
    """One impact: figures, curve, and the particle at two moments."""

    @property
    def velocity(self) -> float: ...
    @property
    def status(self) -> str:
        """`ok`, `sticks`, `no_rebound`, or why it failed."""

    @property
    def warnings(self) -> list[str]: ...
    @property
    def figures(self) -> dict[str, Any]:
        """What `summary.json` holds; what a failed run could not find is NaN."""

    @property
    def columns(self) -> dict[str, Floats]:
        """What `curve.csv` holds."""

    def particle(self, moment: Literal["compressed", "rebound"]) -> dict[str, Column]:
        """Material points and surface at the largest displacement or after the rebound."""

@final
class Law:
    """A law of one body pressed by a rigid plane.

    Two equal spheres at the approach 2 delta have the force of one at delta. Bodies have the radius of the impacts it rests on where
    none is given; a law serves every radius.
    """

    def __new__(cls, path: Place, form: Literal["closed_form", "spline", "hertz"] | None = None) -> Law: ...
    @property
    def name(self) -> str: ...
    @staticmethod
    def from_toml(text: str) -> Law:
        """The law of a law file's text."""

    @property
    def form(self) -> str:
        """`closed_form`, `spline`, `hertz`, or `theory`."""

    @property
    def radius(self) -> float: ...
    @property
    def valid_to(self) -> float:
        """Largest displacement over radius that its source supports."""

    @property
    def velocities(self) -> tuple[float, float] | None:
        """Speeds of the impacts it rests on, m/s; none of a theory."""

    @property
    def warnings(self) -> list[str]: ...
    @property
    def material(self) -> dict[str, float]: ...
    @property
    def worst_error(self) -> float | None:
        """Largest relative error of F*, delta* and e against its own impacts; none where it has none of its own."""

    @property
    def toml(self) -> str:
        """Text of the law file."""

    def as_dict(self) -> dict[str, Any]:
        """What the law file holds."""

    @overload
    def force(self, displacement: Given, *, radius: Given | None = None) -> float: ...
    @overload
    def force(self, displacement: Many, *, radius: Given | None = None) -> Floats:
        """Force on first loading, N, without inertia: what `impactlaw law eval` prints."""

    @overload
    def unload(self, displacement: Given, largest: Given, *, radius: Given | None = None) -> float: ...
    @overload
    def unload(self, displacement: Many, largest: Given, *, radius: Given | None = None) -> Floats:
        """Force on the way back from the displacement `largest`, and up to it again, N."""

    def rebound(self, velocity: Given | Many, *, radius: Given | None = None) -> Rebound:
        """Impact of a sphere on the rigid plane, with the law's inertia."""

    def trajectory(self, velocity: Given, *, radius: Given | None = None) -> dict[str, Floats]:
        """Such an impact from first touch to loss of contact: `time_s`, `displacement_m`, `velocity_m_s`, `force_N`."""

    def save(self, path: Place) -> None:
        """Writes the law file, over what stands there."""

    def export(self, target: str, folder: Place) -> list[Any]:
        """Writes the law for another code into `folder`, over what stands there; returns the files."""

    def plot(self, *, speeds: int = 40) -> Any:
        """Force and restitution as a figure of matplotlib, which has to be installed."""

    def _repr_html_(self) -> str: ...

@final
class Rebound:
    """Impacts under a law: floats, or arrays of the form of the speeds."""

    @property
    def velocity(self) -> Any: ...
    @property
    def restitution(self) -> Any: ...
    @property
    def max_force(self) -> Any:
        """F*, N."""

    @property
    def max_displacement(self) -> Any:
        """delta*, m."""

    @property
    def residual_displacement(self) -> Any:
        """Displacement at loss of contact, m."""

    @property
    def contact_time(self) -> Any:
        """First touch to loss of contact, s."""

@final
class Bed:
    """A scene under one of its laws, step by step, with the bits of `impactlaw bed`; no file is written.

    `positions`, `velocities` and `radii` are views of the bed's memory, not copies. They are read only and show the grains as they stood
    when the view was taken: a bed that is stepped while a view lives leaves the memory to the view and goes on with a copy, once a call.
    """

    def __new__(
        cls, scene: Place, *, law: str | None = None, fitted: Law | None = None, seed: int | None = None
    ) -> Bed: ...
    def step(self, steps: int = 1) -> int:
        """Up to `steps` steps through the scene's stages; fewer only at their end. Returns how many. Ctrl-C ends it."""

    def run(self) -> int:
        """Runs the stages that are left."""

    @property
    def time(self) -> float: ...
    @property
    def time_step(self) -> float: ...
    @property
    def steps(self) -> int:
        """Steps done; counted anew once the packing is made."""

    @property
    def stage(self) -> str: ...
    @property
    def is_over(self) -> bool: ...
    def __len__(self) -> int: ...
    @property
    def positions(self) -> Floats: ...
    @property
    def velocities(self) -> Floats: ...
    @property
    def radii(self) -> Floats: ...
    @property
    def ids(self) -> Wholes:
        """Names of the grains: they stay when the order changes."""

    def contacts(self) -> dict[str, Any]:
        """Contacts that carry force: `grain`, `other_grain` or `body` (-1: none), `position_m`, `normal`, `force_N`, `overlap_m`, ..."""

    def rows(self, *, packing: bool = False) -> dict[str, Column]:
        """Rows of `bed.csv` so far, of the packing or of the stages under the law."""

def theories() -> list[Theory]:
    """Every published model."""

def version() -> str:
    """Name and version of the program."""

def fall(text: str) -> None:
    """Falls, as the library would if it had a fault: for the tests."""

def main(words: Sequence[str]) -> int: ...
def verb(words: Sequence[str]) -> bool: ...
def columns_of(path: Place) -> dict[str, Column]: ...
