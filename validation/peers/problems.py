"""The mechanisms of the comparison, in the words of no engine, and their exact answers.

Nothing is taken from an engine: answers come from closed forms, published digits, or equations of motion of the one mechanism
that SciPy integrates to round-off.
"""

import functools
import json
import math
import os
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline
from scipy.linalg import cho_factor, cho_solve

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
G = 9.81
GROUND = "ground"


def turned(angle, point):
    """A point of a frame that is turned by this angle."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1]])


@dataclass(frozen=True)
class Body:
    """Mass [kg], inertia about the centre of mass [kg m²], centre of mass in the frame [m]; place of the frame, its motion."""

    mass: float
    inertia: float
    com: tuple
    origin: tuple = (0.0, 0.0)
    angle: float = 0.0
    velocity: tuple = (0.0, 0.0)
    omega: float = 0.0

    def place(self, point):
        return np.asarray(self.origin) + turned(self.angle, point)

    def speed(self, point):
        across = turned(self.angle, point)
        return np.asarray(self.velocity) + self.omega * np.array([-across[1], across[0]])


@dataclass(frozen=True)
class Pin:
    """A revolute joint between points of two bodies; the ground's points are places."""

    first: str
    at_first: tuple
    second: str
    at_second: tuple


@dataclass(frozen=True)
class Mechanism:
    bodies: dict
    pins: tuple
    gravity: float
    end: float
    samples: int
    watched: tuple = None

    @property
    def times(self):
        return np.linspace(0.0, self.end, self.samples + 1)


# ---------------------------------------------------------------- A01 and A02 of the IFToMM library


def pendulum():
    bodies = {"rod": Body(1.0, 0.0, (1.0, 0.0), angle=math.pi)}
    return Mechanism(bodies, (Pin(GROUND, (0.0, 0.0), "rod", (0.0, 0.0)),), G, 10.0, 100, ("rod", (1.0, 0.0)))


def four_bars(loops):
    bodies, pins = {}, []
    rod = (1.0, 1 / 12, (0.5, 0.0))
    for i in range(loops + 1):
        bodies[f"r{i}"] = Body(*rod, (float(i), 0.0), math.pi / 2, omega=-1.0)
        pins.append(Pin(GROUND, (float(i), 0.0), f"r{i}", (0.0, 0.0)))
    for i in range(loops):
        bodies[f"c{i}"] = Body(*rod, (float(i), 1.0), velocity=(1.0, 0.0))
        pins.append(Pin(f"r{i}", (1.0, 0.0), f"c{i}", (0.0, 0.0)))
        pins.append(Pin(f"c{i}", (1.0, 0.0), f"r{i + 1}", (1.0, 0.0)))
    return Mechanism(bodies, tuple(pins), G, 10.0, 100, ("r0", (1.0, 0.0)))


def swing_place(loops, times):
    """Place of the watched point of A01 (no loops) or A02, from the one equation that is left."""
    if loops == 0:
        factor, start = -G, [math.pi, 0.0]
    else:
        factor = -G * ((loops + 1) / 2 + loops) / ((loops + 1) / 3 + loops)
        start = [math.pi / 2, -1.0]
    found = solve_ivp(lambda _, y: [y[1], factor * math.cos(y[0])], (0, times[-1]), start, method="DOP853",
                      rtol=3e-14, atol=1e-15, t_eval=times)
    return np.c_[np.cos(found.y[0]), np.sin(found.y[0])]


# ---------------------------------------------------------------- A03: Andrews' squeezing mechanism

SQUEEZER_END = np.array([15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
                         0.5244099658805304, 0.5347301163226948, 1.048080741042263])
SQUEEZER_TORQUE = 0.033
# Stiffness and free length of the spring, its places on the ground and on k3.
SQUEEZER_SPRING = (4530.0, 0.07785, (0.014, 0.072), (0.02, -0.018))


def squeezer():
    beta, gamma, phi, delta, omega, epsilon = (-0.06171389001427645, 0.45527981916307037, 0.2226683901658859,
                                               0.4873649795438425, -0.2226683901658859, 1.2305474445498212)
    a, b, o = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.0, 0.0)
    f, h, g = turned(beta, (0.007, 0)), a + turned(delta, (0.04, 0)), a + turned(epsilon, (0, -0.04))
    bodies = {
        "k1": Body(0.04325, 2.194e-6, (0.00092, 0.0), o, beta),
        "k2": Body(0.00365, 4.410e-7, (-0.0115, 0.0), tuple(f), beta),
        "k3": Body(0.02373, 5.255e-6, (0.01874, 0.01043), b, gamma),
        "k4": Body(0.00706, 5.667e-7, (0.0, -0.00579), tuple(h), phi + delta),
        "k5": Body(0.07050, 1.169e-5, (0.02308, 0.00916), a, delta),
        "k6": Body(0.00706, 5.667e-7, (0.00579, 0.0), tuple(g), omega + epsilon),
        "k7": Body(0.05498, 1.912e-5, (0.01228, -0.00449), a, epsilon),
    }
    tip = (-0.028, 0.0)
    pins = (
        Pin(GROUND, o, "k1", o), Pin("k1", (0.007, 0.0), "k2", o), Pin(GROUND, b, "k3", o),
        Pin(GROUND, a, "k5", o), Pin("k5", (0.04, 0.0), "k4", o), Pin(GROUND, a, "k7", o),
        Pin("k7", (0.0, -0.04), "k6", o), Pin("k2", tip, "k3", (0.0, -0.035)), Pin("k2", tip, "k4", (0.0, -0.02)),
        Pin("k2", tip, "k6", (0.02, 0.0)),
    )
    return Mechanism(bodies, pins, 0.0, 0.03, 1)


def squeezer_error(angles):
    """Largest relative error of the test set's angles, from those of the bodies by name."""
    k = [angles[f"k{i}"] for i in range(1, 8)]
    relative = np.array([k[0], k[1] - k[0], k[2], k[3] - k[4], k[4], k[5] - k[6], k[6]])
    return float(np.abs((relative - SQUEEZER_END) / SQUEEZER_END).max())


# ---------------------------------------------------------------- chain


def chain(links):
    length = 1.0 / links
    bodies = {f"l{i}": Body(length, length**3 / 12, (length / 2, 0.0), (i * length, 0.0)) for i in range(links)}
    pins = [Pin(GROUND, (0.0, 0.0), "l0", (0.0, 0.0))]
    pins += [Pin(f"l{i - 1}", (length, 0.0), f"l{i}", (0.0, 0.0)) for i in range(1, links)]
    return Mechanism(bodies, tuple(pins), G, 1.0, 1, (f"l{links - 1}", (length, 0.0)))


@functools.cache
def chain_tip(links):
    """Place of the tip at the end, by Lagrange's equations in the absolute angles: for each link j
    Σ_k w_jk (cos(φj − φk) φ″k + sin(φj − φk) φ′k²) = p_j cos φj, w of masses and lengths, p of weights behind the joint.
    """
    length = mass = 1.0 / links
    index = np.arange(links)
    behind = links - 1 - np.maximum.outer(index, index)
    weights = mass * length**2 * (behind + np.where(np.eye(links, dtype=bool), 1 / 3, 1 / 2))
    pull = -G * mass * length * (links - 1 - index + 1 / 2)

    def derivative(_, y):
        angle, speed = y[:links], y[links:]
        off = angle[:, None] - angle[None, :]
        forces = pull * np.cos(angle) - (weights * np.sin(off)) @ speed**2
        return np.r_[speed, cho_solve(cho_factor(weights * np.cos(off), check_finite=False), forces, check_finite=False)]

    found = solve_ivp(derivative, (0, 1.0), np.zeros(2 * links), method="DOP853", rtol=1e-11, atol=1e-11)
    angles = found.y[:links, -1]
    return length * np.array([np.cos(angles).sum(), np.sin(angles).sum()])


# ---------------------------------------------------------------- driven six-bar: the bundled Watt-I lock at a constant speed

LOCK_FROM, LOCK_TO, LOCK_INSTANTS = math.radians(-50.0), math.radians(110.0), 2000
LOCK_SPEED = LOCK_TO - LOCK_FROM
LOCK_DRIVEN = "link6"


@functools.cache
def lock():
    """The bundled model in SI, assembled and moving as at the start; driven over its range in a second."""
    with open(os.path.join(ROOT, "models", "watt-i-lock.json"), encoding="utf-8") as file:
        model = json.load(file)

    def metres(point):
        return tuple(1e-3 * np.array(point))

    drawn, points = {}, {}
    for name, words in model["bodies"].items():
        points[name] = {key: metres(point) for key, point in words["points"].items()}
        if name != GROUND:
            pose = words["pose"]
            drawn[name] = Body(words["mass"], 1e-6 * words["inertia"], metres(words["com"]), metres(pose["position"]),
                               math.radians(pose["angle"]))
    pins = []
    for words in model["joints"].values():
        (first, at_first), (second, at_second) = (end.split(".") for end in words["between"])
        pins.append(Pin(first, points[first][at_first], second, points[second][at_second]))
    mechanism = Mechanism(drawn, tuple(pins), G, 1.0, LOCK_INSTANTS)
    start = np.concatenate([[*body.origin, body.angle] for body in drawn.values()])
    q, v, _ = lock_motion(mechanism, start, LOCK_FROM)
    bodies = {name: Body(body.mass, body.inertia, body.com, tuple(q[3 * i:3 * i + 2]), q[3 * i + 2],
                         tuple(v[3 * i:3 * i + 2]), v[3 * i + 2]) for i, (name, body) in enumerate(drawn.items())}
    return Mechanism(bodies, tuple(pins), G, 1.0, LOCK_INSTANTS)


def lock_constraints(mechanism, q, v):
    """Residual of the pins and of the driven angle, its Jacobian, and the rest of its second derivative."""
    index = {name: i for i, name in enumerate(mechanism.bodies)}
    rows = 2 * len(mechanism.pins) + 1
    residual, jacobian, rest = np.zeros(rows), np.zeros((rows, len(q))), np.zeros(rows)
    for k, pin in enumerate(mechanism.pins):
        two = slice(2 * k, 2 * k + 2)
        for sign, name, point in ((1, pin.first, pin.at_first), (-1, pin.second, pin.at_second)):
            if name == GROUND:
                residual[two] += sign * np.array(point)
                continue
            at = 3 * index[name]
            arm = turned(q[at + 2], point)
            residual[two] += sign * (q[at:at + 2] + arm)
            jacobian[two, at:at + 2] += sign * np.eye(2)
            jacobian[two, at + 2] += sign * np.array([-arm[1], arm[0]])
            rest[two] -= sign * arm * v[at + 2]**2
    jacobian[-1, 3 * index[LOCK_DRIVEN] + 2] = 1.0
    return residual, jacobian, rest


def lock_motion(mechanism, q, value):
    """Places, velocities, accelerations at a value of the driver, by Newton's method from a place nearby."""
    at = 3 * list(mechanism.bodies).index(LOCK_DRIVEN) + 2
    q = q.copy()
    for _ in range(20):
        residual, jacobian, _ = lock_constraints(mechanism, q, np.zeros_like(q))
        residual[-1] = q[at] - value
        q -= np.linalg.solve(jacobian, residual)
        if np.abs(residual).max() < 1e-14:
            break
    _, jacobian, _ = lock_constraints(mechanism, q, np.zeros_like(q))
    drive = np.zeros(len(q))
    drive[-1] = LOCK_SPEED
    v = np.linalg.solve(jacobian, drive)
    rest = lock_constraints(mechanism, q, v)[2]
    return q, v, np.linalg.solve(jacobian, -rest)


@functools.cache
def lock_forces():
    """Forces on the second body in all pins, then the torque of the driver, at all instants and at the end."""
    mechanism = lock()
    q = np.concatenate([[*body.origin, body.angle] for body in mechanism.bodies.values()])
    found = []
    for value in np.linspace(LOCK_FROM, LOCK_TO, LOCK_INSTANTS + 1):
        q, v, a = lock_motion(mechanism, q, value)
        _, jacobian, _ = lock_constraints(mechanism, q, np.zeros_like(q))
        wrench = np.zeros_like(q)
        for i, body in enumerate(mechanism.bodies.values()):
            at = 3 * i
            arm = turned(q[at + 2], body.com)
            centre = a[at:at + 2] + a[at + 2] * np.array([-arm[1], arm[0]]) - v[at + 2]**2 * arm
            force = body.mass * (centre + [0.0, G])
            wrench[at:at + 2] = force
            wrench[at + 2] = body.inertia * a[at + 2] + arm[0] * force[1] - arm[1] * force[0]
        multipliers = np.linalg.solve(jacobian.T, wrench)
        found.append(np.r_[-multipliers[:-1], multipliers[-1]])
    return np.array(found)


def lock_error(forces, instants):
    """Largest error, by the largest force or torque, at these instants."""
    exact = lock_forces()[instants]
    off = np.abs(np.asarray(forces) - exact)
    return float(max(off[:, :-1].max() / np.abs(exact[:, :-1]).max(), off[:, -1].max() / np.abs(exact[:, -1]).max()))


# ---------------------------------------------------------------- slider-crank with a clearance joint


@dataclass(frozen=True)
class Clearance:
    """The validation case `slider-crank-clearance`."""

    crank: float = 0.05
    rod: float = 0.12
    crank_mass: tuple = (0.3, 1e-5)
    rod_mass: tuple = (0.21, 2.5e-4)
    slider_mass: float = 0.14
    speed: float = 5000 * 2 * math.pi / 60
    clearance: float = 5e-4
    bearing: float = 0.01
    restitution: float = 0.9
    young: float = 207e9
    poisson: float = 0.3
    friction: float = 0.03
    threshold: float = 0.01
    end: float = 0.024
    samples: int = 480

    @property
    def stiffness(self):
        journal = self.bearing - self.clearance
        each = (1 - self.poisson**2) / self.young
        return 4 / (3 * 2 * each) * math.sqrt(self.bearing * journal / (self.bearing - journal))


@functools.cache
def clearance_reference():
    path = os.path.join(ROOT, "validation", "slider-crank-clearance", "reference.csv")
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    columns = lines[0].strip().split(",")
    table = np.loadtxt(lines[1:], delimiter=",")
    time, place, speed, angle, omega = (table[:, columns.index(name)] for name in (
        "time[s]", "slider.x[m]", "slider.vx[m/s]", "rod.angle[rad]", "rod.omega[rad/s]"))
    return CubicHermiteSpline(time, place, speed), CubicHermiteSpline(time, angle, omega)


def clearance_error(times, slider, angle):
    """Largest error of the slider and of the rod's end, as a part of the clearance."""
    place, turn = clearance_reference()
    problem = Clearance()
    off = np.maximum(np.abs(slider - place(times)), problem.rod * np.abs(angle - turn(times)))
    return float(off.max() / problem.clearance)


def span(kind):
    """End of the motion [s] and number of samples after the start."""
    if kind == "clearance":
        return Clearance.end, Clearance.samples
    mechanism = {"A01": pendulum, "A02": lambda: four_bars(1), "A03": squeezer, "chain": lambda: chain(1), "lock": lock}[kind]()
    return mechanism.end, mechanism.samples


def steps(samples):
    """Numbers of steps by factors of about the root of two, of which every sample is one."""
    found = [round(base * 10**power / samples) * samples for power in range(2, 6) for base in (1, 1.4, 2, 2.8, 4, 5.6, 8)]
    return sorted({number for number in found if number})
