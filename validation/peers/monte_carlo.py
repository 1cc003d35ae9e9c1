"""Monte Carlo of the lengths of a four-bar, linkdyn and pylinkage in turn: variants a minute of CPU time on one core.

    python validation/peers/monte_carlo.py [--rounds 5] [--command target/release/linkdyn]

Needs `pip install pylinkage numba`. The mechanism is the bundled four-bar over one turn at 36 positions; crank, coupler
and rocker scatter with a standard deviation of 20 um. pylinkage is in its fastest form: compiled, warm, with the lengths
set for each variant; it works out the places of its points from closed-form dyads. linkdyn proves that each variant is on
the branch of the nominal mechanism, and keeps why one fails. Its time is that of the process, with its start.
"""

import argparse
import json
import math
import os
import resource
import statistics
import subprocess
import tempfile
import time

import numpy

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
DEVIATION = 2e-5
POSITIONS = 36
RESPONSES = {"last": "last(rocker.angle)", "range": "range(rocker.angle)"}


class Pylinkage:
    """The peer's four-bar."""

    def __init__(self):
        from pylinkage.actuators import Crank
        from pylinkage.components import Ground
        from pylinkage.dyads import RRRDyad
        from pylinkage.simulation import Linkage

        left, right = Ground(0.0, 0.0, name="O2"), Ground(0.3, 0.0, name="O4")
        crank = Crank(anchor=left, radius=0.1, angular_velocity=math.tau / POSITIONS, initial_angle=math.pi / 3, name="crank")
        rocker = RRRDyad(anchor1=crank.output, anchor2=right, distance1=0.25, distance2=0.2, name="rocker")
        self.linkage = Linkage([left, right, crank, rocker], name="four-bar")
        self.lengths = numpy.array(list(self.linkage.get_constraints()), float)
        self.linkage.step_fast(iterations=POSITIONS)

    def seconds(self, samples, response):
        """CPU seconds for so many variants."""
        random = numpy.random.default_rng(1)
        found = []
        begin = time.process_time()
        for _ in range(samples):
            self.linkage.set_constraints(list(self.lengths + random.normal(0, DEVIATION, self.lengths.size)))
            places = numpy.asarray(self.linkage.step_fast(iterations=POSITIONS))
            height = places[:, -1, 1]
            found.append(height[-1] if response == "last" else numpy.ptp(height))
        spent = time.process_time() - begin
        assert numpy.all(numpy.isfinite(found)) and numpy.std(found) > 0
        return spent


def model(response):
    """The bundled four-bar over one turn, its lengths with tolerances of three standard deviations."""
    with open(os.path.join(ROOT, "models", "four-bar.json"), encoding="utf-8") as file:
        words = json.load(file)
    for name in ("crank", "coupler", "rocker"):
        words["parameters"][name] = {"value": words["parameters"][name], "tolerance": f"{3e3 * DEVIATION} mm"}
    words["drivers"]["motor"]["motion"] = {"type": "polynomial", "coefficients": ["60 deg", "360 deg/s"]}
    words["analysis"] = {"type": "kinematics", "end": 1, "outputs": POSITIONS}
    words["responses"] = {"r": RESPONSES[response]}
    return words


def linkdyn(command, path, samples):
    """CPU seconds of the command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = subprocess.run(
        [command, "study", path, "--samples", str(samples), "--threads", "1", "--json"],
        check=True, capture_output=True, env={**os.environ, "RAYON_NUM_THREADS": "1"},
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    completed = json.loads(said.stdout)["summary"]["completed"]
    assert completed["within"] == samples, completed
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--command", default=os.path.join(ROOT, "target", "release", "linkdyn"))
    parser.add_argument("--samples", type=int, nargs=2, default=(200_000, 20_000), metavar=("OURS", "PEER"))
    words = parser.parse_args()
    ours, peer = words.samples
    other = Pylinkage()
    with tempfile.TemporaryDirectory() as directory:
        for response in RESPONSES:
            path = os.path.join(directory, "four-bar.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(model(response), file)
            rates = []
            for number in range(words.rounds):
                pair = (60 * ours / linkdyn(words.command, path, ours), 60 * peer / other.seconds(peer, response))
                rates.append(pair)
                print(f"{response}, round {number + 1}: linkdyn {pair[0]:9.0f}, pylinkage {pair[1]:9.0f} variants a minute")
            ratio = statistics.median(ours / peer for ours, peer in rates)
            print(f"{response}: {ratio:.2f} times as many (median)")


if __name__ == "__main__":
    main()
