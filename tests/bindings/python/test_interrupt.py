"""Ctrl-C ends a detection that runs in the main thread."""

import os
import signal
import threading
import time

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
