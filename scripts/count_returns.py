#!/usr/bin/env python3
"""Counts files and returns of the lists in docs/research/call_order.md.

A return is an entry into a file that was entered before. Ends with 1 where a list marks them
otherwise, or where the last list has more returns than issue 35 allows.
"""
import pathlib
import re
import sys

MOST_RETURNS = 18
page = pathlib.Path(__file__).parent.parent / "docs/research/call_order.md"
wrong = False
for section in re.split(r"^## ", page.read_text(), flags=re.MULTILINE)[1:]:
    rows = re.findall(r"^\| (\d+) \| (\S+) \|.*\| *(return)? *\|$", section, flags=re.MULTILINE)
    if not rows:
        continue
    title, files, returns = section.splitlines()[0], [], 0
    for number, (found, file, mark) in enumerate(rows, 1):
        is_return = file in files
        if int(found) != number or is_return != bool(mark):
            print(f"{title}: row {found}: wrong number or mark", file=sys.stderr)
            wrong = True
        returns += is_return
        if not is_return:
            files.append(file)
    print(f"{title}: {len(files)} files, {returns} returns")
sys.exit(wrong or returns > MOST_RETURNS)
