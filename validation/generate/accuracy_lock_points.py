"""What the angle of the lock's link 2 depends on, where the lengths of the ternary links are meant as places of points: model, sensitivities, shares.

Two derivations: the model's expressions with the implicit differentiation of its loops (accuracy.py), and unit vectors (`shares` of accuracy_lock.py).

Run: python3 accuracy_lock_points.py
"""

import accuracy
import accuracy_lock
from accuracy import DEG, Loops, Model, mp, mpf, pin, text

NAME, OUTPUT = "accuracy-lock-points", "link2.angle"


def main():
    model, sides = (Model(f"validation/{name}/model.json") for name in (NAME, "accuracy-lock"))
    assert max(abs(z - sides.points()[k]) for k, z in model.points().items()) < mpf(10) ** -55, "another lock"
    loops, others = Loops(model), Loops(sides)
    at = range(-50, 1, 10)
    poses, apart = [], mpf(0)
    for degrees, theta in zip(at, loops.follow([k * DEG for k in at])):
        nominal, lengths, pins = loops.sensitivities([OUTPUT], theta)[OUTPUT]
        total = sum(v**2 for v in lengths.values())
        shares = {k: v**2 / total for k, v in lengths.items()}
        again = accuracy_lock.shares(others, theta)["points"]
        apart = max([apart] + [abs(v - again[k]) for k, v in shares.items()])
        poses.append({"driver": {"name": "motor", "value": text(degrees * DEG)}, "degrees": str(degrees), "outputs": [{
            "column": OUTPUT, "unit": "rad", "nominal": text(nominal), "sensitivities": {f"parameters.{k}": text(v) for k, v in lengths.items()},
            "pins": {j: pin(v) for j, v in pins.items()},
            "first_order": [{"c": "0.00001", "value": text(sum(map(abs, pins.values())) / 100000)}], "worst": [],
            "shares_of_variance": {f"parameters.{k}": text(v) for k, v in shares.items()}}]})
        print(degrees, {k: mp.nstr(100 * v, 4) for k, v in shares.items()})
    assert apart < mpf(10) ** -45, apart
    accuracy.write(NAME, {"model": f"validation/{NAME}/model.json", "poses": poses})


if __name__ == "__main__":
    main()
