import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", (ROOT / "docs/guide.md").read_text(encoding="utf-8"), re.M | re.S)


def test_the_python_blocks_run_with_the_scenes_of_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    for language, text in BLOCKS:
        if language == "toml":
            Path(text.split()[1]).write_text(text, encoding="utf-8")
    exec(compile("".join(text for language, text in BLOCKS if language == "python"), "guide.md", "exec"), {})


def test_the_commands_are_those_of_the_readme():
    listed = re.findall(r"^curveflow (\w+)", (ROOT / "README.md").read_text(encoding="utf-8"), re.M)
    shell = "".join(text for language, text in BLOCKS if language == "sh")
    used = re.findall(r"^curveflow (\w+)", shell, re.M)
    assert used and set(used) <= set(listed)
