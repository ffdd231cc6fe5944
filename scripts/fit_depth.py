#!/usr/bin/python3
"""Fits what measured depth says of a pose, beside its edges and shading, and prints how well the
sum judges.

PoseClassifier (host/register/pose_classifier.h) adds such a term to the log-odds of one view. Its
weights are set by hand; this shows how far a fit would change them (docs/research/probability.md).

    edgescout render --depth ...
    for part in SCENES/*; do edgescout_bench_pose_features $part --depth > $(basename $part).csv; done
    scripts/fit_depth.py *.csv

The log-odds of edges and shading are the present ones and stay. Of the samples of the surface that
were measured and that nothing hides, some agree with the pose and the rest contradict it. The share
that agrees has a weight that is not negative; with fewer than twenty samples bias and weight count
less.

The poses are those that detection without a threshold reports, where anything was measured of them.
One is right within 0.1 rad and 5 mm of a true one. The printed figures are cross-validated: the
poses of each part are judged by a fit to all other parts.
"""
import argparse
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

from fit_probability import load, of_stage, print_recall, print_reliability, right

ENOUGH = 20  # samples, as in host/register/pose_classifier.cpp
RIDGE = 0.1


class Poses:
    """Those of which something was measured."""

    def __init__(self, columns):
        measured = columns["agreeing"] + columns["contradicting"]
        self.columns = {name: values[measured > 0] for name, values in columns.items()}
        measured = measured[measured > 0]
        count = np.minimum(1, measured / ENOUGH)
        self.features = np.column_stack([count, count * self.columns["agreeing"] / measured])
        self.grey = self.columns["grey_log_odds"]
        self.right = right(self.columns)
        self.part = self.columns["part"]

    def log_odds(self, weights, kept):
        return self.grey[kept] + self.features[kept] @ weights


def fit(poses, kept):
    """Bias and weight by maximum likelihood, with a little ridge."""
    labels = poses.right[kept]

    def cost(weights):
        log_odds = poses.log_odds(weights, kept)
        residual = 1 / (1 + np.exp(-log_odds)) - labels
        likelihood = (np.logaddexp(0, log_odds) - labels * log_odds).sum()
        return likelihood + RIDGE * (weights**2).sum() / 2, poses.features[kept].T @ residual + RIDGE * weights

    return minimize(cost, np.zeros(2), jac=True, bounds=[(None, None), (0, None)], method="L-BFGS-B").x


def cross_validated(poses):
    """Log-odds of each pose by a fit to all other parts."""
    log_odds = np.empty(len(poses.right))
    for part in np.unique(poses.part):
        of = poses.part == part
        log_odds[of] = poses.log_odds(fit(poses, ~of), of)
    return log_odds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=Path, metavar="CSV")
    arguments = parser.parse_args()
    poses = Poses(of_stage(load(arguments.files), "reported"))
    if len(np.unique(poses.part)) < 2:
        raise SystemExit("fit_depth: found one part with depth, expected two or more to validate by part")
    for name, log_odds in {"edges and shading alone": poses.grey, "present weights": poses.columns["log_odds"],
                           "fit": cross_validated(poses)}.items():
        print(f"\n{name}")
        print_recall(poses.columns, poses.right, log_odds)
        print_reliability(poses.right, log_odds)
    weights = dict(zip(["bias", "agreeing"], fit(poses, np.ones(len(poses.right), bool))))
    print("\nweights: " + ", ".join(f"{field} {weight:.4g}" for field, weight in weights.items()))


if __name__ == "__main__":
    main()
