"""The scout, step by step, on the recorded views of the example scene."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

import edgescout


def pose_of(rotation, translation_mm):
    pose = np.eye(4)
    pose[:3, :3] = np.reshape(rotation, (3, 3))
    pose[:3, 3] = np.array(translation_mm) / 1000
    return pose


@pytest.fixture(scope="module")
def recorded(scene):
    """Two views of one static scene, with one of its parts."""
    folder = scene.file.parents[2] / "000001"
    cameras = json.loads((folder / "scene_camera.json").read_text())
    images = [edgescout.load_image(folder / f"gray/{int(key):06}.png") for key in cameras]
    poses = [pose_of(c["cam_R_w2c"], c["cam_t_w2c"]) for c in cameras.values()]
    truths = [pose_of(t["cam_R_m2c"], t["cam_t_m2c"])
              for t in json.loads((folder / "scene_gt.json").read_text())["0"]
              if t["obj_id"] == 6]
    height, width = images[0].shape
    matrix = np.reshape(cameras["0"]["cam_K"], (3, 3))
    templates = edgescout.Templates(
        edgescout.load_mesh(scene.part.with_name("obj_000006.ply"), "mm"),
        edgescout.TemplateOptions(distance_min=0.45, distance_max=0.52, viewpoints=3,
                                  in_plane_steps=12), backend=scene.backend)
    return SimpleNamespace(images=images, poses=np.array(poses), templates=templates,
                           camera=edgescout.Camera(width, height, matrix),
                           truths=[np.linalg.inv(poses[0]) @ truth for truth in truths])


def new_scout(scene, recorded, **more):
    return edgescout.Scout(recorded.templates, recorded.camera, recorded.poses,
                           edgescout.ScoutOptions(max_views=2), backend=scene.backend, **more)


def test_finds_the_part_and_goes_on_from_a_file(scene, recorded, tmp_path):
    images, poses = recorded.images, recorded.poses
    scout = new_scout(scene, recorded)
    first = scout.propose()
    assert first.view == scout.propose().view == 0
    np.testing.assert_allclose(first.camera_from_world, poses[0], atol=1e-12)
    scout.give(first.view, images[first.view])
    scout.save(tmp_path / "state")
    again = new_scout(scene, recorded)
    again.resume(tmp_path / "state")
    for each in (scout, again):
        second = each.propose()
        assert second.view != 0 and second.values_nats.shape == (len(poses),)
        assert np.isnan(second.values_nats[0]) and np.nanmax(second.values_nats) > 0
        each.give(second.view, images[second.view], poses[second.view])
        assert each.propose() is None and each.end == "view budget" and each.images == 2
    best, same = scout.detections[0], again.detections[0]
    assert best.probability > 0.9 and best.supporting_images and best.name == "obj_000006"
    errors = [np.linalg.norm(best.world_from_object[:3, 3] - truth[:3, 3])
              for truth in recorded.truths]
    assert min(errors) < 0.005
    np.testing.assert_array_equal(best.world_from_object, same.world_from_object)


def test_proposes_another_view_where_one_cannot_be_had(scene, recorded):
    images, poses = recorded.images, recorded.poses
    scout = new_scout(scene, recorded)
    scout.unreachable(scout.propose().view, "no path")
    assert scout.propose().view == 1
    with pytest.raises(edgescout.InputError, match="found 0 again"):
        scout.give(0, images[0])
    with pytest.raises(IndexError, match=f"found {len(poses)}"):
        scout.give(len(poses), images[0])
    with pytest.raises(edgescout.InputError, match="image size"):
        scout.give(1, images[1][:100])


def test_proposes_views_that_can_be_reached(scene, recorded):
    beside = recorded.poses.copy()
    beside[:, 0, 3] += 0.05
    wider = SimpleNamespace(**vars(recorded) | {"poses": np.concatenate([recorded.poses, beside])})
    allowed, asked = {1, 3}, set()

    def reachable(view):
        asked.add(view)
        return view in allowed

    by_function = new_scout(scene, wider, reachable=reachable)
    by_indices = new_scout(scene, wider, reachable=[1, 3])
    for scout in (by_function, by_indices):
        assert scout.propose().view == 1
        scout.give(1, recorded.images[1])
        proposal = scout.propose()
        assert proposal.view == 3
        assert np.isnan(proposal.values_nats).tolist() == [True, True, True, False]
    assert asked == {0, 1, 2, 3}
    np.testing.assert_array_equal(by_function.propose().values_nats,
                                  by_indices.propose().values_nats)
    assert new_scout(scene, recorded, reachable=[]).propose() is None


def test_refuses_what_says_of_no_view_whether_it_can_be_reached(scene, recorded):
    for given, message in [("all", "found str"), (3, "found int"),
                           ([99], "found view 99, expected one of")]:
        with pytest.raises(ValueError, match="reachable: " + message):
            new_scout(scene, recorded, reachable=given)

    def fails(view):
        raise ZeroDivisionError(view)

    scout = new_scout(scene, recorded, reachable=fails)
    with pytest.raises(ZeroDivisionError):
        scout.propose()
    assert scout.images == 0 and scout.end == ""


def test_finds_nothing_behind_a_measured_wall(scene, recorded):
    height, width = recorded.images[0].shape
    scout = new_scout(scene, recorded)
    with pytest.raises(ValueError, match="found 10x20, expected the camera's"):
        scout.give(0, recorded.images[0], depth=np.full((20, 10), 0.1, np.float32))
    scout.give(0, recorded.images[0], depth=np.full((height, width), 100, np.uint16))
    assert scout.images == 1 and not scout.detections


def test_views_look_at_their_centre():
    views = edgescout.hemisphere_views([0.1, 0.2, 0.3], 0.5, 8)
    assert views.shape == (8, 4, 4)
    for view in views:
        np.testing.assert_allclose((view @ [0.1, 0.2, 0.3, 1])[:3], [0, 0, 0.5], atol=1e-9)
    np.testing.assert_allclose(edgescout.look_at([0, 0, 1], [0, 0, 0]) @ [0, 0, 0, 1],
                               [0, 0, 1, 1], atol=1e-9)
