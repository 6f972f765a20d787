"""What methods of smoothing found."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .tables import Table, of_text
from .walk import Certificate, Walk

__all__ = ["Result"]


class Result:
    """What a method of smoothing found.

    Whatever the method does, ``walk`` was found feasible by the experiment's test if ``feasible``;
    ``judged_by`` says how that was asked: "certified" (for all times) or "sampled".
    """

    def __init__(self, found: Mapping[str, Any]) -> None:
        self.method: str = found["method"]
        """Its name."""
        self.walk = Walk(found["walk"])
        """The walk that it ended with."""
        self.status: str = found["status"]
        """"converged", "limit", "deadline" or "interrupted": the walk is the method's own.
        "no_improvement", "not_run", "invalid_input" or "failed": it is what it started from."""
        self.message: str = found["message"]
        """A sentence on the status."""
        self.feasible: bool = found["feasible"]
        """Whether the walk keeps every demanded margin."""
        self.judged_by: str = found["judged_by"]
        """What judged it, whatever was found: "certified" (for all times) or "sampled"."""
        self.cost: float = found["cost"]
        """By the program; for "fastest" the duration [s]."""
        self.wall: float = found["wall"]
        """The time that it took [s]."""
        self.instants: int = found["instants"]
        """How many instants of walks it evaluated."""
        self.effort: float = found["effort"]
        """Its work; 1 is about a second of one core of 2026."""
        self.repeatable: bool = found["repeatable"]
        """Whether the same call gives the same walk: neither the clock nor Ctrl-C ended it."""
        self._iterates = found["iterates"]
        self._overlaps = found["overlaps"]
        self._pareto = found["pareto"]

    @property
    def duration(self) -> float:
        """Of the walk [s]."""
        return self.walk.duration

    @property
    def parameters(self) -> dict[str, np.ndarray]:
        """Of the walk, as Walk.parameters."""
        return self.walk.parameters

    @property
    def iterates(self) -> Table:
        """Every candidate, with the columns of iterates.csv."""
        return of_text(self._iterates)

    @property
    def overlaps(self) -> Table | None:
        """One row a junction, with what holds it and what that costs: overlaps.csv."""
        return None if self._overlaps is None else of_text(self._overlaps)

    @property
    def pareto(self) -> list[tuple[float, float, Walk]]:
        """Of the program "pareto": (duration [s], proved least slack, walk) of each point."""
        return [(duration, slack, Walk(walk)) for duration, slack, walk in self._pareto]

    def certify(self) -> Certificate:
        """The certificate of the walk (Walk.certify)."""
        return self.walk.certify()

    def __repr__(self) -> str:
        return f"<halfstep.Result of {self.method}: {self.duration:.3f} s, {self.status}>"
