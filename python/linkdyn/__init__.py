"""Planar multibody dynamics of linkages.

>>> import linkdyn
>>> m = linkdyn.load("four-bar")
>>> r = m.set({"parameters.crank": "90 mm"}).run()
>>> r["driver.motor.effort"].shape
(401,)

All numbers are in SI units; ``r.units`` names them.
"""

from ._linkdyn import __version__
from .answer import Answer
from .builder import Mechanism
from .equations import Equations
from .errors import (
    Complaint,
    InternalError,
    Interrupted,
    LinkdynError,
    ModelError,
    SolveError,
    UnitError,
    UnknownModel,
    UnknownName,
)
from .family import Family, Variants
from .function import Function
from .linear import LinearSystem
from .model import Model, import_model, load, models
from .run import Run
from .simulation import Checkpoint, Simulation
from .study import Study, Table

__all__ = [
    "Answer",
    "Checkpoint",
    "Complaint",
    "Equations",
    "Family",
    "Function",
    "InternalError",
    "Interrupted",
    "LinearSystem",
    "LinkdynError",
    "Mechanism",
    "Model",
    "ModelError",
    "Run",
    "Simulation",
    "SolveError",
    "Study",
    "Table",
    "UnitError",
    "UnknownModel",
    "UnknownName",
    "Variants",
    "__version__",
    "import_model",
    "load",
    "models",
]
