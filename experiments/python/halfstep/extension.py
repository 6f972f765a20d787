"""Smoothers and solvers of your own, as methods beside those built in."""

from __future__ import annotations

import math
import numbers
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _halfstep
from .config import text
from .errors import InputError, SolveStopped
from .parameters import given_values, takes_values
from .program import OverlapProgram, csr, program_options
from .walk import Walk, number, vector

__all__ = ["SmoothingProblem", "SolverProblem", "register_smoother", "register_solver"]


class _Task:
    _task: Any

    @property
    def stopped(self) -> bool:
        """Whether your function is to return: Ctrl-C came, its effort is used or the deadline
        passed."""
        return self._task.stopped

    @property
    def remaining(self) -> float:
        """Until the deadline [s]; inf: there is none."""
        return self._task.remaining


class SmoothingProblem(_Task):
    """What a smoother of yours is given. It is over when your function returns."""

    def __init__(self, task: Any) -> None:
        if not isinstance(task, _halfstep.SmoothingTask):
            raise TypeError("a SmoothingProblem is made for a function that is registered")
        self._task = task

    @property
    def incumbent(self) -> Walk:
        """The shortest walk that was proved so far; at first the planned motion."""
        return Walk(self._task.incumbent)

    @property
    def duration(self) -> float:
        """Of the incumbent [s]."""
        return self._task.duration

    @property
    def options(self) -> dict[str, Any]:
        """Your own options by their names: what the config says, else their defaults."""
        return self._task.options

    def program(self, program: str | None = None, **options: Any) -> OverlapProgram:
        """The overlap program of the walk: that of ``smoothing.optimizer`` in the config, or with
        the options of OverlapProgram."""
        if program is None and not options:
            return OverlapProgram._of(self._task.program({}))
        return OverlapProgram._of(self._task.program(
            program_options(program=program or "fastest", **options)))

    @takes_values
    def walk(self, *values: Sequence[float] | None, **named: Sequence[float] | None) -> Walk:
        """The walk at given parameters; what is not given is the incumbent's.

        For n half-steps:

        <families>
        """
        sizes = {name: len(row) for name, row in self.incumbent.parameters.items()}
        return Walk(self._task.walk({
            name: list(vector(name, row, sizes[name]))
            for name, row in given_values(self.walk, values, named).items()}))

    def propose(self, walk: Walk) -> bool:
        """Proves a walk by the experiment's test, unless it lasts no shorter than the incumbent.
        True: it is the incumbent now. Whatever is proposed, nothing unproved is returned. Raises
        SolveStopped when the method is to end; there is no need to catch it."""
        if not isinstance(walk, Walk):
            raise TypeError(f"walk: {type(walk).__name__} (valid: a Walk)")
        if self._task.running and self._task.stopped:
            raise SolveStopped("the method is to end")
        return self._task.propose(walk._walk)

    def tell(self, done: float) -> None:
        """Tells the progress, a fraction from 0 to 1."""
        self._task.tell(min(1.0, max(0.0, number("done", done))))


class SolverProblem(_Task):
    """What a solver of yours is given: minimize ``cost(x)`` subject to ``constraint_lower <=
    constraints(x) <= constraint_upper`` and ``lower <= x <= upper``. Evaluations are counted and
    raise SolveStopped when the solve is to end; the best point that was evaluated is kept."""

    def __init__(self, task: Any) -> None:
        if not isinstance(task, _halfstep.SolvingTask):
            raise TypeError("a SolverProblem is made for a function that is registered")
        self._task = task
        self.lower: np.ndarray = task.lower
        """The least values of x (n)."""
        self.upper: np.ndarray = task.upper
        """The largest values of x (n)."""
        self.constraint_lower: np.ndarray = task.constraint_lower
        """The least values of the rows (m)."""
        self.constraint_upper: np.ndarray = task.constraint_upper
        """The largest values of the rows (m)."""
        rows, columns = task.pattern
        self._order = np.argsort(rows, kind="stable")
        self._starts = np.searchsorted(np.asarray(rows)[self._order],
                                       np.arange(len(self.constraint_lower) + 1)).astype(np.int32)
        self._columns = np.asarray(columns, dtype=np.int32)[self._order]

    def cost(self, x: np.ndarray) -> float:
        """The cost at x (n)."""
        return self._task.cost(vector("x", x))

    def gradient(self, x: np.ndarray) -> np.ndarray:
        """Its gradient (n)."""
        return self._task.gradient(vector("x", x))

    def constraints(self, x: np.ndarray) -> np.ndarray:
        """The rows (m)."""
        return self._task.constraints(vector("x", x))

    def jacobian(self, x: np.ndarray) -> Any:
        """Their Jacobian (m×n): scipy.sparse.csr_matrix, an array without SciPy."""
        data = self._task.jacobian(vector("x", x))[self._order]
        return csr(self._starts, self._columns, data, len(self.lower))


def register_smoother(name: str, function: Callable[[SmoothingProblem], Any],
                      meaning: str = "",
                      options: Mapping[str, Any] | None = None) -> None:
    """Makes a function a method of smoothing, by name: for ``Experiment.smooth(name)`` and in
    ``smoothing.methods`` of experiments that this program runs. A later one of the same name takes
    its place; a name of a method that is built in is a ValueError.

    ``function(problem)`` proposes walks; what it returns is not looked at. A loop that proposes
    nothing has to look at ``problem.stopped``, or Ctrl-C waits for it. The families that it
    moves, if it uses ``problem.program()``, its effort and its deadline are up to
    ``smoothing.optimizer``. It is called in another thread than that of ``smooth``.

    ``options`` are keys of your own, under ``smoothing.own.NAME`` in configs, which are read as
    strictly as all others: name to default, True or False, a number or text, or to a dict with
    ``default``, ``meaning``, ``unit``, ``min`` and ``max`` of a number, ``choices`` of a text.
    ``problem.options`` has their values::

        hs.register_smoother("mine/scale", scale_all, options={
            "rounds": {"default": 6, "min": 1, "max": 50, "meaning": "of the bisection"}})
        experiment.smooth("mine/scale", rounds=9)
    """
    _require(name, function)
    if not isinstance(meaning, str):
        raise TypeError(f"meaning: {type(meaning).__name__} (valid: text)")
    text("meaning", meaning)

    def call(task: Any) -> None:
        try:
            function(SmoothingProblem(task))
        except SolveStopped:
            pass  # the incumbent is the result

    _halfstep.register_smoother(name, meaning or _first_line(function), _declared(options), call)


def register_solver(name: str,
                    function: Callable[[SolverProblem, np.ndarray], np.ndarray]) -> None:
    """Makes a function a solver of overlap programs, by name, and with it a method of smoothing
    beside ``ipopt`` or ``halfstep/sqp``: rounds of solving, proving and refining the program, a
    dichotomy before and after.

    ``function(problem, x0)`` returns x (n). A later one of the same name takes its place; a name
    of a solver that is built in is a ValueError. It is called in another thread than ``smooth``.
    """
    _require(name, function)
    _halfstep.register_solver(name, lambda task, x0: vector(
        f"what solver {name} returned", function(SolverProblem(task), x0), len(x0)))


def _require(name: Any, function: Any) -> None:
    if not isinstance(name, str):
        raise TypeError(f"name: {type(name).__name__} (valid: text)")
    if not name or not name.replace("/", "").replace("_", "").isalnum() or not name.isascii():
        raise InputError(f"name: {name!r} (valid: letters, digits, '_' and '/')")
    if not callable(function):
        raise TypeError(f"function: {type(function).__name__} (valid: a function)")


def _declared(options: Any) -> list[dict[str, Any]]:
    if options is not None and not isinstance(options, Mapping):
        raise TypeError(f"options: {type(options).__name__} (valid: a dict)")
    return [_option(name, given) for name, given in (options or {}).items()]


def _option(name: Any, given: Any) -> dict[str, Any]:
    if not isinstance(name, str) or not name.isidentifier() or not name.isascii():
        raise InputError(f"options: {name!r} (valid: a name of letters, digits and '_')")
    if name.endswith("_deg"):
        raise InputError(f"options: {name} (valid: an angle in radians, NAME_rad)")
    given = dict(given) if isinstance(given, Mapping) else {"default": given}
    option = {"name": name, "meaning": "", "unit": "", "min": -math.inf, "max": math.inf,
              "choices": []} | given
    what = f"options: {name}"
    for key in given:
        if key not in ("default", "meaning", "unit", "min", "max", "choices"):
            raise InputError(f"{what}: {key!r} (valid: default, meaning, unit, min, max, choices)")
    for key in ("meaning", "unit"):
        text(f"{what}: {key}", _typed(f"{what}: {key}", option[key], str, "text"))
    option["choices"] = [text(f"{what}: choices", _typed(f"{what}: choices", choice, str, "texts"))
                         for choice in _typed(f"{what}: choices", option["choices"],
                                              (list, tuple), "a list of texts")]
    for key in ("min", "max"):
        if key in given:
            option[key] = number(f"{what}: {key}", option[key])
    default = option.get("default")
    if isinstance(default, str):
        text(f"{what}: default", default)
        if option["choices"] and default not in option["choices"]:
            raise InputError(f"{what}: default {default!r} (valid: {', '.join(option['choices'])})")
    elif isinstance(default, (bool, np.bool_)):
        option["default"] = bool(default)
    else:
        value = number(f"{what}: default", default)
        whole = isinstance(default, numbers.Integral)
        least, most = (max(option["min"], -2**31), min(option["max"], 2**31 - 1)) if whole else (
            option["min"], option["max"])
        if not least <= value <= most:
            raise InputError(f"{what}: default {default} (valid: from {least:g} to {most:g})")
        option["default"] = int(default) if whole else value
    return option


def _typed(what: str, value: Any, kind: Any, valid: str) -> Any:
    if not isinstance(value, kind):
        raise TypeError(f"{what}: {type(value).__name__} (valid: {valid})")
    return value


def _first_line(function: Any) -> str:
    return (getattr(function, "__doc__", None) or "a Python function").strip().splitlines()[0]
