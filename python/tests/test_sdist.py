"""The source distribution: it holds every file that its sources include, and what its tests read."""

import posixpath
import re
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
INCLUDED = re.compile(r'include_(?:str|bytes)!\("([^"]+)"\)')


def test_sdist_is_complete(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "maturin", "sdist", "--out", str(tmp_path)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    (archive,) = tmp_path.iterdir()
    with tarfile.open(archive) as files:
        texts = {
            name: content.read().decode()
            for name in files.getnames()
            if name.endswith(".rs") and (content := files.extractfile(name)) is not None
        }
        names = set(files.getnames())
    included = {
        posixpath.normpath(posixpath.join(posixpath.dirname(name), path))
        for name, text in texts.items()
        for path in INCLUDED.findall(text)
    }
    assert len(included) > 20
    assert included <= names, f"not in the sdist: {sorted(included - names)}"
    (top,) = {name.split("/")[0] for name in names}
    read_by_tests = ["docs/guide.md", "docs/gallery.md", "README.md", "run-main-job.sh", "scenes/circle.toml"]
    licences = ["LICENSE", "licenses/LICENSE_HDF5", "crates/flow-core/assets/LICENSE_DEJAVU"]
    assert {f"{top}/{path}" for path in read_by_tests + licences} <= names
