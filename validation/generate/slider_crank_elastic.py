"""Reference of the case `elastic-clearance`: the slider-crank with clearance, its rod a bent beam of two sines.

Crank at a given rate, A = r exp(i a). In a frame at A whose axis passes through the rod's end, at the angle p, the rod is

    z(x) = A + exp(i p) s,    s = x - f/2 + i w,    w = q1 sin(pi x/L) + q2 sin(2 pi x/L),    f = int_0^x w'^2
    2 T = int rho A |z'|^2 dx + rho I L p'^2 + m_s x_s'^2,    2 V = E I int w''^2 dx = E I (L/2) sum (k pi/L)^4 q_k^2

Terms of fourth order in q belong to no theory of second order: in products of two f, which the kinetic energy has, f is replaced by its
projection on 1, x and the sines, which are the motions that the rod has otherwise. f and its rates are forms of the three functions c = int_0^x (sine_i)' (sine_j)', so all integrals along the rod are constants.
Lagrange's equations, with b_j = ds/dq_j and z'' = A'' + exp(i p) (i p'' s + q_j'' b_j - p'^2 s + 2 i p' s' - f(q', q')):

    int rho A Re(conj(i s; b_j) exp(-i p) z'') dx + (rho I L p''; dV/dq_j) = Re(conj(i l; b_j(L)) exp(-i p) (-F)) + M (1; sine_j'(L))
    m_s x_s'' = F_x

B = A + l exp(i p), l = L - f(L)/2, is the bearing's centre. It turns with the rod's last cross-section, p + w'(L). F is the force
on the journal at the middle of the overlap, an arm R_b + d/2 from B, M = -T (R_b + d/2) the friction's moment on the rod. Every
piece of the laws (flight; contact, with friction at its end values or between) is integrated by itself, from event to event.
The motor's work and what the contact dissipates are integrated along.

One turn multiplies an error by 1e10. So numbers have 113 bits (gmpy2), the method is Gragg's, extrapolated to order 2 COLUMNS,
and each step ends where a row or an event is: nothing is interpolated.

Run: python3 slider_crank_elastic.py [folder]          four minutes; pip install gmpy2 mpmath
"""

import sys
import time as clock
from pathlib import Path

import gmpy2
import mpmath
from gmpy2 import cos, mpc, mpfr, sin, sqrt

gmpy2.get_context().precision = 113
mpmath.mp.prec = 120

FOLDER = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "elastic-clearance"
PI = gmpy2.const_pi()
CRANK, ROD, M_SLIDER = mpfr("0.05"), mpfr("0.12"), mpfr("0.14")
WIDTH, HEIGHT, YOUNG, DENSITY = mpfr("0.02"), mpfr("0.008"), mpfr("210e9"), mpfr("7850")
OMEGA = 500 * PI / 3
CLEARANCE, BEARING = mpfr("5e-4"), mpfr("0.01")
FLEXIBILITY = 2 * (1 - mpfr("0.3") ** 2) / mpfr("207e9")
CONTACT = 4 / (3 * FLEXIBILITY) * sqrt(BEARING * (BEARING - CLEARANCE) / CLEARANCE)
CHI = mpfr("0.75") * (1 - mpfr("0.9") ** 2)
FRICTION, THRESHOLD = mpfr("0.03"), mpfr("0.01")
END, ROWS = mpfr("0.012"), 241
LONGEST = mpfr("5e-6")
COLUMNS = 9
FLIGHT, RELEASED, BACK, MIDDLE, FORTH = range(5)
I = mpc(0, 1)
NAMES = ["time[s]", "slider.x[m]", "rod.angle[rad]", "rod.q1[m]", "rod.q2[m]", "slider.vx[m/s]"]
# A tolerance is a part of: the clearance, 1 m/s, 1 J.
SCALES = [CLEARANCE / ROD, CLEARANCE, CLEARANCE, CLEARANCE, 1 / ROD, mpfr(1), mpfr(1), mpfr(1), mpfr(1), mpfr(1)]


class Rod:
    """Integrals along the rod, times the mass per length. Index m: the products 11, 12, 22."""

    def __init__(self, stiffness=1):
        self.density = DENSITY * WIDTH * HEIGHT
        self.spin = DENSITY * WIDTH * HEIGHT**3 / 12 * ROD
        self.stiff = [stiffness * YOUNG * WIDTH * HEIGHT**3 / 24 * ROD * (k * PI / ROD) ** 4 for k in (1, 2)]
        length = mpmath.mpf("0.12")
        turn = mpmath.pi / length
        sines = [lambda x, k=k: mpmath.sin(k * turn * x) for k in (1, 2)]

        def c(i, j):
            a, b = abs(i - j) * turn, (i + j) * turn
            return lambda x: i * j * turn**2 / 2 * ((x if a == 0 else mpmath.sin(a * x) / a) + mpmath.sin(b * x) / b)

        forms = [c(1, 1), c(1, 2), c(2, 2)]

        def over(f):
            return self.density * mpfr(mpmath.nstr(mpmath.quad(f, mpmath.linspace(0, length, 5)), 37))

        self.c = [over(f) for f in forms]
        self.xc = [over(lambda x, f=f: x * f(x)) for f in forms]
        self.sc = [[over(lambda x, f=f, s=s: f(x) * s(x)) for f in forms] for s in sines]
        self.s = [over(s) for s in sines]
        self.xs = [over(lambda x, s=s: x * s(x)) for s in sines]
        self.ss, self.one, self.x, self.xx = (self.density * v for v in (ROD / 2, ROD, ROD**2 / 2, ROD**3 / 3))
        self.cc = self.fourth_order()
        # At the end: c, and the cross-section's angle.
        self.end = [PI**2 / (2 * ROD), 4 * PI**2 / (2 * ROD)]
        self.tilt = [-PI / ROD, 2 * PI / ROD]

    def fourth_order(self):
        """Products of two foreshortenings, each replaced by its projection on 1, x and the sines."""
        (s1, s2), (x1, x2), ss = self.s, self.xs, self.ss
        gram = [
            [self.one, self.x, s1, s2],
            [self.x, self.xx + self.spin, x1, x2],
            [s1, x1, ss, 0],
            [s2, x2, 0, ss],
        ]
        number = lambda value: mpmath.mpf(str(value))
        gram = mpmath.matrix([[number(value) for value in row] for row in gram])
        sides = [mpmath.matrix([number(row[m]) for row in (self.c, self.xc, *self.sc)]) for m in range(3)]
        solved = [mpmath.lu_solve(gram, side) for side in sides]
        return [[mpfr(mpmath.nstr((u.T * v)[0], 37)) for v in solved] for u in sides]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u, v):
    return u.real * v.imag - u.imag * v.real


def inner(u, v):
    return u.real * v.real + u.imag * v.imag


class Point:
    """Geometry and velocities of a state, in the rod's frame."""

    def __init__(self, rod, t, y):
        self.angle, q1, q2, self.x, self.omega, d1, d2, self.vx = y[:8]
        self.q, self.d = (q1, q2), (d1, d2)
        # exp(-i p), and A in the rod's frame.
        self.back = mpc(cos(self.angle), -sin(self.angle))
        self.arm = CRANK * mpc(cos(OMEGA * t), sin(OMEGA * t)) * self.back
        self.pull = (-rod.end[0] * q1, -rod.end[1] * q2)
        self.length = ROD + (q1 * self.pull[0] + q2 * self.pull[1]) / 2
        self.stretch = d1 * self.pull[0] + d2 * self.pull[1]
        self.e = self.x * self.back - self.arm - self.length
        self.rate = self.vx * self.back - I * OMEGA * self.arm - mpc(self.stretch, self.omega * self.length)
        distance = abs(self.e)
        self.depth = distance - CLEARANCE
        self.n = self.e / distance if distance > 0 else mpc(1)
        self.closing = inner(self.n, self.rate)
        self.reach = BEARING + self.depth / 2
        # The slider does not turn: only the rod's side moves with the contact point.
        self.sliding = cross(self.n, self.rate) - (self.omega + rod.tilt[0] * d1 + rod.tilt[1] * d2) * self.reach


def hold(p, approach):
    return 1 + CHI * p.closing / approach


def contact(p, phase, approach):
    """Normal force, its elastic part, friction."""
    if phase == FLIGHT:
        return mpfr(0), mpfr(0), mpfr(0)
    elastic = CONTACT * p.depth * sqrt(p.depth) if p.depth > 0 else mpfr(0)
    if phase == RELEASED:
        return mpfr(0), elastic, mpfr(0)
    normal = elastic * hold(p, approach)
    return normal, elastic, -FRICTION * normal * (p.sliding / THRESHOLD if phase == MIDDLE else -1 if phase == BACK else 1)


class Forms:
    """Mass matrix by (p, q1, q2), and int s and int b_j, times the mass per length."""

    def __init__(self, rod, p):
        (q1, q2), sc, cc = p.q, rod.sc, rod.cc
        self.qq = (q1 * q1, 2 * q1 * q2, q2 * q2)
        self.pulls = ((q1, q2, 0), (0, q1, q2))
        self.ccqq = [dot(row, self.qq) for row in cc]
        self.ccp = [[dot(row, u) for row in cc] for u in self.pulls]
        self.scp = [[dot(row, u) for row in sc] for u in self.pulls]
        self.squares = rod.xx - dot(rod.xc, self.qq) + dot(self.ccqq, self.qq) / 4 + rod.ss * (q1 * q1 + q2 * q2)
        self.mixed = [rod.xs[j] - dot(sc[j], self.qq) / 2 + q1 * self.scp[j][0] + q2 * self.scp[j][1] for j in (0, 1)]
        self.bends = [dot(self.ccp[0], self.pulls[0]) + rod.ss, dot(self.ccp[0], self.pulls[1]), dot(self.ccp[1], self.pulls[1]) + rod.ss]
        self.place = mpc(rod.x - dot(rod.c, self.qq) / 2, q1 * rod.s[0] + q2 * rod.s[1])
        self.b = [mpc(-dot(rod.c, self.pulls[j]), rod.s[j]) for j in (0, 1)]


def solve(m00, m01, m02, m11, m12, m22, r0, r1, r2):
    c00, c01, c02 = m11 * m22 - m12 * m12, m02 * m12 - m01 * m22, m01 * m12 - m02 * m11
    c11, c12, c22 = m00 * m22 - m02 * m02, m01 * m02 - m00 * m12, m00 * m11 - m01 * m01
    det = m00 * c00 + m01 * c01 + m02 * c02
    return (c00 * r0 + c01 * r1 + c02 * r2) / det, (c01 * r0 + c11 * r1 + c12 * r2) / det, (c02 * r0 + c12 * r1 + c22 * r2) / det


def rhs(rod, t, y, phase, approach):
    p = Point(rod, t, y)
    f = Forms(rod, p)
    (q1, q2), (d1, d2), w = p.q, p.d, p.omega
    normal, elastic, tangential = contact(p, phase, approach)
    force = p.n * mpc(-normal, tangential)
    crank = -OMEGA**2 * p.arm
    dd = (d1 * d1, 2 * d1 * d2, d2 * d2)
    qd = (q1 * d1, q1 * d2 + q2 * d1, q2 * d2)
    turning = (cross(f.place, crank) + 2 * w * (rod.ss * (q1 * d1 + q2 * d2) - dot(rod.xc, qd) + dot(f.ccqq, qd) / 2)
               + q1 * dot(rod.sc[0], dd) + q2 * dot(rod.sc[1], dd))
    load = [-p.length * force.imag - tangential * p.reach - turning]
    for j in (0, 1):
        u = f.pulls[j]
        bending = (inner(f.b[j], crank) - w * w * (rod.ss * p.q[j] - dot(rod.xc, u) + dot(f.ccqq, u) / 2)
                   + 2 * w * (d1 * f.scp[j][0] + d2 * f.scp[j][1] - dot(rod.sc[j], qd)) + dot(f.ccp[j], dd))
        load.append(-p.pull[j] * force.real - tangential * p.reach * rod.tilt[j] - rod.stiff[j] * p.q[j] - bending)
    a = solve(f.squares + rod.spin, *f.mixed, *f.bends, *load)
    # What the crank's pin exerts on the rod; the crank itself needs no torque.
    pin = (rod.one * crank + mpc(-w * w, a[0]) * f.place + a[1] * f.b[0] + a[2] * f.b[1]
           + 2 * I * w * (d1 * f.b[0] + d2 * f.b[1]) - dot(rod.c, dd) + force)
    work = OMEGA * cross(p.arm, pin)
    lost = (normal - elastic) * p.closing - tangential * p.sliding
    return [w, d1, d2, p.vx, *a, inner(force, p.back) / M_SLIDER, work, lost]


def energy(rod, t, y, phase):
    """Kinetic (without the crank), strain, contact, dissipated, minus the motor's work."""
    p = Point(rod, t, y)
    f = Forms(rod, p)
    d1, d2 = p.d
    crank = I * OMEGA * p.arm
    own = I * p.omega * f.place + d1 * f.b[0] + d2 * f.b[1]
    double = (rod.one * inner(crank, crank) + 2 * inner(crank, own) + (f.squares + rod.spin) * p.omega**2
              + 2 * p.omega * (f.mixed[0] * d1 + f.mixed[1] * d2) + f.bends[0] * d1**2 + 2 * f.bends[1] * d1 * d2 + f.bends[2] * d2**2)
    strain = (rod.stiff[0] * p.q[0] ** 2 + rod.stiff[1] * p.q[1] ** 2) / 2
    stored = CONTACT * p.depth**2 * sqrt(p.depth) * 2 / 5 if phase != FLIGHT and p.depth > 0 else mpfr(0)
    return (double + M_SLIDER * p.vx**2) / 2, strain, stored, y[9], -y[8]


def step(f, t, y, h):
    """Gragg's midpoint rule with 2, 4, ... parts, extrapolated; its error, over the scales."""
    start = f(t, y)
    row = []
    for k in range(1, COLUMNS + 1):
        part = h / (2 * k)
        before, now = y, [u + part * v for u, v in zip(y, start)]
        for i in range(1, 2 * k):
            slope = f(t + i * part, now)
            before, now = now, [u + 2 * part * v for u, v in zip(before, slope)]
        last, row = row, [now]
        for j in range(1, k):
            factor = mpfr(k) ** 2 / mpfr(k - j) ** 2 - 1
            row.append([u + (u - v) / factor for u, v in zip(row[j - 1], last[j - 1])])
    return row[-1], max(abs(u - v) / s for u, v, s in zip(row[-1], row[-2], SCALES))


# By phase: events, as (direction, function, next phase or None where the sliding decides).
LEAVE, PULL = (-1, lambda p, _: p.depth, FLIGHT), (-1, hold, RELEASED)
EVENTS = {
    FLIGHT: [(1, lambda p, _: p.depth, None)],
    RELEASED: [LEAVE, (1, hold, None)],
    BACK: [LEAVE, PULL, (1, lambda p, _: p.sliding + THRESHOLD, MIDDLE)],
    MIDDLE: [LEAVE, PULL, (1, lambda p, _: p.sliding - THRESHOLD, FORTH), (-1, lambda p, _: p.sliding + THRESHOLD, BACK)],
    FORTH: [LEAVE, PULL, (-1, lambda p, _: p.sliding - THRESHOLD, MIDDLE)],
}


def piece(p):
    return FORTH if p.sliding > THRESHOLD else BACK if p.sliding < -THRESHOLD else MIDDLE


def locate(f, value, t, y, h, low, high):
    """Where in the step the event's value is zero: Illinois, each time by a step from the start."""
    a, b, side = mpfr(0), h, 0
    while True:
        x = (a * high - b * low) / (high - low)
        end, _ = step(f, t, y, x)
        v = value(t + x, end)
        if min(x - a, b - x) < mpfr("1e-28") or v == 0:
            return x, end
        if (v > 0) == (high > 0):
            b, high = x, v
            low = low / 2 if side == 1 else low
            side = 1
        else:
            a, low = x, v
            high = high / 2 if side == -1 else high
            side = -1


def integrate(rtol, longest=LONGEST, rod=None, end=END, progress=None):
    """Rows, time and approach speed of the impacts, terms of the energy, largest |q1|, kinds of pieces."""
    rod = rod or Rod()
    zero = mpfr(0)
    # Velocities as if the joint were ideal and the rod rigid: those of the slider, and of the rod at angle 0.
    y = [zero, zero, zero, CRANK + ROD, -CRANK * OMEGA / ROD, zero, zero, zero, zero, zero]
    t, phase, approach, h = zero, FLIGHT, zero, longest
    rows, impacts, ledger, bent, steps, pieces = [], [], [], zero, 0, [FLIGHT]

    def f(t, y):
        return rhs(rod, t, y, phase, approach)

    def values(t, y):
        p = Point(rod, t, y)
        return [g(p, approach) for _, g, _ in EVENTS[phase]]

    def report():
        rows.append([t, y[3], y[0], y[1], y[2], y[7]])
        ledger.append(energy(rod, t, y, phase))

    report()
    marks = values(t, y)
    while len(rows) < ROWS and (target := END * len(rows) / (ROWS - 1)) <= end:
        whole = h >= target - t
        taken = target - t if whole else h
        new, error = step(f, t, y, taken)
        steps += 1
        grow = min(mpfr(4), max(mpfr("0.2"), mpfr("0.85") * (rtol / error) ** (mpfr(1) / (2 * COLUMNS - 1)))) if error > 0 else mpfr(4)
        if not error <= rtol:
            h = taken * (grow if gmpy2.is_finite(error) else mpfr("0.2"))
            continue
        h = min(longest, max(h, taken * grow) if whole else taken * grow)
        after = values(t + taken, new)
        hits = []
        for i, (direction, g, following) in enumerate(EVENTS[phase]):
            if direction * marks[i] < 0 <= direction * after[i]:
                at, there = locate(f, lambda t, y: g(Point(rod, t, y), approach), t, y, taken, marks[i], after[i])
                hits.append((at, i, there))
        if not hits:
            t, y, marks = target if whole else t + taken, new, after
        else:
            at, i, y = min(hits)
            t += at
            _, _, following = EVENTS[phase][i]
            p = Point(rod, t, y)
            if phase == FLIGHT:
                approach = p.closing
                impacts.append((t, approach))
                if progress:
                    progress(len(impacts), t, approach, steps)
            phase = piece(p) if following is None else following
            pieces.append(phase)
            ledger.append(energy(rod, t, y, phase))
            # Short: a flight or a change of friction that is over again within a step would be missed.
            h = longest / 64
            marks = values(t, y)
            whole = False
        bent = max(bent, abs(y[1]))
        if whole:
            report()
    return rows, impacts, ledger, bent, steps, pieces


def far(a, b):
    """Largest difference of a row (slider, chord's angle times rod, q1, q2) as a part of the clearance."""
    return max(abs(u - v) * s for u, v, s in zip(a[1:5], b[1:5], (1, ROD, 1, 1))) / CLEARANCE


def imbalance(ledger):
    return max(abs(sum(terms) - sum(ledger[0])) for terms in ledger)


def main():
    began = clock.process_time()
    rows, impacts, ledger, bent, steps, pieces = integrate(mpfr("1e-22"))
    print(f"rtol 1e-22: {len(impacts)} impacts, {len(pieces)} pieces, {steps} steps, {clock.process_time() - began:.0f} s, largest |q1|/L {bent / ROD:.6e}")
    print(f"energy off by {imbalance(ledger):.1e} J; largest",
          ", ".join(f"{n} {max(abs(v) for v in values):.6f}" for n, values in zip(("kinetic", "strain", "contact", "dissipated", "work"), zip(*ledger))))
    note = f"# gmpy2 {gmpy2.version()}, 113 bits, extrapolated midpoint rule of order {2 * COLUMNS}, rtol 1e-22, between events\n"
    for name, columns, table in (("reference.csv", NAMES, rows), ("impacts.csv", ["time[s]", "approach_speed[m/s]"], impacts)):
        with open(FOLDER / name, "w", encoding="utf-8") as f:
            f.write(note + ",".join(columns) + "\n")
            f.writelines(",".join(f"{v:.17g}" if v != 0 else "0" for v in line) + "\n" for line in table)
    for rtol, longest in (("1e-17", LONGEST), ("1e-20", LONGEST / 2)):
        other, hits, others, *_ = integrate(mpfr(rtol), longest)
        errors = [far(a, b) for a, b in zip(other, rows)]
        late, speed = (max(abs(a[i] - b[i]) for a, b in zip(hits, impacts)) for i in (0, 1))
        print(f"rtol {rtol}, steps to {longest:.1e} s, from the reference: trajectory {max(errors):.1e} of the clearance, at",
              ", ".join(f"{i / 20:g} ms {max(errors[: i + 1]):.1e}" for i in range(20, ROWS, 20)) + ";",
              f"impacts {late:.1e} s, {speed:.1e} m/s, {len(hits)} of them; energy {imbalance(others):.1e} J")


if __name__ == "__main__":
    main()
