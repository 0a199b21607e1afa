import hashlib
import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

import curveflow as cf

FINGERPRINT = """
import hashlib, sys
import numpy as np
import curveflow as cf
result = cf.run(cf.Scene.load(sys.argv[1]))
parts = [result.position, result.curvature, result.energy, result.steps["size"], *result.density.values()]
print(hashlib.sha256(b"".join(part.tobytes() for part in parts)).hexdigest())
"""


def fingerprint(result: cf.Result) -> str:
    parts = [result.position, result.curvature, result.energy, result.steps["size"], *result.density.values()]
    return hashlib.sha256(b"".join(part.tobytes() for part in parts)).hexdigest()


@pytest.fixture
def short() -> cf.Scene:
    scene = cf.Scene.shipped("three_fold")
    return scene.with_values({"accuracy.nodes": 128, "time.end": 0.05, "output.frames": 4})


def test_a_result_tells_where_it_comes_from(short: cf.Scene, tmp_path: Path):
    result, path = cf.run(short), tmp_path / "out.h5"
    made = result.provenance
    assert made.version == cf.__version__
    assert made.commit is None or len(made.commit.removesuffix("-dirty")) == 40
    assert "processor" in made.machine and "Promislow" in made.citation
    assert made.integration_seconds == result.stats["integration_seconds"] > 0
    result.save(path)
    opened = cf.open(path)
    assert opened.provenance == made
    # A copy of a file says what made the first one.
    opened.save(tmp_path / "copy.h5")
    assert cf.open(tmp_path / "copy.h5").provenance == made


def test_a_file_makes_its_result_again_bit_by_bit(short: cf.Scene, tmp_path: Path):
    result, path = cf.run(short), tmp_path / "out.h5"
    result.save(path)
    scene = cf.Scene.of(cf.open(path))
    assert scene.text == short.text and scene == short
    again = cf.run(scene)
    assert fingerprint(again) == fingerprint(result)
    assert again.resolved_scene == result.resolved_scene
    # As resolved too, with every choice made.
    assert fingerprint(cf.run(cf.Scene.parse(result.resolved_scene))) == fingerprint(result)


def test_points_from_a_file_stand_in_the_result(tmp_path: Path):
    phi = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    points = tmp_path / "points.txt"
    np.savetxt(points, np.stack([1.5 * np.cos(phi), np.sin(phi)], axis=1), fmt="%.17g")
    text = """
    # A comment.
    curve = { shape = "points", file = "points.txt" }
    energy.bending.rigidity = 1.0
    time.end = 0.01
    """
    (tmp_path / "scene.toml").write_text(text)
    result = cf.run(cf.Scene.load(tmp_path / "scene.toml"))
    result.save(tmp_path / "out.h5")
    points.unlink()
    opened = cf.open(tmp_path / "out.h5")
    assert fingerprint(cf.run(opened.scene)) == fingerprint(result)
    assert isinstance(opened.scene.curve, cf.Points)
    simulation = cf.Simulation(opened.scene)
    simulation.step()
    simulation.checkpoint(tmp_path / "checkpoint")
    assert cf.Simulation.resume(tmp_path / "checkpoint").scene == opened.scene
    rough = opened.scene.with_values({"accuracy.tolerance": 1e-3})
    assert cf.run(rough).success


def test_results_do_not_depend_on_the_number_of_threads(short: cf.Scene, tmp_path: Path):
    path = tmp_path / "scene.toml"
    path.write_text(short.text)
    expected = fingerprint(cf.run(short))
    for threads in ("1", "7"):
        settings = dict.fromkeys(("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), threads)
        command = [sys.executable, "-c", FINGERPRINT, str(path)]
        done = subprocess.run(command, env=os.environ | settings, capture_output=True, text=True, check=True)
        assert done.stdout.strip() == expected


def test_nor_on_what_other_threads_run(short: cf.Scene):
    scenes = [short, cf.Scene.shipped("circle"), short.with_values({"accuracy.tolerance": 1e-4}), short]
    alone = [fingerprint(cf.run(scene)) for scene in scenes]
    together: list[str] = [""] * len(scenes)

    def run(number: int) -> None:
        together[number] = fingerprint(cf.run(scenes[number]))

    threads = [threading.Thread(target=run, args=(number,)) for number in range(len(scenes))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone
