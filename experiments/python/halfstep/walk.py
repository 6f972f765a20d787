"""Walks, their margins and certificates."""

from __future__ import annotations

import math
import numbers
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from . import _halfstep
from .errors import InputError
from .parameters import describes
from .place import NotCovered, Robot
from .tables import Table, of_arrays, of_text

__all__ = ["Certificate", "MarginGradients", "Sensitivities", "Walk"]

QUANTITIES = ("com_x", "com_y", "zmp_x", "zmp_y", "waist_yaw",
              "left_foot_x", "left_foot_y", "left_foot_z", "left_foot_yaw",
              "right_foot_x", "right_foot_y", "right_foot_z", "right_foot_yaw", "waist_z")


class Sensitivities(NamedTuple):
    """Derivatives of a walk's 14 quantities with respect to its parameters."""

    parameters: list[tuple[str, int]]
    """(family, index from 0) of each of the k parameters on which the instant depends."""
    value: np.ndarray
    """Of the quantities (k×14) [m or rad per the parameter's unit]."""
    velocity: np.ndarray
    """Of their first time derivatives (k×14)."""
    acceleration: np.ndarray
    """Of their second time derivatives (k×14)."""
    quantities: tuple[str, ...] = QUANTITIES
    """The names of the 14 quantities."""


class MarginGradients(NamedTuple):
    """The margins at one instant that are near their limits, with derivatives."""

    families: list[str]
    """Family of each of the r statements: "zmp", "joint", "clearance" ..."""
    margins: np.ndarray
    """Their values (r) [the family's unit]."""
    parameters: list[tuple[str, int]]
    """(family, index from 0) of each of the k parameters."""
    gradient: np.ndarray
    """d margin / d parameter (r×k)."""


class Certificate:
    """What is proved of a walk, for all times and not only for samples.

    ``status`` is "certified" (every demanded margin is kept at every instant), "violated" or
    "undecided"; ``sentence`` says the same with the margin that refuses it; ``rows`` is the proof,
    one interval of time and family a row, as certificate.csv of a run; ``not_covered`` lists what
    the proof does not speak of, each with the reason. True if certified.
    """

    def __init__(self, status: str, sentence: str, rows: Table,
                 not_covered: list[NotCovered]) -> None:
        self.status = status
        self.sentence = sentence
        self.rows = rows
        self.not_covered = not_covered

    @property
    def certified(self) -> bool:
        """Whether every demanded margin is proved."""
        return self.status == "certified"

    def __bool__(self) -> bool:
        return self.certified

    def __repr__(self) -> str:
        return f"<halfstep.Certificate {self.status}: {self.sentence}>"


class Walk:
    """A continuous walk: half-steps that overlap, at given parameters.

    Walks come from ``Experiment.planned``, ``Experiment.walk(overlaps=...)``, ``Result.walk`` and
    ``OverlapProgram.walk(x)``. A walk is a pure function of time on [0, duration]; half-step i
    begins at t_i with t_0 = 0, t_{i+1} = t_i + T_i - D_i, where T_i is its duration and D_i the
    overlap with the next one. It never changes, and owns all that it needs.

    Typical use::

        walk = hs.Experiment("bar_8cm").smooth("dichotomy").walk
        table = walk.sample(period=0.005)
        plt.plot(table["t_s"], table["zmp_y_m"])
        walk.margins(table["t_s"])["clearance_m"].min()
        walk.certify().status

    Positions are in the world W [m], yaws in rad, time in s. A foot's place is that of the centre
    of its sole.
    """

    def __init__(self, handle: Any) -> None:
        if not isinstance(handle, _halfstep.Walk):
            raise TypeError("a Walk is made by Experiment.planned, Experiment.walk(), Result.walk "
                            "or OverlapProgram.walk()")
        self._walk = handle

    @property
    def duration(self) -> float:
        """D = sum of T_i - sum of overlaps [s]."""
        return self._walk.duration

    @property
    def num_half_steps(self) -> int:
        """The number n of half-steps; there are n - 1 junctions and n / 2 steps."""
        return self._walk.num_half_steps

    @property
    def starts(self) -> np.ndarray:
        """When each half-step begins (n) [s]."""
        return self._walk.starts

    @property
    @describes
    def parameters(self) -> dict[str, np.ndarray]:
        """All parameters of the n half-steps:

        <families>
        """
        return self._walk.parameters

    @property
    def half_steps(self) -> Table:
        """One row a half-step, with the columns of half_steps.csv."""
        return of_text(self._walk.half_steps)

    @property
    def robot(self) -> Robot:
        """The robot that walks."""
        return Robot._of(self._walk.robot)

    def at(self, t: float, joints: bool = True) -> dict[str, Any]:
        """The walk at one time t [s]: the columns of ``sample`` as a dict of plain values."""
        return of_arrays(self._walk.sample(np.array([_time(t)]),
                                           _flag("joints", joints))).row(0)

    def sample(self, period: float | None = None, times: Sequence[float] | np.ndarray | None = None,
               joints: bool = True) -> Table:
        """Samples the walk, by default every 5 ms; the last row is at its end.

        Either ``period`` [s] > 0 or ``times`` (n) [s]; times outside of the walk read as its ends.
        The columns are those of trajectory.csv without margins: ``t_s``, ``half_step``,
        ``support``, CoM with velocity and acceleration, ZMP, waist, both feet, and with ``joints``
        the leg joints ``q_NAME_rad`` (NaN: the leg does not reach). Without ``joints`` no inverse
        kinematics is solved: a few times faster.
        """
        return of_arrays(self._walk.sample(self._times(period, times), _flag("joints", joints)))

    def margins(self, times: Sequence[float] | np.ndarray | None = None,
                period: float | None = None) -> Table:
        """The least margin of each family at each time: ``zmp_m``, ``joint_rad`` ... (n), positive
        is inside the limit, inf where there is no limit. By default every 5 ms.

        These are samples; ``certify`` proves what lies between. A clearance beyond the horizon
        (0.3 m) reads as that.
        """
        return of_arrays(self._walk.margins(self._times(period, times)))

    def sensitivities(self, t: float, hold: str = "half_step") -> Sensitivities:
        """Analytic derivatives of the 14 quantities at t [s] along all parameters that matter.

        ``hold="half_step"``: the instant keeps its name (half-step, time since it began), and moves
        with it when earlier parameters change. ``hold="time"``: at the same absolute time.
        """
        if hold not in ("half_step", "time"):
            raise InputError(f"hold: {hold!r} (valid: 'half_step', 'time')")
        return Sensitivities(*self._walk.sensitivities(_time(t), hold == "time"))

    def margin_gradients(self, t: float, cutoff: float = 1.5) -> MarginGradients:
        """All margins at t [s] that are nearer to what is demanded than ``cutoff`` (of the family's
        scale), each smooth by itself, and their derivatives at fixed (half-step, time since it
        began)."""
        cutoff = number("cutoff", cutoff)
        return MarginGradients(*self._walk.margin_gradients(_time(t), cutoff))

    def certify(self) -> Certificate:
        """Proves, or refutes, that every demanded margin is kept at every instant."""
        status, sentence, rows = self._walk.certify()
        return Certificate(status, sentence, of_text(rows),
                           [NotCovered(*one) for one in self._walk.not_covered])

    def _times(self, period: float | None, times: Any) -> np.ndarray:
        if times is not None:
            if period is not None:
                raise TypeError("period and times are both given (valid: one of them)")
            return vector("times", times)
        period = 0.005 if period is None else number("period", period)
        if not period > 0.0:
            raise InputError(f"period: {period} (valid: above 0 s)")
        if self.duration / period > 2e8:
            raise InputError(f"period: {period} makes more than 2e8 rows")
        full = np.arange(math.floor(self.duration / period * (1.0 - 1e-12)) + 1) * period
        return np.append(full, self.duration)

    def __repr__(self) -> str:
        return f"<halfstep.Walk of {self.num_half_steps} half-steps, {self.duration:.3f} s>"


def vector(name: str, values: Any, size: int | None = None) -> np.ndarray:
    """Finite numbers in one row (n), or a TypeError or ValueError that names them."""
    try:
        array = np.asarray(values, dtype=float)
    except OverflowError:
        raise InputError(f"{name}: a number beyond 1.8e308 (valid: finite numbers)") from None
    except (TypeError, ValueError):
        raise TypeError(f"{name}: not numbers (valid: an array of numbers)") from None
    if array.ndim != 1:
        raise InputError(f"{name}: shape {array.shape} (valid: one row of numbers)")
    if size is not None and len(array) != size:
        raise InputError(f"{name}: {len(array)} numbers (valid: {size})")
    if not np.isfinite(array).all():
        raise InputError(f"{name}: number {int(np.argmin(np.isfinite(array)))} is not finite")
    return np.ascontiguousarray(array)


def number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name}: {type(value).__name__} (valid: a number)")
    try:
        finite = float(value)
    except OverflowError:
        finite = math.inf
    if not math.isfinite(finite):
        raise InputError(f"{name}: {finite} (valid: a finite number)")
    return finite


def _time(t: Any) -> float:
    return number("t", t)


def _flag(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: {type(value).__name__} (valid: True or False)")
    return bool(value)
