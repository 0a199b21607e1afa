import subprocess
import sys
from pathlib import Path


def test_the_stubs_match_the_extension(tmp_path: Path):
    command = [sys.executable, "-m", "mypy.stubtest", "curveflow"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


NUMBERS = """
import numpy as np
import curveflow as cf

scene = cf.Scene.shipped("circle")
simulation = cf.Simulation(scene)
simulation.add_callback(print, interval=np.float32(10))
simulation.add_callback(print, steps=np.int64(10**6))
simulation.run(until=np.float32(0.1))
simulation.run(until=np.int64(1))
cf.tradeoff(scene, [np.float32(1e-2)], reference_nodes=np.int64(64)).cheapest(np.float32(0.1))
system = cf.System(scene)
system.linearise(system.initial)
system.factorise(np.float32(0.1))
accuracy = cf.Accuracy(nodes=np.int64(256))
output, time = cf.Output(frames=np.int32(3)), cf.Time(end=1.0, max_steps=np.uint8(9))
counts: list[int | None] = [output.frames, time.max_steps, cf.Circle(1.0, turning_number=np.int64(1)).turning_number]
nodes: int | str = accuracy.nodes
assert isinstance(nodes, int) and all(isinstance(count, int) for count in counts)
"""


def test_numbers_of_numpy_are_taken_and_so_say_the_types(tmp_path: Path):
    path = tmp_path / "numbers_of_numpy.py"
    path.write_text(NUMBERS)
    for command in ([sys.executable, "-m", "mypy", "--strict", path], [sys.executable, path]):
        done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode == 0, done.stdout + done.stderr
