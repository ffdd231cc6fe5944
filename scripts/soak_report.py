#!/usr/bin/python3
"""Reports what scripts/soak.sh measured: the slope of resident memory and the open files.

The slope is fitted to each process by itself, after its first quarter (it loads and grows until it
has seen its largest image), by least squares. Its 95 % interval comes from blocks of a tenth of the
samples that are drawn again (samples that follow each other are alike).
"""
import csv
import pathlib
import sys

import numpy

BLOCKS, DRAWS = 10, 2000


def runs_of(file):
    """Seconds, MiB and open files by process."""
    runs = {}
    with open(file, encoding='utf-8') as rows:
        for seconds, process, memory, files in csv.reader(rows):
            runs.setdefault(process, []).append((float(seconds), float(memory), int(files)))
    return [numpy.array(run) for run in runs.values()]


def centred(run):
    """The run after its first quarter, without its own means."""
    kept = run[len(run) // 4:]
    return kept[:, :2] - kept[:, :2].mean(axis=0)


def slope_of(parts):
    points = numpy.concatenate(parts)
    time, memory = points[:, 0], points[:, 1]
    return 3600 * (time @ memory) / (time @ time)


def report(file):
    runs = [run for run in runs_of(file) if len(run) >= 2 * BLOCKS]
    if not runs:
        print(f'{file}: no run of {2 * BLOCKS} samples')
        return
    blocks = [block for run in runs for block in numpy.array_split(centred(run), BLOCKS)]
    random = numpy.random.default_rng(1)
    drawn = [slope_of([blocks[i] for i in random.integers(len(blocks), size=len(blocks))])
             for _ in range(DRAWS)]
    low, high = numpy.percentile(drawn, [2.5, 97.5])
    slope = slope_of([centred(run) for run in runs])
    all_of = numpy.concatenate(runs)
    print(f'{pathlib.Path(file).stem}: {len(runs)} processes, {all_of[:, 0].max() / 60:.0f} min, '
          f'{all_of[:, 1].max():.0f} MiB at most, slope {slope:+.2f} MiB an hour '
          f'(95 %: {low:+.2f} to {high:+.2f}), open files {all_of[:, 2].min():.0f} to '
          f'{all_of[:, 2].max():.0f}')


for measured in sys.argv[1:]:
    if pathlib.Path(measured).exists():
        report(measured)
