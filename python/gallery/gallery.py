"""Draw the figures of the paper, and some more, from the shipped scenes: python gallery.py [-o FOLDER] [NAME…]"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

from incompressible_limit import incompressible_limit
from settling import adhesion, blend, figure_eight
from style import SETTINGS
from three_flows import three_flows
from three_fold import three_fold, three_fold_sharp

FIGURES: dict[str, Callable[[], Figure]] = {
    figure.__name__: figure
    for figure in (three_fold, three_fold_sharp, three_flows, incompressible_limit, figure_eight, adhesion, blend)
}


def draw(name: str, folder: Path) -> Path:
    """Draw one figure of :data:`FIGURES` into ``folder`` and return its path."""
    path = folder / f"{name}.png"
    with plt.rc_context(SETTINGS):
        figure = FIGURES[name]()
        figure.savefig(path)
        plt.close(figure)
    _shrink(path)
    return path


def _shrink(path: Path) -> None:
    """Keep 256 colours, which a drawing can do with, in a third of the space."""
    with Image.open(path) as image:
        few = image.convert("RGB").quantize(256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    few.save(path, optimize=True)


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw what the command line asks for, and print the paths."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where to (default: here)")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"which (default: all): {', '.join(FIGURES)}")
    options = parser.parse_args(arguments)
    unknown = [name for name in options.names if name not in FIGURES]
    if unknown:
        parser.error(f"no figure called {unknown[0]!r}; there are {', '.join(FIGURES)}")
    options.output.mkdir(parents=True, exist_ok=True)
    for name in options.names or FIGURES:
        print(draw(name, options.output))


if __name__ == "__main__":
    main()
