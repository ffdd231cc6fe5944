#!/usr/bin/env python3
"""Average precisions of `edgescout eval` against an implementation written from BOP's definition.

EDGESCOUT_CLI names the program. Random poses of two cubes in 12 images.
"""
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

SIDE, WIDTH, HEIGHT, FOCAL = 40.0, 1280, 960, 1500.0
CORNERS = [(SIDE / 2 * x, SIDE / 2 * y, SIDE / 2 * z)
           for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
LEAST_VISIBLE, MOST_ESTIMATES = 0.1, 100


def rotation(draw, most_rad):
    """About a random axis, by Rodrigues' formula."""
    axis = [draw.gauss(0, 1) for _ in range(3)]
    length = math.sqrt(sum(a * a for a in axis))
    x, y, z = (a / length for a in axis)
    angle = draw.uniform(0, most_rad)
    c, s = math.cos(angle), math.sin(angle)
    v = 1 - c
    return [[c + x * x * v, x * y * v - z * s, x * z * v + y * s],
            [y * x * v + z * s, c + y * y * v, y * z * v - x * s],
            [z * x * v - y * s, z * y * v + x * s, c + z * z * v]]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def moved(pose, point):
    r, t = pose
    return [sum(r[i][k] * point[k] for k in range(3)) + t[i] for i in range(3)]


def in_image(point):
    return FOCAL * point[0] / point[2], FOCAL * point[1] / point[2]


def errors(estimate, truth):
    """MSSD as a share of the diameter, MSPD in px of an image 640 px wide."""
    pairs = [(moved(estimate, c), moved(truth, c)) for c in CORNERS]
    mssd = max(math.dist(a, b) for a, b in pairs) / (SIDE * math.sqrt(3))
    mspd = max(math.dist(in_image(a), in_image(b)) for a, b in pairs) * 640 / WIDTH
    return mssd, mspd


def average_precision(images, obj, kind, threshold):
    detections, to_find = [], 0
    for truths, estimates in images:
        best = sorted(estimates, key=lambda e: -e["score"])[:MOST_ESTIMATES]
        mine = [t for t in truths if t["obj"] == obj]
        to_find += sum(t["visible"] >= LEAST_VISIBLE for t in mine)
        free = list(range(len(mine)))
        for estimate in (e for e in best if e["obj"] == obj and mine):
            near = [(errors(estimate["pose"], mine[t]["pose"])[kind], t) for t in free]
            near = [pair for pair in near if pair[0] < threshold]
            if not near:
                detections.append((estimate["score"], 0))
                continue
            taken = min(near)[1]
            free.remove(taken)
            if mine[taken]["visible"] >= LEAST_VISIBLE:
                detections.append((estimate["score"], 1))
    curve, right = [], 0
    for number, (_, is_right) in enumerate(sorted(detections, reverse=True), 1):
        right += is_right
        curve.append((right / to_find, right / number))
    at = [max((p for r, p in curve if r >= step * 0.01), default=0) for step in range(101)]
    return sum(at) / 101


def expected(images, obj):
    mssd = [average_precision(images, obj, 0, 0.05 * (i + 1)) for i in range(10)]
    mspd = [average_precision(images, obj, 1, 5 * (i + 1)) for i in range(10)]
    return {"precisions_mssd": mssd, "precisions_mspd": mspd,
            "ap_mssd": sum(mssd) / 10, "ap_mspd": sum(mspd) / 10}


def near(draw, pose, spread):
    r, t = pose
    return product(rotation(draw, 0.2 * spread), r), [x + draw.gauss(0, 8 * spread) for x in t]


def random_images(draw):
    def anywhere():
        return rotation(draw, 3), [draw.uniform(-150, 150), draw.uniform(-100, 100),
                                   draw.uniform(500, 900)]
    images = []
    for _ in range(12):
        truths = [{"obj": draw.choice((1, 2)), "pose": anywhere(),
                   "visible": draw.choice((0, 0.05, 0.1, 0.5, 1))}
                  for _ in range(draw.randint(0, 5))]
        estimates = [{"obj": t["obj"], "score": draw.uniform(0.3, 1),
                      "pose": near(draw, t["pose"], draw.random())}
                     for t in truths for _ in range(draw.randint(0, 2))]
        estimates += [{"obj": draw.choice((1, 2)), "score": draw.uniform(0, 0.8),
                       "pose": anywhere()}
                      for _ in range(draw.choice((0, 1, 3, 120)))]
        images.append((truths, estimates))
    return images


def by_row(matrix):
    return [x for row in matrix for x in row]


def write_set(folder, images):
    scene = folder / "000001"
    (scene / "gray").mkdir(parents=True)
    cameras, poses, infos, rows = {}, {}, {}, ["scene_id,im_id,obj_id,score,R,t,time"]
    for i, (truths, estimates) in enumerate(images):
        header = f"P5 {WIDTH} {HEIGHT} 255\n".encode()
        (scene / "gray" / f"{i:06}.pgm").write_bytes(header + bytes(WIDTH * HEIGHT))
        cameras[i] = {"cam_K": [FOCAL, 0, WIDTH / 2, 0, FOCAL, HEIGHT / 2, 0, 0, 1]}
        poses[i] = [{"obj_id": t["obj"], "cam_R_m2c": by_row(t["pose"][0]),
                     "cam_t_m2c": t["pose"][1]} for t in truths]
        infos[i] = [{"visib_fract": t["visible"]} for t in truths]
        for e in estimates:
            r, t = (" ".join(map(repr, part)) for part in (by_row(e["pose"][0]), e["pose"][1]))
            rows.append(f"1,{i},{e['obj']},{e['score']!r},{r},{t},-1")
    for name, content in (("camera", cameras), ("gt", poses), ("gt_info", infos)):
        (scene / f"scene_{name}.json").write_text(json.dumps(content))
    (folder / "results.csv").write_text("\n".join(rows) + "\n")
    ply = ["ply", "format ascii 1.0", "element vertex 8", "property float x", "property float y",
           "property float z", "element face 6", "property list uchar int vertex_indices",
           "end_header"]
    ply += [" ".join(map(str, c)) for c in CORNERS]
    ply += ["4 " + " ".join(map(str, f)) for f in FACES]
    for obj in (1, 2):
        (folder / f"obj_{obj:06}.ply").write_text("\n".join(ply) + "\n")


def compare(seed, program):
    images = random_images(random.Random(seed))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_set(folder, images)
        subprocess.run([program, "eval", folder / "results.csv", folder / "000001", "--model",
                        folder / "obj_000001.ply", folder / "obj_000002.ply", "--unit", "mm",
                        "--json", folder / "eval.json"], check=True, stdout=subprocess.DEVNULL)
        found = json.loads((folder / "eval.json").read_text())
    wanted = {str(obj): expected(images, obj) for obj in (1, 2)}
    for obj, figures in wanted.items():
        for name, values in figures.items():
            others = found["objects"][obj][name]
            pairs = zip(values, others) if isinstance(values, list) else [(values, others)]
            for value, other in pairs:
                assert abs(value - other) < 1e-9, (seed, obj, name, value, other)
    for name in ("ap_mssd", "ap_mspd"):
        mean = sum(figures[name] for figures in wanted.values()) / 2
        assert abs(mean - found["all"][name]) < 1e-9, (seed, name)
        assert 0.05 < mean < 0.95, f"a case that says little: {mean}"


if __name__ == "__main__":
    if "EDGESCOUT_CLI" not in os.environ:
        sys.exit(77)
    for one in (1, 2, 3):
        compare(one, os.environ["EDGESCOUT_CLI"])
