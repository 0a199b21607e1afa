import os
import re
import stat
import subprocess
import sys
from pathlib import Path

import pytest
import xarray

ROOT = Path(__file__).parents[2]
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.M | re.S)


def blocks(language: str) -> list[str]:
    return [text for name, text in BLOCKS if name == language]


def test_there_are_two_commands_and_both_exist():
    commands = blocks("sh")
    assert commands == ["sh run-main-job.sh\n", "sh run-tests.sh\n"]
    for command in commands:
        script = ROOT / command.split()[1]
        assert script.read_text(encoding="utf-8").startswith("#!/bin/sh\n")
        assert os.name == "nt" or script.stat().st_mode & stat.S_IXUSR


def test_the_python_lines_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    exec(compile("".join(blocks("python")), "README.md", "exec"), {})
    for name in ("three_fold.png", "three_fold.h5", "three_fold.html", "three_fold.gif"):
        assert (tmp_path / name).stat().st_size > 10_000


def test_the_first_twelve_lines_need_numpy_alone(tmp_path: Path):
    first = blocks("python")[0]
    assert len(first.strip().splitlines()) <= 12
    lines = [
        "import sys",
        "sys.modules.update(dict.fromkeys(['matplotlib', 'xarray', 'h5netcdf', 'h5py', 'PIL', 'imageio_ffmpeg']))",
        first,
    ]
    subprocess.run([sys.executable, "-c", "\n".join(lines)], cwd=tmp_path, check=True)
    assert (tmp_path / "three_fold.png").read_bytes().startswith(b"\x89PNG")
    with xarray.open_dataset(tmp_path / "three_fold.h5", engine="h5netcdf") as data:
        assert data.position.dims == ("frame", "node", "component")
