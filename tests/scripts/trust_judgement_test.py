"""bench/trust/matching.py and reliability.py on cases done by hand."""
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "trust"))
try:
    import numpy as np

    import judge
    from matching import Estimate, Pose, Truth, error_of_bounds, load_symmetries, match
except ImportError as missing:
    print(f"skipped: {missing} (scripts/setup.sh --dev)")
    sys.exit(77)
from reliability import certain, equal_bins, wilson_interval

NO_SYMMETRY = np.eye(3)[None], np.zeros((1, 3))


def about_z(angle_rad):
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def pose(angle_rad=0.0, x_mm=0.0):
    return Pose(about_z(angle_rad), np.array([x_mm, 0, 500]))


class Matching(unittest.TestCase):
    def test_error_is_the_larger_share_of_its_bound(self):
        self.assertAlmostEqual(error_of_bounds(pose(0.05), pose(), NO_SYMMETRY), 0.5)
        self.assertAlmostEqual(error_of_bounds(pose(0.05, 4), pose(), NO_SYMMETRY), 0.8)
        self.assertAlmostEqual(error_of_bounds(pose(-0.2, 4), pose(), NO_SYMMETRY), 2.0)

    def test_half_turn_beside_the_origin(self):
        # A half turn about z through x = 10 mm: x -> 20 mm - x.
        half_turn = [-1, 0, 0, 20, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        symmetries = self.symmetries({"symmetries_discrete": [half_turn]})
        self.assertAlmostEqual(error_of_bounds(pose(math.pi, 20), pose(), symmetries), 0.0)
        self.assertAlmostEqual(error_of_bounds(pose(math.pi, 23), pose(), symmetries), 0.6)
        self.assertGreater(error_of_bounds(pose(math.pi, 0), pose(), symmetries), 1)

    def test_axis_with_a_flip(self):
        flip = [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1]
        symmetries = self.symmetries({
            "symmetries_discrete": [flip],
            "symmetries_continuous": [{"axis": [0, 0, 2], "offset": [0, 0, 0]}]})
        self.assertEqual(len(symmetries[0]), 2 * 315)
        flipped = Pose(about_z(1.3) @ np.diag([1, -1, -1]), np.array([0, 0, 500.0]))
        self.assertLess(error_of_bounds(flipped, pose(), symmetries), 0.11)

    def symmetries(self, info):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "models_info.json"
            file.write_text(json.dumps({"7": info}))
            return load_symmetries(file, 7)

    def test_most_probable_takes_first_and_a_second_is_wrong(self):
        truths = [Truth(pose(), 0.9), Truth(pose(x_mm=8), 0.5)]
        estimates = [Estimate(pose(x_mm=1), 0.3), Estimate(pose(x_mm=3.5), 0.8),
                     Estimate(pose(x_mm=2), 0.2)]
        match(estimates, truths, NO_SYMMETRY)
        self.assertEqual([e.right for e in estimates], [False, True, False])
        self.assertEqual(truths[0].found, 0.8)
        self.assertTrue(math.isnan(truths[1].found))

    def test_takes_the_truth_that_fits_best(self):
        truths = [Truth(pose(), 0.9), Truth(pose(x_mm=6), 0.9)]
        match([Estimate(pose(x_mm=4), 0.6)], truths, NO_SYMMETRY)
        self.assertEqual(truths[1].found, 0.6)

    def test_no_truth(self):
        estimate = Estimate(pose(), 0.9)
        match([estimate], [], NO_SYMMETRY)
        self.assertFalse(estimate.right)


class Judge(unittest.TestCase):
    def test_counts_of_a_part(self):
        identity = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        with tempfile.TemporaryDirectory() as folder:
            dataset = Path(folder) / "plate"
            (dataset / "models").mkdir(parents=True)
            (dataset / "000003").mkdir()
            (dataset / "models/models_info.json").write_text('{"1": {}}')
            places = [0, 100, 200, 300]
            (dataset / "000003/scene_gt.json").write_text(json.dumps({"0": [
                {"obj_id": 1, "cam_R_m2c": identity, "cam_t_m2c": [x, 0, 500]} for x in places]}))
            (dataset / "000003/scene_gt_info.json").write_text(json.dumps({"0": [
                {"visib_fract": v} for v in (0.9, 0.8, 0.5, 0.1)]}))
            lines = ["scene_id,im_id,obj_id,score,R,t,time"]
            for x, score in ((1, 0.9), (101, 0.03), (202, 0.6), (303, 0.7), (150, 0.4), (1, 0.02)):
                rotation = " ".join(map(str, identity))
                lines.append(f"3,0,1,{score},{rotation},{x} 0 500,1")
            results = Path(folder) / "results.csv"
            results.write_text("\n".join(lines) + "\n")
            row, poses = judge.judge_part(dataset, results, 0.05)
        self.assertEqual((row.images, row.clear, row.clear_found), (1, 2, 1))
        self.assertEqual((row.hidden, row.hidden_found, row.false), (1, 1, 1))
        self.assertEqual(sorted(p[2] for p in poses if p[3]), [0.03, 0.6, 0.7, 0.9])


class Reliability(unittest.TestCase):
    def test_bins_of_equal_count(self):
        poses = [(0.1, False), (0.3, True), (0.9, True), (0.7, False), (0.005, True)]
        low, high = equal_bins(poses, 2)
        self.assertEqual((low.count, high.count), (2, 2))
        self.assertAlmostEqual(low.mean, 0.2)
        self.assertAlmostEqual(low.gap, 0.3)
        self.assertAlmostEqual(high.mean, 0.8)
        self.assertAlmostEqual(high.right, 0.5)

    def test_counts_differ_by_one(self):
        bins = equal_bins([(0.5, True)] * 23, 10)
        self.assertEqual(sum(b.count for b in bins), 23)
        self.assertEqual({b.count for b in bins}, {2, 3})
        self.assertEqual(len(equal_bins([(0.5, True)] * 3, 10)), 3)
        self.assertEqual(equal_bins([], 10), [])

    def test_wilson(self):
        # z = 2: (hits + 2 -+ 2 sqrt(hits (n - hits) / n + 1)) / (n + 4).
        low, high = wilson_interval(5, 10, z=2)
        half = 2 * math.sqrt(2.5 + 1) / 14
        self.assertAlmostEqual(low, 0.5 - half)
        self.assertAlmostEqual(high, 0.5 + half)
        self.assertEqual(wilson_interval(0, 10, z=2)[0], 0)
        self.assertAlmostEqual(wilson_interval(0, 10, z=2)[1], 4 / 14)
        self.assertEqual(wilson_interval(0, 0), (0, 1))

    def test_certain(self):
        poses = [(0.99, False), (0.995, True), (1.0, False), (0.5, False)]
        self.assertEqual(certain(poses), (2, 1))


if __name__ == "__main__":
    unittest.main()
