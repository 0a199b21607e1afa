from dataclasses import FrozenInstanceError, fields
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import curveflow as cf
from curveflow import _curveflow

RADIUS, NODES = 1.7, 96
S = np.arange(NODES) / NODES
PHI = 2 * np.pi * S
CIRCLE = RADIUS * np.stack([np.cos(PHI), np.sin(PHI)], axis=1)
KAPPA, METRIC = np.full(NODES, 1 / RADIUS), np.full(NODES, 2 * np.pi * RADIUS)
GAUGES = ("scaled-arc-length", "graded", "co-moving")


def derivative(values: np.ndarray, metric: np.ndarray) -> np.ndarray:
    """Derivative by the arc length."""
    return np.fft.irfft(2j * np.pi * np.arange(len(values) // 2 + 1) * np.fft.rfft(values), len(values)) / metric


def test_the_geometry_of_a_circle_is_exact():
    circle = cf.geometry(CIRCLE)
    np.testing.assert_allclose(circle.curvature, KAPPA, rtol=1e-11)
    np.testing.assert_allclose(circle.metric, METRIC, rtol=1e-13)
    np.testing.assert_allclose(circle.tangent_angle, np.pi / 2 + PHI, atol=1e-12)
    np.testing.assert_allclose(circle.normal, CIRCLE / RADIUS, atol=1e-13)
    np.testing.assert_allclose(circle.tangent, np.stack([-np.sin(PHI), np.cos(PHI)], axis=1), atol=1e-13)
    assert circle.length == pytest.approx(2 * np.pi * RADIUS, rel=1e-14)
    assert circle.area == pytest.approx(np.pi * RADIUS**2, rel=1e-14)
    assert circle.turning_number == 1 and isinstance(circle.turning_number, int)
    assert circle.closure_defect < 1e-13
    backwards = cf.geometry(CIRCLE[::-1])
    assert (backwards.turning_number, backwards.area < 0) == (-1, True)
    for field in fields(circle):
        value = getattr(circle, field.name)
        assert not isinstance(value, np.ndarray) or not value.flags.writeable
    with pytest.raises(FrozenInstanceError):
        circle.length = 1.0  # type: ignore[misc]


def test_the_geometry_of_a_frame_is_that_of_the_run(membrane: cf.Result):
    found = cf.geometry(membrane.position[-1])
    assert found.length == pytest.approx(membrane.length[-1], rel=1e-10)
    assert found.area == pytest.approx(membrane.area[-1], rel=1e-10)
    np.testing.assert_allclose(found.metric, membrane.metric[-1], rtol=1e-6)
    np.testing.assert_allclose(found.curvature, membrane.curvature[-1], atol=1e-4)
    assert found.closure_defect < 1e-6


def test_unequal_nodes_and_figure_eights_have_a_geometry():
    phi = PHI + 0.3 * np.sin(PHI)
    ellipse = cf.geometry(np.stack([2 * np.cos(phi), np.sin(phi)], axis=1))
    exact = 2 / (4 * np.sin(phi) ** 2 + np.cos(phi) ** 2) ** 1.5
    np.testing.assert_allclose(ellipse.curvature, exact, rtol=1e-8)
    assert ellipse.length == pytest.approx(9.688448220547675, rel=1e-12)
    eight = cf.geometry(np.stack([np.sin(PHI), np.sin(2 * PHI)], axis=1))
    assert eight.turning_number == 0 and abs(eight.area) < 1e-12
    coarse = cf.geometry(np.stack([2 * np.cos(phi), np.sin(phi)], axis=1)[::6])
    assert coarse.closure_defect > 1e-6 > ellipse.closure_defect


def test_a_circle_grows_as_its_normal_velocity_says():
    v = np.ones(NODES)
    for gauge in GAUGES:
        rates = cf.flow_map(KAPPA, METRIC, v, {"protein": 0.3 * v}, gauge=gauge)
        np.testing.assert_allclose(rates.metric, 2 * np.pi * v, rtol=1e-12)
        np.testing.assert_allclose(rates.curvature, -v / RADIUS**2, atol=1e-10)
        np.testing.assert_allclose(rates.density["protein"], -0.3 * v / RADIUS, rtol=1e-12)
        np.testing.assert_allclose(rates.tangential_velocity, 0, atol=1e-12)


def test_the_gauges_move_the_same_curve():
    wave = np.cos(3 * PHI)
    equal = cf.flow_map(KAPPA, METRIC, wave)
    material = cf.flow_map(KAPPA, METRIC, wave, gauge="co-moving")
    # Mode 3 of a circle: κ_t = -(Δ + κ²)V.
    np.testing.assert_allclose(equal.curvature, 8 * wave / RADIUS**2, atol=1e-9)
    np.testing.assert_allclose(material.curvature, equal.curvature, atol=1e-9)
    np.testing.assert_allclose(equal.metric, 0, atol=1e-12)
    np.testing.assert_allclose(material.metric, 2 * np.pi * wave, atol=1e-11)
    # (F1): the nodes stay at equal distances, ∂W = -gκV.
    slope = derivative(equal.tangential_velocity, np.ones(NODES))
    np.testing.assert_allclose(slope, -2 * np.pi * wave, atol=1e-10)
    assert not material.tangential_velocity.any()


@pytest.fixture(scope="module")
def scene() -> cf.Scene:
    """A scene with a term of every part of the energy, on few nodes."""
    return cf.Scene(
        curve=cf.Ellipse((1.3, 0.9)),
        density=[cf.Density("protein", "0.5 + 0.1*cos(2*pi*s)", "diffusion"), cf.Density("lipid", 0.3, "none")],
        energy=[
            cf.Bending(1.0, preferred_curvature="2*rho", density="lipid"),
            cf.Regularization(0.02),
            cf.Length(penalty=3.0, target_ratio=1.2),
            cf.Area(penalty=2.0, target_ratio=0.8),
            cf.Local("0.1*(protein_sigma^2 + kappa^2*lipid^2 + kappa_sigma*protein)"),
        ],
        time=cf.Time(0.01, stop_at_equilibrium=False),
        accuracy=cf.Accuracy(nodes=NODES),
        output=cf.Output(frames=3),
    )


def state(scene: cf.Scene, gauge: str) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    metric = METRIC if gauge == "scaled-arc-length" else METRIC * (1 + 0.3 * np.cos(PHI))
    kappa = KAPPA * (1 + 0.2 * np.cos(2 * PHI) + 0.05 * np.sin(5 * PHI))
    density = {"lipid": 0.3 + 0.05 * np.sin(PHI), "protein": 0.5 + 0.1 * np.cos(2 * PHI + 1)}
    return kappa, metric, density


@pytest.mark.parametrize("gauge", GAUGES)
def test_the_force_is_minus_the_transpose_of_the_flow_map(scene: cf.Scene, gauge: Any):
    flow = cf.Flow(gauge=gauge, grading="1 + 0.3*cos(2*pi*s)" if gauge == "graded" else None)
    scene = cf.Scene(**{name: getattr(scene, name) for name in ("curve", "density", "energy", "time", "accuracy")}, flow=flow)
    kappa, metric, density = state(scene, gauge)
    force = cf.normal_force(scene, kappa, metric, density)
    random = np.random.default_rng(7)
    for _ in range(4):
        v = np.fft.irfft(random.normal(size=9) + 1j * random.normal(size=9), NODES) * NODES
        rates = cf.flow_map(kappa, metric, v, density, gauge=gauge)

        def energy(h: float) -> float:
            moved = {name: rho + h * rates.density[name] for name, rho in density.items()}
            return cf.energy(scene, kappa + h * rates.curvature, metric + h * rates.metric, moved)

        # The metric of the graded gauge moves by a factor: the moved state is one of that gauge again.
        h = 1e-4 / np.abs(rates.curvature).max()
        rate = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h)
        power = float(np.mean(force * v * metric))
        size = float(np.sqrt(np.mean(force**2 * metric) * np.mean(v**2 * metric)))
        assert rate == pytest.approx(-power, abs=3e-8 * size), gauge


def test_the_energy_of_a_frame_is_that_of_the_run(scene: cf.Scene, membrane: cf.Result):
    for result in (cf.run(scene), membrane):
        for frame in (0, -1):
            density = {name: rho[frame] for name, rho in result.density.items()}
            energy = cf.energy(result.scene, result.curvature[frame], result.metric[frame], density)
            assert energy == pytest.approx(result.energy[frame], rel=1e-12)
            force = cf.normal_force(result.scene, result.curvature[frame], result.metric[frame], density)
            # The mobility of the scenes is the identity.
            scale = np.abs(result.normal_velocity[0]).max()
            np.testing.assert_allclose(force, result.normal_velocity[frame], atol=1e-9 * scale)


@pytest.mark.parametrize("gauge", ["graded", "co-moving"])
def test_so_it_is_on_unequal_nodes(gauge: Any):
    scene = cf.Scene.shipped("three_fold").with_values(
        {"flow.gauge": gauge, "flow.grading": "1 + 0.3*cos(6*pi*s)", "accuracy.nodes": 192, "time.end": 1e-3}
    )
    result = cf.run(scene)
    for frame in (0, -1):
        density = {"protein": result.density["protein"][frame]}
        energy = cf.energy(scene, result.curvature[frame], result.metric[frame], density)
        assert energy == pytest.approx(result.energy[frame], rel=1e-11)


def curve_of_unequal_nodes() -> tuple[np.ndarray, np.ndarray]:
    phi = PHI + 0.2 * np.sin(PHI)
    found = cf.geometry(np.stack([1.2 * np.cos(phi), np.sin(phi)], axis=1))
    return found.curvature, found.metric


def test_helmholtz_is_solved():
    f = np.exp(np.sin(PHI))
    # On a circle mode n is divided by (n² + 1)/R².
    u = cf.helmholtz(KAPPA, METRIC, np.cos(3 * PHI))
    np.testing.assert_allclose(u, RADIUS**2 / 10 * np.cos(3 * PHI), atol=1e-10)
    for kappa, metric in ((KAPPA * (1 + 0.3 * np.cos(2 * PHI)), METRIC), curve_of_unequal_nodes()):
        u = cf.helmholtz(kappa, metric, f)
        residual = -derivative(derivative(u, metric), metric) + kappa**2 * u - f
        # The difference of order 8 that stands for the Fourier derivative.
        assert np.abs(residual).max() < 1e-6
    # Staggered differences of order 2 solve their own equation, exactly.
    kappa = KAPPA * (1 + 0.3 * np.cos(2 * PHI))
    u = cf.helmholtz(kappa, METRIC, f, derivative="central-2")
    second = (np.roll(u, 1) - 2 * u + np.roll(u, -1)) * (NODES / METRIC) ** 2
    np.testing.assert_allclose(-second + kappa**2 * u, f, atol=1e-11)


@pytest.mark.parametrize("family", ["fourier", "central-2", "central-4", "central-6", "central-8"])
def test_the_incompressibility_operator_keeps_its_laws(family: Any):
    wave = np.cos(2 * PHI)
    if family == "fourier":
        np.testing.assert_allclose(cf.incompressibility(KAPPA, METRIC, wave), 0.8 * wave, atol=1e-10)
    for kappa, metric in ((KAPPA * (1 + 0.5 * np.cos(2 * PHI)), METRIC), curve_of_unequal_nodes()):

        def apply(f: np.ndarray) -> np.ndarray:
            return cf.incompressibility(kappa, metric, f, derivative=family)

        np.testing.assert_allclose(apply(kappa), 0, atol=1e-13)
        f, g = np.exp(np.sin(PHI)), np.cos(3 * PHI) + 0.2
        left, right = np.mean(apply(f) * g * metric), np.mean(f * apply(g) * metric)
        assert left == pytest.approx(right, rel=1e-11)
        assert 0 <= np.mean(apply(f) * f * metric) <= np.mean(f * f * metric)
        # No piece of the curve is stretched by more than its membrane evens out: the length stays.
        assert abs(np.mean(kappa * apply(f) * metric)) < 1e-13


def test_errors_name_the_argument(scene: cf.Scene, membrane: cf.Result):
    def fails(match: str) -> "pytest.RaisesExc[cf.ArrayError]":
        return pytest.raises(cf.ArrayError, match=match)

    with fails(r"`position` has the shape \(200, 512, 2\), but it must be \(node, 2\); give one frame"):
        cf.geometry(np.zeros((200, 512, 2)))
    with fails(r"`position` is \(NaN, 0\) at node 3"):
        cf.geometry(np.where(np.arange(32)[:, None] == 3, [np.nan, 0.0], np.ones((32, 2))))
    with fails("`position` has 4 nodes, a curve needs 8"):
        cf.geometry(CIRCLE[::24])
    with fails("`curvature` is no array of numbers"):
        cf.helmholtz(["a"], METRIC, S)
    with fails(r"`metric` has the shape \(\), but it must be \(node,\)"):
        cf.helmholtz(KAPPA, 1.0, S)
    with fails(r"`curvature` has the shape .*; give one frame"):
        cf.helmholtz(membrane.curvature, METRIC, S)
    with fails("`normal_velocity` has 3 values, and `curvature` has 96"):
        cf.flow_map(KAPPA, METRIC, [1, 2, 3])
    with fails("`metric` varies by 3.0e-1 of its mean.*use gauge"):
        cf.flow_map(KAPPA, METRIC * (1 + 0.3 * np.cos(PHI)), S)
    with fails("`metric`.*-1.*must be positive"):
        cf.helmholtz(KAPPA, -np.ones(NODES), S)
    with fails(r"`curvature` has .* 4π² or more"):
        cf.incompressibility(1e-3 * KAPPA, METRIC, S)
    with fails("`density` has the names .*, but the scene has the densities: 'protein', 'lipid'"):
        cf.energy(scene, KAPPA, METRIC, {"protein": S})
    with fails("`density` is a ndarray, but it must be a mapping"):
        cf.energy(scene, KAPPA, METRIC, S)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='gauge = "none": it must be one of scaled-arc-length'):
        cf.flow_map(KAPPA, METRIC, S, gauge="none")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='derivative = "central": it must be one of fourier'):
        cf.helmholtz(KAPPA, METRIC, S, derivative="central")  # type: ignore[arg-type]


def test_arrays_are_neither_copied_in_nor_out():
    wide = np.stack([KAPPA, KAPPA], axis=1)
    # The extension borrows: what is not contiguous it refuses, and the package copies only that.
    with pytest.raises(TypeError, match="not contiguous"):
        _curveflow.helmholtz(wide[:, 0], METRIC, S, "fourier")
    np.testing.assert_array_equal(cf.helmholtz(wide[:, 0], METRIC, S), cf.helmholtz(KAPPA, METRIC, S))
    u = cf.helmholtz(KAPPA, METRIC, S)
    # The buffer is that of the core, held by another object.
    assert u.base is not None and not u.flags.owndata and not u.flags.writeable
    assert cf.operators._contiguous("curvature", KAPPA) is KAPPA
    assert cf.helmholtz(KAPPA.astype(np.float32), METRIC.tolist(), S).shape == (NODES,)


def test_frames_of_a_result_are_views(membrane: cf.Result):
    assert membrane.curvature is membrane.curvature
    assert np.shares_memory(membrane.curvature[3], membrane.curvature)
    assert membrane.curvature.base is not None
    last = membrane.curvature[-1]
    assert cf.operators._contiguous("curvature", last) is last
    system = cf.System(membrane.scene)
    out = np.empty_like(system.initial)
    assert system.rate(system.initial, out) is out


def test_a_first_point_that_is_repeated_is_no_curve():
    phi = np.linspace(0, 2 * np.pi, 257)
    with pytest.raises(cf.ArrayError, match="nodes 256 and 0 .*not repeated"):
        cf.geometry(np.stack([np.cos(phi), np.sin(phi)], axis=1))


@pytest.mark.parametrize(
    "given, match",
    [
        (KAPPA + 1j, "it holds complex128, but it must hold real numbers"),
        (np.array([*KAPPA[1:], 1j], dtype=object), "it holds object"),
        (np.arange(NODES).astype("datetime64[s]"), r"it holds datetime64\[s\]"),
        (np.arange(NODES).astype("timedelta64[s]"), r"it holds timedelta64\[s\]"),
        (KAPPA.astype(str), "it holds str"),
        (np.array(["0.5"] * NODES, dtype=object), "it holds object"),
        (np.ma.masked_less(KAPPA * (S > 0.1), 0.1), "has masked values"),
    ],
    ids=["complex", "complex object", "date", "span of time", "text", "text object", "masked"],
)
def test_what_would_change_when_it_is_made_real_is_refused(given: Any, match: str):
    for call in (
        lambda: cf.helmholtz(given, METRIC, S),
        lambda: cf.flow_map(KAPPA, METRIC, S, {"protein": given}),
        lambda: cf.geometry(np.stack([given, given], axis=1) if "mask" not in match else np.ma.stack([given, given], axis=1)),
    ):
        with pytest.raises(cf.ArrayError, match=match):
            call()


def test_other_real_numbers_are_taken():
    expected = cf.helmholtz(np.full(NODES, 0.5), METRIC, np.ones(NODES))
    for given in (np.full(NODES, 0.5, np.float32), [Fraction(1, 2)] * NODES, np.ma.array(np.full(NODES, 0.5))):
        np.testing.assert_array_equal(cf.helmholtz(given, METRIC, np.full(NODES, True)), expected)
