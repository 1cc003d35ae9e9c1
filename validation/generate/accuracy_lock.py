"""Accuracy of the cargo-door lock: first order, worst case, the change point, the whole stroke, shares of the lengths.

Needs accuracy.py; the change point and its √c law once more in closed form below. Clearances are the same in all seven hinges.

Run: python3 accuracy_lock.py (some ten minutes; `--short` leaves out the stroke, and writes nothing)
"""

import csv
import sys

import accuracy
from accuracy import CASES, DEG, FLOAT, MP, Loops, Model, eliminate, mp, mpc, mpf, pin, text

NAME, OUTPUT = "accuracy-lock", "link2.angle"
GROUPS = ("abg", "def", "c")  # hinges whose offsets stand in the same places of the two loops
CLEARANCES = ("0.00001", "0.0001")
POSES = ("-49.95", "0", "60", "90", "105", "110", "114", "116", "117", "120", "125")
LADDER = ("0.00000001", "0.0000001", "0.000001", "0.00001", "0.0001")
PRINTED = {"0.00001": ("0.0011", "0.0184"), "0.0001": ("0.0012", "0.0203")}  # mean and largest |Δθ2| [rad] of the founding paper's table
FAR = ("link2.angle", "link3.angle", "link4.angle", "link5.angle")


# ---------------------------------------------------------------- closed forms of the change point

def change_point(model):
    """theta6 where loop 1 is a line: l1 + l2 = l3 + l4 with theta2 = pi, theta3 = 0, theta4 = pi; then f, e, d are a triangle."""
    l, p = model.parameters, model.points()
    assert l["l1"] + l["l2"] == l["l3"] + l["l4"]
    f, d = p["link3", "f"] - l["l2"], l["l1"] - p["link4", "d"]
    s = abs(d - f)
    theta6 = mp.arg(d - f) - mp.acos((s**2 + l["l6"] ** 2 - l["l5"] ** 2) / (2 * s * l["l6"]))
    theta5 = mp.arg(d - f - l["l6"] * MP.cis(theta6))
    return theta6, {"link2": +mp.pi, "link3": mpf(0), "link4": +mp.pi, "link5": theta5, "link6": theta6}


def root_law(model, theta):
    """|Δθ2| = k √c for small c: the horizontal part of loop 1 to second order.

    l1 + l4 cos θ4 − l2 cos θ2 − l3 cos θ3 is −(l2 − l4 τ4² − l3 τ3²) x²/2 for θ2 = π + x, θ3 = τ3 x, θ4 = π + τ4 x; hinges a, b, c, g can make it 4 c. Its
    vertical part to first order is l2 − l3 τ3 − l4 τ4 = 0; the second loop turns about link 5: its part along link 5 vanishes.
    """
    l, p = model.parameters, model.points()
    to_c, to_d = p["link3", "c"] - p["link3", "f"], -(p["link4", "d"] - p["link4", "c"])  # as they lie there: link 4 is turned by π
    u = MP.cis(theta["link5"])
    along = lambda z: (1j * z * mp.conj(u)).real
    # τ3 along(c − f) + τ4 along(d − c) = 0 and l3 τ3 + l4 τ4 = l2
    a, b = along(to_c), along(to_d)
    t3 = l["l2"] * b / (l["l3"] * b - l["l4"] * a)
    t4 = -l["l2"] * a / (l["l3"] * b - l["l4"] * a)
    bend = (l["l4"] * t4**2 - l["l2"] + l["l3"] * t3**2) / 2
    return mp.sqrt(4 / abs(bend)), t3, t4


def at_change_point(loops, theta6, theta):
    """Both ends for each clearance, and for c → 0."""
    worst, y = loops.worst(OUTPUT, GROUPS), theta["link2"]
    x = [float(theta[b]) for b in loops.unknown]
    k, t3, t4 = root_law(loops.model, theta)
    slope = {"link2": 1.0, "link3": float(t3), "link4": float(t4)}
    ends = {}
    for side in (-1, 1):
        # along the ground, and for d, e, f, which count only in second order, along link 5
        start = x + [0.0, float(theta["link5"]), 0.0]
        found = worst.reach(theta6, y, start, [float(c) for c in LADDER], side, 0.5 * float(k) * 1e-4, 0.002)
        ends[side] = [worst.polish(theta6, y, mpf(c) * (1 if e[0] > 0 else -1), e)[0] for c, e in zip(LADDER, found)]
    return list(zip(ends[-1], ends[1])), k


# ---------------------------------------------------------------- the stroke

def path(loops, values):
    """Angles at values 0.1 deg apart, in doubles, by extrapolation from four: smooth over the change point."""
    points = {k: complex(z) for k, z in loops.model.points().items()}
    weights, past = {1: [1], 2: [2, -1], 3: [3, -3, 1]}, []
    for v in values:
        near = loops.model.guess()
        if past:
            w = weights.get(len(past), [4, -6, 4, -1])
            near = {b: sum(a * t[b] for a, t in zip(w, reversed(past))) for b in past[-1]}
        past.append(loops.close(FLOAT, points, near | {"link6": float(v)}))
    return past


def pins_of(loops, theta):
    """Sensitivities by the offsets of the first pins of the groups."""
    points, turn, worst = loops.model.points(), loops.turns(MP, theta), loops.output(OUTPUT)
    rows = [list(row) for row in zip(*loops.jacobian(points, turn))]
    columns = [loops.pin_columns(worst, g[0], d)[0] for g in GROUPS for d in (mpc(1), mpc(0, 1))]
    solved, _ = eliminate(rows, columns)
    at = loops.unknown.index("link2")
    return {g[0]: mpc(-solved[2 * k][at], -solved[2 * k + 1][at]) for k, g in enumerate(GROUPS)}


def stroke(loops, step=1):
    """Both ends every 0.1 deg: [(deg, ((minus, plus) per clearance), other assemblies passed per clearance)]."""
    count = 1751
    values = [(mpf(k) / 10 - 50) * DEG for k in range(count)]
    worst, points, rows = loops.worst(OUTPUT, GROUPS), loops.model.points(), []
    for k, (v, near) in enumerate(zip(values, path(loops, values))):
        if k % step:
            continue
        theta = loops.close(MP, points, {b: mpf(t) for b, t in near.items()} | {"link6": v})
        pins = pins_of(loops, theta)
        first = min(sum(len(g) * abs(pins[g[0]]) for g in GROUPS) * mpf(CLEARANCES[0]), mpf("0.001"))
        widest = 0.002 if 1650 < k < 1720 else 0.01
        try:
            ends = [worst.reach(v, theta["link2"], worst.start(theta, pins), [float(c) for c in CLEARANCES], s, float(first), widest) for s in (-1, 1)]
        except ArithmeticError as error:
            raise ArithmeticError(f"theta6 = {k / 10 - 50}: {error}") from error
        pairs = [tuple(worst.polish(v, theta["link2"], mpf(c) * (1 if e[i][0] > 0 else -1), e[i])[0] for e in ends)
                 for i, c in enumerate(CLEARANCES)]
        rows.append((k, pairs, [(ends[0][i][3], ends[1][i][3]) for i in range(len(CLEARANCES))]))
    return rows


def summary(rows):
    out = []
    for i, c in enumerate(CLEARANCES):
        worst = [max(abs(p[i][0]), p[i][1]) for _, p, _ in rows]
        own = [w for w, (_, _, f) in zip(worst, rows) if not any(f[i])]
        mean, largest = (mpf(v) for v in PRINTED[c])
        at = max(range(len(worst)), key=lambda k: worst[k])
        out.append({"c": c, "mean": text(sum(worst) / len(worst)), "largest": text(worst[at]), "at": text((mpf(rows[at][0]) / 10 - 50) * DEG),
                    "mean_up_to_the_printed_largest": text(sum(min(w, largest) for w in worst) / len(worst)),
                    "largest_without_another_assembly": text(max(own)), "poses": len(worst), "poses_that_pass_another_assembly": len(worst) - len(own),
                    "printed_mean": text(mean), "printed_largest": text(largest)})
    return out


# ---------------------------------------------------------------- shares of the lengths

def shares(loops, theta):
    """Shares of the variance for equal tolerances of all lengths, for three meanings of the lengths of the ternary links."""
    model, turn = loops.model, loops.turns(MP, theta)
    p = model.points()
    _, sides, pins = loops.sensitivities([OUTPUT], theta)[OUTPUT]
    unit = lambda link, z: z / abs(z) * turn[link]
    dot = lambda a, b: a.real * b.real + a.imag * b.imag
    one, two, both = pins["a"], pins["d"], pins["c"]  # what opens loop 1, loop 2, both (up to signs, which squares lose)
    loop = {"l1": dot(one, mpc(1)), "l2": dot(one, turn["link2"]), "l3": dot(one, turn["link3"]), "l4": dot(one, turn["link4"]),
            "l5": dot(two, turn["link5"]), "l6": dot(two, turn["link6"]), "l3b": dot(two, unit("link3", p["link3", "c"] - p["link3", "f"])),
            "l4b": dot(two, unit("link4", p["link4", "d"] - p["link4", "c"]))}
    point = loop | {"l3": dot(both, turn["link3"]), "l4": dot(both, turn["link4"])}
    out = {}
    for kind, s in (("sides", sides), ("loops", loop), ("points", point)):
        total = sum(v**2 for v in s.values())
        out[kind] = {k: v**2 / total for k, v in s.items()}
    return out


# ---------------------------------------------------------------- files

def entry(name, found, clearances, worst=(), flags=()):
    nominal, lengths, pins = found
    first = sum(map(abs, pins.values()))
    variance = sum(abs(v) ** 2 for v in pins.values())
    out = {"column": name, "unit": "rad", "nominal": text(nominal), "sensitivities": {f"parameters.{k}": text(v) for k, v in lengths.items()},
           "pins": {j: pin(v) for j, v in pins.items()},
           "first_order": [{"c": c, "value": text(mpf(c) * first)} for c in clearances],
           "worst": [{"c": c, "minus": text(w[0]), "plus": text(w[1])} for c, w in zip(clearances, worst)],
           "sigma": [{"c": c, "rim": text(mpf(c) * mp.sqrt(variance / 2)), "disc": text(mpf(c) * mp.sqrt(variance / 4))} for c in clearances]}
    for row, passed in zip(out["worst"], flags):
        row |= {k: v for k, v in zip(("assemblies_passed_by_minus", "assemblies_passed_by_plus"), passed) if v}
    return out


def main():
    model = Model(f"validation/{NAME}/model.json")
    loops = Loops(model)
    bundled = Model("models/watt-i-lock.json").points()
    assert max(abs(z - bundled[k]) for k, z in model.points().items()) < 1e-15, "another lock"
    theta6, theta = change_point(model)
    points = model.points()
    assert max(map(abs, loops.residual(points, loops.turns(MP, theta), {}))) < mpf(10) ** -55
    near = {round(k * 10): t for k, t in zip([-50 + i / 10 for i in range(1751)], path(loops, [(mpf(i) / 10 - 50) * DEG for i in range(1751)]))}
    poses, checks = [], [mpf(0), mpf(0), -1.0, 0.0]
    for word in POSES:
        v = mpf(word) * DEG
        start = near[round(float(word) * 10)]
        angles = loops.close(MP, points, {b: mpf(t) for b, t in start.items()} | {"link6": v})
        found = loops.sensitivities(FAR, angles)
        nominal, _, pins = found[OUTPUT]
        for g in GROUPS:  # equal within a group, in all outputs: Ting's theorem, loop by loop
            checks[0] = max([checks[0]] + [abs(abs(f[2][j]) - abs(f[2][g[0]])) for f in found.values() for j in g])
        worst = loops.worst(OUTPUT, GROUPS)
        x, first = worst.start(angles, pins), sum(map(abs, pins.values())) * mpf(CLEARANCES[0])
        ends, flags = worst.ends(v, nominal, x, CLEARANCES, first)
        checks[2] = max(checks[2], worst.outside(angles, float(CLEARANCES[0]), ends[0], 200))
        scan = [dy for dy in worst.scan(v, nominal, x, float(CLEARANCES[0])) if abs(dy) < 1.5 * float(first)]
        checks[3] = max(checks[3], max(scan) - float(ends[0][1]), float(ends[0][0]) - min(scan))
        if word in ("0", "105"):
            for p in model.parameters:
                checks[1] = max(checks[1], abs(loops.by_differences(OUTPUT, angles, parameter=p) / found[OUTPUT][1][p] - 1))
        outputs = [entry(name, f, CLEARANCES, ends if name == OUTPUT else (), flags if name == OUTPUT else ()) for name, f in found.items()]
        poses.append({"driver": {"name": "motor", "value": text(v)}, "degrees": word, "outputs": outputs})
    ends, k = at_change_point(loops, theta6, theta)
    poses.append({"driver": {"name": "motor", "value": text(theta6)}, "degrees": text(theta6 / DEG), "change_point": True, "outputs": [{
        "column": OUTPUT, "unit": "rad", "nominal": text(theta["link2"]), "sensitivities": {}, "pins": {}, "first_order": [],
        "worst": [{"c": c, "minus": text(w[0]), "plus": text(w[1])} for c, w in zip(LADDER, ends)],
        "root_law": {"coefficient": text(k), "unit": "rad/m^(1/2)"}}]})
    print(f"groups differ by {mp.nstr(checks[0], 2)}, lengths from differences by {mp.nstr(checks[1], 2)}; random offsets leave the worst case by "
          f"{checks[2]:.2g}, random starts by {checks[3]:.2g}")
    assert checks[0] < mpf(10) ** -45 and checks[1] < mpf(10) ** -30 and checks[2] < 0 and checks[3] < 1e-10
    print("change point", mp.nstr(theta6 / DEG, 20), "deg; root law", mp.nstr(k / mp.sqrt(1000), 12), "rad/sqrt(mm)")
    for c, (low, high) in zip(LADDER, ends):
        print(" ", c, mp.nstr(low, 12), mp.nstr(high, 12), "mean / sqrt(c)", mp.nstr((high - low) / 2 / mp.sqrt(mpf(c) * 1000), 8))
    if "--short" in sys.argv:
        return
    write_shares(loops, near)
    rows = stroke(loops)
    write_stroke(rows)
    found = summary(rows)
    for row in found:
        print(" ", row)
    accuracy.write(NAME, {"model": f"validation/{NAME}/model.json", "poses": poses, "stroke": found})


def write_shares(loops, near):
    lengths = ["l1", "l2", "l3", "l3a", "l3b", "l4", "l4a", "l4b", "l5", "l6"]
    with open(CASES / NAME / "shares.csv", "w", newline="", encoding="utf-8") as f:
        out = csv.writer(f, lineterminator="\n")
        out.writerow(["theta6[deg]", "lengths", *lengths])
        for degrees in range(-50, 1, 10):
            start = {b: mpf(t) for b, t in near[degrees * 10].items()} | {"link6": degrees * DEG}
            for kind, s in shares(loops, loops.close(MP, loops.model.points(), start)).items():
                out.writerow([degrees, kind] + [text(s[k]) if k in s else "" for k in lengths])


def write_stroke(rows):
    """Every half degree, thirty digits."""
    names = {"0.00001": "10um", "0.0001": "100um"}
    with open(CASES / NAME / "stroke.csv", "w", newline="", encoding="utf-8") as f:
        out = csv.writer(f, lineterminator="\n")
        out.writerow(["theta6[deg]"] + [f"{side}.{names[c]}[rad]" for c in CLEARANCES for side in ("minus", "plus")] + [f"assemblies_passed.{names[c]}" for c in CLEARANCES])
        for k, pairs, passed in rows:
            if k % 5 == 0:
                out.writerow([mp.nstr(mpf(k) / 10 - 50, 5)] + [mp.nstr(v, 30) for p in pairs for v in p] + [sum(q) for q in passed])


if __name__ == "__main__":
    main()
