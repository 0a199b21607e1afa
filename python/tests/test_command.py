"""The `curveflow` command that comes with the package is the program."""

import os
import signal
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

import pytest

import curveflow as cf

MODULE = [sys.executable, "-m", "curveflow"]


def call(*arguments: str, folder: Path, command: list[str] = MODULE) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*command, *arguments], cwd=folder, capture_output=True, text=True, check=False)


def test_a_run_leaves_its_result(tmp_path: Path) -> None:
    done = call("run", "circle", "--quiet", folder=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert cf.open(tmp_path / "circle.h5").status == "end-time"


def test_exit_codes_and_messages_are_those_of_the_program(tmp_path: Path) -> None:
    usage = call("run", "--no-such-option", folder=tmp_path)
    assert usage.returncode == 2
    assert "Usage: curveflow run" in usage.stderr
    scene = call("check", "circle", "--set", "time.end=-1", folder=tmp_path)
    assert scene.returncode == 3
    assert scene.stderr.startswith("error:")
    assert call("info", "none.h5", folder=tmp_path).returncode == 5
    assert call("--version", folder=tmp_path).stdout.startswith("curveflow ")


def test_the_script_is_installed(tmp_path: Path) -> None:
    script = Path(sysconfig.get_path("scripts")) / "curveflow"
    assert "three_fold" in call("scenes", folder=tmp_path, command=[str(script)]).stdout


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for one process")
def test_ctrl_c_keeps_what_there_is(tmp_path: Path) -> None:
    change = ["--set", "accuracy.tolerance=1e-8", "--set", "accuracy.nodes=2048"]
    run = subprocess.Popen([*MODULE, "run", "three_fold_sharp", *change, "--checkpoint", "0.01"], cwd=tmp_path)
    while not list(tmp_path.glob("three_fold_sharp.h5.checkpoint-*")):
        assert run.poll() is None
        time.sleep(0.01)
    run.send_signal(signal.SIGINT)
    assert run.wait() == 6
    assert cf.open(tmp_path / "three_fold_sharp.h5").status == "interrupted"
