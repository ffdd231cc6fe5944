"""bench/trust/symmetry.py on solids whose symmetries are known."""
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "trust"))
try:
    import numpy as np

    from matching import Pose, error_of_bounds, load_symmetries
    from symmetry import as_models_info, diameter, find_symmetries, turn
except ImportError as missing:
    print(f"skipped: {missing} (scripts/setup.sh --dev)")
    sys.exit(77)


def prism(corners, height, top_scale=1.0):
    """A polygon [n, 2] extruded along z, or a frustum."""
    corners = np.asarray(corners, float)
    n = len(corners)
    bottom = np.c_[corners, np.zeros(n)]
    top = np.c_[top_scale * corners, np.full(n, height)]
    middles = [[*corners.mean(0), 0], [*(top_scale * corners.mean(0)), height]]
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, n + i), (j, n + j, n + i), (2 * n, j, i), (2 * n + 1, n + i, n + j)]
    return np.vstack([bottom, top, middles]), np.array(triangles)


def polygon(n, radius=1.0):
    angles = 2 * math.pi * np.arange(n) / n
    return radius * np.stack([np.cos(angles), np.sin(angles)], 1)


RECTANGLE = [(-1, -0.6), (1, -0.6), (1, 0.6), (-1, 0.6)]
# No symmetry of its outline, so only a half turn about an axis in its plane could be one.
WEDGE = [(0, 0), (2, 0), (2, 0.5), (0.4, 1.3)]


def tilted(mesh):
    """Away from the origin and from the axes, so that nothing is found by chance."""
    vertices, triangles = mesh
    return vertices @ turn(np.array([1.0, 2, 3]), 0.7).T + [5, -6, 7], triangles


class Symmetry(unittest.TestCase):
    def count(self, mesh):
        """The number of rotations of a solid that is none of revolution."""
        found = find_symmetries(*tilted(mesh))
        self.assertIsNone(found.axis)
        return 1 + len(found.rotations)

    def test_box_has_three_half_turns(self):
        self.assertEqual(self.count(prism(RECTANGLE, 0.5)), 4)

    def test_hexagonal_prism_has_twelve_rotations(self):
        self.assertEqual(self.count(prism(polygon(6), 0.3)), 12)

    def test_pyramid_has_no_flip(self):
        self.assertEqual(self.count(prism(polygon(5), 1.0, top_scale=0.2)), 5)

    def test_cube_has_all_moments_equal(self):
        self.assertEqual(self.count(prism(polygon(4), math.sqrt(2))), 24)

    def test_cylinder_and_cone(self):
        for top_scale, flips in ((1.0, 1), (0.3, 0)):
            found = find_symmetries(*tilted(prism(polygon(64), 3.0, top_scale)))
            self.assertEqual(len(found.rotations), flips)
            self.assertGreater(abs(found.axis @ turn(np.array([1.0, 2, 3]), 0.7)[:, 2]), 0.99999)

    def test_none(self):
        self.assertEqual(self.count(prism(WEDGE, 0.7, top_scale=0.8)), 1)

    def test_mirror_image_is_no_rotation(self):
        self.assertEqual(self.count(prism(WEDGE, 0.7)), 1)

    def test_models_info_maps_the_mesh_onto_itself(self):
        vertices, triangles = tilted(prism(RECTANGLE, 0.5))
        info = as_models_info(find_symmetries(vertices, triangles))
        self.assertEqual(len(info["symmetries_discrete"]), 3)
        for numbers in info["symmetries_discrete"]:
            matrix = np.reshape(numbers, (4, 4))
            moved = vertices @ matrix[:3, :3].T + matrix[:3, 3]
            nearest = np.linalg.norm(moved[:8, None] - vertices[None], axis=2).min(1)
            self.assertLess(nearest.max(), 0.01)

    def test_matching_turns_about_the_axis_that_was_found(self):
        vertices, triangles = tilted(prism(polygon(64), 3.0))
        found = find_symmetries(vertices, triangles)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "models_info.json"
            file.write_text(json.dumps({"1": as_models_info(found)}))
            symmetries = load_symmetries(file, 1)
        axis = turn(np.array([1.0, 2, 3]), 0.7)[:, 2]
        rotation = turn(axis, 1.234)
        center = vertices.mean(0)
        estimate = Pose(rotation, center - rotation @ center)
        self.assertLess(error_of_bounds(estimate, Pose(np.eye(3), np.zeros(3)), symmetries), 0.2)

    def test_diameter(self):
        self.assertAlmostEqual(diameter(prism(RECTANGLE, 0.5)[0]), math.sqrt(4 + 1.44 + 0.25))


if __name__ == "__main__":
    unittest.main()
