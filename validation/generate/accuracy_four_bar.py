"""Accuracy of the bundled four-bar: angles of rocker and coupler, and the coupler point.

Two derivations of all first orders: the triangles of the four-bar in closed form, differentiated by hand below, and the vector loop
with its implicit differentiation (accuracy.py). Worst angles in closed form; worst coordinates by the stationary directions.

Run: python3 accuracy_four_bar.py
"""

import accuracy
from accuracy import DEG, MP, Loops, Model, mp, mpc, mpf, pin, text

CLEARANCES = ("0.00005", "0.0005", "0.002")
LENGTHS = ("base", "crank", "coupler", "rocker")
GROUPS = {"rocker.angle": ("abcd",), "coupler.angle": ("abcd",), "coupler.P.x": ("ab", "cd"), "coupler.P.y": ("ab", "cd")}


def triangle(l, th):
    """Angles of coupler and rocker by the diagonal from the crank's end to O4 and the law of cosines; B is above."""
    a = l["crank"] * MP.cis(th)
    d = l["base"] - a
    s = abs(d)
    at_a = mp.acos((s**2 + l["coupler"] ** 2 - l["rocker"] ** 2) / (2 * s * l["coupler"]))
    b = a + l["coupler"] * MP.cis(mp.arg(d) + at_a)
    return mp.arg(b - a), mp.arg(b - l["base"])


def by_hand(l, th):
    """d(angle) by a vector v that opens the loop at any pin, and by the four lengths: v is turned into the directions of the links.

    Rocker + base − crank − coupler = 0. A change v of base + … is met by coupler and rocker: the part of v along the coupler turns the rocker
    by v·u3 / (l4 sin(ψ − φ)), the part along the rocker the coupler by v·u4 / (l3 sin(ψ − φ)).
    """
    phi, psi = triangle(l, th)
    u = {"base": mpc(1), "crank": -MP.cis(th), "coupler": -MP.cis(phi), "rocker": MP.cis(psi)}
    dot = lambda a, b: a.real * b.real + a.imag * b.imag
    turn = {"rocker.angle": MP.cis(phi) / (l["rocker"] * mp.sin(psi - phi)), "coupler.angle": MP.cis(psi) / (l["coupler"] * mp.sin(psi - phi))}
    return {k: (abs(t), {n: dot(v, t) for n, v in u.items()}) for k, t in turn.items()}


def angles_at_worst(l, th, c):
    """Exact: four pins lengthen or shorten the coupler by 4c where the rocker is meant, and the rocker where the coupler is."""
    nominal, out = triangle(l, th), {}
    for k, name, bar in ((1, "rocker.angle", "coupler"), (0, "coupler.angle", "rocker")):
        both = [triangle(l | {bar: l[bar] + s * 4 * c}, th)[k] - nominal[k] for s in (1, -1)]
        out[name] = min(both), max(both)
    return out


def allocation(s, limit):
    """Least sum of 1 mm / t for tolerances t that keep the output within ± limit."""
    s, a = {k: abs(v) for k, v in s.items()}, mpf("0.001")
    total = sum(mp.sqrt(a * v) for v in s.values())
    worst = {k: limit * mp.sqrt(a / v) / total for k, v in s.items()}
    root = mp.sqrt(sum(mp.cbrt((a * v) ** 2) for v in s.values()))
    rss = {k: limit * mp.cbrt(a / v**2) / root for k, v in s.items()}
    equal = {"worst": limit / sum(s.values()), "rss": limit / mp.sqrt(sum(v**2 for v in s.values()))}
    assert abs(sum(s[k] * t for k, t in worst.items()) / limit - 1) < mpf(10) ** -50
    assert abs(sum((s[k] * t) ** 2 for k, t in rss.items()) / limit**2 - 1) < mpf(10) ** -50
    return [{"kind": kind, "limit": text(limit), "cost_coefficient": "0.001", "tolerances": {f"parameters.{k}": text(t) for k, t in ts.items()},
             "cost": text(sum(a / t for t in ts.values())), "equal_tolerance": text(equal[kind]), "equal_cost": text(len(s) * a / equal[kind])}
            for kind, ts in (("worst", worst), ("rss", rss))]


def radius(px, py):
    """First-order worst distance of the coupler point per metre of clearance, and its direction: the largest reach over all directions."""
    reach = lambda t: sum(abs(mp.cos(t) * px[j] + mp.sin(t) * py[j]) for j in px)
    best = max(range(720), key=lambda k: reach(k * mp.pi / 720)) * mp.pi / 720
    slope = lambda t: mp.diff(reach, t)
    t = mp.findroot(slope, best)
    return reach(t), t


def main():
    model = Model("models/four-bar.json")
    loops, l = Loops(model), model.parameters
    at = [60, 150, 240, 330]
    poses, apart, brute = [], mpf(0), -1.0
    for degrees, theta in zip(at, loops.follow([k * DEG for k in at])):
        th = degrees * DEG
        found = loops.sensitivities(GROUPS, theta)
        phi, psi = triangle(l, th)
        assert max(abs(phi - theta["coupler"]), abs(psi - theta["rocker"])) < mpf(10) ** -50
        outputs = []
        for name, (nominal, lengths, pins) in found.items():
            first = sum(map(abs, pins.values()))
            if name.endswith("angle"):
                g, hand = by_hand(l, th)[name]
                apart = max([apart] + [abs(abs(v) / g - 1) for v in pins.values()] + [abs(hand[k] - lengths[k]) / g for k in LENGTHS])
            worst = []
            for c in CLEARANCES:
                if name.endswith("angle"):
                    worst.append(angles_at_worst(l, th, mpf(c))[name])
            if not worst:
                search = loops.worst(name, GROUPS[name])
                worst, _ = search.ends(th, nominal, search.start(theta, pins), CLEARANCES, first * mpf(CLEARANCES[0]))
                brute = max(brute, search.outside(theta, float(CLEARANCES[1]), worst[1]))
                scan = search.scan(th, nominal, search.start(theta, pins), float(CLEARANCES[1]))
                assert abs(max(scan) - worst[1][1]) + abs(min(scan) - worst[1][0]) < 1e-12, (scan, worst[1])
            variance = sum(abs(v) ** 2 for v in pins.values())
            outputs.append({"column": name, "unit": "rad" if name.endswith("angle") else "m", "nominal": text(nominal),
                            "sensitivities": {f"parameters.{k}": text(v) for k, v in lengths.items()},
                            "pins": {j: pin(v) for j, v in pins.items()},
                            "first_order": [{"c": c, "value": text(mpf(c) * first)} for c in CLEARANCES],
                            "worst": [{"c": c, "minus": text(w[0]), "plus": text(w[1])} for c, w in zip(CLEARANCES, worst)],
                            "sigma": [{"c": c, "rim": text(mpf(c) * mp.sqrt(variance / 2)), "disc": text(mpf(c) * mp.sqrt(variance / 4))}
                                      for c in CLEARANCES]})
            if name == "rocker.angle":
                outputs[-1]["allocation"] = allocation(lengths, DEG / 20)
        reach, direction = radius(found["coupler.P.x"][2], found["coupler.P.y"][2])
        poses.append({"driver": {"name": "motor", "value": text(th)}, "outputs": outputs,
                      "radius": [{"point": "coupler.P", "c": c, "first_order": text(mpf(c) * reach), "direction": text(direction)} for c in CLEARANCES]})
    assert apart < mpf(10) ** -50, apart
    assert brute < 0, brute
    accuracy.write("accuracy-four-bar", {"model": "models/four-bar.json", "poses": poses})
    print(f"two derivations differ by {mp.nstr(apart, 2)} of |g|; random offsets stay inside the worst case")


if __name__ == "__main__":
    main()
