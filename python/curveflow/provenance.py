"""Where a result comes from."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Provenance:
    """What made a result; the scene is in ``result.scene``, the counters of work in ``result.stats``."""

    version: str
    """Version of Curveflow."""
    commit: str | None
    """Its commit, with ``-dirty`` if files differed from it; ``None`` if it was not built from a repository."""
    machine: str
    """System, architecture and number of processors."""
    integration_seconds: float
    """Wall time of the integration, without set-up, frames and callbacks."""
    citation: str
    """What to cite."""
