"""Ctrl-C ends long calls that run in the main thread."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import edgescout


def test_ctrl_c_ends_a_detection(scene):
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while time.monotonic() < start + 60:
            scene.detect(scene.image)
    again = scene.detect(scene.image)
    assert again.is_complete and len(again) == 1


def handled_during(call):
    """How many signals were handled during a call. At most one each could be before and after."""
    handled, done = [], threading.Event()
    before = signal.signal(signal.SIGUSR1, lambda *_: handled.append(time.monotonic()))

    def send():
        while not done.wait(0.02):
            os.kill(os.getpid(), signal.SIGUSR1)

    sender = threading.Thread(target=send)
    sender.start()
    try:
        handled.clear()
        call()
        count = len(handled)
    finally:
        done.set()
        sender.join()
        signal.signal(signal.SIGUSR1, before)
    return max(count - 2, 0)


@pytest.fixture(scope="module")
def calls(scene, found):
    """Every call that may take long, with much to do."""
    image, camera, templates, backend = scene.image, scene.camera, scene.templates, scene.backend
    pose = found[0].world_from_object
    poses = np.repeat(pose[None], 200, axis=0)
    views = np.repeat(np.eye(4)[None], 40, axis=0)
    views[:, 0, 3] = np.arange(40) * 0.002
    mesh = edgescout.load_mesh(scene.part, "mm")
    many = edgescout.TemplateOptions(distance_min=0.3, distance_max=0.4, viewpoints=16)
    scout = edgescout.Scout(templates, camera, views, edgescout.ScoutOptions(max_views=3),
                            backend=backend)
    tracker = edgescout.Tracker(templates, camera, backend=backend)
    for _ in range(20):
        tracker.add(pose @ np.array([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))
    searcher = edgescout.Tracker(templates, camera, backend=backend)
    one = edgescout.Backend("cpu", threads=1)
    return {
        "Templates": lambda: edgescout.Templates(mesh, many, backend=backend, cached=False),
        "detect": lambda: edgescout.detect(image, camera, templates, backend=backend),
        "detect_jointly": lambda: edgescout.detect_jointly([image], camera, views[:1], templates,
                                                           backend=backend),
        "register": lambda: edgescout.register(image, camera, templates, poses, backend=backend),
        "register_jointly": lambda: edgescout.register_jointly([image], camera, views[:1],
                                                               templates, poses, backend=backend),
        "Scout.give": lambda: scout.give(0, image),
        "Scout.propose": scout.propose,
        "Tracker.update": lambda: tracker.update(image, 1.0),
        "Tracker.search": lambda: searcher.search(image, backend=one),
    }


@pytest.mark.parametrize("name", ["Templates", "detect", "detect_jointly", "register",
                                  "register_jointly", "Scout.give", "Scout.propose",
                                  "Tracker.update", "Tracker.search"])
def test_signals_are_handled_during(name, calls):
    """Thus Ctrl-C raises in the call."""
    assert handled_during(calls[name]) > 0


def scout_that_asks(scene, reachable):
    views = np.repeat(np.eye(4)[None], 2, axis=0)
    views[:, 0, 3] = 0, 0.01
    return edgescout.Scout(scene.templates, scene.camera, views, reachable=reachable,
                           backend=scene.backend)


def test_ctrl_c_ends_the_wait_for_another_thread(scene):
    asked, answer = threading.Event(), threading.Event()

    def reachable(view):
        asked.set()
        return answer.wait(60)

    other = threading.Thread(target=scout_that_asks(scene, reachable).propose)
    other.start()
    asked.wait()  # from now on the other thread uses the backend
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            scene.detect(scene.image)
        assert other.is_alive()
    finally:
        answer.set()
        other.join()
    assert len(scene.detect(scene.image)) == 1


def test_a_call_inside_a_call_is_refused(scene):
    for inner in (lambda: scene.detect(scene.image), lambda: scout.propose()):
        scout = scout_that_asks(scene, lambda view: inner())
        with pytest.raises(edgescout.LogicError, match="backend: found a call inside another"):
            scout.propose()
    assert len(scene.detect(scene.image)) == 1
