#!/usr/bin/python3
"""Fits the probability of a pose over several views and prints how well it judges.

PoseClassifier (host/register/pose_classifier.h) uses the weights.

    edgescout render --views 3 ...   (docs/research/probability.md has the parts and ranges)
    for part in SCENES/*; do edgescout_bench_pose_features $part --joint > $(basename $part).csv; done
    scripts/fit_probability_over_views.py *.csv
    scripts/fit_probability_over_views.py --write host/register/pose_classifier_weights.h *.csv

The log-odds are linear in the mean over the views of the bounded log-probability in one view; the
weight is not negative. The probability in one view is the present one, so this fit comes after that
of scripts/fit_probability.py.

The poses are those that joint detection without a threshold reports. One is right within 0.1 rad
and 5 mm of a true one. Poses that only one view informs of are left out: their probability is that
in one view.

The printed figures are cross-validated: the poses of each part are judged by a fit to all other
parts.
"""
import argparse
from pathlib import Path

import numpy as np

from fit_probability import fit_logistic, load, of_stage, print_reliability, right
from pose_classifier_weights import write_weights

MIN_LOG_PROBABILITY = -10  # as in host/register/pose_classifier.cpp


def log_probability(log_odds):
    """In one of several views. Something unknown may hide a pose there."""
    return np.maximum(-np.logaddexp(0, -log_odds), MIN_LOG_PROBABILITY)


def joined(*texts):
    """One text a row."""
    return np.array(["|".join(row) for row in zip(*(text.astype(str) for text in texts))])


class Poses:
    """Those that several views inform of."""

    def __init__(self, columns):
        columns = {name: values[columns["informative"] > 0] for name, values in columns.items()}
        scene = joined(columns["part"], columns["image"])
        _, first, pose, views = np.unique(joined(scene, columns["pose"]), return_index=True, return_inverse=True,
                                          return_counts=True)
        mean = np.bincount(pose, log_probability(columns["log_odds"])) / views
        several = views > 1
        first = first[several]
        self.mean = mean[several]
        self.right = right(columns)[first]
        self.part, self.scene, self.views = columns["part"][first], scene[first], views[several]
        self.truth = joined(scene, columns["truth"])[first]


def fit(poses, kept):
    """Bias and weight."""
    return fit_logistic(poses.mean[kept, None], poses.right[kept], [1])


def cross_validated(poses):
    """Log-odds of each pose by a fit to all other parts."""
    log_odds = np.empty(len(poses.right))
    for part in np.unique(poses.part):
        bias, weight = fit(poses, poses.part != part)
        log_odds[poses.part == part] = bias + weight * poses.mean[poses.part == part]
    return log_odds


def print_found(poses, log_odds):
    """True poses above the value that leaves this many wrong poses a scene, by the number of views."""
    print("views  scenes  true poses  found at 0, 0.25, 0.5, 1 wrong poses a scene")
    for views in np.unique(poses.views):
        of = poses.views == views
        truth, scenes = poses.truth[of], len(np.unique(poses.scene[of]))
        is_right, odds = poses.right[of] > 0, log_odds[of]
        wrong = np.append(np.sort(odds[~is_right])[::-1], -np.inf)
        found = [len(np.unique(truth[is_right & (odds > wrong[min(int(rate * scenes), len(wrong) - 1)])]))
                 for rate in (0, 0.25, 0.5, 1)]
        print(f"{views:5d} {scenes:7d} {len(np.unique(truth[is_right])):11d}  {', '.join(map(str, found))}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", metavar="FILE", help="header whose section gets the weights")
    parser.add_argument("files", nargs="+", type=Path, metavar="CSV")
    arguments = parser.parse_args()
    poses = Poses(of_stage(load(arguments.files), "reported"))
    parts = len(np.unique(poses.part))
    if parts < 2:
        raise SystemExit("fit_probability_over_views: found one part, expected two or more to validate by part")
    log_odds = cross_validated(poses)
    bias, weight = fit(poses, np.full(len(poses.right), True))
    print(f"bias {bias:.4g}, log_probability {weight:.4g}")
    print_found(poses, log_odds)
    print_reliability(poses.right, log_odds)
    if arguments.write:
        data = f"{len(poses.right)} poses, {int(poses.right.sum())} right, of {parts} parts of set fit."
        write_weights(arguments.write, "SEVERAL_VIEWS", "SeveralViews", {"bias": bias, "log_probability": weight}, data)


if __name__ == "__main__":
    main()
