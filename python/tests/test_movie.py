import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import curveflow as cf
from curveflow import movie


@pytest.fixture(scope="module")
def growth() -> cf.Result:
    """A circle that grows, with an empty title."""
    scene = cf.Scene.shipped("circle")
    return cf.run(scene.with_values({"output.frames": 11, "accuracy.tolerance": 1e-3, "title": ""}))


def durations(path: Path) -> list[int]:
    with Image.open(path) as gif:
        times = []
        for frame in range(gif.n_frames):
            gif.seek(frame)
            times.append(gif.info["duration"])
    return times


def test_a_gif_shows_every_frame(growth: cf.Result, tmp_path: Path):
    path = tmp_path / "circle.gif"
    growth.animate(path, size=(400, 240), fps=10)
    assert durations(path) == [100] * 11 + [1000]
    with Image.open(path) as gif:
        assert gif.size == (400, 240) and gif.info["loop"] == 0
        first = np.asarray(gif.convert("RGB"), dtype=float)
        gif.seek(11)
        last = np.asarray(gif.convert("RGB"), dtype=float)
    # The curve moves; the frame around the panels does not.
    assert np.abs(first - last).max() > 100
    np.testing.assert_array_equal(first[:4], last[:4])
    assert [file.name for file in tmp_path.iterdir()] == ["circle.gif"]


def test_frames_can_be_chosen(growth: cf.Result, tmp_path: Path):
    assert movie.chosen(None, 4) == [0, 1, 2, 3]
    assert movie.chosen(3, 12) == [0, 6, 11] and movie.chosen(99, 3) == [0, 1, 2] and movie.chosen(1, 5) == [0]
    assert movie.chosen([0, -1, 3], 12) == [0, 11, 3]
    growth.animate(tmp_path / "three.gif", size=(400, 240), frames=3, field="normal_velocity")
    assert len(durations(tmp_path / "three.gif")) == 3
    growth.animate(tmp_path / "one.gif", size=(400, 240), frames=[4])
    assert len(durations(tmp_path / "one.gif")) == 1


def test_any_field_colours_the_curve(membrane: cf.Result):
    assert movie.coloured(membrane, None) == ("protein density $\\rho$", membrane.density["protein"])
    for name in ("curvature", "metric", "normal_velocity"):
        assert movie.coloured(membrane, name)[1] is getattr(membrane, name)
    with pytest.raises(ValueError, match="field = 'lipid': .*it has curvature, metric, normal_velocity, protein"):
        movie.coloured(membrane, "lipid")


def test_an_mp4_has_the_frames_and_the_rate(membrane: cf.Result, tmp_path: Path):
    import imageio_ffmpeg

    path = tmp_path / "membrane.mp4"
    membrane.animate(path, frames=6, fps=5, size=(640, 360))
    count, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
    assert (count, round(seconds, 2)) == (6, 1.2)
    reader = imageio_ffmpeg.read_frames(str(path))
    assert next(reader)["size"] == (640, 360)
    image = np.frombuffer(next(reader), dtype=np.uint8).reshape(360, 640, 3)
    assert (image > 250).mean() > 0.5  # a white page
    reader.close()


def test_existing_movies_are_kept(growth: cf.Result, tmp_path: Path):
    path = tmp_path / "circle.gif"
    path.write_text("precious")
    with pytest.raises(cf.StorageError, match=r"circle\.gif: already exists"):
        growth.animate(path)
    with pytest.raises(cf.StorageError, match=r"ends in \.gif or \.mp4"):
        growth.animate(tmp_path / "circle.avi")
    with pytest.raises(cf.StorageError, match="does not exist; create it first"):
        growth.animate(tmp_path / "none" / "circle.gif", frames=1)
    with pytest.raises(ValueError, match="no frame 12, the result has 12"):
        growth.animate(path, frames=[12], replace=True)
    for wrong in ({"fps": 0}, {"fps": 60}, {"size": (401, 240)}, {"size": (200, 200)}, {"frames": 0}, {"frames": []}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            growth.animate(path, replace=True, **wrong)  # type: ignore[arg-type]
    for no_pair in (1, (960,), (960, 540, 3), (960.5, 540)):
        with pytest.raises(TypeError, match="size = .* a width and a height"):
            growth.animate(path, replace=True, size=no_pair)  # type: ignore[arg-type]
    assert path.read_text() == "precious"
    path.chmod(0o444)
    with pytest.raises(cf.StorageError, match="write-protected"):
        growth.animate(path, replace=True)
    path.chmod(0o644)
    link = tmp_path / "link.gif"
    link.symlink_to(path)
    growth.animate(link, frames=1, size=(400, 240), replace=True)
    assert link.is_symlink() and path.read_bytes().startswith(b"GIF")
    link.unlink()
    growth.animate(path, frames=2, size=(400, 240), replace=True)
    assert [file.name for file in tmp_path.iterdir()] == ["circle.gif"]


def test_what_is_missing_is_named(tmp_path: Path):
    code = """
import sys
sys.modules[sys.argv[1]] = None
import curveflow as cf
try:
    cf.run(cf.Scene.shipped("circle").with_values({"accuracy.tolerance": 1e-3})).animate(sys.argv[2], frames=2)
except cf.MissingExtraError as error:
    print(error)
"""
    for module, package, name in (
        ("matplotlib", "matplotlib", "a.gif"), ("PIL", "Pillow", "a.gif"), ("imageio_ffmpeg", "imageio-ffmpeg", "a.mp4"),
    ):
        command = [sys.executable, "-c", code, module, str(tmp_path / name)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        assert f'needs {package}: pip install "curveflow[movie]"' in done.stdout
    assert not list(tmp_path.iterdir())


def test_the_scale_of_colours_suits_the_whole_movie(membrane: cf.Result):
    from matplotlib.colors import SymLogNorm

    from curveflow.movie_stage import _scale

    norm, extend = _scale(membrane.density["protein"])
    assert (norm.vmin, norm.vmax, extend) == (
        membrane.density["protein"].min(), membrane.density["protein"].max(), "neither",
    )
    # The velocity falls by ten decades on the way to rest.
    norm, extend = _scale(membrane.normal_velocity)
    assert isinstance(norm, SymLogNorm) and norm.vmin == -norm.vmax and extend == "both"
    norm, _ = _scale(np.ones((3, 8)))
    assert norm.vmin < 1 < norm.vmax


def test_sizes_that_cannot_be_read_are_refused():
    assert movie.checked((400, 240)) == (400, 240) and movie.checked((4096, 4096)) == (4096, 4096)
    with pytest.raises(ValueError, match=r"size = \(200, 300\): the width must be an even number of pixels from 400 to 4096"):
        movie.checked((200, 300))
    with pytest.raises(ValueError, match=r"size = \(400, 200\): the height must be an even number of pixels from 240 to 4096"):
        movie.checked((400, 200))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [(400, 240), (402, 1000), (1000, 240), (960, 540)])
def test_texts_keep_apart_at_every_size(membrane: cf.Result, size: tuple[int, int]):
    from curveflow.movie_stage import Stage

    stage = Stage(membrane, *movie.coloured(membrane, None), [0, 9], size)
    assert stage.image(9).shape == (size[1], size[0], 3)
    panel = stage._figure.axes[0]
    heading, note = panel._left_title.get_window_extent(), panel._right_title.get_window_extent()  # type: ignore[attr-defined]
    assert heading.x1 < note.x0
    for axes in stage._figure.axes[:2]:
        boxes = sorted((label.get_window_extent() for label in axes.get_xticklabels() if label.get_text()), key=lambda box: box.x0)
        assert axes.get_window_extent().width > 0.15 * size[0]
        assert all(box.x1 < following.x0 for box, following in zip(boxes, boxes[1:], strict=False))


def test_a_movie_starts_with_the_initial_energy_and_round_curves(growth: cf.Result):
    from curveflow.movie_stage import Stage

    stage = Stage(growth, *movie.coloured(growth, None), [0, 11], (400, 240))
    stage.image(0)
    assert stage._now.get_ydata()[0] == growth.energy[0]
    assert stage._past.get_xydata().shape == (1, 2)
    assert growth.position.shape[1] < 400 <= len(stage._curve.get_segments())


def test_a_curve_that_shrinks_to_a_point_is_a_dot_in_the_end():
    from curveflow.movie_stage import Stage

    shrinking = cf.Scene(curve=cf.Circle(1.0), energy=[cf.Length(tension=1.0)], time=cf.Time(10.0))
    result = cf.run(shrinking)
    assert result.length[-1] < 1e-3 * result.length[0]
    last = len(result.time) - 1
    stage = Stage(result, *movie.coloured(result, None), [0, last], (400, 240))
    stage.image(last)
    np.testing.assert_allclose(stage._dot.get_xydata(), [result.position[-1].mean(axis=0)], atol=1e-6)
    stage.image(0)
    assert not len(stage._dot.get_xydata())
