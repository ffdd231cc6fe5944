"""BOP scenes and result files, as the program reads and writes them."""

import subprocess

import numpy as np
import pytest

import edgescout


@pytest.fixture(scope="module")
def folder(scene):
    return scene.file.parents[1]


def test_reads_a_scene(scene, folder):
    read = edgescout.load_bop_scene(folder)
    assert (read.scene_id, read.camera_name, len(read.images)) == (0, "", 1)
    image = read.images[0]
    assert np.array_equal(edgescout.load_image(image.file), scene.image)
    assert np.array_equal(image.camera.K, scene.camera.K)
    assert image.camera_from_world.shape == (4, 4)
    truths = read.truth(image.image_id)
    assert len(truths) == 8 and {t.object_id for t in truths} <= set(range(1, 7))
    assert all(0 <= t.visible_fraction <= 1 for t in truths)
    assert read.truth(77) == []
    assert edgescout.bop_cameras(folder) == [""]


def test_results_are_those_that_the_program_judges(scene, folder, found, program, tmp_path):
    rows = [edgescout.BopResult(0, 0, d.object_id, d.probability, d.world_from_object, 0.5)
            for d in found]
    file = tmp_path / "results.csv"
    edgescout.save_bop_results(rows, file)
    again = edgescout.load_bop_results(file)
    assert len(again) == len(rows) > 0
    for row, detection in zip(again, found):
        assert np.allclose(row.camera_from_object, detection.world_from_object, atol=1e-6)
        assert row.score == pytest.approx(detection.probability, abs=1e-6)
        assert row.time_s == 0.5
    judged = subprocess.run([program, "eval", file, folder, "--model", scene.part, "--unit", "mm"],
                            capture_output=True, text=True)
    assert judged.returncode == 0, judged.stderr


def test_says_what_is_wrong(tmp_path):
    with pytest.raises(edgescout.InputError, match="no_such: folder: found none"):
        edgescout.bop_cameras(tmp_path / "no_such")
    with pytest.raises(edgescout.InputError, match="scene_camera"):
        edgescout.load_bop_scene(tmp_path)
    with pytest.raises(ValueError, match="camera_from_object: found .*expected shape"):
        edgescout.BopResult(0, 0, 1, 0.5, np.eye(3))
