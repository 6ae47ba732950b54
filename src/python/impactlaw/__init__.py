"""Contact laws for discrete-element codes, from simulated impacts of yielding particles.

    import impactlaw
    case = impactlaw.Case.from_toml("copper.toml")
    runs = case.impact()
    law = runs.fit()
    print(law.rebound(10.0).restitution)

Numbers are SI; texts with units ("250 um") are taken wherever a number is. What the library refuses is raised as `Error`.
"""

from ._impactlaw import (
    Bed,
    Case,
    Error,
    Impact,
    Impacts,
    Law,
    Rebound,
    theories,
    version,
)
from ._law import atlas
from ._table import Table, compare, cost, inverse, study
from ._types import Given

__version__ = version().split()[-1]
__all__ = [
    "Bed",
    "Case",
    "Error",
    "Given",
    "Impact",
    "Impacts",
    "Law",
    "Rebound",
    "Table",
    "atlas",
    "compare",
    "cost",
    "inverse",
    "study",
    "theories",
    "version",
]
