#!/usr/bin/python3
"""Draws what edgescout_bench_bins wrote: the paper's figure 15 (a-h), and prints it as a Markdown table.

    scripts/plot_bins.py bins.csv [MORE.csv ...] --out bins.png [--px]

Correct rate (above) and false positives a bin (below) by the number of views; instances lightly and highly occluded in the first view, one and all types searched for. Intervals:
95 % by bootstrap over bins, the same bins drawn for all strategies. --px: right is what lies within 10 px in the first view, not within 0.1 rad and 5 mm.
"""
import argparse
import csv
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

DRAWS = 2000
NAMES = {"mi-max": "MI-MAX", "random": "Random", "dis": "DIS", "fixed": "Fixed"}
COLOURS = {"mi-max": "#c0392b", "random": "#2471a3", "dis": "#239b56", "fixed": "#7d6608"}
GROUPS = {"light": "lightly occluded", "heavy": "highly occluded"}


def read(files, correct, wrong):
    """counts[sought, group, strategy][scene][views]: (instances, correct, wrong)."""
    counts = defaultdict(lambda: defaultdict(dict))
    for file in files:
        with open(file, newline="", encoding="utf-8") as rows:
            for row in csv.DictReader(rows):
                key = int(row["sought"]), row["group"], row["strategy"]
                counts[key][int(row["scene"])][int(row["views"])] = int(row["instances"]), int(row[correct]), int(row[wrong])
    return counts


def common_scenes(counts, sought):
    """Bins that every strategy has been through: others would compare different bins."""
    done = [set(scenes) for (count, _, _), scenes in counts.items() if count == sought]
    return sorted(set.intersection(*done)) if done else []


def rates(scenes, bins, views):
    """Correct rate and wrong ones a bin, by views: (value, low, high) each."""
    values = np.array([[scenes[b][v] for v in views] for b in bins], float)  # bin, views, count
    draws = np.random.default_rng(1).integers(0, len(bins), (DRAWS, len(bins)))
    drawn = values[draws].sum(axis=1)
    result = []
    for measure in (lambda x: x[..., 1] / np.maximum(1, x[..., 0]), lambda x: x[..., 2] / len(bins)):
        low, high = np.percentile(measure(drawn), [2.5, 97.5], axis=0)
        result.append((measure(values.sum(axis=0)), low, high))
    return result, values[:, 0, 0].sum()


def panel(axes, curves, views, title):
    for i, (strategy, (value, low, high)) in enumerate(curves.items()):
        x = np.array(views) + 0.06 * (i - (len(curves) - 1) / 2)
        axes.errorbar(x, value, [np.maximum(0, value - low), np.maximum(0, high - value)], label=NAMES.get(strategy, strategy), color=COLOURS.get(strategy), marker="o", markersize=4, capsize=2, linewidth=1.4)
    axes.set_title(title, fontsize=9)
    axes.set_xticks(views)
    axes.set_xlabel("views")
    axes.grid(alpha=0.3)


def print_table(panels, views):
    print("| searched | instances | strategy | " + " | ".join(f"{v} views" if v > 1 else "1 view" for v in views) + " |")
    print("|---|---|---|" + "---|" * len(views))
    for (searched, group, instances), curves in panels.items():
        for strategy, (correct, wrong) in curves.items():
            cells = [f"{100 * c:.0f} % [{100 * a:.0f}, {100 * b:.0f}], {w:.2f}" for c, a, b, w in zip(*correct, wrong[0])]
            print(f"| {searched} | {instances:.0f} {GROUPS[group]} | {NAMES.get(strategy, strategy)} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", nargs="+")
    parser.add_argument("--out", required=True, metavar="PNG")
    parser.add_argument("--px", action="store_true")
    arguments = parser.parse_args()
    suffix = "_px" if arguments.px else ""
    counts = read(arguments.csv, "correct" + suffix, "wrong" + suffix)
    strategies = list(dict.fromkeys(strategy for _, _, strategy in counts))
    soughts = sorted({sought for sought, _, _ in counts})
    figure, axes = plt.subplots(2, 2 * len(soughts), figsize=(8 * len(soughts), 7), squeeze=False, constrained_layout=True)
    panels, views = {}, []
    for column, (sought, group) in enumerate((s, g) for s in soughts for g in GROUPS):
        bins = common_scenes(counts, sought)
        if not bins:
            continue
        views = sorted(next(iter(counts[sought, group, strategies[0]].values())))
        searched = "one type" if sought == 1 else f"{sought} types"
        measured = {s: rates(counts[sought, group, s], bins, views) for s in strategies if (sought, group, s) in counts}
        instances = next(iter(measured.values()))[1]
        curves = {s: result for s, (result, _) in measured.items()}
        panels[searched, group, instances] = curves
        title = f"{searched}, {GROUPS[group]}"
        letter = "abcdefgh"[column], "abcdefgh"[column + 2 * len(soughts)]
        panel(axes[0, column], {s: r[0] for s, r in curves.items()}, views, f"({letter[0]}) {title}: {instances:.0f} instances, {len(bins)} bins")
        panel(axes[1, column], {s: r[1] for s, r in curves.items()}, views, f"({letter[1]}) {title}")
        axes[0, column].set_ylim(0, 1.02)
        axes[1, column].set_ylim(bottom=0)
    axes[0, 0].set_ylabel("correct localization rate")
    axes[1, 0].set_ylabel("false positives a bin")
    axes[0, 0].legend(loc="lower right", fontsize=8)
    figure.savefig(arguments.out, dpi=110)
    print_table(panels, views)


if __name__ == "__main__":
    main()
