"""The `curveflow` command, also as `python -m curveflow`."""

import signal
import sys

from . import _curveflow


def main() -> None:
    """Does what the command line asks for, and exits with its code."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # the command has a handler of its own, which keeps what there is
    sys.exit(_curveflow.command(["curveflow", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
