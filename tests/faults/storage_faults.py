"""Kills a run at every call that changes a file, and makes each of these calls fail; then goes on with the run.

Needs strace (Linux). From the root of the repository:

    cargo build --release -p flow-cli
    python3 tests/faults/storage_faults.py target/release/curveflow

Each trial starts from a run that was stopped by its limit. `resume` is then killed, or refused, at the n-th call; a second
`resume` without faults must end with the same energies as the unbroken run. After a refusal the command must have ended by
itself, with exit code 5 and a message, and the result of the run before must still be readable.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from itertools import count, product
from pathlib import Path

CALLS = ("write", "pwrite64", "fsync", "fdatasync", "ftruncate", "rename", "renameat", "link", "linkat", "unlink", "unlinkat")
FAULTS = ("signal=SIGKILL", "error=ENOSPC", "error=EIO", "error=EROFS")


def call(program: Path, folder: Path, *arguments: str, fault: str = "") -> subprocess.CompletedProcess[str]:
    command = [str(program), *arguments]
    if fault:
        command = ["strace", "-f", "-qq", "-o", "trace.txt", "-e", f"inject={fault}", *command]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=120)


def energies(program: Path, folder: Path) -> tuple[float, float, int]:
    info = json.loads(call(program, folder, "info", "out.h5", "--json").stdout)
    return info["energy_last"], info["length_last"], info["steps"]


def main() -> None:
    program = Path(sys.argv[1]).resolve()
    scene = Path(__file__).parents[2] / "scenes" / "three_fold.toml"
    with tempfile.TemporaryDirectory() as name:
        start, trial = Path(name) / "start", Path(name) / "trial"
        start.mkdir()
        shutil.copy(scene, start / "scene.toml")
        whole = call(program, start, "run", "scene.toml", "-o", "out.h5", "-q")
        assert whole.returncode == 0, whole.stderr
        expected = energies(program, start)
        stopped = call(program, start, "run", "scene.toml", "-o", "out.h5", "--replace", "--max-wall", "0.01")
        assert stopped.returncode == 6, stopped.stderr
        counts = dict.fromkeys(FAULTS, 0)
        for fault, name in product(FAULTS, CALLS):
            for number in count(1):
                shutil.rmtree(trial, ignore_errors=True)
                shutil.copytree(start, trial)
                injected = f"{name}:{fault}:when={number}"
                hit = call(program, trial, "resume", "out.h5", "-q", "--checkpoint", "0.005", fault=injected)
                trace = (trial / "trace.txt").read_text()
                killed = hit.returncode < 0 or hit.returncode == 137
                if not killed and "INJECTED" not in trace:
                    break
                check(program, trial, hit, injected, said="write(2" not in trace or "(INJECTED)" not in trace.split("write(2", 1)[1])
                again = call(program, trial, "run", "scene.toml", "-o", "out.h5", "--resume", "-q")
                assert again.returncode == 0, (injected, again.stderr)
                assert energies(program, trial) == expected, injected
                counts[fault] += 1
        print(", ".join(f"{count} × {fault}" for fault, count in counts.items()), "and nothing lost")


def check(program: Path, trial: Path, hit: subprocess.CompletedProcess[str], fault: str, said: bool) -> None:
    """The result of before is whole; a refusal ends the command with a message, if the message was not refused itself."""
    readable = call(program, trial, "info", "out.h5", "--json")
    assert readable.returncode == 0, (fault, readable.stderr)
    if ":error" in fault:
        # Rubbish that cannot be removed does no harm.
        assert hit.returncode in (0, 5), (fault, hit.returncode, hit.stderr)
        assert not said or hit.returncode == 0 or "error: " in hit.stderr, (fault, hit.stderr)


if __name__ == "__main__":
    main()
