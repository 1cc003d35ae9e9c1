"""F12 of the ideal lock near -40 deg for 49 choices of the centres of mass of links 3 and 4.

Angles from the paper's two vector loops (lock.py), every 0.1 deg up to 90 deg; forces by Newton and Euler for the five links, in doubles.
The moments are taken about the origins of the links' frames, so that one matrix serves all choices.

Run: python3 lock_centres.py
"""

import itertools
import math

import lock
from lock import DEG, Loops, branch, mp

HINGES = (("a", None, 2), ("b", 2, 3), ("c", 3, 4), ("d", 4, 5), ("e", 5, 6), ("f", 3, 6), ("g", None, 4))
LINKS = range(2, 7)


def turned(angle, p):
    c, s = math.cos(angle), math.sin(angle)
    return c * p[0] - s * p[1], s * p[0] + c * p[1]


def solve(a, b):
    """Solution of a x = b for several right-hand sides: Gauss and Jordan with pivots."""
    n = len(a)
    m = [a[i] + b[i] for i in range(n)]
    for i in range(n):
        p = max(range(i, n), key=lambda r: abs(m[r][i]))
        m[i], m[p] = m[p], m[i]
        for r in range(n):
            if r != i and m[r][i]:
                f = m[r][i] / m[i][i]
                m[r] = [x - f * y for x, y in zip(m[r], m[i])]
    return [[v / m[i][i] for v in m[i][n:]] for i in range(n)]


class Instant:
    """Angles of the links with their derivatives by time, and how F12 follows from the loads on the links."""

    def __init__(self, loops, points, th):
        w = 2 * math.sqrt(th[6] + 50 * DEG)
        first, second = loops.derivatives(th)
        self.angle = {k: float(th[k]) for k in LINKS}
        self.omega = {k: float(first[k]) * w for k in LINKS}
        self.alpha = {k: float(second[k]) * w**2 + 2 * float(first[k]) for k in LINKS}
        # sum of hinge forces, sum of their moments about the origin, per link; the torque on link 6 last
        a = [[0.0] * 15 for _ in range(15)]
        for j, (name, *ends) in enumerate(HINGES):
            for link, sign in zip(ends, (-1, 1)):
                if link:
                    row, r = 3 * (link - 2), turned(self.angle[link], points[link][name])
                    a[row][2 * j] += sign
                    a[row + 1][2 * j + 1] += sign
                    a[row + 2][2 * j] -= sign * r[1]
                    a[row + 2][2 * j + 1] += sign * r[0]
        a[14][14] = 1.0
        transposed = [list(column) for column in zip(*a)]
        self.rows = solve(transposed, [[float(i == k) for k in (0, 1)] for i in range(15)])

    def acceleration(self, chain):
        x = y = 0.0
        for link, p in chain:
            v = turned(self.angle[link], p)
            x += -v[1] * self.alpha[link] - v[0] * self.omega[link] ** 2
            y += v[0] * self.alpha[link] - v[1] * self.omega[link] ** 2
        return x, y

    def force(self, mass, inertia, origin, com):
        """F12."""
        out = [0.0, 0.0]
        for k in LINKS:
            a, r = self.acceleration(origin[k] + [(k, com[k])]), turned(self.angle[k], com[k])
            f = mass[k] * a[0], mass[k] * (a[1] + 9.81)
            load = f[0], f[1], inertia[k] * self.alpha[k] + r[0] * f[1] - r[1] * f[0]
            for i in range(3):
                for axis in (0, 1):
                    out[axis] += self.rows[3 * (k - 2) + i][axis] * load[i]
        return out


def main():
    mp.dps = 20
    spec = lock.model()
    loops = Loops(spec)
    bodies = {k: spec["bodies"][f"link{k}"] for k in LINKS}
    points = {k: {n: [v / 1000 for v in p] for n, p in b["points"].items()} for k, b in bodies.items()}
    com = {k: [v / 1000 for v in b["com"]] for k, b in bodies.items()}
    mass, inertia = ({k: float(v) for k, v in d.items()} for d in (loops.mass, loops.inertia))
    at_s = [(2, points[2]["b"]), (3, points[3]["f"])]
    origin = {2: [], 3: at_s[:1], 4: [], 5: at_s + [(6, points[6]["e"])], 6: at_s}
    instants = [Instant(loops, points, th) for th in branch(loops, last="90")]
    theta6 = [-50 + k / 10 for k in range(len(instants))]
    centres = lambda k, names: [("".join(c), [sum(points[k][n][i] for n in c) / len(c) for i in (0, 1)])
                                for size in (3, 2, 1) for c in itertools.combinations(names, size)]
    median = lambda values: sorted(values)[len(values) // 2]
    print("joints whose mean is the centre of link 3, of link 4; least |F12| [N] at theta6 [deg]; near -40 deg by the median: turn, change")
    for (third, com[3]), (fourth, com[4]) in itertools.product(centres(3, "bcf"), centres(4, "gcd")):
        f = [instant.force(mass, inertia, origin, com) for instant in instants]
        pairs = list(zip(f, f[1:]))
        turn = [abs(math.degrees(math.atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]))) / 0.1 for p, q in pairs]
        change = [math.hypot(q[0] - p[0], q[1] - p[1]) / 0.1 for p, q in pairs]
        near = [i for i, at in enumerate(theta6[1:]) if abs(at + 40) < 2.501]
        least = min(range(len(f)), key=lambda i: math.hypot(*f[i]))
        ratios = [max(v[i] for i in near) / median(v) for v in (turn, change)]
        mark = " abrupt" if max(ratios) >= 10 else ""
        print(f"{third:4}{fourth:4} {math.hypot(*f[least]):8.3f} at {theta6[least]:6.1f} {ratios[0]:8.3f} {ratios[1]:8.3f}{mark}")


if __name__ == "__main__":
    main()
