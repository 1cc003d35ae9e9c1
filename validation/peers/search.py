"""The whole grid of a peer's settings on a row: what its cheapest setting is that meets the error.

Of each setting the ladder of sizes is bisected. What would cost far more than the best that is known is not run: it can't win.
"""

import dataclasses
import math
import time
from dataclasses import dataclass

# A setting may take this many times the CPU time of the best one before it is given up, and at first this many seconds.
SLACK, PATIENCE = 1.5, 10.0
# Rungs of a stride; what is left of the error after one that is worth it; how many others in a row are too many.
STRIDE, WORTH, IDLE = 4, 0.7, 3
FINALISTS, REPETITIONS = 6, 5


@dataclass
class Found:
    setting: object
    error: float
    cpu: float


def attempt(peer, row, setting):
    """Error and CPU time; an infinite error where the peer gives up."""
    begin = time.process_time()
    try:
        error, cpu = peer.prepare(row, setting)()
    except Exception:  # Peers refuse in many ways; each says that this setting is none.
        error, cpu = math.inf, time.process_time() - begin
    return Found(setting, error if math.isfinite(error) else math.inf, cpu)


def loosest(peer, row, setting, ladder, bound):
    """The cheapest size that meets the error within a bound of the time, or the most accurate run."""
    def run(k):
        return attempt(peer, row, dataclasses.replace(setting, size=ladder[k]))

    # Up in large strides until the error is met, as long as each is worth it; then between the last two.
    low, best, idle = 0, run(0), 0
    last = best
    while best.error > row.wanted:
        high = min(low + STRIDE, len(ladder) - 1)
        while high > low and last.cpu * ladder[high] / ladder[low] > bound:
            high -= 1
        if high == low or last.cpu > bound:
            return best
        found = run(high)
        if found.error <= row.wanted:
            break
        if math.isfinite(best.error):
            idle = idle + 1 if found.error > WORTH * best.error else 0
        low, last = high, found
        best = min(best, found, key=lambda each: each.error)
        if idle == IDLE:
            return best
    else:
        return best
    while high - low > 1:
        middle = (low + high) // 2
        between = run(middle)
        if between.error <= row.wanted:
            found, high = between, middle
        else:
            low = middle
    return found


def search(peer, row, samples, say=print):
    """Settings that meet the error by their time; where none does, those with the least errors."""
    met, missed, bound = [], [], PATIENCE
    for setting in peer.grid(row):
        found = loosest(peer, row, setting, peer.sizes(setting, samples), bound)
        if found.error > row.wanted:
            missed.append(found)
            continue
        met.append(found)
        bound = min(bound, SLACK * found.cpu + 1e-4)
        say(f"{row.name}: {found.error:.1e}, {found.cpu:.3g} s: {found.setting}", flush=True)
    if not met:
        return sorted(missed, key=lambda found: found.error)[:FINALISTS]
    finalists = sorted(met, key=lambda found: found.cpu)[:FINALISTS]
    for found in finalists:
        runs = [attempt(peer, row, found.setting) for _ in range(REPETITIONS)]
        found.cpu = min([found.cpu, *(run.cpu for run in runs)])
    return sorted(finalists, key=lambda found: found.cpu)
