"""Depth from Python gives what the program gives with --depth."""

import json
import subprocess

import numpy as np
import pytest

import edgescout


@pytest.fixture(scope="module")
def depth_mm():
    """A plane through the part, tilted, with a hole."""
    rows, columns = np.mgrid[0:480, 0:640]
    values = (328 + rows // 16).astype(np.uint16)
    values[100:140, 100:200] = 0
    return values


def test_equals_the_program(scene, depth_mm, program, tmp_path):
    depth_m = (depth_mm / 1000).astype(np.float32)
    file = tmp_path / "depth.pfm"  # its rows begin below
    file.write_bytes(b"Pf\n640 480\n-1.0\n" + depth_m[::-1].astype("<f4").tobytes())
    subprocess.run(
        [program, "detect", scene.file, "--depth", file, "--depth-noise", "0.002", "--model",
         scene.part, "--unit", "mm", *scene.arguments, "--camera",
         scene.file.parents[1] / "scene_camera.json", "--device", "cpu", "--no-overlays",
         "--min-probability", "0.001", "--out",
         tmp_path / "out"], check=True, capture_output=True)
    (result,) = [json.loads(file.read_text()) for file in (tmp_path / "out").rglob("*.json")
                 if "edgescout_result" in file.read_text()]
    found = scene.detect(scene.image, min_probability=0.001,  # the plane contradicts most poses
                         depth=depth_m, depth_options=edgescout.DepthOptions(depth_noise=0.002))
    assert len(found) > 0
    assert [d.probability for d in found] == [d["probability"] for d in result["detections"]]
    for detection, of_program in zip(found, result["detections"]):
        pose = of_program["camera_from_object"]
        np.testing.assert_array_equal(detection.world_from_object[:3, 3], pose["t"])
        np.testing.assert_allclose(detection.world_from_object[:3, :3].ravel(), pose["R"], rtol=0,
                                   atol=1e-14)  # files hold matrices, the library quaternions


@pytest.mark.parametrize("dtype", [np.uint16, np.float32])
def test_without_any_value_is_no_depth(scene, found, dtype):
    other = scene.detect(scene.image, depth=np.zeros((480, 640), dtype))
    assert len(other) == len(found)
    np.testing.assert_array_equal(other[0].world_from_object, found[0].world_from_object)
    assert other[0].probability == found[0].probability


def test_a_wall_before_the_part_hides_it(scene):
    """In metres, in half millimetres, and of strided values: the unit is right."""
    wall = np.full((480, 640), 200, np.uint16)
    half_mm = edgescout.DepthOptions(depth_unit=0.0005)
    for depth, options in ((wall, None), (2 * wall, half_mm), (wall[:, ::-1], None),
                           ((wall / 1000).astype(np.float32), None)):
        assert len(scene.detect(scene.image, depth=depth, depth_options=options)) == 0


@pytest.mark.parametrize("depth, message", [
    (np.ones((480, 640)), "depth: found float64 of shape (480, 640)"),
    (np.ones((480, 640, 1), np.uint16), "depth: found uint16 of shape (480, 640, 1)"),
    (np.full((240, 320), 400, np.uint16), "320x240, expected the camera's 640x480"),
    (np.full((480, 640), 400, np.float32), "which are 400 m"),
])
def test_refuses_what_is_no_depth(scene, depth, message):
    with pytest.raises(ValueError) as error:
        scene.detect(scene.image, depth=depth)
    assert message in str(error.value)


def test_jointly_needs_one_an_image(scene):
    with pytest.raises(ValueError, match="found 1 depth images, expected one or None an image"):
        edgescout.detect_jointly([scene.image] * 2, scene.camera, [np.eye(4)] * 2, scene.templates,
                                 depth=[None])


def test_registration_uses_it(scene, found):
    """A surface measured before the part's origin moves the pose."""
    pose = found[0].world_from_object
    nearer = np.full((480, 640), pose[2, 3] - 0.011, np.float32)
    plain, drawn = (edgescout.register(scene.image, scene.camera, scene.templates, [pose],
                                       depth=depth, backend=scene.backend)[0]
                    for depth in (None, nearer))
    assert drawn.world_from_object[2, 3] != plain.world_from_object[2, 3]
