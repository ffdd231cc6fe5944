"""Registration of given poses."""

import numpy as np
import pytest

import edgescout


def moved(pose, angle_rad, shift_m):
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(angle_rad), -np.sin(angle_rad)], [np.sin(angle_rad), np.cos(angle_rad)]]
    other = pose @ turn
    other[:3, 3] += shift_m
    return other


def test_brings_a_rough_pose_to_the_detected_one(scene, found):
    pose = found[0].world_from_object
    behind = pose.copy()
    behind[2, 3] *= -1
    starts = [moved(pose, 0.1, [0.003, -0.002, 0.004]), behind]
    near, unseen = edgescout.register(scene.image, scene.camera, scene.templates, starts,
                                      backend=scene.backend)
    assert np.linalg.norm(near.world_from_object[:3, 3] - pose[:3, 3]) < 0.001
    assert near.probability > 0.5
    assert unseen.probability == 0 and unseen.convergence == "out of sight"


def test_over_two_views_gives_poses_in_the_world(scene, found):
    camera_from_world = moved(np.eye(4), 0.3, [0.1, 0.2, 0.3])
    pose = np.linalg.inv(camera_from_world) @ found[0].world_from_object
    (refined,) = edgescout.register_jointly(
        [scene.image] * 2, scene.camera, [camera_from_world] * 2, scene.templates,
        [moved(pose, 0.05, 0.002)], backend=scene.backend)
    assert np.linalg.norm(refined.world_from_object[:3, 3] - pose[:3, 3]) < 0.002


@pytest.mark.parametrize("poses, objects, message", [
    (np.eye(4), None, "shape (4, 4), expected shape (n, 4, 4)"),
    ([np.eye(3)], None, "(1, 3, 3)"),
    ([np.eye(4)] * 2, [0], "objects: found 1"),
    ([np.eye(4)], [1], "objects: found 1, expected one of 1 templates"),
    ([np.zeros((4, 4))], None, "camera_from_object[0]: found another last row"),
])
def test_refuses_what_are_no_starts(scene, poses, objects, message):
    with pytest.raises(ValueError) as error:
        edgescout.register(scene.image, scene.camera, scene.templates, poses, objects)
    assert message in str(error.value)
