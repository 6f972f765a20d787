"""Nonlinear programs over a walk's parameters, for any solver."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from . import _halfstep
from .errors import InputError
from .experiment import Experiment
from .parameters import all_flags, takes_flags
from .tables import Table
from .walk import Walk, _flag, number, vector

__all__ = ["OverlapProgram", "Refinement"]


class Refinement(NamedTuple):
    """What came of ``OverlapProgram.refine``."""

    proved: bool
    """Whether the walk of x was proved for all times."""
    least_slack: float
    """The least slack that was sampled, of the margins' scales; negative: a margin is missed."""
    sentence: str
    """What refuses the walk; "" when it is proved."""


def csr(starts: np.ndarray, columns: np.ndarray, data: np.ndarray, size: int) -> Any:
    """A Jacobian: a scipy.sparse.csr_matrix where SciPy is there, else an array (m×size)."""
    rows = len(starts) - 1
    try:
        from scipy.sparse import csr_matrix
    except ImportError:
        dense = np.zeros((rows, size))
        dense[np.repeat(np.arange(rows), np.diff(starts)), columns] = data
        return dense
    # Copies: SciPy sorts indices in place.
    return csr_matrix((data, columns.copy(), starts.copy()), shape=(rows, size))


class OverlapProgram:
    """The nonlinear program of an experiment, for SciPy or a solver of your own::

        minimize  cost(x)   subject to   constraint_lower <= constraints(x) <= constraint_upper,
                                         lower <= x <= upper

    ``program``: "fastest" (cost: the duration [s]), "smooth" (duration and roughness, by ``weights``
    of the CoM's acceleration, its jerk and the feet's speed) or "safest" (minus the least slack,
    the last variable, with a duration of at most ``duration_limit`` [s]).

    The variables are the overlaps, each as a fraction of its natural bound, and on request the
    other families of parameters, by their keys under ``smoothing.optimizer`` in configs: ``heights``
    of all steps, ``durations`` of all half-steps and so on (``Walk.parameters``). Rows are slacks (margin less what is demanded, of the family's
    scale), gathered by half-step and family at ``instants`` times a half-step, smoothly
    (``sharpness``): at least 0 when every margin is met there. ``row_per_instant``: one row for
    each instant in place of one for each half-step.

    Rows see instants only. ``refine(x)`` proves the walk of x and makes the rows look where that
    failed; solve, refine and solve again until it is proved::

        program = hs.OverlapProgram(experiment, heights=True, durations=True)
        x = program.x0
        for _ in range(5):
            x = minimize(program.cost, x, jac=program.gradient, method="SLSQP", ...).x
            if program.refine(x).proved:
                break

    Outside of the bounds there are no walks; values go on linearly from the nearest point within,
    for solvers that look there. Not to be used from two threads at once.
    """

    @takes_flags
    def __init__(self, experiment: Experiment, program: str = "fastest", *, overlaps: bool = True,
                 instants: int = 32, sharpness: float = 60.0, row_per_instant: bool = False,
                 duration_limit: float = 0.0, weights: Sequence[float] = (0.05, 0.0, 0.0),
                 **flags: bool) -> None:
        if not isinstance(experiment, Experiment):
            raise TypeError(f"experiment: {type(experiment).__name__} (valid: an Experiment)")
        self._program = _halfstep.Program(experiment._experiment, program_options(
            program=program, overlaps=overlaps, instants=instants, sharpness=sharpness,
            row_per_instant=row_per_instant, duration_limit=duration_limit, weights=weights,
            **all_flags(flags)))
        self._pattern: tuple[np.ndarray, np.ndarray, int] | None = None

    @classmethod
    def _of(cls, handle: Any) -> OverlapProgram:
        program = cls.__new__(cls)
        program._program = handle
        program._pattern = None
        return program

    @property
    def names(self) -> list[str]:
        """The names of the variables (n), such as "overlap[0]"."""
        return self._program.names

    @property
    def x0(self) -> np.ndarray:
        """The planned motion, where every method begins (n)."""
        return self._program.x0

    @property
    def lower(self) -> np.ndarray:
        """The least values of x (n)."""
        return self._program.lower

    @property
    def upper(self) -> np.ndarray:
        """The largest values of x (n)."""
        return self._program.upper

    @property
    def constraint_lower(self) -> np.ndarray:
        """The least values of the rows (m)."""
        return self._program.constraint_lower

    @property
    def constraint_upper(self) -> np.ndarray:
        """The largest values of the rows (m), mostly inf."""
        return self._program.constraint_upper

    @property
    def sharpness(self) -> float:
        """How near a row comes to the least slack that it gathers; > 0."""
        return self._program.sharpness

    @sharpness.setter
    def sharpness(self, value: float) -> None:
        if not number("sharpness", value) > 0.0:
            raise InputError(f"sharpness: {value} (valid: above 0)")
        self._program.sharpness = value

    def cost(self, x: np.ndarray) -> float:
        """The cost at x (n)."""
        return self._program.cost(self._x(x))

    def gradient(self, x: np.ndarray) -> np.ndarray:
        """Its gradient (n), analytic."""
        return self._program.gradient(self._x(x))

    def constraints(self, x: np.ndarray) -> np.ndarray:
        """The rows (m)."""
        return self._program.constraints(self._x(x))

    def jacobian(self, x: np.ndarray) -> Any:
        """Their Jacobian (m×n), analytic: scipy.sparse.csr_matrix, an array without SciPy."""
        data = self._program.jacobian(self._x(x))
        if self._pattern is None:
            self._pattern = (*self._program.pattern, len(self.lower))
        starts, columns, size = self._pattern
        return csr(starts, columns, data, size)

    def watched(self) -> Table:
        """What each row of slacks is about: its ``half_step``, from 1, and its ``family``."""
        half_steps, families = self._program.watched
        return Table({"half_step": np.array(half_steps, dtype=int),
                      "family": np.array(families, dtype=object)})

    def walk(self, x: np.ndarray) -> Walk:
        """The walk of a point within the bounds; a ValueError outside."""
        return Walk(self._program.walk(self._x(x)))

    def to_x(self, walk: Walk) -> np.ndarray:
        """The point of a walk of the same half-steps (n); what is not a variable is left out."""
        if not isinstance(walk, Walk):
            raise TypeError(f"walk: {type(walk).__name__} (valid: a Walk)")
        return self._program.to_x(walk._walk)

    def refine(self, x: np.ndarray) -> Refinement:
        """Proves the walk of x for all times, and makes the rows look where that failed and where
        slacks are small. Rows grow sharper when it was proved, and keep more in reserve when not.
        With ``row_per_instant`` the number of rows changes."""
        self._pattern = None
        return Refinement(*self._program.refine(self._x(x)))

    def _x(self, x: Any) -> np.ndarray:
        return vector("x", x)

    def __repr__(self) -> str:
        return (f"<halfstep.OverlapProgram: {len(self.lower)} variables, "
                f"{len(self.constraint_lower)} rows>")


def program_options(**options: Any) -> dict[str, Any]:
    """The options of a program, checked."""
    checked: dict[str, Any] = {}
    for name, value in options.items():
        if name == "program":
            if not isinstance(value, str):
                raise TypeError(f"program: {type(value).__name__} (valid: text)")
            checked[name] = value
        elif name == "weights":
            weights = vector("weights", value, 3)
            if (weights < 0.0).any():
                raise InputError("weights: below 0 (valid: 0 or more)")
            checked[name] = list(weights)
        elif name == "instants":
            if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
                raise TypeError(f"instants: {type(value).__name__} (valid: an integer)")
            if not 1 <= value <= 1000:
                raise InputError(f"instants: {value} (valid: 1 ... 1000)")
            checked[name] = int(value)
        elif name in ("sharpness", "duration_limit"):
            amount = number(name, value)
            if amount < 0.0 or (name == "sharpness" and amount == 0.0):
                raise InputError(f"{name}: {value} (valid: above 0)")
            checked[name] = amount
        else:
            checked[name] = _flag(name, value)
    return checked
