"""Whether probabilities mean what they say: bins of equal count, and the poses called certain."""
import math
from dataclasses import dataclass

BINS = 10
LEAST = 0.01  # poses of a lower probability are left out
CERTAIN = 0.99


@dataclass
class Bin:
    count: int
    mean: float  # of the probabilities
    right: float  # fraction

    @property
    def gap(self):
        return abs(self.mean - self.right)


def equal_bins(poses, bins=BINS):
    """`poses`: (probability, right) pairs. Bins of rising probability; their counts differ by one
    at most. Fewer bins than asked for if there are fewer poses."""
    poses = sorted((p, bool(right)) for p, right in poses if p >= LEAST)
    bins = min(bins, len(poses))
    result = []
    for k in range(bins):
        part = poses[k * len(poses) // bins:(k + 1) * len(poses) // bins]
        result.append(Bin(len(part), sum(p for p, _ in part) / len(part),
                          sum(right for _, right in part) / len(part)))
    return result


def wilson_interval(hits, trials, z=1.96):
    """95 % interval of a rate; (0, 1) without trials. Poses of one image are not independent, so
    the interval is too narrow where an image has several wrong ones."""
    if trials == 0:
        return 0.0, 1.0
    rate = hits / trials
    middle = rate + z * z / (2 * trials)
    half = z * math.sqrt(rate * (1 - rate) / trials + z * z / (4 * trials * trials))
    scale = 1 + z * z / trials
    return max(0.0, (middle - half) / scale), min(1.0, (middle + half) / scale)


def certain(poses, least=CERTAIN):
    """(number of poses above `least`, wrong ones among them)."""
    above = [right for p, right in poses if p > least]
    return len(above), sum(not right for right in above)
