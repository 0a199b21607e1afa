"""Everything that Curveflow raises: one class per kind of mistake, each under a built-in class."""


class CurveflowError(Exception):
    """Base of all errors of this package."""


class SceneError(CurveflowError, ValueError):
    """A scene cannot be read or is not valid.

    The message names every key at fault, its line and value, what is allowed and one thing to try.
    """


class SetupError(SceneError):
    """A scene reads well, but its curve, densities and energy make no initial state."""


class LadderError(CurveflowError, ValueError):
    """A list of tolerances, or a number of nodes of the reference, is out of range."""


class TradeoffError(CurveflowError, RuntimeError):
    """A ladder of tolerances has nothing to be measured against: the scene itself or the reference failed."""


class StorageError(CurveflowError, OSError):
    """A file cannot be written, or is not a readable result file. A failed write leaves the target as it was."""


class ArrayError(CurveflowError, ValueError):
    """An array given to an operator cannot be used: the message names it, its shape or value, and what is allowed."""


class MissingExtraError(CurveflowError, ImportError):
    """A call needs a package that comes with an extra of this one; the message is the command that installs it."""


class BugError(CurveflowError, RuntimeError):
    """Curveflow broke an assumption of its own; please report it together with the scene."""
