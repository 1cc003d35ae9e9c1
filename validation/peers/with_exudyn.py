"""Exudyn's settings: what is tried, which of it is kept, and how one runs."""

import time
from dataclasses import dataclass

import exudyn_models as models
import problems
from exudyn_models import exu

EXPLICIT = ("RK44", "RK67", "VelocityVerlet")
ADAPTIVE = ("ODE23", "DOPRI5")
SMALLEST = 1e-15


@dataclass(frozen=True)
class Setting:
    """A method and a formulation; `size` is the number of steps, or the relative tolerance of a method that chooses its steps.

    With `jump` steps are shortened until a contact begins within this tolerance of Exudyn's, to SMALLEST.
    """

    method: str
    size: float
    form: str = "bodies"
    radius: float = 0.9
    modified: bool = True
    newton: float = 1e-6
    linear: str = "EXUdense"
    jump: float = 0.0

    def __str__(self):
        size = f"rtol {self.size:g}" if self.method in ADAPTIVE else f"{self.size:g} steps"
        words = [self.form, self.method, size]
        if self.method == "alpha":
            words.append(f"radius {self.radius:g}")
        if self.method in ("alpha", "trapezoidal"):
            words.append(f"{'modified' if self.modified else 'full'} Newton to {self.newton:g}, {self.linear}")
        if self.jump:
            words.append(f"discontinuities to {self.jump:g}")
        return ", ".join(words)


def build(row, mbs, form):
    """What reads the error after a run; end of the motion, number of samples."""
    kind, size = row.problem, row.size
    makers = {"chain": models.chain, "A02": models.four_bars}
    if kind in makers:
        error = makers[kind](mbs, form, size)
    else:
        error = {"A01": models.pendulum, "A03": models.squeezer, "lock": models.lock, "clearance": models.clearance}[kind](
            mbs, form)
    return error, *problems.span(kind)


def simulation_settings(setting, end, samples):
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = end / samples
    settings.parallel.numberOfThreads = 1
    settings.linearSolver.solverType = getattr(exu.LinearSolverType, setting.linear)
    settings.linearSolver.reuseAnalyzedPattern = setting.linear == "EigenSparse"
    integration = settings.timeIntegration
    integration.endTime = end
    integration.verboseMode = 0
    integration.adaptiveStep = setting.jump > 0
    if setting.jump:
        integration.minimumStepSize = SMALLEST
        integration.discontinuous.iterationTolerance = setting.jump
    if setting.method in ADAPTIVE:
        integration.numberOfSteps = samples
        integration.relativeTolerance, integration.absoluteTolerance = setting.size, setting.size
        integration.initialStepSize = 1e-4 * end
    else:
        integration.numberOfSteps = int(setting.size)
        integration.automaticStepSize = False
    integration.explicit.computeEndOfStepAccelerations = False
    integration.newton.relativeTolerance = setting.newton
    integration.newton.useModifiedNewton = setting.modified
    integration.generalizedAlpha.spectralRadius = setting.radius
    integration.generalizedAlpha.useIndex2Constraints = setting.method == "trapezoidal"
    integration.generalizedAlpha.useNewmark = setting.method == "trapezoidal"
    if setting.method in EXPLICIT + ADAPTIVE:
        integration.solverType = getattr(exu.DynamicSolverType, setting.method)
    return settings


def prepare(row, setting):
    """A function that integrates once and returns error and CPU seconds."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    error, end, samples = build(row, mbs, setting.form)
    mbs.Assemble()
    settings = simulation_settings(setting, end, samples)
    kind = exu.MainSolverExplicit if setting.method in EXPLICIT + ADAPTIVE else exu.MainSolverImplicitSecondOrder

    def run():
        _ = container  # Owns the system.
        solver = kind()
        begin = time.process_time()
        done = solver.SolveSystem(mbs, settings)
        cpu = time.process_time() - begin
        if not done:
            raise RuntimeError("it gave up")
        return error(), cpu
    return run


# ---------------------------------------------------------------- settings that are tried

IMPLICIT = [
    dict(method=method, radius=radius, modified=modified, newton=newton)
    for method, radius in (("alpha", 0.9), ("alpha", 0.8), ("alpha", 0.6), ("alpha", 0.95), ("alpha", 1.0), ("alpha", 0.3),
                           ("alpha", 0.0), ("trapezoidal", 1.0))
    for modified in (False, True)
    for newton in (1e-6, 1e-4, 1e-3, 1e-8)
]


def implicit(forms, linears):
    return [Setting(size=0, form=form, linear=linear, **words) for form in forms for linear in linears for words in IMPLICIT]


def explicit(forms, **words):
    return [Setting(method, 0, form, **words) for form in forms for method in EXPLICIT + ADAPTIVE]


def grid(row):
    """All settings that are sensible for a row, without their sizes; those that are likely to win first."""
    small, middle, large = ("EXUdense", "EigenDense"), ("EigenSparse", "EXUdense"), ("EigenSparse",)
    if row.problem == "A01":
        return explicit(("rotors", "held", "tree")) + implicit(("rod", "rotors"), small)
    if row.problem == "A02":
        return implicit(("rotors", "bodies"), large if row.size > 10 else middle if row.size > 1 else small)
    if row.problem == "A03":
        return implicit(("rotors", "bodies"), small)
    if row.problem == "chain":
        return explicit(("tree",)) + implicit(("bodies", "tree"), large if row.size > 10 else middle)
    if row.problem == "lock":
        return implicit(("speed", "clock"), middle)
    jumps = [setting for jump in (1e-2, 1e-1, 1, 10, 100) for setting in explicit(("tree",), jump=jump)]
    return jumps + [Setting("alpha", 0, form, radius=radius, jump=jump, newton=1e-8, linear="EigenDense")
                    for form in ("tree", "bodies") for radius in (0.6, 0.9, 1.0) for jump in (1.0, 10.0, 100.0)]


def sizes(setting, samples):
    """A fine ladder from cheap to dear."""
    if setting.method in ADAPTIVE:
        return [10 ** (-half / 2) for half in range(6, 25)]
    return problems.steps(samples)


# ---------------------------------------------------------------- settings that are kept


def alpha(sizes, radius, newton, linear="EXUdense", modified=False, form="rotors"):
    return Setting("alpha", 0, form, radius, modified, newton, linear), sizes


def freely(method, sizes, form="tree", jump=0.0):
    return Setting(method, 0, form, jump=jump), sizes


# By row: settings and the sizes tried of each.
KEPT = {
    "A01-1e-6": (
        freely("RK67", (100, 200, 300), "rotors"), freely("RK67", (200,), "held"), freely("RK44", (400, 600), "rotors"),
        freely("DOPRI5", (1e-8, 10**-8.5), "rotors"),
    ),
    "A02-1-1e-4": (alpha((10000, 14000, 20000), 0.95, 1e-3), alpha((10000, 14000), 0.95, 1e-4), alpha((10000, 14000), 0.9, 1e-4)),
    "A02-1-1e-6": (alpha((100000, 140000, 200000), 0.95, 1e-6), alpha((140000,), 0.95, 1e-8)),
    "A02-10-1e-4": (alpha((10000, 14000, 20000), 0.95, 1e-3, "EigenSparse"), alpha((14000,), 0.95, 1e-4, "EigenSparse")),
    "A02-40-1e-4": (alpha((10000, 14000, 20000), 0.95, 1e-3, "EigenSparse"),),
    "A02-100-1e-4": (alpha((10000, 14000), 0.95, 1e-3, "EigenSparse"),),
    "A02-1000-1e-3": (alpha((4000,), 0.95, 1e-3, "EigenSparse"),),
    "A03-1e-3": (
        alpha((280, 400, 560), 0.9, 1e-3, modified=True), alpha((280, 400), 0.8, 1e-3, modified=True),
        alpha((280, 400), 0.6, 1e-3, modified=True),
    ),
    "A03-1e-6": (alpha((14000, 20000, 28000), 0.6, 1e-6), alpha((14000, 20000), 0.9, 1e-6), alpha((20000,), 0.8, 1e-6)),
    "chain-10-1e-5": (freely("DOPRI5", (1e-4, 10**-4.5, 1e-5)), freely("RK67", (140, 200, 280))),
    "chain-50-1e-5": (freely("DOPRI5", (1e-3, 10**-3.5)), freely("RK67", (800, 1000))),
    "chain-100-1e-5": (alpha((10000, 14000), 0.95, 1e-4, "EigenSparse", form="bodies"), freely("DOPRI5", (1e-3,))),
    "lock-1e-4": tuple(
        alpha((2000,), radius, newton, form="speed") for radius in (0.6, 0.3, 0.0) for newton in (1e-3, 1e-4, 1e-6)
    ),
    "clearance-1e-2": (
        freely("RK67", (67200, 96000, 140160), jump=10), freely("RK67", (140160,), jump=1e-2), freely("RK44", (96000,), jump=1),
    ),
    "clearance-1e-3": (
        (Setting("RK67", 0, "tree", newton=1e-8, linear="EigenDense", jump=10), (140160,)), freely("RK67", (140160,), jump=10),
    ),
}
