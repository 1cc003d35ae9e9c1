"""Reference of the case `slider-crank-clearance`: the journal's eccentricity as the coordinates, SciPy's DOP853.

The crank turns at a given rate, the rod hangs on it, the slider moves along x. With A = r exp(i a), rod angle p, journal centre
minus bearing centre e = x - (A + L exp(i p)):

    sin p = -(e_y + r sin a) / L                           e_y and its rate give the rod
    (J + m s^2) p'' = L exp(i p) x (-F) + M - m s exp(i p) x A''     rod about A; u x v = Im(conj(u) v)
    m_s x'' = F_x                                          slider
    e'' = x'' - A'' - L (i p'' - p'^2) exp(i p)            integrated: (e_x, e_y, e_x', e_y')

F is the force on the journal at the middle of the overlap, an arm R_b + d/2 from the bearing's centre, and M = -T (R_b + d/2)
the friction's moment on the rod. Every piece of the laws (flight; contact, with friction at its end values or between) is
integrated by itself, from event to event.

Run: python3 slider_crank_clearance.py
"""

from cmath import exp
from math import asin, cos, pi, sqrt
from pathlib import Path

import numpy as np
import scipy
from scipy.integrate import solve_ivp

FOLDER = Path(__file__).resolve().parent.parent / "slider-crank-clearance"
CRANK, ROD, CENTRE = 0.05, 0.12, 0.06
M_ROD, J_ROD, M_SLIDER = 0.21, 2.5e-4, 0.14
OMEGA = 5000 * 2 * pi / 60
CLEARANCE, BEARING = 5e-4, 0.01
FLEXIBILITY = 2 * (1 - 0.3**2) / 207e9
STIFFNESS = 4 / (3 * FLEXIBILITY) * sqrt(BEARING * (BEARING - CLEARANCE) / CLEARANCE)
CHI = 0.75 * (1 - 0.9**2)
FRICTION, THRESHOLD = 0.03, 0.01
END, ROWS = 0.024, 481
LONGEST = 5e-6
FLIGHT, RELEASED, BACK, MIDDLE, FORTH = range(5)
NAMES = ["time[s]", "slider.x[m]", "slider.vx[m/s]", "slider.ax[m/s^2]", "rod.angle[rad]", "rod.omega[rad/s]", "rod.alpha[rad/s^2]",
         "joint.b.ex[m]", "joint.b.ey[m]", "joint.b.fx[N]", "joint.b.fy[N]", "driver.motor.effort[N*m]"]


def cross(u, v):
    return (u.conjugate() * v).imag


class Point:
    """Geometry and velocities of a state."""

    def __init__(self, t, y):
        self.e, self.rate = complex(y[0], y[1]), complex(y[2], y[3])
        self.arm = CRANK * exp(1j * OMEGA * t)
        self.angle = asin(-(y[1] + self.arm.imag) / ROD)
        self.turn = exp(1j * self.angle)
        self.omega = -(y[3] + OMEGA * self.arm.real) / (ROD * cos(self.angle))
        distance = abs(self.e)
        self.depth = distance - CLEARANCE
        self.n = self.e / distance if distance > 0 else 1 + 0j
        self.closing = (self.n.conjugate() * self.rate).real
        self.reach = BEARING + 0.5 * self.depth
        # The slider does not turn: only the rod's side moves with the contact point.
        self.sliding = cross(self.n, self.rate) - self.omega * self.reach


def hold(p, approach):
    return 1 + CHI * p.closing / approach


def accelerate(p, phase, approach):
    """p'', x'', force on the journal."""
    force, moment = 0j, 0.0
    if phase >= BACK:
        normal = STIFFNESS * max(p.depth, 0.0) ** 1.5 * hold(p, approach)
        tangential = -FRICTION * normal * {BACK: -1.0, MIDDLE: p.sliding / THRESHOLD, FORTH: 1.0}[phase]
        force = p.n * (-normal + 1j * tangential)
        moment = -tangential * p.reach
    crank = -OMEGA**2 * p.arm
    alpha = cross(ROD * p.turn, -force) + moment - M_ROD * CENTRE * cross(p.turn, crank)
    return alpha / (J_ROD + M_ROD * CENTRE**2), force.real / M_SLIDER, force


def rhs(t, y, phase, approach):
    p = Point(t, y)
    alpha, along, _ = accelerate(p, phase, approach)
    e2 = along + OMEGA**2 * p.arm - ROD * (1j * alpha - p.omega**2) * p.turn
    return [y[2], y[3], e2.real, e2.imag]


def event(direction, f):
    def g(t, y, phase, approach):
        return f(Point(t, y), approach)

    g.terminal, g.direction = True, direction
    return g


MEET, LEAVE = event(1, lambda p, _: p.depth), event(-1, lambda p, _: p.depth)
PULL, PRESS = event(-1, hold), event(1, hold)
OVER, UNDER = (event(d, lambda p, _: p.sliding - THRESHOLD) for d in (1, -1))
UP, DOWN = (event(d, lambda p, _: p.sliding + THRESHOLD) for d in (1, -1))
EVENTS = {
    FLIGHT: {MEET: None},
    RELEASED: {LEAVE: FLIGHT, PRESS: None},
    BACK: {LEAVE: FLIGHT, PULL: RELEASED, UP: MIDDLE},
    MIDDLE: {LEAVE: FLIGHT, PULL: RELEASED, OVER: FORTH, DOWN: BACK},
    FORTH: {LEAVE: FLIGHT, PULL: RELEASED, UNDER: MIDDLE},
}


def piece(p):
    return FORTH if p.sliding > THRESHOLD else BACK if p.sliding < -THRESHOLD else MIDDLE


def integrate(rtol):
    """Rows, and time and approach speed of the impacts."""
    times = np.linspace(0, END, ROWS)
    rows, impacts = [], []
    t, y, phase, approach = 0.0, [0.0, 0.0, 0.0, 0.0], FLIGHT, 0.0
    # Velocities as if the joint were ideal: those of the slider, and of the rod at phi = 0.
    while True:
        events = EVENTS[phase]
        run = solve_ivp(rhs, (t, END), y, "DOP853", args=(phase, approach), events=list(events), rtol=rtol,
                        atol=[rtol * 1e-5 * CLEARANCE] * 2 + [rtol * 1e-2] * 2, max_step=LONGEST, dense_output=True)
        for time in times[len(rows):]:
            if time > run.t[-1]:
                break
            rows.append(row(time, run.sol(time), phase, approach))
        t, y = run.t[-1], run.y[:, -1]
        if run.status != 1:
            return np.array(rows), impacts
        fired = next(e for e, times_of in zip(events, run.t_events) if len(times_of))
        p = Point(t, y)
        if fired is MEET:
            approach = p.closing
            impacts.append((t, approach))
        phase = piece(p) if events[fired] is None else events[fired]


def row(t, y, phase, approach):
    p = Point(t, y)
    alpha, along, force = accelerate(p, phase, approach)
    centre = -OMEGA**2 * p.arm + CENTRE * (1j * alpha - p.omega**2) * p.turn
    x = p.e + p.arm + ROD * p.turn
    v = p.rate + 1j * OMEGA * p.arm + ROD * 1j * p.omega * p.turn
    assert abs(x.imag) < 1e-14 and abs(v.imag) < 1e-11
    # What the crank's pin exerts on the rod.
    pin = M_ROD * centre + force
    return [t, x.real, v.real, along, p.angle, p.omega, alpha, p.e.real, p.e.imag, force.real, force.imag,
            cross(p.arm, pin)]


def far(a, b):
    """Largest difference of the trajectories as a part of the clearance."""
    return max(abs(a[:, 1] - b[:, 1]).max(), ROD * abs(a[:, 4] - b[:, 4]).max()) / CLEARANCE


def main():
    rows, impacts = integrate(1e-13)
    for rtol in (1e-10, 1e-11, 1e-12):
        other, hits = integrate(rtol)
        late = max(abs(a[0] - b[0]) for a, b in zip(hits, impacts))
        print(f"rtol {rtol:.0e} from 1e-13: trajectory {far(other, rows):.1e} of the clearance, impacts {late:.1e} s, {len(hits)} of them")
    note = f"# SciPy {scipy.__version__}, solve_ivp, DOP853, rtol 1e-13, between events\n"
    for name, columns, table in (("reference.csv", NAMES, rows), ("impacts.csv", ["time[s]", "approach_speed[m/s]"], impacts)):
        with open(FOLDER / name, "w", encoding="utf-8") as f:
            f.write(note + ",".join(columns) + "\n")
            f.writelines(",".join(f"{float(v) + 0.0:.15g}" for v in line) + "\n" for line in table)
    for time, speed in impacts[:3]:
        print(f"{time * 1e3:.7f} ms  {speed:.5f} m/s")


if __name__ == "__main__":
    main()
