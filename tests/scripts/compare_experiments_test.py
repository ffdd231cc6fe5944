"""scripts/compare_experiments.py on small folders: equal, renamed, different, with rows missing."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "compare_experiments.py"

CELL = """\
# experiment: nbv
# free_sight: 0.5
# strategies: mi-max random
# commit: 111111111111
bin,strategy,found,seconds
0,mi-max,12,1.5
0,random,9,0.25
"""
NAMES = {
    "columns": {"found": "num_found"},
    "notes": {"free_sight": "visibility_exponent"},
    "values": {"strategy": {"mi-max": "information"}, "strategies": {"mi-max": "information"}},
    "fields": {"evidence": "psi_z_score"},
    "files": {"cells/nbv/bin_000.csv": "cells/next_view/bin_000.csv"},
    "only_in_new": ["solver"],
}


class CompareExperiments(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.write("names.json", json.dumps(NAMES))

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def write_cells(self, before, after):
        self.write("before/cells/nbv/bin_000.csv", before)
        self.write("after/cells/nbv/bin_000.csv", after)

    def compare(self, *more):
        done = subprocess.run(
            [sys.executable, SCRIPT, self.folder / "before", self.folder / "after", "--names",
             self.folder / "names.json", *more], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_equal_but_for_commit_and_times(self):
        self.write_cells(CELL, CELL.replace("111111111111", "222222222222").replace("1.5", ""))
        self.write("after/nbv.md", "a report is not compared")
        code, text = self.compare()
        self.assertEqual((code, text), (0, "1 files before, 1 after, 0 differ\n"))

    def test_renamed(self):
        new = (CELL.replace("found", "num_found").replace("free_sight", "visibility_exponent")
               .replace("mi-max", "information").replace("# commit", "# solver: batched\n# commit"))
        self.write("before/cells/nbv/bin_000.csv", CELL)
        self.write("after/cells/next_view/bin_000.csv", new)
        self.write("before/result.json", '{"detections": [{"evidence": 1.50, "ms": 3}]}')
        self.write("after/result.json", '{"detections": [{"psi_z_score": 1.50, "ms": 4}]}')
        code, text = self.compare()
        self.assertEqual((code, text), (0, "2 files before, 2 after, 0 differ\n"))

    def test_columns_in_another_order(self):
        self.write_cells("a,b\n1,2\n", "b,a\n2,1\n")
        self.assertEqual(self.compare()[0], 0)

    def test_name_that_no_table_knows(self):
        self.write_cells(CELL, CELL.replace("strategy", "plan"))
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("column strategy: only before", text)
        self.assertIn("column plan: only after", text)

    def test_different_figure(self):
        self.write_cells(CELL, CELL.replace("0,random,9", "0,random,8"))
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("column num_found: 1 of 2 rows, largest relative difference 0.11;"
                      " first row 2: 9 before, 8 after", text)

    def test_figure_of_other_digits(self):
        self.write_cells("a\n0.5\n", "a\n0.50\n")
        self.assertEqual(self.compare()[0], 1)

    def test_different_setting(self):
        self.write_cells(CELL, CELL.replace("free_sight: 0.5", "free_sight: 1"))
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("note visibility_exponent: 0.5 before, 1 after", text)

    def test_missing_row(self):
        self.write_cells(CELL, CELL.replace("0,mi-max,12,1.5\n", ""))
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("rows: 2 before, 1 after", text)
        self.assertIn("row only before: bin=0 num_found=12 strategy=information", text)

    def test_rows_in_another_order(self):
        self.write_cells("a\n1\n2\n", "a\n2\n1\n")
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("rows: the same in another order", text)

    def test_missing_file(self):
        self.write_cells(CELL, CELL)
        self.write("after/cells/nbv/bin_001.csv", CELL)
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("cells/nbv/bin_001.csv: only after", text)

    def test_different_json(self):
        self.write("before/result.json", '{"detections": [{"psi": 0.8}]}')
        self.write("after/result.json", '{"detections": [{"psi": 0.7}]}')
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("value.detections[0].psi: 0.8 before, 0.7 after", text)

    def test_shows_the_first_differences(self):
        self.write_cells("a\n" + "1\n" * 5, "a\n")
        code, text = self.compare("--show", "2")
        self.assertEqual(code, 1)
        self.assertEqual(text.count("row only before"), 1)
        self.assertIn("4 more differences", text)

    def test_bad_input(self):
        self.write_cells(CELL, CELL + "0,random\n")
        code, text = self.compare()
        self.assertEqual(code, 2)
        self.assertIn("line 8: found 2 cells, expected 4", text)
        self.write_cells("", CELL)
        self.assertIn("no line with the names of columns", self.compare()[1])
        self.write("names.json", '{"colums": {}}')
        self.assertIn("no such table: colums", self.compare()[1])

    def test_empty_folder(self):
        self.write("before/index.md", "")
        self.write("after/index.md", "")
        code, text = self.compare()
        self.assertEqual(code, 2)
        self.assertIn("no .csv and no .json file", text)


if __name__ == "__main__":
    unittest.main()
