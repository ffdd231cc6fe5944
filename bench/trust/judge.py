#!/usr/bin/python3
"""Detects the parts of a set with a given program and judges the poses.

    bench/trust/judge.py SET OUT [--program PROGRAM] [--parts NAME ...] [-- DETECT_OPTION ...]

SET is a folder that make_sets.sh made: one BOP dataset a part. OUT gets a folder of results a
part, judgement.md, parts.csv, bins.csv and poses.csv. Results that are there are not computed
again, so give another folder for another program or other options. PROGRAM may be an older
edgescout: only options that all versions know are passed.

The options after -- go to `edgescout detect`. The program's defaults judge it as users have it:

    judge.py test out/default                                          recall, false poses, time
    judge.py test out/range -- --distance-min 0.3 --distance-max 0.7 without the search over scale
    judge.py test out/all -- --min-probability 0.01                    reliability

A pose is right as matching.py says. Poses below the program's default --min-probability (or
--threshold) do not count as found or false; all of them count in the bins. The share of instances
between 40 and 70 % visible is counted apart. An instance below 40 % is neither asked for nor, if
found, false. Seconds are of processor time, over all cores; they include the making of templates.
"""
import argparse
import csv
import json
import re
import resource
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from matching import load_estimates, load_symmetries, load_truths, match
from reliability import CERTAIN, certain, equal_bins, wilson_interval

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/host/cli/edgescout"
CLEAR, HIDDEN = 0.7, 0.4  # visible fractions


@dataclass
class PartRow:
    part: str
    images: int = 0
    clear: int = 0  # instances more than 70 % visible
    clear_found: int = 0
    hidden: int = 0  # instances 40 to 70 % visible
    hidden_found: int = 0
    false: int = 0
    cpu_s: float = 0.0
    wall_s: float = 0.0

    def add(self, other):
        for name in ("images", "clear", "clear_found", "hidden", "hidden_found", "false", "cpu_s",
                     "wall_s"):
            setattr(self, name, getattr(self, name) + getattr(other, name))


def default_threshold(program):
    """The default of --min-probability, from the program's help."""
    for flag in ("--help-all", "--help"):
        done = subprocess.run([program, "detect", flag], capture_output=True, text=True,
                              check=False)
        found = re.search(r"--min-probability FLOAT[^=\n]*=([0-9.e-]+)", done.stdout)
        if done.returncode == 0 and found:
            return float(found[1])
    sys.exit(f"judge: {program}: found no default of --min-probability in its help")


def detect(program, dataset, out, options):
    """Returns the seconds of processor and of wall time."""
    seconds = out / "seconds.json"
    if seconds.exists():
        return json.loads(seconds.read_text())
    out.mkdir(parents=True, exist_ok=True)
    command = [program, "detect", dataset, "--model", dataset / "models/obj_000001.ply", "--unit",
               "mm", "--models-info", dataset / "models/models_info.json", "--device", "cpu",
               "--no-overlays", "--out", out / "results", *options]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    with open(out / "detect.log", "w") as log:
        done = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"judge: detect failed with {done.returncode}; see {out / 'detect.log'}")
    measured = {"cpu_s": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
                "wall_s": time.monotonic() - start}
    seconds.write_text(json.dumps(measured))
    return measured


def judge_part(dataset, results, threshold):
    """The part's row, and (scene, image, probability, right) of every pose."""
    truths, estimates = load_truths(dataset), load_estimates(results)
    symmetries = load_symmetries(dataset / "models/models_info.json", 1)
    row, poses = PartRow(dataset.name, images=len(truths)), []
    for (scene, image), instances in sorted(truths.items()):
        found = estimates.get((scene, image), [])
        match(found, instances, symmetries)
        poses += [(scene, image, e.probability, e.right) for e in found]
        row.false += sum(e.probability >= threshold and not e.right for e in found)
        for truth in instances:
            if truth.visible > CLEAR:
                row.clear += 1
                row.clear_found += truth.found >= threshold
            elif truth.visible >= HIDDEN:
                row.hidden += 1
                row.hidden_found += truth.found >= threshold
    return row, poses


def percent(hits, trials):
    return f"{100 * hits / trials:.1f} %" if trials else "-"


def table_line(row):
    images = max(1, row.images)
    return (f"| {row.part} | {row.images} | {row.clear} | {row.clear_found} | "
            f"{percent(row.clear_found, row.clear)} | {row.hidden} | {row.hidden_found} | "
            f"{percent(row.hidden_found, row.hidden)} | {row.false / images:.2f} | "
            f"{row.cpu_s / images:.2f} |")


def report(head, rows, poses, threshold):
    total = PartRow("all")
    for row in rows:
        total.add(row)
    pairs = [pose[2:] for _, pose in poses]
    bins, (count, wrong) = equal_bins(pairs), certain(pairs)
    low, high = wilson_interval(wrong, count)
    return "\n".join([
        *head, f"probability from {threshold:g}", "",
        "| part | images | over 70 % visible | found | | 40-70 % visible | found | "
        "| false an image | CPU s an image |",
        "|---|---|---|---|---|---|---|---|---|---|",
        *map(table_line, rows), table_line(total), "",
        f"Bins of equal count, {sum(b.count for b in bins)} poses. Largest gap: "
        f"{max((b.gap for b in bins), default=0):.3f}", "",
        "| poses | mean probability | fraction right | gap |", "|---|---|---|---|",
        *[f"| {b.count} | {b.mean:.3f} | {b.right:.3f} | {b.gap:.3f} |" for b in bins], "",
        f"Above {CERTAIN}: {count} poses, {wrong} wrong: {percent(wrong, count)} "
        f"(95 %: {100 * low:.2f} to {100 * high:.2f} %)", ""])


def write_csv(file, names, rows):
    with open(file, "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([names, *rows])


def write_all(out, text, rows, poses):
    (out / "judgement.md").write_text(text)
    write_csv(out / "parts.csv", list(vars(PartRow(""))), [list(vars(r).values()) for r in rows])
    write_csv(out / "poses.csv", ["part", "scene", "image", "probability", "right"],
              [[part, *pose[:3], int(pose[3])] for part, pose in poses])
    write_csv(out / "bins.csv", ["count", "mean", "right"],
              [[b.count, b.mean, b.right] for b in equal_bins([p[2:] for _, p in poses])])


def arguments():
    parser = argparse.ArgumentParser(description="Detects and judges the parts of a set.",
                                     epilog="Options after -- go to `edgescout detect`.")
    parser.add_argument("set", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--program", type=Path, default=PROGRAM)
    parser.add_argument("--parts", nargs="+", help="only these")
    parser.add_argument("--threshold", type=float, help="default: the program's")
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    parsed = parser.parse_args(words[:split])
    parsed.options = words[split + 1:]
    return parsed


def main():
    a = arguments()
    version = subprocess.run([a.program, "--version"], capture_output=True, text=True, check=True)
    threshold = default_threshold(a.program) if a.threshold is None else a.threshold
    datasets = sorted(p.parent.parent for p in a.set.glob("*/models/models_info.json"))
    datasets = [d for d in datasets if not a.parts or d.name in a.parts]
    if not datasets:
        sys.exit(f"judge: {a.set}: found no part, expected folders PART/models")
    rows, poses = [], []
    for dataset in datasets:
        seconds = detect(a.program, dataset, a.out / dataset.name, a.options)
        row, new = judge_part(dataset, a.out / dataset.name / "results/results.csv", threshold)
        row.cpu_s, row.wall_s = seconds["cpu_s"], seconds["wall_s"]
        rows.append(row)
        poses += [(dataset.name, pose) for pose in new]
        print(table_line(row), flush=True)
    head = [f"{version.stdout.strip()}, {a.set.name}, options: {' '.join(a.options) or 'default'}"]
    text = report(head, rows, poses, threshold)
    write_all(a.out, text, rows, poses)
    print("\n" + text)


if __name__ == "__main__":
    main()
