"""Monte Carlo of the lengths of a four-bar, linkdyn and pylinkage in turn: variants a minute on one core.

    python validation/peers/monte_carlo.py [--rounds 3] [--command target/release/linkdyn]

Needs `pip install pylinkage`. The mechanism is the bundled four-bar over one turn at 36 positions; crank, coupler and
rocker scatter with a standard deviation of 20 um. pylinkage works out the places of one point from closed-form dyads;
linkdyn positions, velocities and accelerations of all bodies, and two responses. Each runs as a user runs it, with its
start; the samples are as many as take some seconds.
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import tempfile
import time
import warnings

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
DEVIATION = 2e-5
POSITIONS = 36


def pylinkage(samples):
    """Seconds of the peer's own tolerance analysis."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.linkage.sensitivity import analyze_tolerance
    from pylinkage.simulation import Linkage

    left, right = Ground(0.0, 0.0, name="O2"), Ground(0.3, 0.0, name="O4")
    crank = Crank(anchor=left, radius=0.1, angular_velocity=math.tau / POSITIONS, initial_angle=1.0, name="crank")
    rocker = RRRDyad(anchor1=crank.output, anchor2=right, distance1=0.25, distance2=0.2, name="rocker")
    linkage = Linkage([left, right, crank, rocker], name="four-bar")
    off = {"crank_radius": DEVIATION, "rocker_dist1": DEVIATION, "rocker_dist2": DEVIATION}
    begin = time.perf_counter()
    analyze_tolerance(linkage, off, n_samples=samples, seed=1, iterations=POSITIONS)
    return time.perf_counter() - begin


def model():
    """The bundled four-bar over one turn, its lengths with tolerances of three standard deviations."""
    with open(os.path.join(ROOT, "models", "four-bar.json"), encoding="utf-8") as file:
        words = json.load(file)
    for name in ("crank", "coupler", "rocker"):
        words["parameters"][name] = {"value": words["parameters"][name], "tolerance": f"{3e3 * DEVIATION} mm"}
    words["drivers"]["motor"]["motion"] = {"type": "polynomial", "coefficients": ["60 deg", "360 deg/s"]}
    words["analysis"] = {"type": "kinematics", "end": 1, "outputs": POSITIONS}
    words["responses"] = {"top": "max(coupler.P.y)", "swing": "range(rocker.angle)"}
    return words


def linkdyn(command, path, samples):
    """Seconds of the command."""
    begin = time.perf_counter()
    said = subprocess.run(
        [command, "study", path, "--samples", str(samples), "--threads", "1", "--json"],
        check=True, capture_output=True,
    )
    spent = time.perf_counter() - begin
    completed = json.loads(said.stdout)["summary"]["completed"]
    assert completed["within"] == samples, completed
    return spent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--command", default=os.path.join(ROOT, "target", "release", "linkdyn"))
    parser.add_argument("--samples", type=int, nargs=2, default=(200_000, 20_000), metavar=("OURS", "PEER"))
    words = parser.parse_args()
    warnings.filterwarnings("ignore")
    ours, peer = words.samples
    rates = []
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "four-bar.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(model(), file)
        pylinkage(100)
        for number in range(words.rounds):
            pair = (60 * ours / linkdyn(words.command, path, ours), 60 * peer / pylinkage(peer))
            rates.append(pair)
            print(f"round {number + 1}: linkdyn {pair[0]:9.0f}, pylinkage {pair[1]:9.0f} variants a minute, {pair[0] / pair[1]:.1f} times")
    ratio = statistics.median(ours / peer for ours, peer in rates)
    print(f"median: {ratio:.1f} times as many on one core")


if __name__ == "__main__":
    main()
