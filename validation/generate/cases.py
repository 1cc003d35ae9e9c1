"""Hand-made cases: classical linkages, an inclined slider, a moving guide, a triad, floating and linear drivers, redundant joints.

Run: python3 cases.py [case …]
"""

import json
import sys
from math import atan2, cos, hypot, radians, sin, sqrt
from pathlib import Path

from mpmath import mpf
from planar import Mechanism, produce

CASES = Path(__file__).resolve().parent.parent
OWN = "own dimensions"


def meet(p, r, q, s, side):
    """Corner over p → q at distances r and s, on the left (side 1) or right (-1)."""
    d = hypot(q[0] - p[0], q[1] - p[1])
    x = (d * d + r * r - s * s) / (2 * d)
    y = side * sqrt(r * r - x * x)
    e = ((q[0] - p[0]) / d, (q[1] - p[1]) / d)
    return (p[0] + x * e[0] - y * e[1], p[1] + x * e[1] + y * e[0])


def along(p, q):
    """Pose of a link whose frame lies at p with x towards q."""
    return (p[0], p[1], atan2(q[1] - p[1], q[0] - p[0]))


def pin(first, second):
    return {"type": "revolute", "between": [first, second]}


def link(mass, inertia, com, **points):
    return {"mass": mass, "inertia": inertia, "com": com, "points": {k: list(v) for k, v in points.items()}}


def inverse(end, outputs):
    return {"type": "inverse_dynamics", "end": end, "outputs": outputs}


def four_bar():
    model = {
        "format": "linkdyn/1", "name": "Four-bar in mixed units",
        "about": "Crank-rocker; every dimension in another unit, some numbers with their own.", "source": OWN,
        "units": {"length": "cm", "angle": "deg", "mass": "g", "inertia": "kg*mm^2", "stiffness": "N/mm", "torque": "N*mm"},
        "gravity": [0, "-9810 mm/s^2"],
        "bodies": {
            "ground": {"points": {"O2": [0, 0], "O4": ["300 mm", 0], "S": [5, 35]}},
            "crank": link(800, 700, [5, 0], O2=(0, 0), A=(10, 0)),
            "coupler": link("1.9 kg", "0.009 kg*m^2", [12.5, "20 mm"], A=(0, 0), B=(25, 0), P=(12.5, 8)),
            "rocker": link(1500, 5000, [10, 1], O4=(0, 0), B=(20, 0)),
        },
        "joints": {"a": pin("ground.O2", "crank.O2"), "b": pin("crank.A", "coupler.A"), "c": pin("coupler.B", "rocker.B"),
                   "d": pin("ground.O4", "rocker.O4")},
        "drivers": {"motor": {"type": "rotation", "body": "crank",
                              "motion": {"type": "polynomial", "coefficients": [60, "10 rad/s", "-4 rad/s^2"]}}},
        "forces": {
            "return": {"type": "spring", "between": ["ground.S", "coupler.P"], "stiffness": 0.4, "damping": 6, "free_length": "150 mm"},
            "load": {"type": "torque", "body": "rocker", "value": -900},
            "brake": {"type": "torque", "body": "rocker", "relative_to": "coupler", "value": "0.35 N*m"},
        },
        "points": ["coupler.P"],
        "analysis": inverse(1.0, 101),
    }
    a = (0.1 * cos(radians(60)), 0.1 * sin(radians(60)))
    b = meet(a, 0.25, (0.3, 0), 0.2, 1)
    poses = {"crank": (0, 0, radians(60)), "coupler": along(a, b), "rocker": along((0.3, 0), b)}
    return dict(model=model, every=10, poses=poses, digits=(0, -1),
                how="Four-bar crank-rocker with numbers in many units, a damped spring at the coupler point, constant torques. Own dimensions.")


def stephenson_iii():
    a, b, c, d, p, q, u, v = 0.08, 0.105, 0.12, 0.135, 0.225, 0.195, 0.18, 0.18
    g1, g3 = radians(-20), radians(20)
    f = [round(q * cos(g1), 6), round(q * sin(g1), 6)]
    e = [round(p * cos(g3), 6), round(p * sin(g3), 6)]
    model = {
        "format": "linkdyn/1", "name": "Stephenson III six-bar",
        "about": "Four-bar A B C D whose coupler point E drives the dyad E G F.",
        "source": "dimensions of the Stephenson III example in the code of Constans and Dyer, Introduction to Mechanism Design; "
                  "layout, masses and loads ours",
        "units": "SI", "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"A": [0, 0], "D": [d, 0], "F": f}},
            "crank": link(0.4, 3e-4, [0.03, 0.005], A=(0, 0), B=(a, 0)),
            "coupler": link(1.1, 4.5e-3, [0.09, 0.03], B=(0, 0), C=(b, 0), E=e),
            "rocker": link(0.5, 7e-4, [0.06, 0], D=(0, 0), C=(c, 0)),
            "upper": link(0.45, 1.3e-3, [0.09, 0], E=(0, 0), G=(u, 0)),
            "output": link(0.7, 2.1e-3, [0.1, 0.01], F=(0, 0), G=(v, 0), H=(0.25, 0.03)),
        },
        "joints": {"A": pin("ground.A", "crank.A"), "B": pin("crank.B", "coupler.B"), "C": pin("rocker.C", "coupler.C"),
                   "D": pin("ground.D", "rocker.D"), "E": pin("coupler.E", "upper.E"), "F": pin("output.F", "ground.F"),
                   "G": pin("upper.G", "output.G")},
        "drivers": {"motor": {"type": "rotation", "body": "crank",
                              "motion": {"type": "constant_velocity", "start": 0.5, "velocity": 8}}},
        "forces": {"tip": {"type": "force", "at": "output.H", "vector": [0, -25], "frame": "body"},
                   "load": {"type": "torsion_spring", "between": ["ground", "output"], "stiffness": 3, "damping": 0.05, "free_angle": 1}},
        "points": ["output.H", "coupler.E"],
        "analysis": inverse(0.8, 161),
    }
    pb = (a * cos(0.5), a * sin(0.5))
    pc = meet(pb, b, (d, 0), c, 1)
    th = atan2(pc[1] - pb[1], pc[0] - pb[0])
    pe = (pb[0] + p * cos(th + g3), pb[1] + p * sin(th + g3))
    pg = meet(pe, u, f, v, 1)
    poses = {"crank": (0, 0, 0.5), "coupler": along(pb, pc), "rocker": along((d, 0), pc), "upper": along(pe, pg),
             "output": along(f, pg)}
    return dict(model=model, every=16, poses=poses, digits=(2, 1),
                how="Stephenson III six-bar, a whole turn of the crank. Link lengths of the example in the program code that goes with E. Constans and "
                    "K. Dyer, Introduction to Mechanism Design; the layout is our reading of its symbols, masses, spring and load are ours. All "
                    "numbers in reference.csv are computed here.")


def inclined_slider_crank():
    model = {
        "format": "linkdyn/1", "name": "Inclined offset slider-crank",
        "about": "Slider on an inclined line that misses the crank's centre, with spring, damper and loads.", "source": OWN,
        "units": {"length": "mm", "angle": "deg"}, "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"O": [0, 0], "G": [60, 95], "W": [520, 240]}},
            "crank": link(1.3, 2.2e-3, [35, -6], O=(0, 0), A=(120, 0)),
            "rod": link(1.8, 1.9e-2, [150, 8], A=(0, 0), B=(350, 0), K=(210, 40)),
            "slider": link(2.4, 4e-3, [15, 5], B=(0, 0), H=(60, 20)),
        },
        "joints": {"O": pin("ground.O", "crank.O"), "A": pin("crank.A", "rod.A"), "B": pin("rod.B", "slider.B"),
                   "guide": {"type": "prismatic", "between": ["ground.G", "slider.B"], "axis": [0.9, 0.42], "angle": "10 deg"}},
        "drivers": {"motor": {"type": "rotation", "body": "crank",
                              "motion": {"type": "constant_velocity", "start": 20, "velocity": "12 rad/s"}}},
        "forces": {
            "buffer": {"type": "spring", "between": ["slider.H", "ground.W"], "stiffness": 900, "damping": 35, "free_length": 200},
            "cutting": {"type": "force", "at": "slider.H", "vector": [-60, 15], "frame": "body"},
            "side": {"type": "force", "at": "rod.K", "vector": [12, -18]},
            "ripple": {"type": "torque", "body": "crank",
                       "value": {"type": "harmonic", "offset": 0.5, "amplitude": 2, "frequency": 3, "phase": "30 deg"}},
        },
        "points": ["slider.H"],
        "analysis": inverse(0.5, 101),
    }
    e = (0.9 / hypot(0.9, 0.42), 0.42 / hypot(0.9, 0.42))
    a = (0.12 * cos(radians(20)), 0.12 * sin(radians(20)))
    d = (a[0] - 0.06, a[1] - 0.095)
    off, base = d[1] * e[0] - d[0] * e[1], d[0] * e[0] + d[1] * e[1]
    s = base + sqrt(0.35**2 - off**2)
    b = (0.06 + s * e[0], 0.095 + s * e[1])
    poses = {"crank": (0, 0, radians(20)), "rod": along(a, b), "slider": (*b, radians(10))}
    return dict(model=model, every=10, poses=poses, digits=(-1, -1),
                how="Offset slider-crank, guide inclined by atan(0.42/0.9), slider frame turned by 10 deg; loads fixed in the ground and in a "
                    "body, a torque that varies with time. Own dimensions.")


def inverted_slider_crank():
    model = {
        "format": "linkdyn/1", "name": "Inverted slider-crank",
        "about": "Quick-return: a block on the crank pin slides in a swinging guide, beside the guide's pivot.", "source": OWN,
        "units": "SI", "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"O2": [0, 0.2], "O4": [0.02, 0]}},
            "crank": link(0.9, 1.5e-3, [0.02, 0.01], O2=(0, 0), A=(0.08, 0)),
            "block": link(0.25, 8e-5, [0.004, 0.002], A=(0, 0), K=(0.015, -0.01)),
            "guide": link(2.2, 3.4e-2, [0.17, 0.01], O4=(0, 0), slot=(0.05, 0.03), tip=(0.4, 0)),
        },
        "joints": {"O2": pin("ground.O2", "crank.O2"), "A": pin("crank.A", "block.A"),
                   "slide": {"type": "prismatic", "between": ["guide.slot", "block.K"], "axis": [2, 0], "angle": 0.3},
                   "O4": pin("ground.O4", "guide.O4")},
        "drivers": {"motor": {"type": "rotation", "body": "crank",
                              "motion": {"type": "polynomial", "coefficients": [0.2, 3, 1.5, -0.25]}}},
        "forces": {"return": {"type": "torsion_spring", "between": ["guide", "ground"], "stiffness": 12, "damping": 0.4, "free_angle": -1.5},
                   "tool": {"type": "force", "at": "guide.tip", "vector": [-40, 0]}},
        "points": ["guide.tip"],
        "analysis": inverse(2.0, 101),
    }
    a = (0.08 * cos(0.2), 0.2 + 0.08 * sin(0.2))
    th = atan2(a[1], a[0] - 0.02) - 0.1
    poses = {"crank": (0, 0.2, 0.2), "block": (*a, th + 0.3), "guide": (0.02, 0, th)}
    return dict(model=model, every=10, poses=poses, digits=(2, 1),
                how="Slotted-lever quick-return: the prismatic joint's guide moves, the slot misses its pivot, the block is turned by 0.3 rad "
                    "in the slot and held at a point beside the crank pin. Own dimensions.")


def assur_class_iii():
    place = {"O": (0, 0), "A": (0.05, 0.087), "D": (0.33, 0.24), "E": (0.55, 0.32), "F": (0.46, 0.11), "P": (0.5, 0.65), "Q": (0.7, -0.1)}
    dist = lambda p, q: round(hypot(place[q][0] - place[p][0], place[q][1] - place[p][1]), 3)
    de, df = dist("D", "E"), dist("D", "F")
    turn = atan2(0.11 - 0.24, 0.46 - 0.33) - atan2(0.08, 0.22)
    tern = (round(df * cos(turn), 3), round(df * sin(turn), 3))
    bar = lambda p, q, m, j: link(m, j, [dist(p, q) / 2, 0.004], **{p: (0, 0), q: (dist(p, q), 0)})
    model = {
        "format": "linkdyn/1", "name": "Triad",
        "about": "A ternary link on three links, to a driven crank and two fixed pivots: an Assur group of class III, "
                 "which can't be solved dyad by dyad.",
        "source": OWN, "units": "SI", "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {k: list(place[k]) for k in "OPQ"}},
            "crank": bar("O", "A", 0.5, 6e-4), "first": bar("A", "D", 0.8, 7e-3),
            "plate": link(2.5, 1.4e-2, [0.13, -0.04], D=(0, 0), E=(de, 0), F=tern),
            "second": bar("P", "E", 0.9, 8e-3), "third": bar("Q", "F", 0.85, 7.5e-3),
        },
        "joints": {"O": pin("ground.O", "crank.O"), "A": pin("crank.A", "first.A"), "D": pin("first.D", "plate.D"),
                   "E": pin("plate.E", "second.E"), "F": pin("plate.F", "third.F"), "P": pin("ground.P", "second.P"),
                   "Q": pin("third.Q", "ground.Q")},
        "drivers": {"motor": {"type": "rotation", "body": "crank",
                              "motion": {"type": "harmonic", "offset": 1.05, "amplitude": 0.6, "frequency": 0.8, "phase": 0.1}}},
        "forces": {"spring": {"type": "spring", "between": ["ground.O", "plate.F"], "stiffness": 300, "damping": 8, "free_length": 0.4}},
        "points": ["plate.E"],
        "analysis": inverse(1.25, 101),
    }
    start = 1.05 + 0.6 * sin(0.1)
    poses = {"crank": (0, 0, start), "first": along(place["A"], place["D"]), "plate": along(place["D"], place["E"]),
             "second": along(place["P"], place["E"]), "third": along(place["Q"], place["F"])}
    return dict(model=model, every=10, poses=poses, digits=(2, 1), how="Triad (Assur group of class III), harmonic drive. Own dimensions.")


def floating_driver():
    model = {
        "format": "linkdyn/1", "name": "Five-bar with a driven elbow",
        "about": "Two degrees of freedom; one motor sits between two moving links, a third turns a tool on a moving link.",
        "source": OWN, "units": {"angle": "deg"}, "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"A": [0, 0], "E": [0.5, 0]}},
            "left": link(1.2, 5e-3, [0.09, 0], A=(0, 0), B=(0.2, 0)),
            "upper": link(1.5, 1.7e-2, [0.16, 0.01], B=(0, 0), C=(0.35, 0)),
            "fore": link(1.4, 1.5e-2, [0.15, -0.01], C=(0, 0), D=(0.33, 0)),
            "right": link(1.1, 4.5e-3, [0.12, 0], D=(0, 0), E=(0.22, 0), T=(0.1, 0.05)),
            "tool": link(0.6, 1.2e-3, [0.05, 0.02], T=(0, 0), tip=(0.15, 0)),
        },
        "joints": {"A": pin("ground.A", "left.A"), "B": pin("left.B", "upper.B"), "C": pin("upper.C", "fore.C"),
                   "D": pin("fore.D", "right.D"), "E": pin("right.E", "ground.E"), "T": pin("right.T", "tool.T")},
        "drivers": {
            "elbow": {"type": "rotation", "body": "fore", "relative_to": "upper",
                      "motion": {"type": "polynomial", "coefficients": [-95, 20, -12, 3]}},
            "base": {"type": "rotation", "body": "left",
                     "motion": {"type": "harmonic", "offset": 110, "amplitude": 15, "frequency": 0.7, "phase": "0 rad"}},
            "wrist": {"type": "rotation", "body": "tool", "relative_to": "right",
                      "motion": {"type": "constant_acceleration", "start": 30, "velocity": "1 rad/s", "acceleration": "-0.8 rad/s^2"}},
        },
        "forces": {"tip": {"type": "force", "at": "tool.tip", "vector": [10, {"type": "polynomial", "coefficients": [-5, 4]}]}},
        "points": ["tool.tip", "upper.C"],
        "analysis": inverse(1.5, 101),
    }
    b = (0.2 * cos(radians(110)), 0.2 * sin(radians(110)))
    # upper and fore with 95 deg between them act as one side from B to D
    bd = hypot(0.35 + 0.33 * cos(radians(-95)), 0.33 * sin(radians(-95)))
    d = meet(b, bd, (0.5, 0), 0.22, 1)
    c = meet(b, 0.35, d, 0.33, 1)
    up, fore = along(b, c), along(c, d)
    right = along(d, (0.5, 0))
    t = (right[0] + 0.1 * cos(right[2]) - 0.05 * sin(right[2]), right[1] + 0.1 * sin(right[2]) + 0.05 * cos(right[2]))
    poses = {"left": (0, 0, radians(110)), "upper": up, "fore": fore, "right": right, "tool": (*t, right[2] + radians(30))}
    return dict(model=model, every=10, poses=poses, digits=(2, -1),
                how="Five-bar of two degrees of freedom: one driver from the ground, one between two floating links, and an open chain driven from "
                    "a moving link. Own dimensions.")


def translation_driver():
    model = {
        "format": "linkdyn/1", "name": "Excavator arm",
        "about": "Boom and stick, each moved by a hydraulic cylinder: prismatic joints between two moving bodies, driven in length.",
        "source": OWN, "units": {"length": "mm", "angle": "deg", "velocity": "mm/s", "acceleration": "mm/s^2"},
        "gravity": ["0 m/s^2", "-9.81 m/s^2"],
        "bodies": {
            "ground": {"points": {"B": [0, 0], "C": [400, -300]}},
            "boom": link(450, 620, [1350, 180], B=(0, 0), C=(1300, 60), D=(1500, 500), S=(2800, 0)),
            "stick": link(220, 95, [500, 40], S=(0, 0), R=(-450, 120), tip=(1500, 0)),
            "barrel1": link(60, 6, [350, 0], C=(0, 0), front=(300, 0)),
            "rod1": link(35, 4, [-400, 0], C=(0, 0)),
            "barrel2": link(55, 5, [380, 0], D=(0, 0), front=(200, 10)),
            "rod2": link(30, 3.5, [-350, 0], R=(0, 0)),
        },
        "joints": {
            "boom": pin("ground.B", "boom.B"), "stick": pin("boom.S", "stick.S"),
            "foot1": pin("ground.C", "barrel1.C"), "head1": pin("rod1.C", "boom.C"),
            "cylinder1": {"type": "prismatic", "between": ["barrel1.front", "rod1.C"], "axis": [1, 0]},
            "foot2": pin("boom.D", "barrel2.D"), "head2": pin("rod2.R", "stick.R"),
            "cylinder2": {"type": "prismatic", "between": ["barrel2.front", "rod2.R"], "axis": [3, 0.15], "angle": 5},
        },
        "drivers": {
            "lift": {"type": "translation", "joint": "cylinder1",
                     "motion": {"type": "polynomial", "coefficients": [800, 0, 60, -15]}},
            "crowd": {"type": "translation", "joint": "cylinder2",
                      "motion": {"type": "harmonic", "offset": "0.95 m", "amplitude": 150, "frequency": 0.25, "phase": "0.5 rad"}},
        },
        "forces": {"digging": {"type": "force", "at": "stick.tip", "vector": ["-6 kN", 2500], "frame": "body"}},
        "points": ["stick.tip"],
        "analysis": inverse(2.5, 126),
    }
    l1 = 1.1
    bc = hypot(1.3, 0.06)
    c = meet((0, 0), bc, (0.4, -0.3), l1, 1)
    th = atan2(c[1], c[0]) - atan2(0.06, 1.3)
    glob = lambda p: (p[0] * cos(th) - p[1] * sin(th), p[0] * sin(th) + p[1] * cos(th))
    d, s = glob((1.5, 0.5)), glob((2.8, 0))
    l2 = 0.2 + 0.95 + 0.15 * sin(0.5)
    r = meet(d, l2, s, hypot(0.45, 0.12), 1)
    st = atan2(r[1] - s[1], r[0] - s[0]) - atan2(0.12, -0.45)
    c1, c2 = along((0.4, -0.3), c), along(d, r)
    poses = {"boom": (0, 0, th), "stick": (*s, st), "barrel1": c1, "rod1": (*c, c1[2]), "barrel2": c2, "rod2": (*r, c2[2] + radians(5))}
    return dict(model=model, every=5 * 5, poses=poses, digits=(-1, 0),
                how="Excavator arm with two hydraulic cylinders as linear drivers between moving bodies (one with an axis that is oblique in its "
                    "barrel and a rod turned by 5 deg). Own dimensions.")


def doubled_joint():
    model = {
        "format": "linkdyn/1", "name": "Four-bar with a doubled pin",
        "about": "The pin between coupler and rocker stands twice: two constraints too many; by least norm each pin takes half.",
        "source": OWN, "units": "SI", "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"O2": [0, 0], "O4": [0.3, 0]}},
            "crank": link(0.8, 7e-4, [0.05, 0], O2=(0, 0), A=(0.1, 0)),
            "coupler": link(1.9, 9e-3, [0.125, 0.02], A=(0, 0), B=(0.25, 0)),
            "rocker": link(1.5, 5e-3, [0.1, 0], O4=(0, 0), B=(0.2, 0)),
        },
        "joints": {"a": pin("ground.O2", "crank.O2"), "b": pin("crank.A", "coupler.A"), "c1": pin("coupler.B", "rocker.B"),
                   "c2": pin("rocker.B", "coupler.B"), "d": pin("ground.O4", "rocker.O4")},
        "drivers": {"motor": {"type": "rotation", "body": "crank",
                              "motion": {"type": "constant_velocity", "start": 1, "velocity": 10}}},
        "analysis": inverse(0.6, 61),
    }
    a = (0.1 * cos(1), 0.1 * sin(1))
    b = meet(a, 0.25, (0.3, 0), 0.2, 1)
    return dict(model=model, every=6, poses={"crank": (0, 0, 1.0), "coupler": along(a, b), "rocker": along((0.3, 0), b)}, digits=(2, 1),
                how="Four-bar whose coupler-rocker pin stands twice, once in each direction. By symmetry the least-norm solution gives each pin half of "
                    "the force of the single pin, c2 = -c1 because its bodies are named the other way round; the motion, the torque and the other "
                    "reactions are those of the simple four-bar. The least-norm solution is taken over all joint forces (N); the script compares it "
                    "with numpy's pseudo-inverse, and with halves of the simple four-bar.")


def parallel_crank():
    crank = lambda m, j, p, q: link(m, j, [0.09, 0.01], **{p: (0, 0), q: (0.2, 0)})
    model = {
        "format": "linkdyn/1", "name": "Parallel cranks",
        "about": "Parallelogram with a third crank: one constraint too many, motion unique, reactions of least norm.",
        "source": OWN, "units": "SI", "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"P": [0, 0], "Q": [0.25, 0], "R": [0.6, 0]}},
            "first": crank(1.0, 4e-3, "P", "A"), "second": crank(0.7, 3e-3, "Q", "B"), "third": crank(1.6, 6e-3, "R", "C"),
            "bar": link(3.0, 0.11, [0.33, 0.03], A=(0, 0), B=(0.25, 0), C=(0.6, 0), H=(0.7, 0.05)),
        },
        "joints": {"P": pin("ground.P", "first.P"), "Q": pin("ground.Q", "second.Q"), "R": pin("ground.R", "third.R"),
                   "A": pin("first.A", "bar.A"), "B": pin("second.B", "bar.B"), "C": pin("bar.C", "third.C")},
        "drivers": {"motor": {"type": "rotation", "body": "first",
                              "motion": {"type": "harmonic", "offset": 1.5, "amplitude": 0.9, "frequency": 1, "phase": 0.4}}},
        "forces": {"load": {"type": "force", "at": "bar.H", "vector": [20, -50]}},
        "analysis": inverse(1.0, 101),
    }
    start = 1.5 + 0.9 * sin(0.4)
    tip = lambda x: (x + 0.2 * cos(start), 0.2 * sin(start))
    poses = {"first": (0, 0, start), "second": (0.25, 0, start), "third": (0.6, 0, start), "bar": (*tip(0), 0.0)}
    return dict(model=model, every=10, poses=poses, digits=(2, 1),
                how="Parallelogram with a third crank: thirteen scalar constraints (twelve of joints, one of the driver) on twelve coordinates, never "
                    "flat in the range. The reactions are those of least Euclidean norm over all joint forces (N), A^T (A A^T)^-1 b in 40 digits, "
                    "compared with numpy's pseudo-inverse of the full equilibrium matrix. (The driver's torque is unique, so it makes no difference "
                    "whether it counts in the norm.)")


def compare_with_single_pin(machine, model):
    """The doubled pins carry half of the single one each; everything else is as with the single pin."""
    single = json.loads(json.dumps(model))
    del single["joints"]["c2"]
    single = Mechanism(single)
    for t in (mpf(0), mpf("0.24"), mpf("0.6")):
        twice, once = (dict(zip(m.columns(), m.row(t, m.follow([t])[0]))) for m in (machine, single))
        for column, value in once.items():
            for c, share in (("c1", mpf(1) / 2), ("c2", -mpf(1) / 2)) if "joint.c1" in column else (("c1", 1),):
                assert abs(twice[column.replace("c1", c)] - share * value) < mpf(10) ** -25 * (1 + abs(value)), column


def slot(first, second, axis):
    return {"type": "slot", "between": [first, second], "axis": axis}


def slotted_lever():
    model = {
        "format": "linkdyn/1", "name": "Slotted lever and ram",
        "about": "Shaper: the crank pin runs in a lever's slot, a pin of the ram in another slot of the lever.", "source": OWN,
        "units": {"length": "mm", "angle": "deg", "inertia": "kg*mm^2"}, "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"O2": [20, 250], "O4": [0, 0], "R": [0, 520]}},
            "crank": link(1.4, 3100, [25, 5], O2=(0, 0), A=(95, 0)),
            "lever": link(3.1, 91000, [260, -12], O4=(0, 0), S=(40, 15), T=(0, -25)),
            "ram": link(6.5, 42000, [60, 30], B=(0, 0), tool=(-220, 10)),
        },
        "joints": {"O2": pin("ground.O2", "crank.O2"), "O4": pin("lever.O4", "ground.O4"), "A": slot("lever.S", "crank.A", [3, 0]),
                   "B": slot("lever.T", "ram.B", [0.98, 0.05]),
                   "guide": {"type": "prismatic", "between": ["ground.R", "ram.B"], "axis": [1, 0]}},
        "drivers": {"motor": {"type": "rotation", "body": "crank",
                              "motion": {"type": "polynomial", "coefficients": [35, 300, 40]}}},
        "forces": {"cutting": {"type": "force", "at": "ram.tool", "vector": [{"type": "harmonic", "offset": -150, "amplitude": 100,
                                                                              "frequency": 1.5, "phase": "20 deg"}, 40]},
                   "drag": {"type": "spring", "between": ["ground.O2", "ram.tool"], "stiffness": 90, "damping": 25, "free_length": 300}},
        "points": ["ram.tool", "crank.A"],
        "analysis": inverse(1.0, 101),
    }
    a = (0.02 + 0.095 * cos(radians(35)), 0.25 + 0.095 * sin(radians(35)))
    th = atan2(a[1], a[0]) - 0.05
    poses = {"crank": (0.02, 0.25, radians(35)), "lever": (0, 0, th), "ram": (0.52 / sin(th) * cos(th), 0.52, 0)}
    return dict(model=model, every=10, poses=poses, digits=(0, 0),
                how="Shaper mechanism with two slots in a turning body, both beside its pivot, one of them not along its x axis. Own dimensions.")


def driven_slot():
    model = {
        "format": "linkdyn/1", "name": "Driven slot",
        "about": "A cylinder in a slot: the slide of a pin along a swinging arm is driven, the pin's link may turn.", "source": OWN,
        "units": "SI", "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"O": [0, 0], "Q": [0.5, 0.1]}},
            "arm": link(1.7, 2.4e-2, [0.2, 0.03], O=(0, 0), S=(0.05, 0.02)),
            "rocker": link(1.2, 1.1e-2, [0.13, -0.02], Q=(0, 0), P=(0.3, 0.04), K=(0.36, 0)),
        },
        "joints": {"O": pin("ground.O", "arm.O"), "Q": pin("ground.Q", "rocker.Q"), "pin": slot("arm.S", "rocker.P", [1, 0.1])},
        "drivers": {"cylinder": {"type": "translation", "joint": "pin",
                                 "motion": {"type": "harmonic", "offset": 0.38, "amplitude": 0.1, "frequency": 0.8, "phase": 0.4}}},
        "forces": {"load": {"type": "force", "at": "rocker.K", "vector": [15, -30], "frame": "body"}},
        "points": ["rocker.K"],
        "analysis": inverse(1.5, 151),
    }
    s = 0.38 + 0.1 * sin(0.4)
    reach = hypot(0.05 + s * 0.995, 0.02 + s * 0.0995)
    p = meet((0, 0), reach, (0.5, 0.1), hypot(0.3, 0.04), 1)
    poses = {"arm": (0, 0, atan2(p[1], p[0]) - 0.13), "rocker": (0.5, 0.1, atan2(p[1] - 0.1, p[0] - 0.5) - 0.13)}
    return dict(model=model, every=10, poses=poses, digits=(2, 1),
                how="The slide of a slot is driven by a harmonic motion; the slot turns with its arm and misses the pivot. Own dimensions.")


def geared_five_bar():
    model = {
        "format": "linkdyn/1", "name": "Geared five-bar, unequal wheels",
        "about": "Five-bar whose cranks mesh at −3/2, drawn at rough poses, with the mesh told in degrees.", "source": OWN,
        "units": {"length": "mm", "angle": "deg"}, "gravity": [0, -9.81],
        "bodies": {
            "ground": {"points": {"A": [10, -20], "B": [190, 40], "W": [100, 400]}},
            "one": link(1.6, 4.2e-3, [6, -9], A=(0, 0), C=(45, 0)),
            "two": link(1.1, 1.9e-3, [-4, 3], B=(0, 0), D=(38, 0)),
            "first": link(0.7, 4.4e-3, [120, 6], C=(0, 0), P=(250, 0)),
            "second": link(0.8, 4.9e-3, [115, -5], D=(0, 0), P=(240, 0), E=(300, 50)),
        },
        "joints": {"A": pin("ground.A", "one.A"), "B": pin("two.B", "ground.B"), "C": pin("one.C", "first.C"), "D": pin("two.D", "second.D"),
                   "P": pin("first.P", "second.P"),
                   "mesh": {"type": "gear", "between": ["one.A", "two.B"], "carrier": "ground", "ratio": -1.5, "angle": 160}},
        "drivers": {"motor": {"type": "rotation", "body": "one", "motion": {"type": "polynomial", "coefficients": [20, "5 rad/s", "2 rad/s^2"]}}},
        "forces": {"spring": {"type": "spring", "between": ["second.E", "ground.W"], "stiffness": 400, "damping": 12, "free_length": 150}},
        "points": ["second.E"],
        "analysis": inverse(1.2, 121),
    }
    th1, th2 = radians(20), radians(130)
    c = (0.01 + 0.045 * cos(th1), -0.02 + 0.045 * sin(th1))
    d = (0.19 + 0.038 * cos(th2), 0.04 + 0.038 * sin(th2))
    p = meet(c, 0.25, d, 0.24, 1)
    poses = {"one": (0.01, -0.02, th1), "two": (0.19, 0.04, th2), "first": along(c, p), "second": along(d, p)}
    return dict(model=model, every=10, poses=poses, digits=(-1, -1),
                how="Five-bar closed by a gear pair on the ground, line of centres inclined, masses off the wheels' centres. Own dimensions.")


def planetary_crank():
    model = {
        "format": "linkdyn/1", "name": "Planet on a swinging arm",
        "about": "A sun wheel turns a planet on a moving carrier; the planet, also inside a fixed ring, carries a rod to a slider.",
        "source": OWN, "units": "SI", "gravity": [0.5, -9.81],
        "bodies": {
            "ground": {"points": {"O": [0.03, 0.02], "G": [0.02, -0.11]}},
            "sun": link(2.1, 5.2e-3, [0.004, 0.002], O=(0, 0)),
            "arm": link(0.9, 2.8e-3, [0.04, -0.01], O=(0, 0), C=(0.08, 0.06)),
            "planet": link(0.8, 6.1e-4, [0.003, -0.005], C=(0, 0), K=(0.02, 0.015)),
            "rod": link(0.6, 3.9e-3, [0.14, 0.01], K=(0, 0), B=(0.34, 0)),
            "slider": link(1.3, 1e-3, [0.01, 0.01], B=(0, 0)),
        },
        "joints": {"sun": pin("ground.O", "sun.O"), "arm": pin("arm.O", "sun.O"), "C": pin("planet.C", "arm.C"),
                   "inner": {"type": "gear", "between": ["sun.O", "planet.C"], "carrier": "arm", "ratio": -2.5, "angle": 0.4},
                   "outer": {"type": "gear", "between": ["planet.C", "ground.O"], "carrier": "arm", "ratio": 0.222},
                   "K": pin("planet.K", "rod.K"), "B": pin("rod.B", "slider.B"),
                   "guide": {"type": "prismatic", "between": ["ground.G", "slider.B"], "axis": [1, 0.2], "angle": 0.1}},
        "drivers": {"motor": {"type": "rotation", "body": "sun", "motion": {"type": "polynomial", "coefficients": [0.3, 6, 2.5]}}},
        "forces": {"load": {"type": "force", "at": "slider.B", "vector": [-35, 0]},
                   "brake": {"type": "torque", "body": "arm", "relative_to": "planet", "value": 0.6}},
        "points": ["planet.K"],
        "analysis": inverse(2.5, 251),
    }
    arm, sun = 0.2, 0.3
    planet = arm - 2.5 * (sun - arm) + 0.4
    c = (0.03 + 0.1 * cos(arm + atan2(3, 4)), 0.02 + 0.1 * sin(arm + atan2(3, 4)))
    k = (c[0] + 0.025 * cos(planet + atan2(3, 4)), c[1] + 0.025 * sin(planet + atan2(3, 4)))
    e = (1 / hypot(1, 0.2), 0.2 / hypot(1, 0.2))
    d = (k[0] - 0.02, k[1] + 0.11)
    off, base = d[1] * e[0] - d[0] * e[1], d[0] * e[0] + d[1] * e[1]
    s = base + sqrt(0.34**2 - off**2)
    b = (0.02 + s * e[0], -0.11 + s * e[1])
    # the ring meshes as drawn, at these very poses
    model["joints"]["outer"]["angle"] = -arm - 0.222 * (planet - arm)
    poses = {"sun": (0.03, 0.02, sun), "arm": (0.03, 0.02, arm), "planet": (*c, planet), "rod": along(k, b), "slider": (*b, 0.1)}
    return dict(model=model, every=10, poses=poses, digits=(2, 1),
                how="Planetary train with one external and one internal mesh on a carrier that turns more than once; every mass off its centre, a rod at "
                    "the planet. The free bodies get the tooth forces at the pitch points, unlike the engine's multipliers. Own dimensions.")


def rubbing_four_bar():
    """The four-bar with friction in all its pins and in a slider that hangs on it."""
    case = four_bar()
    model = case["model"]
    model["name"] = "Four-bar with friction"
    model["about"] = "Crank-rocker with friction in every pin, and a slider at the coupler that rubs on a tilted guide with both its ends."
    for joint, mu, radius in (("a", 0.15, "12 mm"), ("b", 0.1, "8 mm"), ("c", 0.2, 0.9), ("d", 0.12, "0.01 m")):
        model["joints"][joint] |= {"friction": {"law": "coulomb", "coefficient": mu, "threshold_velocity": 0.02}, "pin_radius": radius}
    model["bodies"]["ground"]["points"]["G"] = [12, 20]
    model["bodies"]["link"] = link("0.4 kg", "1e-3 kg*m^2", [8, 0], P=(0, 0), Q=(16, 0))
    model["bodies"]["slider"] = link("0.7 kg", "4e-4 kg*m^2", [1, 0.5], Q=(0, 0))
    model["joints"] |= {
        "e": pin("coupler.P", "link.P"),
        "f": pin("link.Q", "slider.Q"),
        "g": {"type": "prismatic", "between": ["ground.G", "slider.Q"], "axis": [5, 1], "angle": "0.1 rad",
              "friction": {"law": "coulomb", "coefficient": 0.18, "threshold_velocity": "30 mm/s"}, "guide_length": "15 mm"},
    }
    model["units"]["velocity"] = "m/s"
    # the coupler point where the file's poses put it, and the slider on the guide's right
    place, turn = case["poses"]["coupler"][:2], case["poses"]["coupler"][2]
    p = (place[0] + 0.125 * cos(turn) - 0.08 * sin(turn), place[1] + 0.125 * sin(turn) + 0.08 * cos(turn))
    e = (5 / hypot(5, 1), 1 / hypot(5, 1))
    d = (p[0] - 0.12, p[1] - 0.20)
    off, base = d[1] * e[0] - d[0] * e[1], d[0] * e[0] + d[1] * e[1]
    s = base + sqrt(0.16**2 - off**2)
    q = (0.12 + s * e[0], 0.20 + s * e[1])
    case["poses"] |= {"link": along(p, q), "slider": (*q, 0.1)}
    case["how"] = ("The case `four-bar` with a link and a slider at the coupler point, and Coulomb's friction with a ramp in the pins of the four-bar and in the "
                   "slider's guide: the free bodies are solved again and again, with the friction of the reactions found, until no digit changes. Own dimensions.")
    return case


ALL = [four_bar, rubbing_four_bar, stephenson_iii, inclined_slider_crank, inverted_slider_crank, assur_class_iii, floating_driver, translation_driver, slotted_lever,
       driven_slot, geared_five_bar, planetary_crank,
       doubled_joint, parallel_crank]


def main():
    for make in ALL:
        name = make.__name__.replace("_", "-")
        if sys.argv[1:] and name not in sys.argv[1:]:
            continue
        case = make()
        model = case.pop("model")
        how = case.pop("how")
        poses = {b: pose for b, pose in case.pop("poses").items()} | {"ground": (0, 0, 0)}
        machine = produce(CASES / name, model, (model["about"], model["source"]), how, poses=poses, **case)
        if make is doubled_joint:
            compare_with_single_pin(machine, model)


if __name__ == "__main__":
    main()
