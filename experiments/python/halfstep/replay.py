"""Walks on a simulated robot, and controllers of your own."""

from __future__ import annotations

import json
import numbers
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from . import _halfstep
from .errors import InputError
from .tables import Table, of_text
from .walk import number

__all__ = ["Measured", "PlannedInstant", "Replay"]


class Measured(NamedTuple):
    """What the robot measures of itself at an instant. Rows of two: left, right."""

    t: float
    """When it was measured, by the time of the walk [s]."""
    q: np.ndarray
    """Angles of the legs' joints (2×6) [rad]."""
    speeds: np.ndarray
    """Their speeds (2×6) [rad/s]."""
    R_WB: np.ndarray
    """IMU: the waist's orientation in W (3×3)."""
    turn_B: np.ndarray
    """IMU: the waist's angular velocity, in B (3) [rad/s]."""
    forces: np.ndarray
    """On each sole along its z (2) [N]; 0: it carries nothing."""
    centres: np.ndarray
    """Centre of pressure in each sole's frame (2×2) [m]."""


class PlannedInstant(NamedTuple):
    """What is planned for an instant. Rows of two: left, right."""

    t: float
    """[s]"""
    q: np.ndarray
    """Angles of the legs' joints (2×6) [rad]."""
    speeds: np.ndarray
    """Their speeds (2×6) [rad/s]."""
    torques: np.ndarray
    """What the motors then give (2×6) [N m]."""
    X_WB: np.ndarray
    """Pose of the waist (4×4) [m]."""
    X_WL: np.ndarray
    """Pose of the left sole's centre (4×4) [m]."""
    X_WR: np.ndarray
    """The same of the right one."""
    stands: tuple[bool, bool]
    """Whether a sole carries."""
    com: np.ndarray
    """CoM of the whole robot in W (3) [m]."""
    com_velocity: np.ndarray
    """(3) [m/s]"""
    zmp: np.ndarray
    """ZMP of the whole robot in W, in the plane z = zmp_height (2) [m]."""
    force: float
    """That the floor gives, along z [N]."""
    zmp_height: float
    """Of the sole that stands, or halfway between two, in W [m]."""
    tilt: np.ndarray
    """How far the ZMP goes aside for each metre of that plane's height (2)."""
    levels: tuple[float, float]
    """Where each sole stands or will stand next: z in W [m]."""


class Replay:
    """A walk that was played on a simulated robot. True when the robot stays up in all simulations."""

    def __init__(self, told: dict[str, Any], table: Table) -> None:
        self.told: dict[str, Any] = told
        """What ``halfstep replay --json`` says of the walk."""
        self.table: Table = table
        """replay.csv, a row each 5 ms; with seeds replays.csv, a row a seed."""

    @property
    def stands(self) -> int:
        """In how many simulations the robot stays up."""
        return int(self.told.get("stands", self.told.get("stayed_up")))

    @property
    def of(self) -> int:
        """How many simulations there are."""
        return int(self.told.get("of", 1))

    def __bool__(self) -> bool:
        return self.stands == self.of

    def __repr__(self) -> str:
        return f"<halfstep.Replay {self.told['method']}: stands in {self.stands} of {self.of}>"


def play(run: str, method: str, controller: Any, servos: Sequence[float] | None,
         ankle: Sequence[float] | None, torque_limits: bool, seeds: int | None,
         sensor_delay: float, sensor_seed: int | None, suggest_tube: bool,
         progress: Callable[[str, float], None] | None) -> Replay:
    """``Run.replay``; ``run`` is the folder."""
    options = {"servos": _spring("servos", servos), "ankle": _spring("ankle", ankle),
               "torque_limits": bool(torque_limits), "suggest_tube": bool(suggest_tube),
               "seeds": _whole("seeds", seeds, 1, _halfstep.most_seeds),
               "sensor_seed": _whole("sensor_seed", sensor_seed, 0, 2**64 - 1),
               "sensor_delay": number("sensor_delay", sensor_delay)}
    if not 0.0 <= options["sensor_delay"] <= 1.0:
        raise InputError(f"sensor_delay: {sensor_delay} (valid: 0 ... 1 s)")
    text, table = _halfstep.replay(run, method, _controller(controller), options, progress)
    return Replay(json.loads(text), of_text(table))


def _controller(controller: Any) -> Any:
    """A name, or a function without arguments that makes a function of tuples."""
    names = ["none", *_halfstep.controllers()]
    if controller is None or isinstance(controller, str):
        if (controller or "none") not in names:
            raise InputError(f"controller: {controller!r} (valid: {', '.join(names)}, or a function "
                             "without arguments that makes one)")
        return controller or "none"
    if not callable(controller):
        raise TypeError(f"controller: {type(controller).__name__} (valid: a name, or a function "
                        "without arguments that makes one, such as its class)")
    return lambda: _Commands(controller())


class _Commands:
    """Calls a controller with named values, and checks what it returns."""

    def __init__(self, controller: Any) -> None:
        if not callable(getattr(controller, "command", None)):
            raise TypeError(f"controller: {type(controller).__name__} (valid: an object with "
                            "command(measured, then, next))")
        self._controller = controller

    def __call__(self, measured: tuple, then: tuple, planned: tuple) -> tuple:
        returned = self._controller.command(Measured(*measured), PlannedInstant(*then),
                                            PlannedInstant(*planned))
        if not isinstance(returned, (tuple, list)) or len(returned) != 2:
            raise TypeError(f"command: returned {type(returned).__name__} (valid: joint angles and "
                            "joint speeds)")
        return tuple(_legs(name, values) for name, values in zip(("angles", "speeds"), returned))


def _legs(what: str, values: Any) -> np.ndarray:
    try:
        legs = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"command: {what} are no numbers (valid: 2×6 of them)") from None
    if legs.shape != (2, 6):
        raise InputError(f"command: {what} of shape {legs.shape} (valid: (2, 6))")
    if not np.isfinite(legs).all():
        raise InputError(f"command: {what} are not finite (valid: finite numbers)")
    return legs


def _spring(what: str, given: Sequence[float] | None) -> list[float]:
    if given is None:
        return []
    if isinstance(given, str) or not isinstance(given, Sequence):
        raise TypeError(f"{what}: {type(given).__name__} (valid: K, D)")
    return [number(what, value) for value in given]


def _whole(what: str, given: int | None, least: int, most: int) -> int | None:
    if given is None:
        return None
    if not isinstance(given, numbers.Integral) or isinstance(given, bool):
        raise TypeError(f"{what}: {type(given).__name__} (valid: an integer)")
    if not least <= given <= most:
        raise InputError(f"{what}: {given} (valid: {least} ... {most})")
    return int(given)
