"""Meshes, cameras, templates and images."""

import numpy as np
import pytest

import edgescout


def test_mesh_from_arrays_equals_the_file(scene):
    loaded = edgescout.load_mesh(scene.part, "mm")
    made = edgescout.Mesh(loaded.vertices_m, loaded.triangles, "made")
    np.testing.assert_array_equal(made.vertices_m, loaded.vertices_m)
    np.testing.assert_array_equal(made.triangles, loaded.triangles)
    assert made.diameter_m == loaded.diameter_m


@pytest.mark.parametrize("vertices, triangles, message", [
    (np.zeros((4, 2)), [[0, 1, 2]], "vertices_m: found float64 of shape (4, 2)"),
    (np.eye(3), [[0, 1, 7]], "found vertex index 7"),
    (np.eye(3), [[0, 1, 2**40]], "an index of a vertex"),
    (np.eye(3), [[0.5, 1, 2]], "triangles: found 0.5, expected an index of a vertex"),
    (np.eye(3), [[np.nan, 1, 2]], "triangles: found nan"),
    (["a"], [[0, 1, 2]], "vertices_m"),
    (np.full((3, 3), np.nan), [[0, 1, 2]], "finite"),
])
def test_refuses_what_is_no_mesh(vertices, triangles, message):
    with pytest.raises(ValueError) as error:
        edgescout.Mesh(vertices, triangles)
    assert message in str(error.value)


def test_missing_files_are_named():
    with pytest.raises(edgescout.InputError, match="no_such.stl"):
        edgescout.load_mesh("no_such.stl", "mm")
    with pytest.raises(edgescout.InputError, match='found "feet"'):
        edgescout.load_mesh("no_such.stl", "feet")


def test_templates_need_distances_or_a_camera(scene):
    mesh = edgescout.load_mesh(scene.part, "mm")
    with pytest.raises(ValueError, match="distance_min, distance_max"):
        edgescout.Templates(mesh)


def test_templates_are_saved_whole(scene, tmp_path):
    scene.templates.save(tmp_path / "part.templates")
    loaded = edgescout.Templates.load(tmp_path / "part.templates")
    assert loaded.options == scene.templates.options
    assert repr(loaded) == repr(scene.templates)


def test_symmetries_are_words_or_matrices(scene):
    mesh = edgescout.load_mesh(scene.part, "mm")
    half_turn = np.diag([-1.0, -1.0, 1.0, 1.0])
    options = edgescout.TemplateOptions(distance_min=0.3, distance_max=0.3, viewpoints=1)
    for given, count in (("z2", 2), ([half_turn], 2), ([np.eye(4), half_turn], 2), (None, 1)):
        made = edgescout.Templates(mesh, options, symmetries=given, backend=scene.backend)
        assert made.symmetries.shape == (count, 4, 4)
        np.testing.assert_allclose(made.symmetries[0], np.eye(4))
    with pytest.raises(ValueError, match="q9"):
        edgescout.Templates(mesh, options, symmetries="q9", backend=scene.backend)


def test_images_are_written_and_read(tmp_path):
    image = np.random.default_rng(1).integers(0, 256, (40, 60), np.uint8)
    edgescout.save_png(image[:, ::-1], tmp_path / "image.png")
    np.testing.assert_array_equal(edgescout.load_image(tmp_path / "image.png"), image[:, ::-1])


def test_camera_is_what_was_given():
    matrix = np.array([[700.0, 0, 320], [0, 710, 240], [0, 0, 1]])
    camera = edgescout.Camera(640, 480, matrix, [0.1, 0.01])
    np.testing.assert_array_equal(camera.K, matrix)
    np.testing.assert_array_equal(camera.distortion[:3], [0.1, 0.01, 0])
    with pytest.raises(ValueError):
        edgescout.Camera(640, 480, np.zeros((3, 3)))
    with pytest.raises(ValueError, match="at most 14"):
        edgescout.Camera(640, 480, matrix, [0.0] * 15)
    of_opencv = edgescout.Camera(640, 480, matrix, np.array([[0.1, 0.01, 0, 0, 0]]))
    assert of_opencv == camera == edgescout.Camera(640, 480, matrix, camera.distortion)


def test_camera_keeps_skew():
    matrix = np.array([[700.0, 5, 320], [0, 710, 240], [0, 0, 1]])
    camera = edgescout.Camera(640, 480, matrix)
    np.testing.assert_array_equal(camera.K, matrix)
    np.testing.assert_array_equal(edgescout.Camera(640, 480, camera.K).K, matrix)
    assert camera != edgescout.Camera(640, 480, matrix * (matrix != 5))


MATRIX = np.array([[700.0, 5, 320], [0, 710, 240], [0, 0, 1]])


@pytest.mark.parametrize("matrix, message", [
    (MATRIX.T, "K: found [[700.0, 0.0, 0.0], [5.0"),
    (2 * MATRIX, "expected fx skew cx, 0 fy cy, 0 0 1"),
    ("x", "K: found str, expected an array of numbers"),
    ([[1, 2], [3]], "K: found list, expected an array of numbers"),
    (object(), "K: found object, expected an array of numbers"),
    (None, "expected shape (3, 3)"),
    (np.full((3, 3), np.nan), "K: found"),
])
def test_refuses_what_is_no_matrix_of_a_camera(matrix, message):
    with pytest.raises(ValueError) as error:
        edgescout.Camera(640, 480, matrix)
    assert message in str(error.value)


@pytest.mark.parametrize("factor", [-1, 0, 1e-9, 1e300, float("nan"), float("inf")])
def test_refuses_a_scale_that_leaves_no_image(factor):
    with pytest.raises(ValueError):
        edgescout.Camera(640, 480, MATRIX).scaled(factor)


def test_a_camera_without_a_size_is_given_one(scene):
    """Of BOP, whose files have none; the lens and the skew stay."""
    camera = edgescout.load_camera(scene.file.parents[1] / "scene_camera.json")
    assert (camera.width, camera.height) == (0, 0)
    sized = camera.with_size(640, 480)
    assert sized == scene.camera == sized.with_size(640, 480)
    skewed = edgescout.Camera(640, 480, MATRIX, [0.1])
    assert skewed.with_size(640, 480) == skewed
    with pytest.raises(ValueError, match="size: found 320x240, expected the camera's 640x480"):
        sized.with_size(320, 240)
    with pytest.raises(ValueError):
        camera.with_size(-640, 480)


def test_undistort_names_both_sizes():
    camera = edgescout.Camera(640, 480, MATRIX, [0.1])
    with pytest.raises(ValueError, match="image: found 64x48 px, expected the camera's 640x480"):
        edgescout.undistort(np.zeros((48, 64), np.uint8), camera)


def test_deep_images_become_what_files_of_them_become(scene):
    """An 8-bit image times 257 is the same image of 16 bit."""
    deep = scene.image.astype(np.uint16) * 257
    np.testing.assert_array_equal(
        edgescout.to_grey(deep, edgescout.ImageOptions(image_scaling="full")), scene.image)
    assert np.abs(edgescout.to_grey(deep).astype(int) - scene.image).max() <= 1
    real = (scene.image / 255).astype(np.float32)
    np.testing.assert_array_equal(
        edgescout.to_grey(real[:, ::-1], edgescout.ImageOptions(image_scaling="full")),
        scene.image[:, ::-1])
