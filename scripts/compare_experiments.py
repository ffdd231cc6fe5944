#!/usr/bin/python3
"""Compares the result folders of two runs of `edgescout bench experiments --no-times`.

    scripts/compare_experiments.py BEFORE AFTER [--names FILE] [--show N]

Every CSV and JSON file must hold the same rows with the same figures, as text. Names may differ as
the file of names says (scripts/experiment_names.json). Commit, version, machine and times are not
compared. Neither are the reports (.md, .svg), which are made from the rows.

The file of names is a JSON object. Each of its tables maps an old name to a new one:

    columns      columns of CSV files
    notes        names in the first lines of CSV files ("# name: value")
    values       for a column, note or field: its values; words of a list are replaced one by one
    fields       fields of JSON files
    files        file paths below the folder
    only_in_new  a list of columns, notes and fields that only the newer version writes

The names of both folders are replaced, so that either may be of the older version.

Exit code: 0 the same, 1 different, 2 something cannot be read.
"""
import argparse
import collections
import json
import sys
from pathlib import Path

NOT_COMPARED = {"commit", "version", "machine", "times", "ms", "seconds", "timings_ms"}
TABLES = ("columns", "notes", "values", "fields", "files")
NAMES_FILE = Path(__file__).with_name("experiment_names.json")


class Unreadable(Exception):
    """A file or folder that cannot be compared."""


class Names:
    """What is written under another name since an earlier version."""

    def __init__(self, tables):
        unknown = set(tables) - set(TABLES) - {"only_in_new"}
        if unknown:
            raise Unreadable(f"file of names: no such table: {', '.join(sorted(unknown))}")
        for table in TABLES:
            setattr(self, table, tables.get(table, {}))
        self.left_out = NOT_COMPARED | set(tables.get("only_in_new", []))
        self.values = {self._new(name): words for name, words in self.values.items()}

    def _new(self, name):
        for table in (self.columns, self.notes, self.fields):
            name = table.get(name, name)
        return name

    def value(self, name, text):
        """`name` is the new one. A whole value, or a list of words."""
        words = self.values.get(name)
        if not words:
            return text
        return words.get(text, " ".join(words.get(word, word) for word in text.split(" ")))


Csv = collections.namedtuple("Csv", "notes columns rows")  # notes: a dict; rows: tuples of text


def unique(new_name, names, file):
    if new_name in names:
        raise Unreadable(f"{file}: two columns, notes or fields are called {new_name}")
    return new_name


def load_csv(file, names):
    notes, header, rows = {}, None, []
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if header is None and line.startswith("# "):
            old, _, text = line[2:].partition(": ")
            name = names.notes.get(old, old)
            if name not in names.left_out:
                notes[unique(name, notes, file)] = names.value(name, text)
        elif header is None:
            header = [names.columns.get(name, name) for name in line.split(",")]
            kept = [i for i, name in enumerate(header) if name not in names.left_out]
        else:
            cells = line.split(",")
            if len(cells) != len(header):
                raise Unreadable(f"{file}: line {number}: found {len(cells)} cells,"
                                 f" expected {len(header)}")
            rows.append({header[i]: names.value(header[i], cells[i]) for i in kept})
    if header is None:
        raise Unreadable(f"{file}: no line with the names of columns")
    columns = []
    for i in kept:
        columns.append(unique(header[i], columns, file))
    columns.sort()  # their order may differ
    return Csv(notes, columns, [tuple(row[name] for name in columns) for row in rows])


def renamed_json(value, names, file, field=None):
    if isinstance(value, dict):
        result = {}
        for old, inner in value.items():
            name = names.fields.get(old, old)
            if name not in names.left_out:
                result[unique(name, result, file)] = renamed_json(inner, names, file, name)
        return result
    if isinstance(value, list):
        return [renamed_json(inner, names, file, field) for inner in value]
    return names.value(field, value) if isinstance(value, str) else value


def load_json(file, names):
    try:
        # Numbers stay the text that they are in the file.
        value = json.loads(file.read_text(), parse_float=str)
    except ValueError as error:
        raise Unreadable(f"{file}: {error}") from error
    return renamed_json(value, names, file)


def dict_differences(a, b, what):
    for name in sorted(a.keys() | b.keys()):
        if name not in b:
            yield f"{what} {name}: only before"
        elif name not in a:
            yield f"{what} {name}: only after"
        elif a[name] != b[name]:
            yield f"{what} {name}: {a[name]} before, {b[name]} after"


def relative_difference(a, b):
    """None where one is no number."""
    try:
        a, b = float(a), float(b)
    except ValueError:
        return None
    return abs(a - b) / max(abs(a), abs(b), sys.float_info.min)


def cell_differences(a, b):
    """Between rows at the same place, column by column."""
    for i, column in enumerate(a.columns):
        pairs = [(row, x[i], y[i]) for row, (x, y) in enumerate(zip(a.rows, b.rows), 1)
                 if x[i] != y[i]]
        if not pairs:
            continue
        row, x, y = pairs[0]
        sizes = [size for size in (relative_difference(x, y) for _, x, y in pairs)
                 if size is not None]
        largest = f", largest relative difference {max(sizes):.2g}" if sizes else ""
        yield (f"column {column}: {len(pairs)} of {len(a.rows)} rows{largest}; first row {row}:"
               f" {x} before, {y} after")


def csv_differences(a, b):
    yield from dict_differences(a.notes, b.notes, "note")
    if a.columns != b.columns:
        yield from dict_differences(dict.fromkeys(a.columns), dict.fromkeys(b.columns), "column")
    elif len(a.rows) == len(b.rows):
        if a.rows != b.rows and sorted(a.rows) == sorted(b.rows):
            yield "rows: the same in another order"
        else:
            yield from cell_differences(a, b)
    else:
        yield f"rows: {len(a.rows)} before, {len(b.rows)} after"
        rows_a, rows_b = collections.Counter(a.rows), collections.Counter(b.rows)
        for when, rows in (("before", rows_a - rows_b), ("after", rows_b - rows_a)):
            for row in rows.elements():
                text = " ".join(f"{name}={cell}" for name, cell in zip(a.columns, row))
                yield f"row only {when}: {text}"


def json_differences(a, b, place="value"):
    if isinstance(a, dict) and isinstance(b, dict):
        both = a.keys() & b.keys()
        yield from dict_differences({name: a[name] for name in a.keys() - both},
                                    {name: b[name] for name in b.keys() - both}, place)
        for name in sorted(both):
            yield from json_differences(a[name], b[name], f"{place}.{name}")
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        for i, (x, y) in enumerate(zip(a, b)):
            yield from json_differences(x, y, f"{place}[{i}]")
    elif isinstance(a, list) and isinstance(b, list):
        yield f"{place}: {len(a)} elements before, {len(b)} after"
    elif a != b:
        yield f"{place}: {a} before, {b} after"


def files_in(folder, names):
    if not folder.is_dir():
        raise Unreadable(f"{folder}: no folder")
    files = {}
    for file in sorted(folder.rglob("*")):
        if file.suffix in (".csv", ".json") and not file.name.startswith("."):
            old = file.relative_to(folder).as_posix()
            files[names.files.get(old, old)] = file
    if not files:
        raise Unreadable(f"{folder}: no .csv and no .json file")
    return files


def file_differences(a, b, names):
    if a.suffix == ".csv":
        return csv_differences(load_csv(a, names), load_csv(b, names))
    return json_differences(load_json(a, names), load_json(b, names))


def compare(before, after, names, show):
    """Prints what differs, of each file the first `show` differences. True where nothing does."""
    files_a, files_b = files_in(before, names), files_in(after, names)
    differing = 0
    for name in sorted(files_a.keys() | files_b.keys()):
        if name in files_a and name in files_b:
            found = list(file_differences(files_a[name], files_b[name], names))
        else:
            found = ["only before" if name in files_a else "only after"]
        differing += bool(found)
        for text in found[:show]:
            print(f"{name}: {text}")
        if len(found) > show:
            print(f"{name}: {len(found) - show} more differences")
    print(f"{len(files_a)} files before, {len(files_b)} after, {differing} differ")
    return differing == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", type=Path)
    parser.add_argument("after", type=Path)
    parser.add_argument("--names", type=Path, default=NAMES_FILE, help="file of names")
    parser.add_argument("--show", type=int, default=10, help="differences printed of each file")
    arguments = parser.parse_args()
    try:
        try:
            names = Names(json.loads(arguments.names.read_text()))
        except ValueError as error:
            raise Unreadable(f"{arguments.names}: {error}") from error
        return 0 if compare(arguments.before, arguments.after, names, arguments.show) else 1
    except (Unreadable, OSError) as error:
        print(f"compare_experiments: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
