#!/usr/bin/env python3
"""Compares two folders of `edgescout detect`, `register` or `merge`: all but times must be equal.

    scripts/compare_batches.py A B [--tables]

--tables: results.csv and summary.json alone, as a merged folder has no NAME.json. Prints what was
compared, or the first difference in every file; then the exit code is 1.
"""
import argparse
import json
import pathlib
import sys

TIMES = {'seconds', 'images_per_second', 'timings_ms', 'mean_ms_per_image'}


def without_times(value):
    if isinstance(value, list):
        return [without_times(item) for item in value]
    if not isinstance(value, dict):
        return value
    kept = {}
    for name, item in value.items():
        if name in TIMES:
            continue
        if name in ('done', 'skipped'):  # a resumed run skips what was done
            kept['finished'] = kept.get('finished', 0) + item
            continue
        if name == 'templates':  # built, or read from the cache
            item = [origin['object_id'] for origin in item]
        kept[name] = without_times(item)
    return kept


def rows(file):
    """The lines of a results.csv without the last column, which is the time."""
    return [line.rsplit(',', 1)[0] for line in file.read_text().splitlines()]


def content(file):
    if file.suffix == '.csv':
        return rows(file)
    return json.dumps(without_times(json.loads(file.read_text())), indent=1).splitlines()


def files_of(folder, tables):
    names = {'results.csv', 'summary.json'}
    if not tables:
        names |= {file.name for file in folder.glob('*.json')}
    return names


def first_difference(a, b):
    for number, (left, right) in enumerate(zip(a, b), 1):
        if left != right:
            return f'line {number}: {left.strip()} | {right.strip()}'
    return f'{len(a)} and {len(b)} lines' if len(a) != len(b) else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('a', type=pathlib.Path)
    parser.add_argument('b', type=pathlib.Path)
    parser.add_argument('--tables', action='store_true')
    arguments = parser.parse_args()
    a, b = (files_of(folder, arguments.tables) for folder in (arguments.a, arguments.b))
    differences = [f'{name}: only in one' for name in sorted(a ^ b)]
    for name in sorted(a & b):
        difference = first_difference(content(arguments.a / name), content(arguments.b / name))
        if difference:
            differences.append(f'{name}: {difference}')
    for difference in differences:
        print(difference)
    if not differences:
        count = len(rows(arguments.a / 'results.csv')) - 1
        print(f'equal but for times: {len(a)} files, {count} poses')
    return 1 if differences else 0


if __name__ == '__main__':
    sys.exit(main())
