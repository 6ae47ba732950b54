"""Laws without a simulation."""

from ._impactlaw import Case, Law
from ._types import Given


def atlas(
    *,
    young: Given,
    yield_: Given,
    poisson: float,
    density: Given,
    radius: Given = 1e-3,
    hardening: Given | None = None,
    name: str = "atlas",
) -> Law:
    """Law that the atlas has for a material, in milliseconds.

    It serves every size; the radius is that of bodies where none is given. What no case may have, what looks like a slip of a unit
    and what lies outside the atlas is refused.
    """
    case = Case(
        name=name,
        radius=radius,
        density=density,
        young_modulus=young,
        poisson_ratio=poisson,
        yield_strength=yield_,
        hardening_modulus=hardening,
        velocities=["1 m/s"],
        tolerance=0.02,
    )
    return case.atlas()
