"""Accuracy of the bundled slider-crank: the piston's place over its three pins and two lengths.

Closed forms: x = r cos θ + √((l ± 3c)² − r² sin² θ), since offsets of the pins act like a longer or shorter rod; each pin contributes c / cos φ. The
derivatives once more by implicit differentiation of r e^{iθ} + l e^{iφ} + e = x with the unknowns φ and x, and by closing it again.

Run: python3 accuracy_slider_crank.py
"""

import accuracy
from accuracy import DEG, MP, Model, eliminate, mp, mpc, mpf, pin, text

CLEARANCES = ("0.00001", "0.00005", "0.0005")
PINS = ("main", "crankpin", "wristpin")


def place(r, l, th, e=mpc(0)):
    end = r * MP.cis(th) + e
    return end.real + mp.sqrt(l**2 - end.imag**2)


def implicit(r, l, th):
    """By r, l and a pin's offset: one column each."""
    phi = -mp.asin(r * mp.sin(th) / l)
    turn = 1j * l * MP.cis(phi)  # by φ; by x it is −1
    columns = [[-z.real, -z.imag] for z in (MP.cis(th), MP.cis(phi), mpc(1), mpc(0, 1))]
    found, _ = eliminate([[turn.real, mpf(-1)], [turn.imag, mpf(0)]], columns)
    by_r, by_l, gx, gy = (x[1] for x in found)
    return by_r, by_l, mpc(gx, gy)


def main():
    model = Model("models/slider-crank.json")
    r, l = (model.parameters[k] for k in ("crank", "rod"))
    poses, apart, h = [], mpf(0), mpf(10) ** -22
    for degrees in (0, 60, 90, 250):
        th = degrees * DEG
        phi = -mp.asin(r * mp.sin(th) / l)
        nominal = place(r, l, th)
        closed = mp.cos(th) + mp.sin(th) * mp.tan(phi), 1 / mp.cos(phi), mpc(1, mp.tan(phi))
        central = [(place(r + h, l, th) - place(r - h, l, th)) / (2 * h), (place(r, l + h, th) - place(r, l - h, th)) / (2 * h),
                   mpc(*((place(r, l, th, h * w) - place(r, l, th, -h * w)) / (2 * h) for w in (mpc(1), mpc(0, 1))))]
        by_hand = implicit(r, l, th)
        assert max(abs(a - b) for a, b in zip(closed, central)) < mpf(10) ** -34
        apart = max([apart] + [abs(a - b) for a, b in zip(closed, by_hand)])
        g = abs(closed[2])
        assert abs(g - 1 / mp.cos(phi)) < mpf(10) ** -50
        ends = lambda c: [place(r, l + s * 3 * c, th) - nominal for s in (-1, 1)]
        poses.append({"driver": {"name": model.driver, "value": text(th)}, "outputs": [{
            "column": "piston.x", "unit": "m", "nominal": text(nominal),
            "sensitivities": {"parameters.crank": text(closed[0]), "parameters.rod": text(closed[1])},
            "pins": {j: pin(closed[2]) for j in PINS},
            "first_order": [{"c": c, "value": text(3 * mpf(c) * g)} for c in CLEARANCES],
            "worst": [dict(zip(("c", "minus", "plus"), [c] + [text(v) for v in ends(mpf(c))])) for c in CLEARANCES],
            "sigma": [{"c": c, "rim": text(mpf(c) * g * mp.sqrt(mpf(3) / 2)), "disc": text(mpf(c) * g * mp.sqrt(mpf(3) / 4))}
                      for c in CLEARANCES]}]})
    assert apart < mpf(10) ** -50, apart
    accuracy.write("accuracy-slider-crank", {"model": "models/slider-crank.json", "poses": poses})
    print(f"closed forms and implicit differentiation differ by {mp.nstr(apart, 2)}")


if __name__ == "__main__":
    main()
