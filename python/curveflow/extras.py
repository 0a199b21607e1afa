"""Packages that are needed by some calls only, and imported there."""

from importlib import import_module
from typing import Any

from .errors import MissingExtraError


def need(module: str, purpose: str, extra: str) -> Any:
    """Import a module of an extra of this package.

    Raises:
        MissingExtraError: it, or something that it needs, is not installed.
    """
    try:
        return import_module(module)
    except ImportError as error:
        name = module.partition(".")[0]
        package = {"PIL": "Pillow"}.get(name, name.replace("_", "-"))
        raise MissingExtraError(f'{purpose} needs {package}: pip install "curveflow[{extra}]"') from error
