import subprocess
import sys
from pathlib import Path


def test_the_stubs_match_the_extension(tmp_path: Path):
    command = [sys.executable, "-m", "mypy.stubtest", "curveflow"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
