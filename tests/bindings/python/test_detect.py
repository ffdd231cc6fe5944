"""Detection from Python gives what the program gives."""

import json
import subprocess
import threading

import numpy as np
import pytest

import edgescout


def test_equals_the_program_bit_for_bit(scene, found, program, tmp_path):
    subprocess.run(
        [program, "detect", scene.file, "--model", scene.part, "--unit", "mm",
         *scene.arguments, "--camera", scene.file.parents[1] / "scene_camera.json",
         "--device", "cpu", "--no-overlays", "--out", tmp_path], check=True, capture_output=True)
    (result,) = [json.loads(file.read_text()) for file in tmp_path.rglob("*.json")
                 if "edgescout_result" in file.read_text()]
    assert len(result["detections"]) == len(found) == 1
    of_program, detection = result["detections"][0], found[0]
    pose = of_program["camera_from_object"]
    np.testing.assert_array_equal(detection.world_from_object[:3, 3], pose["t"])
    # The program's is camera_from_world * world_from_object, whose quaternion is normalized anew.
    np.testing.assert_allclose(detection.world_from_object[:3, :3].ravel(), pose["R"], 0, 2e-15)
    np.testing.assert_array_equal(detection.covariance.ravel(), of_program["covariance"])
    for name in ("probability", "psi", "psi_z_score", "cost_px", "unexplained_grey"):
        assert getattr(detection, name) == of_program[name], name
    assert detection.name == "obj_000001" and detection.object_id == 1


def test_takes_arrays_of_any_layout(scene, found):
    rgba = np.dstack([scene.image] * 3 + [np.zeros_like(scene.image)])
    strided = np.repeat(scene.image, 2, axis=1)[:, ::2]
    assert not strided.flags.c_contiguous
    read_only = scene.image.copy()
    read_only.flags.writeable = False
    for image in (rgba, strided, np.asfortranarray(scene.image), read_only):
        other = scene.detect(image)
        np.testing.assert_array_equal(other[0].world_from_object, found[0].world_from_object)


@pytest.mark.parametrize("image, message", [
    (np.zeros((480, 640)), "float64 of shape (480, 640)"),
    (np.zeros(640, np.uint8), "(640,)"),
    (np.zeros((480, 640, 5), np.uint8), "(480, 640, 5)"),
    (np.zeros((240, 640), np.uint8), "640x240 px, expected the camera's 640x480"),
    (np.zeros((0, 0), np.uint8), "expected pixels"),
    (np.zeros((8, 8), np.uint8), "found 8x8, expected at least 16x16 px"),
    (np.broadcast_to(np.uint8(0), (2**17, 2**17)), "at most 2^28 pixels"),
    (None, "image: found NoneType, expected an array of numbers"),
    ([[1, 2], [3]], "image: found list, expected an array of numbers"),
    ([[0] * 640] * 480, "image: found int64 of shape (480, 640)"),
])
def test_refuses_what_is_no_image(scene, image, message):
    with pytest.raises(ValueError) as error:
        scene.detect(image)
    assert message in str(error.value)


def test_ends_at_the_deadline(scene):
    cut = scene.detect(scene.image, max_seconds=0)
    assert not cut.is_complete and len(cut) == 0


@pytest.mark.parametrize("seconds", [1e10, 1e300, float("inf")])
def test_does_not_end_before_a_long_time(scene, found, seconds):
    other = scene.detect(scene.image, max_seconds=seconds)
    assert other.is_complete and len(other) == len(found)


@pytest.mark.parametrize("seconds", [-1, float("nan"), -float("inf")])
def test_refuses_what_is_no_time(scene, seconds):
    with pytest.raises(ValueError, match="max_seconds: found .*, expected 0 or more"):
        scene.detect(scene.image, max_seconds=seconds)


def test_other_threads_run_meanwhile(scene):
    """The interpreter's lock is released: another thread counts while detection works."""
    counted, done = 0, threading.Event()

    def work():
        edgescout.detect(scene.image, scene.camera, scene.templates, backend=scene.backend)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.wait(0.01):
        counted += 1
    thread.join()
    assert counted > 10


@pytest.mark.parametrize("templates, message", [
    (None, "templates: found NoneType, expected Templates or a sequence of them"),
    ("part", "templates: found str in them"),
    ([3], "templates: found int in them"),
    ([], "templates: found none, expected at least one"),
])
def test_refuses_what_are_no_templates(scene, templates, message):
    with pytest.raises(ValueError) as error:
        edgescout.detect(scene.image, scene.camera, templates)
    assert message in str(error.value)


def test_jointly_takes_a_camera_an_image(scene, found):
    """The second camera has half the size: its image is the first one, resized."""
    half = scene.camera.scaled(0.5)
    small = scene.image.reshape(240, 2, 320, 2).mean((1, 3)).round().astype(np.uint8)
    poses = [np.eye(4)] * 2
    options = edgescout.DetectOptions(coarse_poses_joint=600, medium_poses_joint=100, candidates=20)
    both = edgescout.detect_jointly([scene.image, small], [scene.camera, half], poses,
                                    scene.templates, options, backend=scene.backend)
    expected = found[0].world_from_object
    assert np.linalg.norm(both[0].world_from_object[:3, 3] - expected[:3, 3]) < 0.003
    (refined,) = edgescout.register_jointly([scene.image, small], (scene.camera, half), poses,
                                            scene.templates, [expected], backend=scene.backend)
    assert np.linalg.norm(refined.world_from_object[:3, 3] - expected[:3, 3]) < 0.003
    for cameras, message in (([scene.camera], "camera: found 1 cameras, expected one for all or"),
                             ([half, None], "camera: found NoneType in them"),
                             (None, "camera: found NoneType")):
        with pytest.raises(ValueError, match=message):
            edgescout.detect_jointly([scene.image] * 2, cameras, poses, scene.templates)


def test_jointly_needs_a_pose_an_image(scene):
    with pytest.raises(ValueError, match="found 1 poses, expected one an image of 2"):
        edgescout.detect_jointly([scene.image] * 2, scene.camera, [np.eye(4)], scene.templates)
    bent = np.eye(4)
    bent[0, 0] = 2
    with pytest.raises(ValueError, match=r"camera_from_world\[1\]"):
        edgescout.detect_jointly([scene.image] * 2, scene.camera, [np.eye(4), bent],
                                 scene.templates)


def test_jointly_gives_poses_in_the_world(scene, found):
    """Twice the same image from one place: the pose of the single image, moved to the world."""
    camera_from_world = np.eye(4)
    camera_from_world[:3, 3] = 0.1, 0.2, 0.3
    options = edgescout.DetectOptions(coarse_poses_joint=600, medium_poses_joint=100, candidates=20)
    both = edgescout.detect_jointly([scene.image] * 2, scene.camera, [camera_from_world] * 2,
                                    scene.templates, options, backend=scene.backend)
    in_camera = camera_from_world @ both[0].world_from_object
    assert np.linalg.norm(in_camera[:3, 3] - found[0].world_from_object[:3, 3]) < 0.002


def test_overlay_is_a_picture_of_the_image(scene, found):
    picture = edgescout.overlay(scene.image, scene.camera, list(found), scene.templates,
                                backend=scene.backend)
    assert picture.shape == (480, 640, 3) and picture.dtype == np.uint8
    red, green, blue = (picture[..., i].astype(int) for i in range(3))
    assert (green - np.maximum(red, blue) > 80).sum() > 100
