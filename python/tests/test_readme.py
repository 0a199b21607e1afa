import os
import re
import stat
from pathlib import Path

import pytest

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
    first, second = blocks("python")
    monkeypatch.chdir(tmp_path)
    exec(compile(first + second, "README.md", "exec"), {})
    assert (tmp_path / "three_fold.png").stat().st_size > 10_000
    assert (tmp_path / "three_fold.h5").exists()
