"""Initial densities by values, and scenes that start from a result."""

from dataclasses import replace

import numpy as np
import pytest

import curveflow as cf

WAVE = "0.9 + 0.05*cos(6*pi*s) + 0.02*cos(2*pi*s)"


def fractions(count):
    return np.arange(count) / count


def wave(s):
    return 0.9 + 0.05 * np.cos(6 * np.pi * s) + 0.02 * np.cos(2 * np.pi * s)


@pytest.mark.parametrize("nodes", [96, "auto"])
def test_values_at_equal_distances_are_as_good_as_their_formula(nodes):
    scene = cf.Scene.shipped("three_fold").with_values({"time.end": 0.01, "accuracy.nodes": nodes, "density.0.initial": WAVE})
    by_values = replace(scene, density=[cf.Density("protein", wave(fractions(64)), "diffusion")])
    results = [cf.run(one) for one in (scene, by_values)]
    assert results[0].energy[-1] == pytest.approx(results[1].energy[-1], rel=1e-9)
    assert cf.Scene.parse(by_values.to_toml()) == by_values
    assert "<64 values>" in repr(by_values)


def test_on_a_curve_through_points_values_belong_to_the_points():
    phi = 2 * np.pi * fractions(128)
    ellipse = np.stack([2 * np.cos(phi), np.sin(phi)], axis=1)
    x = ellipse[:, 0]  # a density that knows where it is
    scene = cf.Scene(
        curve=cf.Points(ellipse), density=[cf.Density("c", 1 + 0.1 * x, "diffusion")],
        energy=[cf.Bending(1), cf.Local("(c-1)^2")], time=cf.Time(1e-9), accuracy=cf.Accuracy(nodes=256),
    )
    first = cf.run(scene)
    assert np.abs(first.density["c"][0] - (1 + 0.1 * first.position[0, :, 0])).max() < 1e-9
    with pytest.raises(cf.SceneError, match="must be 128; give a value for each point"):
        replace(scene, density=[cf.Density("c", x[1:], "diffusion")])
    # The first one may be repeated, with its point.
    closed = replace(scene, curve=cf.Points([*ellipse, ellipse[0]]), density=[cf.Density("c", [*(1 + 0.1 * x), 1 + 0.1 * x[0]], "diffusion")])
    assert closed == scene


@pytest.mark.parametrize(("gauge", "exact"), [("scaled-arc-length", 1e-6), ("graded", 1e-4), ("co-moving", 1e-4)])
def test_a_scene_starts_where_another_ended(gauge, exact):
    absolute = {"energy.length.target_ratio": None, "energy.length.target": 12.0}
    scene = cf.Scene.shipped("three_fold").with_values({**absolute, "flow.gauge": gauge, "time.end": 0.05})
    whole = cf.run(scene.with_values({"time.end": 0.1}))
    half = cf.run(scene)
    again = cf.run(scene.starting_from(half))
    assert again.energy[0] == pytest.approx(half.energy[-1], rel=exact)
    assert again.energy[-1] == pytest.approx(whole.energy[-1], rel=1e-4)
    assert np.allclose(again.position[0, 0], half.position[-1, 0], atol=1e-3)
    with pytest.raises(IndexError):
        scene.starting_from(half, 10_000)


@pytest.mark.parametrize("wrong", ["circle.h5", cf.Scene.shipped("circle"), None])
def test_a_scene_starts_from_a_result_only(wrong):
    with pytest.raises(TypeError, match="it must be a curveflow.Result: curveflow.open"):
        cf.Scene.shipped("circle").starting_from(wrong)


def test_noise_is_a_start_like_any_other():
    noise = 0.9 + 0.01 * np.random.default_rng(1).standard_normal(64)
    scene = cf.Scene.shipped("three_fold").with_values({"time.end": 1e-3, "density.0.initial": noise.tolist()})
    assert cf.run(scene).success


@pytest.mark.parametrize(("values", "said"), [
    ([1.0, 2.0, 1.0], "must be 4 to 16384|between 4 and 16384"),
    ([1.0, "two", 1.0, 2.0], "initial.1"),
    ([1.0, float("nan"), 1.0, 2.0], "initial.1"),
    (True, "a number, an expression in quotes or a list of numbers"),
])
def test_what_is_no_list_of_values_is_refused(values, said):
    with pytest.raises((cf.SceneError, TypeError), match=said):
        cf.Scene.shipped("three_fold").with_values({"density.0.initial": values})
