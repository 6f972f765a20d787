"""What halfstep raises."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ["InputError", "SolveStopped"]


class InputError(ValueError):
    """A config, a robot, a scene or a run folder that cannot be taken as it is.

    ``complaints`` has one sentence for each mistake, as
    ``file:line:column: key: what is wrong (valid: ...)``; all mistakes are told at once.
    """

    def __init__(self, complaints: Iterable[str] | str) -> None:
        self.complaints: tuple[str, ...] = (
            (complaints,) if isinstance(complaints, str) else tuple(complaints))
        super().__init__("\n".join(self.complaints))


class SolveStopped(RuntimeError):
    """Says to a solver or smoother of yours that it is to end: by its effort, a limit, its
    deadline or Ctrl-C.

    Raised by the evaluations of the problem that it was given. There is no need to catch it: the
    best point that was evaluated, or the incumbent, is kept.
    """
