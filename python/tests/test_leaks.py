import gc
import os
import sys
from pathlib import Path

import pytest

import curveflow as cf

CYCLES = 1000
# Pages that an allocator keeps; a frame of a run that were kept would make 5 MB of a thousand.
MOST_GROWTH = 2 << 20


def resident() -> int:
    """Bytes of this process in memory."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def descriptors() -> int:
    return len(os.listdir("/proc/self/fd"))


def cycles(scene: cf.Scene, path: Path, count: int) -> None:
    """Make, run and drop; every tenth time also what comes after a run."""
    for number in range(count):
        result = cf.run(scene, callback=lambda _: None)
        assert result.position.size and result.steps["time"].size
        if number % 10 == 0:
            simulation = cf.Simulation(scene)
            simulation.step()
            result.save(path, replace=True)
            opened = cf.open(path)
            cf.energy(opened.scene, opened.curvature[-1], opened.metric[-1])
            cf.geometry(opened.position[-1])


@pytest.mark.skipif(sys.platform != "linux", reason="memory and descriptors are read from /proc")
def test_runs_leave_memory_and_descriptors_flat(circle: cf.Scene, tmp_path: Path):
    scene = circle.with_values({"time.end": 1e-3, "output.frames": 2})
    path = tmp_path / "out.h5"
    cycles(scene, path, CYCLES // 5)
    gc.collect()
    open_before, before = descriptors(), resident()
    cycles(scene, path, CYCLES)
    gc.collect()
    assert descriptors() == open_before
    assert resident() - before < MOST_GROWTH
