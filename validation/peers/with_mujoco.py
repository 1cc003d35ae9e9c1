"""MuJoCo's settings: what is tried, which of it is kept, and how one runs.

A mechanism is a tree of hinges along the pins in their order; pins that close a loop become `connect` constraints, which are
soft: `solref` is their time constant in steps.
"""

import time
from dataclasses import dataclass

import mujoco as mj
import numpy as np

import problems
from problems import GROUND

# It would write a file where a motion diverges; the error says that.
mj.set_mju_user_warning(lambda _: None)


@dataclass(frozen=True)
class Setting:
    """An integrator with its number of steps, and how loops are closed."""

    method: str
    size: float
    stiff: float = 2.0
    impedance: float = 0.9999
    solver: str = "Newton"
    iterations: int = 100
    tolerance: float = 1e-12
    jacobian: str = "auto"
    loops: bool = True

    def __str__(self):
        words = [self.method, f"{self.size:g} steps"]
        if self.loops:
            words += [f"solref {self.stiff:g} steps", f"solimp {self.impedance:g}",
                      f"{self.solver} to {self.tolerance:g} in {self.iterations}", f"{self.jacobian} Jacobian"]
        return ", ".join(words)


class Tree:
    """Which pin carries which body, and the pins that are left."""

    def __init__(self, mechanism):
        self.mechanism = mechanism
        self.carrier, self.children, self.closing = {}, {GROUND: []}, []
        for pin in mechanism.pins:
            if pin.second in self.carrier:
                self.closing.append(pin)
                continue
            self.carrier[pin.second] = pin
            self.children.setdefault(pin.first, []).append(pin.second)
        # Depth first, as MuJoCo numbers them.
        self.order, waiting = [], list(reversed(self.children[GROUND]))
        while waiting:
            name = waiting.pop()
            self.order.append(name)
            waiting += reversed(self.children.get(name, []))
        self.index = {name: i for i, name in enumerate(self.order)}

    def parent(self, name):
        return self.mechanism.bodies.get(self.carrier[name].first)

    def turn(self, name):
        """Angle and angular velocity relative to the body before at the start."""
        body, parent = self.mechanism.bodies[name], self.parent(name)
        return (body.angle - parent.angle, body.omega - parent.omega) if parent else (body.angle, body.omega)

    def up(self, name):
        """The bodies from the ground to this one."""
        found = []
        while name != GROUND:
            found.append(name)
            name = self.carrier[name].first
        return found[::-1]

    def angles(self, name, positions):
        """Absolute angle at every row of joint positions."""
        return self.mechanism.bodies[name].angle + positions[:, [self.index[each] for each in self.up(name)]].sum(axis=1)

    def place(self, name, point, positions):
        """Place of a point at every row of joint positions."""
        place = np.zeros((len(positions), 2))
        angle = np.zeros(len(positions))
        for each in [*self.up(name), None]:
            local = self.carrier[each].at_first if each else point
            c, s = np.cos(angle), np.sin(angle)
            place += np.c_[c * local[0] - s * local[1], s * local[0] + c * local[1]]
            if each:
                angle = self.angles(each, positions)
        return place

    def xml(self):
        words = []
        for name in self.children[GROUND]:
            self.body_xml(name, words)
        return "".join(words)

    def body_xml(self, name, words):
        # Without recursion: a chain is as deep as it is long.
        waiting = [(name, False)]
        while waiting:
            name, done = waiting.pop()
            if done:
                words.append("</body>")
                continue
            body, pin = self.mechanism.bodies[name], self.carrier[name]
            x, y = (float(value) for value in pin.at_first)
            inertia = body.inertia or 1e-12
            words.append(
                f'<body name="{name}" pos="{x!r} {y!r} 0" euler="0 0 {float(self.turn(name)[0])!r}">'
                f'<joint type="hinge" axis="0 0 1"/><inertial pos="{body.com[0]!r} {body.com[1]!r} 0" mass="{body.mass!r}" '
                f'diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>')
            if name == "k3":
                x, y = problems.SQUEEZER_SPRING[3]
                words.append(f'<site name="D" pos="{x} {y} 0"/>')
            waiting.append((name, True))
            waiting += [(child, False) for child in reversed(self.children.get(name, []))]


def mechanism_of(row):
    makers = {"A01": problems.pendulum, "A03": problems.squeezer}
    if row.problem in makers:
        return makers[row.problem]()
    return {"A02": problems.four_bars, "chain": problems.chain}[row.problem](row.size)


def model_xml(row, tree, setting):
    step = tree.mechanism.end / setting.size
    world, tendon = tree.xml(), ""
    if row.problem == "A03":
        stiffness, length, (x, y), _ = problems.SQUEEZER_SPRING
        world += f'<site name="C" pos="{x} {y} 0"/>'
        tendon = (f'<tendon><spatial stiffness="{stiffness}" springlength="{length}"><site site="C"/><site site="D"/>'
                  "</spatial></tendon>")
    equality = "".join(f'<connect body1="{pin.first}" body2="{pin.second}" anchor="{pin.at_first[0]!r} {pin.at_first[1]!r} 0"/>'
                       for pin in tree.closing)
    # Below two steps the time constant of a constraint is only accepted unsafely.
    safe = "enable" if setting.stiff >= 2 else "disable"
    return (
        f'<mujoco><option timestep="{step!r}" integrator="{setting.method}" gravity="0 {-tree.mechanism.gravity!r} 0" '
        f'iterations="{setting.iterations}" tolerance="{setting.tolerance!r}" solver="{setting.solver}" '
        f'jacobian="{setting.jacobian}"><flag contact="disable" refsafe="{safe}"/></option>'
        '<compiler angle="radian" boundmass="0" boundinertia="0"/><default>'
        f'<equality solref="{setting.stiff * step!r} 1" solimp="{setting.impedance} {setting.impedance} 0.001 0.5 2"/></default>'
        f"<worldbody>{world}</worldbody><equality>{equality}</equality>{tendon}</mujoco>")


def error_of(row, tree, positions):
    if row.problem == "A03":
        return problems.squeezer_error({name: tree.angles(name, positions[-1:])[0] for name in tree.order})
    if row.problem == "chain":
        tip = tree.place(*tree.mechanism.watched, positions[-1:])[0]
        return float(np.hypot(*(tip - problems.chain_tip(row.size))))
    loops = row.size if row.problem == "A02" else 0
    off = tree.place(*tree.mechanism.watched, positions) - problems.swing_place(loops, tree.mechanism.times)
    return float(np.hypot(*off.T).max())


def prepare(row, setting):
    """A function that integrates once and returns error and CPU seconds."""
    tree = Tree(mechanism_of(row))
    model = mj.MjModel.from_xml_string(model_xml(row, tree, setting))
    data = mj.MjData(model)
    samples = tree.mechanism.samples
    chunk, rest = divmod(int(setting.size), samples)
    if rest:
        raise ValueError(f"{setting.size} steps are not a multiple of {samples} samples")
    start = np.array([tree.turn(name)[1] for name in tree.order])

    def run():
        mj.mj_resetData(model, data)
        data.qvel[:] = start
        if row.problem == "A03":
            data.qfrc_applied[tree.index["k1"]] = problems.SQUEEZER_TORQUE
        positions = np.zeros((samples + 1, model.nq))
        begin = time.process_time()
        for k in range(1, samples + 1):
            mj.mj_step(model, data, nstep=chunk)
            positions[k] = data.qpos
        cpu = time.process_time() - begin
        error = error_of(row, tree, positions)
        if not np.isfinite(error):
            raise RuntimeError("it diverged")
        return error, cpu
    return run


# ---------------------------------------------------------------- settings that are tried


def grid(row):
    """All settings that are sensible for a row, without their sizes; none where it has not the problem."""
    integrators = ("RK4", "implicitfast", "Euler", "implicit")
    if row.problem in ("A01", "chain"):
        return [Setting(method, 0, loops=False) for method in integrators]
    if row.problem not in ("A02", "A03"):
        return []
    return [
        Setting(method, 0, stiff, impedance, solver, iterations, tolerance, jacobian)
        for solver, iterations, tolerance in (("Newton", 100, 1e-12), ("Newton", 1, 1e-12), ("Newton", 100, 1e-8),
                                              ("CG", 100, 1e-12), ("PGS", 100, 1e-12))
        for method in integrators
        for stiff in (2, 1.4, 1, 0.7, 0.5)
        for impedance in (0.9999, 0.999, 0.99)
        for jacobian in (("sparse",) if getattr(row, "size", 0) > 10 else ("dense", "sparse"))
    ]


def sizes(setting, samples):
    """A fine ladder from cheap to dear."""
    return problems.steps(samples)


# ---------------------------------------------------------------- settings that are kept


def closed(method, sizes, stiff, impedance=0.9999, jacobian="sparse", **words):
    return Setting(method, 0, stiff, impedance, jacobian=jacobian, **words), sizes


def opened(sizes):
    return (Setting("RK4", 0, loops=False), sizes)


# By row: settings and the sizes tried of each.
KEPT = {
    "A01-1e-6": (opened((400, 600, 800)),),
    "A02-1-1e-4": (
        closed("implicit", (4000, 5600, 8000), 2, 0.999, "dense"), closed("implicit", (5600, 8000), 1.4, jacobian="dense"),
        closed("implicitfast", (10000, 14000), 1.4, jacobian="dense"),
        closed("implicitfast", (10000, 14000), 2, jacobian="dense"), closed("RK4", (4000, 5600), 0.7, jacobian="dense"),
    ),
    "A02-1-1e-6": (
        closed("implicit", (40000, 56000, 80000), 1.4, jacobian="dense"), closed("implicit", (56000, 80000), 2, jacobian="dense"),
        closed("implicitfast", (56000, 80000), 1.4, jacobian="dense"), closed("Euler", (56000, 80000), 1.4, jacobian="dense"),
    ),
    "A02-10-1e-4": (
        closed("implicit", (8000, 10000, 14000), 1.4), closed("implicit", (10000, 14000), 2), closed("Euler", (20000, 28000), 1.4),
        closed("RK4", (5600, 8000), 0.5),
    ),
    "A02-40-1e-4": (
        closed("RK4", (2800, 4000, 5600), 0.7), closed("implicit", (10000, 14000), 1.4), closed("Euler", (14000,), 2),
        closed("implicitfast", (14000, 20000), 1.4),
    ),
    "A02-100-1e-4": (
        closed("implicitfast", (10000, 14000), 1.4), closed("Euler", (10000, 14000), 1.4), closed("RK4", (2800,), 0.7),
    ),
    "A02-1000-1e-3": (closed("implicitfast", (2800, 4000, 5600), 1.4),),
    "A03-1e-3": (closed("RK4", (140, 200, 280), 2, jacobian="dense"),
                 closed("RK4", (200, 280), 2, jacobian="dense", tolerance=1e-8)),
    "A03-1e-6": (closed("RK4", (5600, 8000, 10000), 2, jacobian="dense"),
                 closed("RK4", (5600, 8000), 2, jacobian="dense", iterations=1)),
    "chain-10-1e-5": (opened((400, 560, 800)),),
    "chain-50-1e-5": (opened((1400, 2000, 2800)),),
    "chain-100-1e-5": (opened((2800, 4000, 5600)),),
}
