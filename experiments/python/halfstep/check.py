"""Anybody's joint trajectories, proved between their knots."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from . import _halfstep
from .config import path_of_robot, text
from .errors import InputError
from .place import Scene
from .walk import number

__all__ = ["Check", "Finding", "check"]

_ARRAYS = ("times", "joints", "positions", "velocities", "accelerations", "base",
           "base_velocities")
_COLUMNS = {"base": 7, "base_velocities": 6}


class Finding(NamedTuple):
    """One statement about a trajectory: for all t, or not."""

    kind: str
    """"joint limits", "clearance" … as in experiments/check.md."""
    subject: str
    """A joint, a link, or "A - B" of two bodies."""
    proved: bool
    """At least ``demanded`` is kept at every time."""
    demanded: float
    """[rad, m, or of the limit's unit]"""
    least: float
    """Proved: no less is kept at any time. Else about what is kept at ``at``."""
    at: float
    """Where the least is kept, or was not proved [s]."""
    at_knots: float | None
    """Of what is not proved: the least at the trajectory's own knots."""
    holds: float | None
    """Of a contact, the ground or friction, not proved: the least limit that is [m, rad, 1]."""


class Check:
    """What was found of a trajectory. True when all of it is proved."""

    def __init__(self, told: dict[str, Any]) -> None:
        self.told: dict[str, Any] = told
        """What ``halfstep check --json`` says."""
        self.findings: list[Finding] = [
            Finding(one["kind"], one["subject"], one["proved"], _or_inf(one["demanded"]),
                    _or_inf(one["least"]), one["at_s"], one.get("at_knots"), one.get("holds"))
            for one in told["findings"]]
        """All statements, by kind, those that are not proved first."""

    @property
    def missed(self) -> list[Finding]:
        """The statements that are not proved."""
        return [one for one in self.findings if not one.proved]

    @property
    def not_covered(self) -> list[str]:
        """What was not looked at, as sentences."""
        return self.told["not_covered"]

    def __bool__(self) -> bool:
        return bool(self.told["proved"])

    def __repr__(self) -> str:
        proved = len(self.findings) - len(self.missed)
        return f"<halfstep.Check: {proved} of {len(self.findings)} statements are proved>"


def check(trajectory: Any, positions: Any = None, *, robot: str | os.PathLike,
          joints: Sequence[str] | None = None, velocities: Any = None, accelerations: Any = None,
          base: Any = None, base_velocities: Any = None,
          scene: str | os.PathLike | Mapping[str, Any] | Scene | None = None,
          interpolation: str | None = None, clearance: float = 0.0, self_clearance: float = 0.0,
          acceleration: float | None = None, ground: float | None = None,
          contacts: Sequence[Any] = (), contact_distance: float = 0.001,
          contact_angle: float = 0.01, zmp: float | None = None, friction: float | None = None,
          ignore: Sequence[tuple[str, str]] = (),
          packages: Mapping[str, str | os.PathLike] | None = None,
          progress: Callable[[str, float], None] | None = None) -> Check:
    """Proves what a joint trajectory keeps at every time between its knots (experiments/check.md).

        hs.check("path.csv", robot="arm.urdf", scene="table.yaml", clearance=0.01)
        hs.check(times, q, joints=names, base=poses, robot="g1.urdf", ground=0.005,
                 contacts=[("left_foot", 0.0, 0.8)])

    ``trajectory``: a .csv, .yaml or .npz file, or the knots' times (n) [s]; then ``positions``,
    ``velocities`` and ``accelerations`` (n×joints), in the order of ``joints``, and ``base``, if the
    root moves (n×7): x, y, z [m], and its quaternion w, x, y, z; ``base_velocities`` (n×6): linear
    [m/s], then angular [rad/s], both in the world's frame. A .npz has arrays of these names: times,
    joints, positions …. ``robot``: a URDF, a robot file or a shipped robot's name. The others
    are options of ``halfstep check``; ``contacts``: links, or (link, from, to). Raises InputError.
    """
    given = dict(zip(_ARRAYS, (trajectory, joints, positions, velocities, accelerations, base,
                               base_velocities)))
    if isinstance(trajectory, (str, os.PathLike)):
        if any(given[name] is not None for name in _ARRAYS[1:]):
            raise InputError("positions: are in the file (valid: a file, or arrays)")
        path = text("trajectory", os.fspath(trajectory))
        source = _arrays(_npz(path), path) if path.endswith(".npz") else path
    else:
        source = _arrays(given, "trajectory")
    if interpolation not in (None, "linear", "cubic", "quintic"):
        raise InputError(f"interpolation: {interpolation!r} (valid: linear, cubic, quintic)")
    if scene is not None and not isinstance(scene, Scene):
        scene = Scene(scene)
    options = {
        "interpolation": interpolation or "", "ignore": [tuple(pair) for pair in ignore],
        "contacts": [_contact(one) for one in contacts],
        "packages": {name: os.path.abspath(path) for name, path in (packages or {}).items()},
        "acceleration": None if acceleration is None else _least("acceleration", acceleration),
        "ground": None if ground is None else _least("ground", ground),
        "zmp": None if zmp is None else _least("zmp", zmp),
        "friction": None if friction is None else _least("friction", friction),
        "clearance": _least("clearance", clearance),
        "self_clearance": _least("self_clearance", self_clearance),
        "contact_distance": _least("contact_distance", contact_distance),
        "contact_angle": _least("contact_angle", contact_angle)}
    return Check(json.loads(_halfstep.check(source, path_of_urdf(robot),
                                            scene._scene if scene else None, options, progress)))


def path_of_urdf(robot: str | os.PathLike) -> str:
    """A URDF's own path, else as for robots."""
    path = os.fspath(robot)
    return path if isinstance(path, str) and path.endswith(".urdf") else path_of_robot(robot)


def _npz(path: str) -> dict[str, Any]:
    with np.load(path, allow_pickle=False) as file:
        unknown = sorted(set(file.files) - set(_ARRAYS))
        if unknown:
            raise InputError(f"{path}: {unknown[0]} (valid: arrays {', '.join(_ARRAYS)})")
        return {name: file[name] if name in file.files else None for name in _ARRAYS}


def _arrays(given: dict[str, Any], name: str) -> dict[str, Any]:
    names, times = given["joints"], _numbers(f"{name}: times", given["times"], 1)
    if names is None or isinstance(names, str):
        raise InputError(f"{name}: joints: are missing (valid: the names of the columns)")
    names = [str(one) for one in names]
    arrays: dict[str, Any] = {"name": name, "joints": names, "times": times}
    for what in _ARRAYS[2:]:
        arrays[what] = None
        if given[what] is None and what != "positions":
            continue
        arrays[what] = _numbers(f"{name}: {what}", given[what], 2)
        shape = (len(times), _COLUMNS.get(what, len(names)))
        if arrays[what].shape != shape:
            raise InputError(f"{name}: {what}: shape {arrays[what].shape} (valid: {shape})")
    if arrays["base"] is None and arrays["base_velocities"] is not None:
        raise InputError(f"{name}: base: is missing (valid with base_velocities)")
    return arrays


def _numbers(name: str, values: Any, dimensions: int) -> np.ndarray:
    try:
        numbers = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: not numbers (valid: an array of numbers)") from None
    if numbers.ndim != dimensions or values is None:
        raise InputError(f"{name}: {numbers.ndim} dimensions (valid: {dimensions})")
    return numbers


def _contact(given: Any) -> tuple[str, float | None, float | None]:
    if isinstance(given, str):
        return given, None, None
    if not isinstance(given, Sequence) or len(given) != 3 or not isinstance(given[0], str):
        raise InputError(f"contacts: {given!r} (valid: a link, or (link, from, to))")
    return given[0], number("contacts", given[1]), number("contacts", given[2])


def _least(name: str, value: Any) -> float:
    if number(name, value) < 0.0:
        raise InputError(f"{name}: {value} (valid: at least 0)")
    return float(value)


def _or_inf(value: float | None) -> float:
    return -math.inf if value is None else value
