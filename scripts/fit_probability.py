#!/usr/bin/python3
"""Fits a logistic function of a pose's features in one view and prints its reliability.

PoseClassifier (host/register/pose_classifier.h) has two such functions. `probability` is fitted on reported poses,
`rank` on these and all registered candidates.

    PARTS="l_bracket bearing_block u_channel"
    edgescout render --part $PARTS --scenes 8 --objects 6 --clutter 1 --pile 0.4 --width 800 --height 600 --focal 950 \\
        --min-distance 0.35 --max-distance 0.6 --seed 500 --out A
    edgescout render --part $PARTS --scenes 8 --objects 5 --clutter 1 --pile 0.4 --width 640 --height 480 --focal 800 \\
        --min-distance 0.4 --max-distance 0.7 --seed 900 --blur 1.4 --noise 3 --out B
    ALL="--min-probability 0 --no-overlays"   # for rank, besides: --max-claimed 1 --restart-rotation 0
    edgescout detect A --model A/models/*.ply --unit mm --models-info A/models/models_info.json \\
        --distance-min 0.33 --distance-max 0.66 $ALL --out A_RESULTS
    edgescout detect B --model B/models/*.ply --unit mm --models-info B/models/models_info.json \\
        --distance-min 0.36 --distance-max 0.72 $ALL --out B_RESULTS
    scripts/fit_probability.py A A_RESULTS B B_RESULTS
    scripts/fit_probability.py --write host/register/pose_classifier_weights.h --as probability A A_RESULTS B B_RESULTS

A candidate is right if the corners of its bounding box project within 10 px of those of a true instance, modulo
symmetry. Features: the logarithm of psi_z_score, mean DCD (px) and unexplained grey, from the result files. Older
result files call psi_z_score `evidence`.
"""
import argparse
import json
from pathlib import Path

import numpy as np

from pose_classifier_weights import write_weights

RIGHT_PX = 10
MIN_PSI_Z_SCORE = 0.5


def rotation_about(axis, angle):
    axis = axis / np.linalg.norm(axis)
    cross = np.cross(np.eye(3), -axis)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def symmetries(info):
    """4x4 transforms in metres."""
    result = [np.eye(4)]
    for flat in info.get("symmetries_discrete", []):
        transform = np.array(flat, float).reshape(4, 4)
        transform[:3, 3] /= 1000
        result.append(transform)
    turns = []
    for s in info.get("symmetries_continuous", []):
        for k in range(64):
            transform = np.eye(4)
            transform[:3, :3] = rotation_about(np.array(s["axis"], float), 2 * np.pi * k / 64)
            offset = np.array(s["offset"], float) / 1000
            transform[:3, 3] = offset - transform[:3, :3] @ offset
            turns.append(transform)
    return [t @ d for d in result for t in turns] if turns else result


def box_corners(info):
    low = np.array([info["min_x"], info["min_y"], info["min_z"]]) / 1000
    size = np.array([info["size_x"], info["size_y"], info["size_z"]]) / 1000
    return np.array([low + size * [i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)])


def project(camera, rotation, translation, points):
    x = points @ rotation.T + translation
    return np.stack([camera[0] * x[:, 0] / x[:, 2] + camera[2], camera[1] * x[:, 1] / x[:, 2] + camera[3]], 1)


def load_candidates(scenes, results):
    """Rows of features and labels."""
    models = json.loads((scenes / "models" / "models_info.json").read_text())
    features, labels = [], []
    for file in sorted(results.glob("*.json")):
        result = json.loads(file.read_text())
        if "detections" not in result:
            continue
        folder = Path(result["image"]).parent.parent
        truth = json.loads((folder / "scene_gt.json").read_text())[str(result["image_id"])]
        k = json.loads((folder / "scene_camera.json").read_text())[str(result["image_id"])]["cam_K"]
        camera = (k[0], k[4], k[2], k[5])
        for d in result["detections"]:
            info = models[str(d["object_id"])]
            corners = box_corners(info)
            pose = d["camera_from_object"]
            seen = project(camera, np.array(pose["R"]).reshape(3, 3), np.array(pose["t"]), corners)
            error = np.inf
            for t in truth:
                if t["obj_id"] != d["object_id"]:
                    continue
                rotation, translation = np.array(t["cam_R_m2c"]).reshape(3, 3), np.array(t["cam_t_m2c"]) / 1000
                for s in symmetries(info):
                    there = project(camera, rotation, translation, corners @ s[:3, :3].T + s[:3, 3])
                    error = min(error, np.abs(np.linalg.norm(there - seen, axis=1)).max())
            psi_z_score = d["psi_z_score"] if "psi_z_score" in d else d["evidence"]
            features.append([1, np.log(max(psi_z_score, MIN_PSI_Z_SCORE)), d["cost_px"], d["unexplained_grey"]])
            labels.append(error < RIGHT_PX)
    return np.array(features), np.array(labels, float)


def fit_logistic(x, y, ridge=5):
    """Newton's method with a little ridge on standardised features (not on the bias)."""
    mean, scale = x.mean(0), x.std(0)
    mean[0], scale[0] = 0, 1
    z = (x - mean) / scale
    w = np.zeros(x.shape[1])
    penalty = ridge * np.eye(len(w))
    penalty[0, 0] = 0
    for _ in range(50):
        p = 1 / (1 + np.exp(-z @ w))
        step = np.linalg.solve(z.T @ (z * (p * (1 - p))[:, None]) + penalty, z.T @ (y - p) - penalty @ w)
        w += step
        if np.abs(step).max() < 1e-9:
            break
    weights = w / scale
    weights[0] = w[0] - (w[1:] * mean[1:] / scale[1:]).sum()
    return weights


def fit_monotone(x, y):
    """A larger psi_z_score, closer edges and less unexplained grey must never lower the probability. The features are
    correlated, so a weight may get the wrong sign: it is set to zero, and the others are fitted again."""
    signs = np.array([0, 1, -1, -1])
    used = np.ones(4, bool)
    while True:
        w = np.zeros(4)
        w[used] = fit_logistic(x[:, used], y)
        wrong = used & (w * signs < 0)
        if not wrong.any():
            return w
        used &= ~wrong


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", metavar="FILE", help="header whose section gets the weights")
    parser.add_argument("--as", dest="function", choices=["rank", "probability"], default="probability")
    parser.add_argument("folders", nargs="+", type=Path, metavar="SCENES RESULTS")
    arguments = parser.parse_args()
    if len(arguments.folders) % 2:
        parser.error("pairs of a folder of scenes and a folder of results")
    return arguments


def main():
    arguments = parse_arguments()
    folders = arguments.folders
    sets = [load_candidates(scenes, results) for scenes, results in zip(folders[::2], folders[1::2])]
    x, y = (np.concatenate(part) for part in zip(*sets))
    w = fit_monotone(x, y)
    p = 1 / (1 + np.exp(-x @ w))
    print(f"{len(y)} candidates, {int(y.sum())} right")
    print(f"log loss {-np.mean(np.where(y > 0, np.log(p), np.log(1 - p))):.3f}")
    print("bias %.3f  log psi_z_score %.3f  mean_px %.4f  unexplained grey %.3f" % tuple(w))
    print("predicted    candidates  right")
    for low in np.arange(0, 1, 0.1):
        inside = (p >= low) & (p < low + 0.1 + 1e-9)
        if inside.any():
            print(f"{low:.1f} .. {low + 0.1:.1f}   {inside.sum():10d}  {y[inside].mean():.2f}")
    if arguments.write:
        weights = dict(zip(["bias", "log_psi_z_score", "mean_px", "unexplained_grey"], w))
        data = f"{len(y)} candidates, {int(y.sum())} right, in " + ", ".join(f.name for f in folders[::2]) + "."
        write_weights(arguments.write, f"{arguments.function.upper()}_ONE_VIEW", "OneView", weights, data)


if __name__ == "__main__":
    main()
