"""Options have the names, bounds and words of the command line."""

import pytest

import edgescout


def test_hold_what_is_given():
    options = edgescout.DetectOptions(min_probability=0.25, edges="gradient")
    assert options.min_probability == 0.25
    options.coarse_poses = 500
    assert options.copy() == options != edgescout.DetectOptions()
    assert "coarse_poses=500" in repr(options)
    assert options.lambda_ > 0


@pytest.mark.parametrize("name, value, error, message", [
    ("min_probability", 2, ValueError, "min_probability: found 2"),
    ("min_probability", float("nan"), ValueError, "nan"),
    ("min_probability", "high", TypeError, "found 'high', expected a number"),
    ("coarse_poses", 1.5, TypeError, "expected an integer"),
    ("faint_edges", 1, TypeError, "expected True or False"),
    ("edges", "sobel", ValueError, "found sobel, expected one of"),
    ("world_box", [1, 2], ValueError, "world_box"),
    ("min_probabilty", 0.5, AttributeError, "there is min_probability"),
])
def test_refuse_in_one_line(name, value, error, message):
    with pytest.raises(error) as raised:
        edgescout.DetectOptions(**{name: value})
    assert message in str(raised.value) and "\n" not in str(raised.value)


def test_a_name_that_does_not_exist_is_refused_with_one_that_is_near():
    options = edgescout.DetectOptions()
    with pytest.raises(AttributeError, match="there is min_probability"):
        options.min_probabilty
    with pytest.raises(AttributeError, match="there is min_probability"):
        options.min_probabilty = 0.5


def test_each_is_explained():
    options = edgescout.DetectOptions()
    assert set(options.help()) < set(dir(options))
    assert all(len(text) > 10 for text in options.help().values())
    assert edgescout.DetectOptions.coarse_poses.__doc__ == options.help()["coarse_poses"]
