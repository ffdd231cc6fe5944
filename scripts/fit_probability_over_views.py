#!/usr/bin/python3
"""Fits the probability of a pose over several views (host/detect/probability_over_views.cpp), and prints how well it
tells right candidates from wrong ones.

    edgescout_bench_views_probability 1 6 > first.csv
    edgescout_bench_views_probability 8 13 > second.csv
    scripts/fit_probability_over_views.py first.csv second.csv

Candidates that only one view sees are left out: they have a fit of their own (scripts/fit_probability.py). What is
said of log loss and of right and wrong ones is cross-validated: each bin is judged by a fit to the others.
"""
import sys

import numpy as np

from fit_probability import fit_logistic


def load(files):
    rows = np.concatenate([np.loadtxt(file, delimiter=",", skiprows=1, ndmin=2) for file in files])
    return rows[rows[:, 3] > 1]


def features(rows):
    """Sums over the views that speak, n of them, over the square root of n; of_a_view is summed n times."""
    root = np.sqrt(rows[:, 3])
    return np.column_stack([np.ones(len(rows)), root, *(rows[:, 4:7] / root[:, None]).T])


def probabilities(x, weights):
    return 1 / (1 + np.exp(-np.clip(x @ weights, -50, 50)))


def main():
    rows = load(sys.argv[1:])
    x, y, bins = features(rows), rows[:, 2], rows[:, 0]
    p = np.empty(len(y))
    for held_out in np.unique(bins):
        rest = bins != held_out
        p[~rest] = probabilities(x[~rest], fit_logistic(x[rest], y[rest], ridge=2))
    print(f"{len(y)} candidates, {int(y.sum())} right, {len(np.unique(bins))} bins")
    print(f"log loss {-np.mean(np.where(y > 0, np.log(p), np.log(1 - p))):.4f}")
    print("bias %.3f  of a view %.3f  log evidence %.3f  log over beside %.3f  unexplained grey %.3f"
          % tuple(fit_logistic(x, y, ridge=2)))
    print("views   right   wrong   from 0.25 up: right, wrong   right above every wrong one")
    for views in np.unique(rows[:, 1]):
        of = rows[:, 1] == views
        right, wrong = p[of & (y > 0)], p[of & (y == 0)]
        print(f"{int(views):5d} {len(right):7d} {len(wrong):7d} {(right > 0.25).sum():21d}, {(wrong > 0.25).sum():5d}"
              f" {(right > wrong.max(initial=0)).sum():29d}")


if __name__ == "__main__":
    main()
