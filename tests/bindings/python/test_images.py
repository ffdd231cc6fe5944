"""Arrays become the grey images that files of the same pixels become, fast."""

import time

import numpy as np
import pytest

import edgescout

RANDOM = np.random.default_rng(39)
RGB = RANDOM.integers(0, 256, (480, 640, 3), np.uint8)


def png_of(tmp_path):
    edgescout.save_png(RGB, tmp_path / "colour.png")
    return edgescout.load_image(tmp_path / "colour.png")


def test_colours_are_weighed_as_in_files(tmp_path):
    """Bit for bit, in every order of the pixels in memory."""
    expected = png_of(tmp_path)
    rgba = np.dstack([RGB, RANDOM.integers(0, 256, RGB.shape[:2], np.uint8)])
    bgr = np.ascontiguousarray(RGB[:, :, ::-1])
    upwards = np.ascontiguousarray(RGB[::-1])
    wide = np.zeros((480, 700, 3), np.uint8)
    wide[:, 20:660] = RGB
    planes = np.ascontiguousarray(RGB.transpose(2, 0, 1))
    for name, image in {"rgb": RGB, "rgba": rgba, "bgr": bgr[:, :, ::-1], "rgb of rgba":
                        rgba[:, :, :3], "upwards": upwards[::-1], "window": wide[:, 20:660],
                        "bgr window": np.ascontiguousarray(wide[:, :, ::-1])[:, 20:660, ::-1],
                        "planes": planes.transpose(1, 2, 0), "fortran": np.asfortranarray(RGB),
                        "mirrored": np.ascontiguousarray(RGB[:, ::-1])[:, ::-1],
                        "turned": np.ascontiguousarray(RGB[::-1, ::-1, ::-1])[::-1, ::-1, ::-1],
                        }.items():
        np.testing.assert_array_equal(edgescout.to_grey(image), expected, name)


def test_of_a_pixel_repeated_every_row_is_read():
    row = RGB[:1, :, 0]
    grey = edgescout.to_grey(np.broadcast_to(row, (32, 640)))
    np.testing.assert_array_equal(grey, np.repeat(row, 32, axis=0))


def test_one_channel_is_a_grey_image():
    np.testing.assert_array_equal(edgescout.to_grey(RGB[:, :, :1]), RGB[:, :, 0])


def test_deep_colours_and_the_other_order_of_bytes_are_read():
    full = edgescout.ImageOptions(image_scaling="full")
    expected = edgescout.to_grey(RGB)
    deep = RGB.astype(np.uint16) * 257
    for image in (deep, deep.astype(">u2"), np.ascontiguousarray(deep[:, :, ::-1])[:, :, ::-1],
                  np.dstack([deep, deep[:, :, :1]])):
        grey = edgescout.to_grey(image, full)
        assert np.abs(grey.astype(int) - expected).max() <= 1
        np.testing.assert_array_equal(grey, edgescout.to_grey(deep, full))
    real = (RGB[:, :, 0] / 255).astype(np.float32)
    np.testing.assert_array_equal(edgescout.to_grey(real.astype(">f4"), full),
                                  edgescout.to_grey(real, full))


def test_options_hold_for_8_bit_too():
    mosaic = edgescout.to_grey(RGB[:, :, 0], edgescout.ImageOptions(bayer="rggb"))
    assert (mosaic != RGB[:, :, 0]).any()
    with pytest.raises(edgescout.InputError, match="colours of its own"):
        edgescout.to_grey(RGB, edgescout.ImageOptions(bayer="rggb"))


@pytest.mark.parametrize("image", [
    np.zeros((480, 640), np.int16), np.zeros((480, 640), bool), np.zeros((480, 640, 3), np.float32),
    np.zeros((480, 640), np.uint32), np.zeros((480, 640, 2), np.uint8), np.uint8(3), "image.png",
])
def test_other_types_are_named(image):
    with pytest.raises(ValueError) as error:
        edgescout.to_grey(image)
    assert "image: found " in str(error.value) and len(str(error.value)) < 300


@pytest.mark.parametrize("image", [
    np.zeros((0, 4, 3), np.uint8), np.zeros((4, 4)), np.zeros((4, 4, 4), np.uint8), [[[1]]],
])
def test_only_pixels_are_saved(image, tmp_path):
    with pytest.raises(ValueError, match="image: found .*, expected pixels"):
        edgescout.save_png(image, tmp_path / "image.png")
    assert not list(tmp_path.iterdir())


def test_saves_small_pictures(tmp_path):
    edgescout.save_png(RGB[:4, :4], tmp_path / "colour.png")
    edgescout.save_png(RGB[:4, :4, 0], tmp_path / "grey.png")
    assert len(list(tmp_path.iterdir())) == 2


def test_reading_takes_less_than_a_millisecond():
    """The least of many: other programs may run."""
    bgr = np.ascontiguousarray(RGB[:, :, ::-1])
    for name, image in (("grey", RGB[:, :, 0].copy()), ("rgb", RGB), ("bgr", bgr[:, :, ::-1]),
                        ("rgba", np.dstack([RGB, RGB[:, :, :1]]))):
        least_s = 1.0
        for _ in range(100):
            start = time.perf_counter()
            edgescout.to_grey(image)
            least_s = min(least_s, time.perf_counter() - start)
        assert least_s < 0.001, name
