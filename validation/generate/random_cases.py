"""Random driven linkages, grown from a seed on the ground by cranks, dyads, triads, driven cylinders and welds.

Each part is drawn in a pose far from its own singular positions, so the branch is clear; a linkage whose loop equations come near
a singular position within its motion is thrown away and the next seed is tried. Body frames are random and the poses in the file
are only rough, or the body is drawn straight in global coordinates and its pose left out.

Run: python3 random_cases.py [number …]
"""

import random
import sys
from math import atan2, cos, degrees, hypot, pi, sin, sqrt
from pathlib import Path

import numpy
import planar
from mpmath import mpf
from planar import Mechanism

CASES = Path(__file__).resolve().parent.parent
SMALLEST = 0.03  # least singular value of the closure Jacobian (SI) that is let through

# parts of each linkage, its units, and whether one slider is without mass
RECIPES = [
    (("crank", "rrr", "weld"), "SI", False),
    (("crank", "rrp", "rrr"), "mm", False),
    (("crank", "triad", "rpr"), "SI", False),
    (("cylinder", "crank on a body", "rrr", "rrp"), "mm", True),
    (("crank", "rrr", "rrp", "rpr", "rrr", "weld"), "SI", True),
    (("crank", "crank", "triad", "rrp", "rrr", "rpr", "weld"), "mm", False),
]


class Part:
    """A body in global coordinates at the start."""

    def __init__(self, name, frame, rigid):
        self.name, self.frame, self.rigid = name, frame, rigid  # frame: x, y, angle; rigid: bodies that can't move against each other
        self.points = {}


class Grower:
    def __init__(self, seed, units, massless):
        self.r = random.Random(seed)
        self.mm, self.massless = units == "mm", massless
        self.parts = {"ground": Part("ground", (0.0, 0.0, 0.0), 0)}
        self.joints, self.drivers, self.sliders = {}, {}, []

    # -------------------------------------------------------- geometry

    def body(self, rigid=None):
        name = f"body{len(self.parts)}"
        straight = self.r.random() < 0.3
        angle = 0.0 if straight else self.angle(self.r.uniform(-pi, pi))
        frame = (0.0, 0.0, 0.0) if straight else (self.r.uniform(-0.3, 0.6), self.r.uniform(-0.3, 0.5), angle)
        self.parts[name] = Part(name, frame, len(self.parts) if rigid is None else rigid)
        return self.parts[name]

    def angle(self, x):
        """Rounded so that the file can print it: 0.1 deg or 0.001 rad."""
        return round(degrees(x), 1) * pi / 180 if self.mm else round(x, 3)

    def point(self, part, at):
        """Names a point of a body at a global place."""
        name = f"p{len(part.points)}"
        part.points[name] = at
        return f"{part.name}.{name}"

    def somewhere(self, part):
        """A global place that suits a body."""
        if part.name == "ground":
            return (self.r.uniform(-0.1, 0.8), self.r.uniform(-0.3, 0.5))
        xs = list(part.points.values())
        cx, cy = sum(p[0] for p in xs) / len(xs), sum(p[1] for p in xs) / len(xs)
        return (cx + self.r.uniform(-0.15, 0.15), cy + self.r.uniform(-0.15, 0.15))

    def two(self, low=0.18, high=0.7):
        """Places on two bodies that move against each other."""
        while True:
            a, b = self.r.sample(list(self.parts.values()), 2)
            if a.rigid == b.rigid:
                continue
            p, q = self.somewhere(a), self.somewhere(b)
            if low < hypot(q[0] - p[0], q[1] - p[1]) < high:
                return a, p, b, q

    def corner(self, p, q):
        """A point seen from p and q under 60 to 120 deg."""
        d = hypot(q[0] - p[0], q[1] - p[1])
        g, ratio = self.r.uniform(pi / 3, 2 * pi / 3), self.r.uniform(0.7, 1.4)
        a = d / sqrt(1 + ratio**2 - 2 * ratio * cos(g))
        b = ratio * a
        x = (d * d + a * a - b * b) / (2 * d)
        y = self.r.choice((1, -1)) * sqrt(max(a * a - x * x, 0))
        e = ((q[0] - p[0]) / d, (q[1] - p[1]) / d)
        return (p[0] + x * e[0] - y * e[1], p[1] + x * e[1] + y * e[0])

    # -------------------------------------------------------- joints

    def join(self, kind, a, p, b, q=None, **more):
        ends = [self.point(a, p), self.point(b, q or p)]
        name = f"{kind[0]}{len(self.joints)}"
        self.joints[name] = {"type": kind, "between": ends} | more
        return name

    def pin(self, a, b, p):
        if self.r.random() < 0.5:
            a, b = b, a
        return self.join("revolute", a, p, b)

    def slide(self, first, p, second, q):
        """A prismatic joint along p → q, its axis fixed in the first body; to be finished when the frames are written."""
        direction = atan2(q[1] - p[1], q[0] - p[0])
        name = self.join("prismatic", first, p, second, q)
        local = direction - first.frame[2]
        size = self.r.choice((1, 2.5))
        axis = [round(size * cos(local), 6), round(size * sin(local), 6)]
        self.joints[name] |= {"axis": axis, "angle": self.out_angle(second.frame[2] - first.frame[2])}
        return name

    def out_angle(self, x):
        return round(degrees(x), 1) if self.mm else round(x, 3)

    def out_length(self, x):
        return round(1000 * x, 1) if self.mm else round(x, 4)

    # -------------------------------------------------------- drivers

    def motion(self, start, swing, out):
        """A law that begins near `start` (SI) and stays within about `swing` of it for a second; numbers of the file by `out`."""
        u = self.r.uniform
        kind = self.r.choice(("harmonic", "polynomial", "constant_acceleration"))
        if kind == "harmonic":
            a, phase = swing * u(0.3, 0.5), round(u(-1, 1), 2)
            return {"type": kind, "offset": out(start - a * sin(phase)), "amplitude": out(a), "frequency": round(u(0.4, 1.3), 2),
                    "phase": f"{phase} rad"}
        c = [start, swing * u(-0.5, 0.5), swing * u(-0.7, 0.7), swing * u(-0.4, 0.4)]
        if kind == "polynomial":
            return {"type": kind, "coefficients": [out(x) for x in c]}
        unit, size = ("rad", 1) if out == self.out_angle else ("mm", 1000)
        return {"type": kind, "start": out(start), "velocity": f"{round(size * c[1], 3)} {unit}/s",
                "acceleration": f"{round(size * c[2], 3)} {unit}/s^2"}

    # -------------------------------------------------------- parts

    def crank(self, base):
        p = self.somewhere(base)
        arm = self.body()
        self.pin(base, arm, p)
        th, length = self.r.uniform(-pi, pi), self.r.uniform(0.1, 0.2)
        self.point(arm, (p[0] + length * cos(th), p[1] + length * sin(th)))
        relative = {} if base.name == "ground" else {"relative_to": base.name}
        self.drivers[f"motor{len(self.drivers)}"] = {
            "type": "rotation", "body": arm.name} | relative | {
            "motion": self.motion(arm.frame[2] - base.frame[2], 0.8, self.out_angle)}

    def rrr(self):
        a, p, b, q = self.two()
        m = self.corner(p, q)
        one, two = self.body(), self.body()
        self.pin(a, one, p)
        self.pin(b, two, q)
        self.pin(one, two, m)

    def rrp(self):
        """Rod on one body, slider on a line of another; the rod lies within 50 deg of the line."""
        a, p, b, q = self.two(0.25, 0.6)
        rod, slider = self.body(), self.body()
        self.pin(a, rod, p)
        self.pin(rod, slider, q)
        th = atan2(q[1] - p[1], q[0] - p[0]) + self.r.uniform(-0.85, 0.85)
        side = self.r.uniform(-0.03, 0.03)
        # the line passes beside the pin; its point in the slider is `side` away
        s = (q[0] - side * sin(th), q[1] + side * cos(th))
        back = self.r.uniform(0.1, 0.25)
        g = (s[0] - back * cos(th), s[1] - back * sin(th))
        self.slide(b, g, slider, s) if self.r.random() < 0.7 else self.slide(slider, s, b, g)
        self.sliders.append(slider.name)

    def rpr(self):
        """A passive telescope between two bodies."""
        a, p, b, q = self.two(0.25, 0.7)
        one, two = self.body(), self.body()
        self.pin(a, one, p)
        self.pin(b, two, q)
        self.slide(one, (p[0] + 0.2 * (q[0] - p[0]), p[1] + 0.2 * (q[1] - p[1])), two, q)

    def cylinder(self):
        """An arm held and moved by a driven telescope."""
        base = self.parts["ground"]
        while True:
            p, q = self.somewhere(base), self.somewhere(base)
            if 0.25 < hypot(q[0] - p[0], q[1] - p[1]) < 0.5:
                break
        e = self.corner(p, q)
        arm, barrel, rod = self.body(), self.body(), self.body()
        self.pin(base, arm, p)
        self.pin(base, barrel, q)
        self.pin(arm, rod, e)
        front = (q[0] + 0.3 * (e[0] - q[0]), q[1] + 0.3 * (e[1] - q[1]))
        name = self.slide(barrel, front, rod, e)
        length = hypot(e[0] - front[0], e[1] - front[1])
        self.drivers[f"ram{len(self.drivers)}"] = {"type": "translation", "joint": name,
                                                   "motion": self.motion(length, 0.3 * length, self.out_length)}

    def triad(self):
        """A plate on three legs; the legs' lines stay clear of a common point."""
        while True:
            hosts = self.r.sample(list(self.parts.values()), min(3, len(self.parts)))
            while len(hosts) < 3:
                hosts.append(self.parts["ground"])
            if len({h.rigid for h in hosts}) < 2:
                continue
            feet = [self.somewhere(h) for h in hosts]
            c = (sum(f[0] for f in feet) / 3, sum(f[1] for f in feet) / 3)
            turn = self.r.uniform(-pi, pi)
            pins = [(c[0] + self.r.uniform(0.08, 0.15) * cos(turn + k * 2.1), c[1] + self.r.uniform(0.08, 0.15) * sin(turn + k * 2.1))
                    for k in range(3)]
            legs = [(q[0] - f[0], q[1] - f[1]) for f, q in zip(feet, pins)]
            lengths = [hypot(*v) for v in legs]
            if min(lengths) < 0.12 or max(lengths) > 0.6:
                continue
            # the three unit lines must resist force and moment well
            rows = [[v[0] / n, v[1] / n, ((q[0] - c[0]) * v[1] - (q[1] - c[1]) * v[0]) / n / 0.12] for v, n, q in zip(legs, lengths, pins)]
            if numpy.linalg.svd(numpy.array(rows), compute_uv=False)[-1] > 0.45:
                break
        plate = self.body()
        for host, f, q in zip(hosts, feet, pins):
            leg = self.body()
            self.pin(host, leg, f)
            self.pin(plate, leg, q)

    def weld(self):
        host = self.r.choice([p for p in self.parts.values() if p.name != "ground"])
        extra = self.body(rigid=host.rigid)
        at = self.somewhere(host)
        pair = [host, extra] if self.r.random() < 0.5 else [extra, host]
        self.join("fixed", pair[0], at, pair[1], angle=self.out_angle(pair[1].frame[2] - pair[0].frame[2]))
        self.point(extra, (at[0] + 0.08, at[1] + 0.05))

    def add(self, kind):
        if kind == "crank":
            self.crank(self.parts["ground"])
        elif kind == "crank on a body":
            self.crank(self.r.choice([p for p in self.parts.values() if p.name != "ground"]))
        else:
            getattr(self, kind)()

    # -------------------------------------------------------- model file

    def local(self, part, at):
        x, y, th = part.frame
        d = (at[0] - x, at[1] - y)
        return [self.out_length(cos(th) * d[0] + sin(th) * d[1]), self.out_length(-sin(th) * d[0] + cos(th) * d[1])]

    def model(self, name):
        r, u = self.r, self.r.uniform
        bodies, forces = {}, {}
        massless = self.sliders[0] if self.massless and self.sliders else None
        moving = [p for p in self.parts.values() if p.name != "ground"]
        loads = r.sample(moving, min(3, len(moving)))
        places = [self.point(p, self.somewhere(p)) for p in loads]
        for part in self.parts.values():
            spec = {}
            if part.name == massless:
                spec |= {"mass": 0, "inertia": 0}
            elif part.name != "ground":
                mass = round(u(0.3, 3), 2)
                xs = [self.local(part, p) for p in part.points.values()]
                mean = [sum(p[i] for p in xs) / len(xs) + u(-0.02, 0.02) * (1000 if self.mm else 1) for i in (0, 1)]
                spec |= {"mass": mass, "inertia": round(mass * u(0.05, 0.12) ** 2, 6), "com": [round(c, 1 if self.mm else 4) for c in mean]}
            spec["points"] = {k: self.local(part, p) for k, p in part.points.items()}
            if part.frame != (0.0, 0.0, 0.0):
                x, y, th = part.frame
                rough = [round((v + u(-0.02, 0.02)) * (1000 if self.mm else 1), 0 if self.mm else 2) for v in (x, y)]
                th += u(-0.08, 0.08)
                spec["pose"] = {"position": rough, "angle": round(degrees(th)) if self.mm else round(th, 2)}
            bodies[part.name] = spec
        forces["load"] = {"type": "force", "at": places[0], "vector": [round(u(-40, 40), 1), round(u(-40, 40), 1)], "frame": "body"}
        if len(places) > 1:
            anchor = self.point(self.parts["ground"], self.somewhere(self.parts["ground"]))
            bodies["ground"]["points"][anchor.split(".")[1]] = self.local(self.parts["ground"], self.parts["ground"].points[anchor.split(".")[1]])
            forces["spring"] = {"type": "spring", "between": [anchor, places[1]], "stiffness": round(u(100, 600)), "damping": round(u(1, 20), 1),
                                "free_length": self.out_length(u(0.1, 0.4))}
        # a torsion spring across a revolute joint of two moving bodies
        for joint in self.joints.values():
            pair = [e.split(".")[0] for e in joint["between"]]
            if joint["type"] == "revolute" and "ground" not in pair:
                forces["twist"] = {"type": "torsion_spring", "between": pair, "stiffness": round(u(0.5, 5), 2), "damping": round(u(0.02, 0.3), 2),
                                   "free_angle": self.out_angle(u(-1, 1))}
                break
        forces["wind"] = {"type": "torque", "body": loads[-1].name, "value": {"type": "polynomial", "coefficients": [round(u(-3, 3), 2), round(u(-3, 3), 2)]}}
        names = list(self.joints)
        r.shuffle(names)
        return {
            "format": "linkdyn/1", "name": name, "about": "A linkage grown at random.", "source": "made by validation/generate/random_cases.py",
            "units": {"length": "mm", "angle": "deg"} if self.mm else "SI", "gravity": [0, -9.81],
            "bodies": bodies, "joints": {k: self.joints[k] for k in names}, "drivers": self.drivers, "forces": forces,
            "points": places[:1], "analysis": {"type": "inverse_dynamics", "end": 1.0, "outputs": 101},
        }


def try_one(seed, parts, units, massless, name):
    """A model grown from a seed, or nothing where it comes near a singular position."""
    grower = Grower(seed, units, massless)
    for kind in parts:
        grower.add(kind)
    model = grower.model(name)
    machine, smallest = Mechanism(model), []
    try:
        machine.follow([mpf(k) / 20 for k in range(21)], substeps=4, smallest=smallest)
        if min(smallest) < SMALLEST:
            return None
        # the rough poses must lead where the drawn ones lead
        drawn = {p.name: p.frame for p in grower.parts.values()}
        q1, q2 = (machine.position(planar.FLOAT, 0.0, machine.guess(planar.FLOAT, g), 1e-12) for g in (None, drawn))
        if max(abs(a - b) for a, b in zip(q1, q2)) > 1e-9:
            return None
        planar.absolute_assembly(machine)
    except (ArithmeticError, AssertionError):
        return None
    return model


def main():
    for k, (parts, units, massless) in enumerate(RECIPES, 1):
        if sys.argv[1:] and str(k) not in sys.argv[1:]:
            continue
        for seed in range(1000 * k, 1000 * k + 1000):
            model = try_one(seed, parts, units, massless, f"Random linkage {k}")
            if model is None:
                continue
            how = (f"Random linkage from seed {seed}: {', '.join(parts)}. Poses in the file are rough (0.02 m, 0.08 rad) or left out where the body is "
                   "drawn straight in global coordinates.")
            try:
                planar.produce(CASES / f"random-{k}", model, (model["about"] + " Parts: " + ", ".join(parts) + ".", model["source"]), how, every=10)
                break
            except AssertionError as problem:
                print(seed, problem)


if __name__ == "__main__":
    main()
