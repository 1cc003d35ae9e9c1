"""Random closed linkages of 5, 9 and 13 moving bodies, driven by one crank, and their sensitivities.

Each linkage is grown from a seed by a crank, dyads and triads; every coordinate of a point that is not zero is a parameter of its own. A linkage is
thrown away where its loops come near a singular position between the first and the last pose. Sensitivities by implicit differentiation
of the loops (accuracy.py), and each once more by closing the whole linkage again with a neighbouring length or offset.

Run: python3 accuracy_random.py
"""

import json
import math
import random
import sys

import accuracy
from accuracy import CASES, FLOAT, MP, Loops, Model, eliminate, mp, mpc, mpf, pin, text

RECIPES = {1: (7100, ("dyad", "dyad")), 2: (7200, ("triad", "dyad", "dyad")), 3: (7300, ("dyad", "triad", "dyad", "dyad", "dyad"))}
SWING = (-0.3, 0.0, 0.35)  # the three poses about the start [rad]
SMALLEST = 0.02  # least pivot of the scaled loop equations that is let through


class Grower:
    def __init__(self, seed):
        self.r = random.Random(seed)
        self.at = {"ground": {"O": 0j}}  # points of the bodies in global places at the start
        self.joints, self.ternary = {}, []
        self.crank()

    def body(self, name, at):
        self.at[name] = {"O": at}
        return name

    def point(self, body, at):
        for name, place in self.at[body].items():
            if place == at and name != "O":
                return f"{body}.{name}"
        name = "PQRSTUVW"[len(self.at[body]) - 1]
        self.at[body][name] = at
        return f"{body}.{name}"

    def pin(self, first, second):
        self.joints[f"j{len(self.joints) + 1}"] = (first, second) if self.r.random() < 0.5 else (second, first)

    def crank(self):
        self.body("crank", 0j)
        self.joints["main"] = ("ground.O", "crank.O")
        start = self.r.uniform(-math.pi, math.pi)
        self.at["crank"]["P"] = 0.09 * FLOAT.cis(start)
        self.start = start

    def free_point(self, body):
        """A point of a body where something can be hung: an end in use, or a new one beside it."""
        places = list(self.at[body].values())
        if body == "ground":
            return complex(self.r.uniform(-0.35, 0.45), self.r.uniform(-0.35, 0.35))
        middle = sum(places) / len(places)
        return middle + self.r.uniform(0.06, 0.14) * FLOAT.cis(self.r.uniform(-math.pi, math.pi))

    def two(self, low, high):
        """Places on two bodies; the first one is the youngest or the crank, so that the motion is handed on."""
        while True:
            bodies = list(self.at)
            a = self.r.choice(bodies[1:][-3:])
            b = self.r.choice([k for k in bodies if k != a])
            p = self.at["crank"]["P"] if a == "crank" else self.free_point(a)
            q = self.at["crank"]["P"] if b == "crank" else self.free_point(b)
            if low < abs(q - p) < high:
                return a, p, b, q

    def corner(self, p, q):
        """A place that is seen from p and q under 60 to 120 deg."""
        g, ratio, side = self.r.uniform(math.pi / 3, 2 * math.pi / 3), self.r.uniform(0.75, 1.35), self.r.choice((1, -1))
        a = abs(q - p) / math.sqrt(1 + ratio**2 - 2 * ratio * math.cos(g))
        x = (abs(q - p) ** 2 + a * a - (ratio * a) ** 2) / (2 * abs(q - p))
        return p + (x + 1j * side * math.sqrt(max(a * a - x * x, 0))) * (q - p) / abs(q - p)

    def name(self):
        return f"bar{len(self.at) - 1}"

    def dyad(self):
        a, p, b, q = self.two(0.2, 0.6)
        m = self.corner(p, q)
        one = self.body(self.name(), p)
        two = self.body(self.name(), q)
        self.pin(self.point(a, p), f"{one}.O")
        self.pin(self.point(b, q), f"{two}.O")
        self.pin(self.point(one, m), self.point(two, m))

    def triad(self):
        """A plate held by three rods."""
        while True:
            (a, p, b, q), (_, _, c, s) = self.two(0.25, 0.6), self.two(0.1, 0.9)
            if min(abs(s - p), abs(s - q)) > 0.12:
                break
        middle = (p + q + s) / 3 + self.r.uniform(0.1, 0.2) * FLOAT.cis(self.r.uniform(-math.pi, math.pi))
        turn = self.r.uniform(-math.pi, math.pi)
        corners = [middle + self.r.uniform(0.08, 0.15) * FLOAT.cis(turn + k * 2 * math.pi / 3 + self.r.uniform(-0.4, 0.4)) for k in range(3)]
        plate = self.body(self.name(), corners[0])
        for body, place, corner in ((a, p, corners[0]), (b, q, corners[1]), (c, s, corners[2])):
            rod = self.body(self.name(), place)
            self.pin(self.point(body, place), f"{rod}.O")
            self.pin(self.point(rod, corner), f"{plate}.O" if corner == corners[0] else self.point(plate, corner))

    def model(self, number):
        """Frames along the first point; lengths in mm with one decimal, so that the file is exact."""
        parameters, bodies = {}, {}
        self.frames = {}
        for name, points in self.at.items():
            moving = name != "ground"
            along = next((z - points["O"] for k, z in points.items() if k != "O"), 1) if moving else 1
            angle = math.atan2(along.imag, along.real) if moving else 0.0
            self.frames[name] = angle
            out = {"O": [0, 0]}
            for k, z in points.items():
                if k == "O":
                    continue
                local = (z - points["O"]) * FLOAT.cis(-angle)
                stem = f"{name}_{k}"
                binary = moving and k == "P"
                for axis, value in (("x", local.real), ("y", local.imag)):
                    if not (binary and axis == "y"):
                        parameters[stem if binary else f"{stem}_{axis}"] = f"{round(1000 * value, 1)} mm"
                out[k] = [f"={stem}", 0] if binary else [f"={stem}_x", f"={stem}_y"]
            bodies[name] = {"points": out}
            if moving:
                at = points["O"]
                bodies[name]["pose"] = {"position": [round(1000 * at.real, 1), round(1000 * at.imag, 1)], "angle": round(math.degrees(angle), 1)}
        first = round(math.degrees(self.start + SWING[0]), 1)
        last = list(self.at)[-1]
        end = next(k for k in reversed(self.at[last]) if k != "O")
        return {
            "format": "linkdyn/1", "name": f"Random linkage {number}",
            "about": f"A closed linkage of {len(bodies) - 1} moving bodies with a parameter for each length, for sensitivities",
            "source": "Made for this engine; dimensions are random",
            "units": {"length": "mm", "angle": "deg"}, "parameters": parameters, "bodies": bodies,
            "joints": {k: {"type": "revolute", "between": list(v)} for k, v in self.joints.items()},
            "drivers": {"motor": {"type": "rotation", "body": "crank", "motion": {"type": "polynomial", "coefficients": [first, "0.7 rad/s"]}}},
            "points": [f"{last}.{end}"], "analysis": {"type": "kinematics", "end": 1, "outputs": 141}}


def layout(model):
    """The model as people write it: an entry a line below the second level."""
    lines = []
    for k, v in model.items():
        if isinstance(v, dict) and k in ("bodies", "joints", "parameters"):
            inner = ",\n".join(f"    {json.dumps(n)}: {json.dumps(w)}" for n, w in v.items())
            lines.append(f"  {json.dumps(k)}: {{\n{inner}\n  }}")
        else:
            lines.append(f"  {json.dumps(k)}: {json.dumps(v)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def condition(loops, theta):
    """Least pivot of the loop equations, columns scaled by the size of the linkage (about 0.2 m): a rough distance from singular positions."""
    points = {k: complex(z) for k, z in loops.model.points().items()}
    m = [[v / 0.2 for v in row] for row in zip(*loops.jacobian(points, loops.turns(FLOAT, {b: float(t) for b, t in theta.items()})))]
    least = math.inf
    for i in range(len(m)):
        p = max(range(i, len(m)), key=lambda r: abs(m[r][i]))
        m[i], m[p] = m[p], m[i]
        least = min(least, abs(m[i][i]))
        if least < 1e-9:
            return 0.0
        for r in range(i + 1, len(m)):
            f = m[r][i] / m[i][i]
            m[r] = [x - f * y for x, y in zip(m[r], m[i])]
    return least


def grow(number):
    """The first linkage of the seed's successors that moves well, its file, and its angles at the three poses."""
    seed, parts = RECIPES[number]
    folder = CASES / f"accuracy-random-{number}"
    folder.mkdir(exist_ok=True)
    for at in range(seed, seed + 500):
        grower = Grower(at)
        for part in parts:
            getattr(grower, part)()
        model = grower.model(number)
        (folder / "model.json").write_text(layout(model), encoding="utf-8")
        loops = Loops(Model(f"validation/{folder.name}/model.json"))
        start = round(math.degrees(grower.start + SWING[0]), 1)
        drive = [start + step for step in range(0, 41, 1)]
        try:
            # from the drawn pose back to the first one, then on
            angles = loops.follow([mpf(str(d)) * mp.pi / 180 for d in (drive[18], drive[0])], 0.005)
            points = {k: complex(z) for k, z in loops.model.points().items()}
            theta = {b: float(t) for b, t in angles[-1].items()}
            worst = math.inf
            for d in drive:
                theta = loops.close(FLOAT, points, theta | {"crank": math.radians(d)})
                worst = min(worst, condition(loops, theta))
        except (ArithmeticError, TypeError, ValueError, OverflowError):
            continue
        turned = {b: abs(theta[b] - float(angles[-1][b])) for b in loops.unknown}
        if worst > SMALLEST and min(turned.values()) > 0.01:
            return at, worst, model, loops, folder, start
    raise ArithmeticError("no seed leads to a linkage that moves well")


def main():
    for number in RECIPES:
        seed, worst, model, loops, folder, start = grow(number)
        # poses of the file are those at the start of the motion, rounded
        values = [mpf(str(round(start + d, 1))) * mp.pi / 180 for d in (0, 20, 40)]
        crank = model["bodies"]["crank"]["pose"]["angle"]
        before = loops.follow([mpf(str(crank)) * mp.pi / 180, values[0]], 0.005)[-1]
        place(model, loops, before)
        (folder / "model.json").write_text(layout(model), encoding="utf-8")
        loops = Loops(Model(f"validation/{folder.name}/model.json"))
        last = model["points"][0]
        columns = [f"{last.split('.')[0]}.angle", f"{last}.x"]
        poses, apart = [], mpf(0)
        for value, theta in zip(values, loops.follow(values, 0.01)):
            assert value != values[0] or max(abs(theta[b] - before[b]) for b in loops.unknown) < mpf(10) ** -40, "another assembly"
            found = loops.sensitivities(columns, theta)
            for name, (_, lengths, pins) in found.items():
                size = max(map(abs, pins.values()))
                pairs = [(v, loops.by_differences(name, theta, parameter=p)) for p, v in lengths.items()]
                pairs += [(w, loops.by_differences(name, theta, pin=(j, d))) for j, v in pins.items() for d, w in ((mpc(1), v.real), (mpc(0, 1), v.imag))]
                apart = max([apart] + [abs(p - q) / size for p, q in pairs])
            outputs = [{"column": name, "unit": "rad" if name.endswith("angle") else "m", "nominal": text(nominal),
                        "sensitivities": {f"parameters.{k}": text(v) for k, v in lengths.items()}, "pins": {j: pin(v) for j, v in pins.items()},
                        "first_order": [{"c": "0.00001", "value": text(sum(map(abs, pins.values())) / 100000)}], "worst": []}
                       for name, (nominal, lengths, pins) in found.items()]
            poses.append({"driver": {"name": "motor", "value": text(value)}, "outputs": outputs})
        assert apart < mpf(10) ** -32, apart
        accuracy.write(folder.name, {"model": f"validation/{folder.name}/model.json", "poses": poses})
        print(f"{folder.name}: seed {seed}, {len(model['bodies']) - 1} bodies, {len(loops.loops)} loops, {len(model['parameters'])} lengths, "
              f"least pivot {worst:.3f}, differences {mp.nstr(apart, 2)}", file=sys.stdout)


def place(model, loops, theta):
    """Poses of the file: rounded to 1 mm and 1 deg at the first instant."""
    points, turn = loops.model.points(), loops.turns(MP, theta)
    for b in loops.model.moving:
        z = loops.value(loops.chain[b], points, turn, {})
        model["bodies"][b]["pose"] = {"position": [round(float(1000 * z.real)), round(float(1000 * z.imag))], "angle": round(math.degrees(theta[b]))}


if __name__ == "__main__":
    main()
