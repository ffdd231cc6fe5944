#!/usr/bin/python3
"""Fits the two logistic functions of a pose's features in one view and prints how well they judge.

PoseClassifier (host/register/pose_classifier.h) has two such functions. `rank` is fitted on poses
after the medium stage of detection, `probability` on the poses that detection without a threshold
reports.

    bench/trust/make_sets.py PARTS SETS --sets fit
    for part in SETS/fit/*; do edgescout_bench_pose_features $part > $(basename $part).csv; done
    scripts/fit_probability.py *.csv
    scripts/fit_probability.py --write host/register/pose_classifier_weights.h *.csv

For the rank a pose is right if all vertices project within 10 px of their true places, modulo
symmetry: the fine stage can still bring it to the truth. Poses that are up to half as far off again
are left out: their label says little. For the probability a pose is right within 0.1 rad and 5 mm
of a true one.

Every weight has the sign that its feature must have: more edge support never lowers the
probability. The printed figures are cross-validated: the poses of each part are judged by a fit to
all other parts.
"""
import argparse
import csv
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

from pose_classifier_weights import write_weights

MIN_PSI_Z_SCORE = 0.5
RIGHT_PX = 10
WRONG_PX = 15
RIGHT_RAD = 0.1
RIGHT_M = 0.005


def signed_root(values):
    """Evidence grows more slowly than the number of edge points: their errors depend on each other."""
    return np.sign(values) * np.sqrt(np.abs(values))


# By field of pose_classifier_weights::OneView: the sign of the weight, and the feature from the
# columns of the file.
FEATURES = {
    "log_psi_z_score": (1, lambda c: np.log(np.maximum(c["psi_z_score"], MIN_PSI_Z_SCORE))),
    "mean_px": (-1, lambda c: c["mean_px"]),
    "root_log_ratio": (1, lambda c: signed_root(c["log_ratio"])),
    "root_interior_log_ratio": (1, lambda c: signed_root(c["interior_log_ratio"])),
    "unexplained_grey": (-1, lambda c: c["unexplained_grey"]),
    "best_displaced": (-1, lambda c: c["best_displaced"]),
}
TEXTS = ("set", "part", "image", "stage")


def load(files):
    """Columns by name."""
    rows = [row for file in files for row in csv.DictReader(open(file))]
    if not rows:
        raise SystemExit("fit_probability: no poses")
    return {name: np.array([row[name] if name in TEXTS else float(row[name]) for row in rows]) for name in rows[0]}


def of_stage(columns, stage):
    kept = columns["stage"] == stage
    return {name: values[kept] for name, values in columns.items()}


def near_in_image(columns):
    """1 where near, 0 where far, NaN between."""
    error = columns["mspd_px"]
    return np.where(error < RIGHT_PX, 1.0, np.where(error < WRONG_PX, np.nan, 0.0))


def right(columns):
    return ((columns["angle_rad"] < RIGHT_RAD) & (columns["distance_m"] < RIGHT_M)).astype(float)


# By function: the stage of its poses, and their labels.
FUNCTIONS = {"rank": ("medium", near_in_image), "probability": ("reported", right)}


def fit_logistic(x, y, signs=None, ridge=1):
    """The bias and a weight of each column of x, by maximum likelihood with a little ridge on standardised features.
    `signs` are those of the weights; where they are not given any sign will do."""
    signs = np.zeros(x.shape[1]) if signs is None else signs
    mean, scale = x.mean(0), x.std(0)
    scale[scale == 0] = 1
    z = np.column_stack([np.ones(len(x)), (x - mean) / scale])
    penalty = np.r_[0, np.full(x.shape[1], ridge)]

    def cost(w):
        log_odds = z @ w
        residual = 1 / (1 + np.exp(-log_odds)) - y
        likelihood = (np.logaddexp(0, log_odds) - y * log_odds).sum()
        return likelihood + (penalty * w * w).sum() / 2, z.T @ residual + penalty * w

    bounds = [(None, None)] + [(0 if sign > 0 else None, 0 if sign < 0 else None) for sign in signs]
    w = minimize(cost, np.zeros(z.shape[1]), jac=True, bounds=bounds, method="L-BFGS-B",
                 options={"ftol": 1e-14, "gtol": 1e-9}).x
    return np.r_[w[0] - (w[1:] * mean / scale).sum(), w[1:] / scale]


def fit(features, labels):
    return fit_logistic(features, labels, [sign for sign, _ in FEATURES.values()])


def cross_validated(features, labels, parts):
    """Log-odds of each pose by a fit to all other parts."""
    log_odds = np.empty(len(labels))
    for part in np.unique(parts):
        rest = parts != part
        w = fit(features[rest], labels[rest])
        log_odds[~rest] = w[0] + features[~rest] @ w[1:]
    return log_odds


def area_under_roc(values, labels):
    """NaN where all labels are equal."""
    _, index, counts = np.unique(values, return_inverse=True, return_counts=True)
    ranks = (np.cumsum(counts) - (counts - 1) / 2)[index]
    right, wrong = labels.sum(), (1 - labels).sum()
    return (ranks[labels > 0].sum() - right * (right + 1) / 2) / (right * wrong) if right * wrong else np.nan


def print_areas(columns, features, labels, log_odds):
    """Areas under the ROC curve by part; the last row has their means."""
    judged = {"today": columns["rank"], "fit": log_odds}
    judged |= {name: sign * features[:, i] for i, (name, (sign, _)) in enumerate(FEATURES.items())}
    print(f"{'area under the ROC curve':28s} poses right " + " ".join(f"{name:>23s}" for name in judged))
    areas = []
    for part in np.unique(columns["part"]):
        of = columns["part"] == part
        areas.append([area_under_roc(values[of], labels[of]) for values in judged.values()])
        print(f"{part:28s} {of.sum():5d} {int(labels[of].sum()):5d} " + " ".join(f"{a:23.3f}" for a in areas[-1]))
    print(f"{'mean':28s} {len(labels):5d} {int(labels.sum()):5d} "
          + " ".join(f"{a:23.3f}" for a in np.nanmean(areas, axis=0)))


def print_reliability(labels, log_odds):
    p = 1 / (1 + np.exp(-log_odds))
    print(f"log loss {np.mean(np.logaddexp(0, log_odds) - labels * log_odds):.3f}")
    print("predicted    poses  mean p  right")
    for low in np.arange(0, 1, 0.1):
        inside = (p >= low) & (p < low + 0.1 + 1e-9)
        if inside.any():
            print(f"{low:.1f} .. {low + 0.1:.1f} {inside.sum():7d}    {p[inside].mean():.2f}   {labels[inside].mean():.2f}")


def print_recall(columns, labels, log_odds):
    """True poses above the value that leaves this many wrong poses an image."""
    image = np.char.add(columns["part"], columns["image"])
    of_truth = np.char.add(image, columns["truth"].astype(str))
    truths, images = len(np.unique(of_truth[labels > 0])), len(np.unique(image))
    wrong = np.sort(log_odds[labels == 0])[::-1]
    print(f"true poses among all: {truths}; by wrong poses an image: " + ", ".join(
        f"{rate:g}: {len(np.unique(of_truth[(labels > 0) & (log_odds > wrong[min(int(rate * images), len(wrong) - 1)])]))}"
        for rate in (0.25, 0.5, 1, 2)))


def fit_and_print(name, columns):
    stage, label = FUNCTIONS[name]
    columns = of_stage(columns, stage)
    labels = label(columns)
    columns = {column: values[~np.isnan(labels)] for column, values in columns.items()}
    labels = labels[~np.isnan(labels)]
    features = np.column_stack([feature(columns) for _, feature in FEATURES.values()])
    log_odds = cross_validated(features, labels, columns["part"])
    weights = dict(zip(["bias", *FEATURES], fit(features, labels)))
    print(f"\n{name}: " + ", ".join(f"{field} {weight:.4g}" for field, weight in weights.items()))
    print_areas(columns, features, labels, log_odds)
    print_recall(columns, labels, log_odds)
    print_reliability(labels, log_odds)
    data = f"{len(labels)} poses, {int(labels.sum())} right, of the {len(np.unique(columns['part']))} parts of set fit."
    return weights, data


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", metavar="FILE", help="header whose sections get the weights")
    parser.add_argument("files", nargs="+", type=Path, metavar="CSV")
    arguments = parser.parse_args()
    columns = load(arguments.files)
    if len(np.unique(columns["part"])) < 2:
        raise SystemExit("fit_probability: found one part, expected two or more to validate by part")
    for name in FUNCTIONS:
        weights, data = fit_and_print(name, columns)
        if arguments.write:
            write_weights(arguments.write, f"{name.upper()}_ONE_VIEW", "OneView", weights, data)


if __name__ == "__main__":
    main()
