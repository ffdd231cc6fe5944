#!/usr/bin/python3
"""Fits the probability of a pose over several views and prints how well it separates right and wrong candidates.

PoseClassifier (host/register/pose_classifier.h) uses the weights.

    edgescout_bench_views_probability 1 6 > first.csv
    edgescout_bench_views_probability 8 13 > second.csv
    scripts/fit_probability_over_views.py first.csv second.csv
    scripts/fit_probability_over_views.py --write host/register/pose_classifier_weights.h first.csv second.csv

Candidates that only one view sees are left out: scripts/fit_probability.py fits those. The printed log loss and counts
are cross-validated: each bin is evaluated with a fit to the other bins.
"""
import argparse

import numpy as np

from fit_probability import fit_logistic
from pose_classifier_weights import write_weights


def load(files):
    rows = np.concatenate([np.loadtxt(file, delimiter=",", skiprows=1, ndmin=2) for file in files])
    return rows[rows[:, 3] > 1]


def features(rows):
    """Sums over the n informative views divided by the square root of n: of 1 and of each feature."""
    root = np.sqrt(rows[:, 3])
    return np.column_stack([root, *(rows[:, 4:7] / root[:, None]).T])


def probabilities(x, weights):
    return 1 / (1 + np.exp(-np.clip(weights[0] + x @ weights[1:], -50, 50)))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", metavar="FILE", help="header whose section gets the weights")
    parser.add_argument("files", nargs="+", metavar="CSV")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    rows = load(arguments.files)
    x, y, bins = features(rows), rows[:, 2], rows[:, 0]
    p = np.empty(len(y))
    for held_out in np.unique(bins):
        rest = bins != held_out
        p[~rest] = probabilities(x[~rest], fit_logistic(x[rest], y[rest], ridge=2))
    print(f"{len(y)} candidates, {int(y.sum())} right, {len(np.unique(bins))} bins")
    print(f"log loss {-np.mean(np.where(y > 0, np.log(p), np.log(1 - p))):.4f}")
    weights = fit_logistic(x, y, ridge=2)
    print("bias %.3f  views %.3f  log psi_z_score %.3f  log background_psi_z_score %.3f  unexplained grey %.3f"
          % tuple(weights))
    print("views   right   wrong   from 0.25 up: right, wrong   right above every wrong one")
    for views in np.unique(rows[:, 1]):
        of = rows[:, 1] == views
        right, wrong = p[of & (y > 0)], p[of & (y == 0)]
        print(f"{int(views):5d} {len(right):7d} {len(wrong):7d} {(right > 0.25).sum():21d}, {(wrong > 0.25).sum():5d}"
              f" {(right > wrong.max(initial=0)).sum():29d}")
    if arguments.write:
        fields = ["bias", "views", "log_psi_z_score", "log_background_psi_z_score", "unexplained_grey"]
        data = f"{len(y)} candidates, {int(y.sum())} right, of {len(np.unique(bins))} bins."
        write_weights(arguments.write, "SEVERAL_VIEWS", "SeveralViews", dict(zip(fields, weights)), data)


if __name__ == "__main__":
    main()
