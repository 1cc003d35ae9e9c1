"""Accuracy of the one-way clutch: closed forms of cos φ = (a + c)/(e − c), by hand and by differences.

Run: python3 accuracy_clutch.py
"""

import itertools

import accuracy
from accuracy import DEG, Model, mp, mpc, mpf, pin, text

TOLERANCES = {"a": "0.00005", "c": "0.00001", "e": "0.0000125"}
CLEARANCES = ("0.000001", "0.00001")


def angle(v, shift=mpf(0)):
    """`shift`: by how much the pivot's journal lies above the bearing's centre."""
    return mp.acos((v["a"] + v["c"] - shift) / (v["e"] - v["c"]))


def main():
    model = Model("validation/accuracy-clutch/model.json")
    v = model.parameters
    phi, height, length = angle(v), v["a"] + v["c"], v["e"] - v["c"]
    s = {"a": -1 / (length * mp.sin(phi)), "c": -(1 + mp.cos(phi)) / (length * mp.sin(phi)), "e": height / (length**2 * mp.sin(phi))}
    h = mpf(10) ** -22
    for k in s:
        assert abs((angle(v | {k: v[k] + h}) - angle(v | {k: v[k] - h})) / (2 * h) - s[k]) < mpf(10) ** -30
    g = mpc(0, 1 / (length * mp.sin(phi)))  # the journal of the pivot higher: the link leans more
    assert abs((angle(v, h) - angle(v, -h)) / (2 * h) - g.imag) < mpf(10) ** -30
    t = {k: mpf(x) for k, x in TOLERANCES.items()}
    corners = [angle({k: v[k] + d * t[k] for k, d in zip(v, signs)}) - phi for signs in itertools.product((-1, 1), repeat=3)]
    worst = sum(abs(s[k]) * t[k] for k in s)
    variance = {k: (s[k] * t[k]) ** 2 for k in s}
    total = sum(variance.values())
    tolerances = {"half_widths": {f"parameters.{k}": x for k, x in TOLERANCES.items()}, "worst_first_order": text(worst), "rss": text(mp.sqrt(total)),
                  "minus": text(min(corners)), "plus": text(max(corners)),
                  "shares_of_worst": {f"parameters.{k}": text(abs(s[k]) * t[k] / worst) for k in s},
                  "shares_of_variance": {f"parameters.{k}": text(x / total) for k, x in variance.items()}}
    output = {"column": "link.angle", "unit": "rad", "nominal": text(phi), "sensitivities": {f"parameters.{k}": text(x) for k, x in s.items()},
              "pins": {"pivot": pin(g)}, "first_order": [{"c": c, "value": text(mpf(c) * abs(g))} for c in CLEARANCES],
              "worst": [{"c": c, "minus": text(angle(v, -mpf(c)) - phi), "plus": text(angle(v, mpf(c)) - phi)} for c in CLEARANCES],
              "tolerances": tolerances}
    accuracy.write("accuracy-clutch", {"model": "validation/accuracy-clutch/model.json", "poses": [{"driver": None, "outputs": [output]}]})
    print("phi", mp.nstr(phi / DEG, 12), "deg; per mm", *(mp.nstr(x / 1000, 12) for x in s.values()), "worst and RSS [deg]",
          mp.nstr(worst / DEG, 9), mp.nstr(mp.sqrt(total) / DEG, 9), "shares [%]", *(mp.nstr(100 * x / total, 6) for x in variance.values()))


if __name__ == "__main__":
    main()
