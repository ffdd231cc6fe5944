#!/usr/bin/python3
"""Fits the factor of a pose's covariance that no distance to an edge shows, and prints how well the
regions hold.

The factor is common_to_edges (host/register/edge_covariance.h): of_all * explained ^ power.

    bench/trust/make_sets.py PARTS SETS --sets fit
    for part in SETS/fit/*; do edgescout_bench_pose_covariance $part > $(basename $part).csv; done
    scripts/fit_covariance.py *.csv
    scripts/fit_covariance.py --write host/register/edge_covariance_weights.h *.csv

The squared error of a pose, normalised by its covariance, is below the chi-squared bound of 95 %
where the 95 % region holds the error. Its tails are heavier than a Gaussian's, so the factor comes
from the tail itself: the logarithm of squared error over bound has zero as its conditional 95 %
quantile (quantile regression: Koenker and Bassett, Econometrica 1978). Only right poses count,
within 0.1 rad and 5 mm. The printed shares are cross-validated: the poses of each part are judged
by a fit to all other parts.
"""
import argparse
import csv
from pathlib import Path

import numpy as np
from scipy.optimize import minimize
from scipy.stats import chi2

from pose_classifier_weights import write_weights

RIGHT_RAD = 0.1
RIGHT_M = 0.005
INSIDE = 0.95
SIZES_PX = (0, 60, 120, np.inf)


def load(files):
    """Columns by name, of the right poses that edges hold."""
    rows = [row for file in files for row in csv.DictReader(open(file))]
    if not rows:
        raise SystemExit("fit_covariance: no poses")
    columns = {name: np.array([row[name] if name in ("set", "part") else float(row[name]) for row in rows])
               for name in rows[0]}
    right = (columns["angle_rad"] < RIGHT_RAD) & (columns["distance_m"] < RIGHT_M)
    held = np.isfinite(columns["squared"]) & (columns["explained"] > 0)
    print(f"{len(rows)} poses, {right.sum()} right, {(right & ~held).sum()} of these without a covariance")
    return {name: values[right & held] for name, values in columns.items()}


def log_excess(columns, factor):
    """Below 0 where the region of the covariance with this factor holds the error."""
    squared = columns["squared"] * columns["common"] / factor
    return np.log(squared / chi2.ppf(INSIDE, columns["unknowns"]))


def fit_quantile(x, y, smooth=0.05):
    """Coefficients of the linear conditional quantile, by the check loss with a corner rounded over `smooth`."""
    def loss(coefficients):
        residual = y - x @ coefficients
        below = 1 / (1 + np.exp(np.clip(residual / smooth, -500, 500)))
        value = INSIDE * residual + smooth * np.logaddexp(0, -residual / smooth)
        return value.mean(), -x.T @ (INSIDE - below) / len(y)

    return minimize(loss, np.r_[np.quantile(y, INSIDE), np.zeros(x.shape[1] - 1)], jac=True, method="BFGS").x


def fit(columns):
    """Fields of edge_covariance_weights::CommonToEdges."""
    least, most = np.quantile(columns["explained"], (0.01, 0.99))
    x = np.column_stack([np.ones(len(columns["explained"])), np.log(np.clip(columns["explained"], least, most))])
    log_of_all, power = fit_quantile(x, log_excess(columns, 1))
    return {"of_all": np.exp(log_of_all), "power": power, "least_explained": least, "most_explained": most}


def factor(weights, explained):
    share = np.clip(explained, weights["least_explained"], weights["most_explained"])
    return weights["of_all"] * share ** weights["power"]


def cross_validated(columns):
    """The factor of each pose by a fit to all other parts."""
    factors = np.empty(len(columns["part"]))
    for part in np.unique(columns["part"]):
        of = columns["part"] == part
        rest = {name: values[~of] for name, values in columns.items()}
        factors[of] = factor(fit(rest), columns["explained"][of])
    return factors


def print_row(name, chosen, columns, factors):
    if not chosen.any():
        return
    before, after = (log_excess(columns, f)[chosen] for f in (columns["common"], factors))
    shares = f"{np.mean(before < 0):8.3f} {np.mean(after < 0):8.3f}"
    print(f"{name:28s} {chosen.sum():5d} {shares} {np.sqrt(factors[chosen] / columns['common'][chosen]).mean():10.2f}")


def print_groups(columns, factors):
    print(f"{'share of poses inside 95 %':28s} poses    today      fit deviations")
    print_row("all", factors > 0, columns, factors)
    for views in np.unique(columns["views"]):
        for least, most in zip(SIZES_PX, SIZES_PX[1:]):
            sized = (columns["size_px"] >= least) & (columns["size_px"] < most)
            print_row(f"{views:.0f} views, {least} to {most} px", sized & (columns["views"] == views), columns, factors)
    edges = np.quantile(columns["explained"], np.linspace(0, 1, 6))
    for least, most in zip(edges, edges[1:]):
        share = (columns["explained"] >= least) & (columns["explained"] <= most)
        print_row(f"explained {least:.2f} to {most:.2f}", share, columns, factors)
    for part in np.unique(columns["part"]):
        print_row(part, columns["part"] == part, columns, factors)


def main():
    parser = argparse.ArgumentParser(description="Fits the factor that covariances of poses need.")
    parser.add_argument("files", metavar="CSV", nargs="+", type=Path)
    parser.add_argument("--write", metavar="HEADER", type=Path, help="replace the weights in this file")
    a = parser.parse_args()
    columns = load(a.files)
    weights = fit(columns)
    print(", ".join(f"{field} {value:.4g}" for field, value in weights.items()))
    print_groups(columns, cross_validated(columns))
    if a.write:
        data = f"{len(columns['part'])} right poses of {len(np.unique(columns['part']))} parts of set fit."
        write_weights(a.write, "COMMON_TO_EDGES", "CommonToEdges", weights, data)


if __name__ == "__main__":
    main()
