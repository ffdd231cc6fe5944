"""The tracker, on the example image moved by whole pixels."""

import threading

import numpy as np
import pytest

import edgescout
from edgescout import TrackState


def moved(image, pixels):
    return np.roll(image, pixels, axis=1)


def place_px(camera, track):
    x, y, z = track.camera_from_object[:3, 3]
    return camera.K[0, 0] * x / z + camera.K[0, 2]


@pytest.fixture
def tracker(scene):
    return edgescout.Tracker(scene.templates, scene.camera, backend=scene.backend)


def test_follows_an_object_that_moves(scene, found, tracker):
    best = found[0]
    assert tracker.add(best.world_from_object) == 1
    first = None
    for frame in range(6):
        track, = tracker.update(moved(scene.image, 5 * frame), 0.1 * frame)
        assert track.state == TrackState.TRACKED, track
        assert track.above_chance > 0.5
        assert track.covariance.shape == (6, 6)
        first = first or place_px(scene.camera, track)
        assert place_px(scene.camera, track) - first == pytest.approx(5 * frame, abs=1)
    assert [t.id for t in tracker.tracks] == [1]
    assert tracker.tracks[0].object_id == scene.templates.object_id
    assert tracker.overlay(scene.image).shape == (*scene.image.shape, 3)


def test_searches_in_another_thread(scene, found, tracker):
    results = []
    backend = edgescout.Backend("cpu", threads=1)
    thread = threading.Thread(
        target=lambda: results.append(tracker.search(scene.image, backend=backend)))
    thread.start()
    time_s = 0.0
    while thread.is_alive():
        time_s += 1
        tracker.update(scene.image, time_s)
    thread.join()
    assert results == [1]
    track, = tracker.update(scene.image, time_s + 1)
    assert track.state == TrackState.TRACKED
    offset = np.linalg.inv(track.camera_from_object) @ found[0].world_from_object
    assert np.linalg.norm(offset[:3, 3]) < 0.005


def test_refuses_what_is_no_next_image(scene, found, tracker):
    tracker.add(found[0].world_from_object)
    tracker.update(scene.image, 1)
    with pytest.raises(edgescout.InputError, match="later than the last frame"):
        tracker.update(scene.image, 1)
    with pytest.raises(ValueError, match="image: found 100x80 px"):
        tracker.update(np.zeros((80, 100), np.uint8), 2)
    with pytest.raises(ValueError, match="object: found 3, expected one of 1"):
        tracker.add(np.eye(4), object=3)
    with pytest.raises(edgescout.LogicError, match="no such id"):
        tracker.remove(7)
    with pytest.raises(ValueError, match="another one"):
        tracker.search(scene.image, backend=scene.backend)


def test_a_pose_that_depth_contradicts_is_doubtful(scene, found):
    """The sensor saw a wall behind the part; without any value there is no difference."""
    pose = found[0].world_from_object

    def followed(depth):
        tracker = edgescout.Tracker(scene.templates, scene.camera, backend=scene.backend)
        tracker.add(pose)
        for frame in range(3):
            track, = tracker.update(scene.image, frame, depth=depth)
        return track

    plain = followed(None)
    empty = followed(np.zeros(scene.image.shape, np.uint16))
    np.testing.assert_array_equal(empty.camera_from_object, plain.camera_from_object)
    np.testing.assert_array_equal(empty.covariance, plain.covariance)
    wall = followed(np.full(scene.image.shape, pose[2, 3] + 0.05, np.float32))
    assert plain.state == edgescout.TrackState.TRACKED
    assert wall.state == edgescout.TrackState.DOUBTFUL


def test_a_limit_of_time_ends_the_registration_of_doubtful_objects(scene, found):
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]]

    def followed(options=None, **limit):
        tracker = edgescout.Tracker(scene.templates, scene.camera, options, backend=scene.backend)
        tracker.add(found[0].world_from_object @ turn)
        track, = tracker.update(scene.image, 0, **limit)
        return track

    plain = followed(edgescout.TrackOptions(no_register=True))
    limited = followed(max_seconds=0)
    assert followed(max_seconds=60).state == TrackState.TRACKED
    assert plain.state == limited.state == TrackState.DOUBTFUL
    np.testing.assert_array_equal(limited.camera_from_object, plain.camera_from_object)
    with pytest.raises(ValueError, match="max_seconds: found -1"):
        followed(max_seconds=-1)


def test_refuses_depth_of_another_size(scene, tracker):
    with pytest.raises(ValueError, match="320x240, expected the camera's 640x480"):
        tracker.update(scene.image, 0, depth=np.full((240, 320), 400, np.uint16))
    with pytest.raises(ValueError, match="320x240, expected the camera's 640x480"):
        tracker.search(scene.image, depth=np.full((240, 320), 400, np.uint16))


def test_a_mesh_alone_is_followed_but_not_searched_for(scene, found):
    alone = edgescout.Templates.without_views(edgescout.load_mesh(scene.part, "mm"))
    tracker = edgescout.Tracker(alone, scene.camera, backend=scene.backend)
    tracker.add(found[0].world_from_object)
    track, = tracker.update(scene.image, 0)
    assert track.state == TrackState.TRACKED
    tracker.remove(track.id)
    with pytest.raises(edgescout.LogicError, match="without templates"):
        tracker.search(scene.image)


def test_options_have_the_names_of_the_command_line(scene):
    options = edgescout.TrackOptions(search_px=12, instances=2)
    assert (options.search_px, options.instances) == (12, 2)
    with pytest.raises(edgescout.InputError, match="search_px"):
        edgescout.TrackOptions(search_px=1000)
