#!/usr/bin/python3
"""Renders the sets fit, choice and test from the parts that make_parts.py made.

    bench/trust/make_sets.py PARTS OUT [--program PROGRAM] [--sets SET ...] [--parts NAME ...]
                             [--scenes N]

OUT gets SET/PART, one BOP dataset a part: scenes of one image with five instances of the part.
Clutter and occluders are the other parts of the same set, and photographs are the set's own. So
nothing that is seen in one set is seen in another. All sets have the ranges below.

Part and set determine the images: the first seed of a part is in parts.csv, scene i has seed + i.
Datasets that are there are kept.
"""
import argparse
import hashlib
import shutil
import subprocess
import sys
from pathlib import Path

from make_parts import SETS, load_table

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/host/cli/edgescout"
SCENES = {"fit": 12, "choice": 40, "test": 46}

RANGES = """
--width 640 --height 480 --focal 800 --views 1 --objects 5 --pile 0.5
--min-distance 0.36 --max-distance 0.60 --min-elevation 30 --max-elevation 85
--clutter 1 --clutter-objects 1 7 --clutter-size 0.5 1.5 --occluders 0 2
--background-share 0.6 --board-texture-share 0.4
--metal 0.4 --reflectance 0.5 0.9 --roughness 0.08 0.4 --anisotropy 0 0.6
--gloss 0 0.06 --board-gloss 0 0.06 --albedo 0.04 0.7
--lamp-width 0.01 0.2 --lamp-share 0.3 0.8
--brightness 0.3 1.5 --contrast 0.4 1 --gamma 1.8 2.4
--blur 0.4 --defocus 0 1.2 --motion-blur 0 1.5 --vignetting 0 0.4 --lens-residue -0.7 0.7
--noise 0 --sensor-noise 1 4 --sharpening 0 1.2 --jpeg 60 98
""".split()


def model(parts, name):
    return parts / name / "obj_000001.ply"


def render(a, row, others):
    """Renders the dataset of a part, in a folder beside it until it is whole."""
    dataset = a.out / row["set"] / row["name"]
    if dataset.exists():
        return
    beside = dataset.with_name(dataset.name + ".part")
    shutil.rmtree(beside, ignore_errors=True)
    photographs = a.parts_folder / "photographs" / row["set"]
    info = a.parts_folder / row["name"] / "models_info.json"
    command = [a.program, "render", "--model", model(a.parts_folder, row["name"]), "--unit", "mm",
               "--models-info", info, "--seed", row["seed"],
               "--scenes", str(a.scenes or SCENES[row["set"]]), "--out", beside,
               "--clutter-model", *(model(a.parts_folder, name) for name in others),
               "--backgrounds", photographs, "--board-texture", photographs,
               "--environments", photographs, *RANGES]
    if subprocess.run(command, check=False).returncode != 0:
        sys.exit(f"make_sets: rendering {row['name']} failed")
    # With the axes of surfaces of revolution, which the program samples.
    shutil.copyfile(info, beside / "models/models_info.json")
    beside.rename(dataset)


def checksum(folder):
    """Of the names and contents of all files."""
    total = hashlib.sha256()
    for file in sorted(p for p in folder.rglob("*") if p.is_file()):
        total.update(str(file.relative_to(folder)).encode())
        total.update(hashlib.sha256(file.read_bytes()).digest())
    return total.hexdigest()[:16]


def main():
    parser = argparse.ArgumentParser(description="Renders the sets fit, choice and test.")
    parser.add_argument("parts_folder", metavar="PARTS", type=Path)
    parser.add_argument("out", metavar="OUT", type=Path)
    parser.add_argument("--program", type=Path, default=PROGRAM)
    parser.add_argument("--sets", nargs="+", choices=SETS, default=SETS)
    parser.add_argument("--parts", nargs="+", metavar="NAME", help="only these")
    parser.add_argument("--scenes", type=int, help="of each part; default: as frozen")
    a = parser.parse_args()
    table = load_table()
    missing = [r["name"] for r in table if not model(a.parts_folder, r["name"]).exists()]
    if missing:
        sys.exit(f"make_sets: {a.parts_folder}: found no {', '.join(missing)} (make_parts.py)")
    for name in a.sets:
        rows = [r for r in table if r["set"] == name]
        for row in rows:
            if not a.parts or row["name"] in a.parts:
                render(a, row, [r["name"] for r in rows if r["name"] != row["name"]])
        print(f"{name}: checksum {checksum(a.out / name)}")


if __name__ == "__main__":
    main()
