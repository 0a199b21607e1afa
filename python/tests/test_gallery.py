import os
import subprocess
import sys
from pathlib import Path

import gallery
import incompressible_limit
import numpy as np
import pytest
import settling
import three_flows
from alignment import align
from PIL import Image

DOCS = Path(__file__).parents[2] / "docs"
LARGEST = 120_000


@pytest.mark.parametrize("name", gallery.FIGURES)
def test_every_figure_can_be_drawn(name: str, tmp_path: Path):
    path = gallery.draw(name, tmp_path)
    assert path.stat().st_size < LARGEST
    with Image.open(path) as image:
        assert image.width > 1000
        assert len(image.getcolors() or []) > 100, "a drawing with smoothed lines has many colours"


def test_the_page_shows_every_figure():
    page = (DOCS / "gallery.md").read_text(encoding="utf-8")
    for name in gallery.FIGURES:
        assert f"](gallery/{name}.png)" in page
        assert (DOCS / "gallery" / f"{name}.png").stat().st_size < LARGEST
    assert len(list((DOCS / "gallery").iterdir())) == len(gallery.FIGURES)


def test_the_script_draws_what_it_is_asked_for(tmp_path: Path):
    script = [sys.executable, gallery.__file__, "-o", "new/pictures"]
    subprocess.run([*script, "figure_eight"], cwd=tmp_path, check=True, env={**os.environ, "MPLBACKEND": "agg"})
    assert [path.name for path in (tmp_path / "new" / "pictures").iterdir()] == ["figure_eight.png"]
    refused = subprocess.run([*script, "figure_nine"], cwd=tmp_path, capture_output=True, text=True)
    assert refused.returncode == 2
    assert "no figure called 'figure_nine'; there are three_fold" in refused.stderr


def test_the_three_flows_cross_where_the_physics_page_says():
    curves = three_flows.aligned(three_flows.run())
    incompressible = curves["incompressible"]
    np.testing.assert_allclose(np.degrees(incompressible.crossings), [27, 94, 148, 217, 267, 335], atol=0.6)
    assert np.abs(incompressible.gap).max() == pytest.approx(0.0499, abs=1e-4)
    assert incompressible.rotation == pytest.approx(0.0008, abs=1e-4)
    assert len(curves["membrane_penalty"].crossings) == 6
    assert np.abs(curves["membrane_penalty"].gap).max() == pytest.approx(0.0239, abs=1e-4)
    np.testing.assert_allclose(curves["length_penalty"].gap, 0, atol=1e-7)


def test_a_curve_that_was_turned_is_turned_back():
    phi = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    curve = np.stack([2 * np.cos(phi) + 0.3, np.sin(phi)], axis=1)
    cos, sin = np.cos(0.04), np.sin(0.04)
    found = align(curve @ np.array([[cos, sin], [-sin, cos]]), curve)
    assert found.rotation == pytest.approx(-0.04, abs=1e-5)
    assert np.abs(found.gap).max() < 1e-4
    with pytest.raises(ValueError, match="star-shaped"):
        align(curve[::-1], curve)


def test_the_limit_has_the_slopes_of_the_physics_page():
    results = incompressible_limit.run()
    slopes = {name: slope.value for name, (_, slope) in incompressible_limit.exponents(results).items()}
    expected = {"distance": 1.990, "velocity residual": 1.015, "length deficit": 0.999}
    assert slopes == pytest.approx(expected, abs=1e-3)
    for epsilon, rate in ((3e-4, 0.819), (1e-4, 0.815)):
        assert incompressible_limit.decay(results[epsilon], epsilon).value == pytest.approx(rate, abs=2e-3)


def test_the_elastica_is_closed_and_has_its_invariant():
    assert settling.energy_times_length() == pytest.approx(56.21980487, abs=1e-8)
    curve = settling.elastica(3.0)
    assert np.linalg.norm(curve - np.roll(curve, 1, axis=0), axis=1).sum() == pytest.approx(3.0, rel=1e-5)
