"""Robots and scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from . import _halfstep
from .config import path_of_robot, path_of_scene, to_document
from .tables import Table

__all__ = ["NotCovered", "Robot", "Scene"]


class NotCovered(NamedTuple):
    """One thing that a certificate does not speak of."""

    kind: str
    """"family" (a margin family of which nothing is demanded, or that has no limit), "limit" (a
    joint's limit that no file states), "placeholder" (a limit that walking cannot meet), "assumed"
    (a value that no file states), "mass" (without a body) or "pair" (of bodies whose
    distance is not watched)."""
    subject: str
    """What it is: a family, a joint, "friction", "mass", "A - B" of two bodies."""
    sentence: str
    """The whole of it, with the reason."""


class Robot:
    """A robot as walking needs it: ``hs.Robot("hrp2")`` or ``hs.Robot("my_robot.yaml")``.

    Robot files: README of wpg, "Robots"; ``halfstep robot URDF`` writes one from a URDF.
    Raises InputError, with every complaint, for a file that cannot be taken.
    """

    def __init__(self, robot: str | os.PathLike) -> None:
        self.path: str | None = path_of_robot(robot)
        self._robot = _halfstep.Robot(self.path)

    @classmethod
    def _of(cls, handle: Any) -> Robot:
        robot = cls.__new__(cls)
        robot.path = None
        robot._robot = handle
        return robot

    @property
    def name(self) -> str:
        """As in its file."""
        return self._robot.name

    @property
    def mass(self) -> float:
        """Of the whole robot [kg]."""
        return self._robot.mass

    @property
    def com_height(self) -> float:
        """Height of the CoM above the floor while walking [m]."""
        return self._robot.com_height

    @property
    def waist_height(self) -> float:
        """Height of the waist frame above the floor while walking [m]."""
        return self._robot.waist_height

    @property
    def standing_width(self) -> float:
        """Distance of the sole centres when it stands [m]."""
        return self._robot.standing_width

    @property
    def sole_size(self) -> np.ndarray:
        """Length and width of the sole rectangle [m] (2)."""
        return self._robot.sole_size

    @property
    def joints(self) -> Table:
        """The twelve leg joints, the left leg's first: ``name``, ``lower_rad``, ``upper_rad``,
        ``speed_rad_s``, ``torque_n_m`` (inf: not known), ``acceleration_rad_s2`` (inf:
        no limit)."""
        rows = self._robot.joints
        names = ("name", "lower_rad", "upper_rad", "speed_rad_s", "torque_n_m",
                 "acceleration_rad_s2")
        return Table({name: np.array([row[i] for row in rows], dtype=object if i == 0 else float)
                      for i, name in enumerate(names)})

    @property
    def bodies(self) -> list[str]:
        """The names of the collision bodies."""
        return self._robot.bodies

    @property
    def warnings(self) -> list[str]:
        """What of its files was repaired or left out, as sentences."""
        return self._robot.warnings

    @property
    def not_covered(self) -> list[NotCovered]:
        """What no certificate about this robot speaks of, whatever is demanded."""
        return [NotCovered(*one) for one in self._robot.not_covered]

    def __repr__(self) -> str:
        return f"<halfstep.Robot {self.name}: {self.mass:.1f} kg, CoM at {self.com_height:.3f} m>"


class Scene:
    """What a robot walks among: ``hs.Scene("bar_8cm")``, a path, or a dict::

        hs.Scene({"obstacles": [{"name": "box", "box": {"size_m": [0.2, 0.2, 0.1]},
                                 "pose": {"xyz": [0.5, 0.0, 0.05]}}]})

    The keys are those of scene files (README of the planner, "Scenes"); paths of meshes in a dict
    are relative to ``directory``. Raises InputError with every complaint.
    """

    def __init__(self, scene: str | os.PathLike | Mapping[str, Any],
                 directory: str | os.PathLike | None = None) -> None:
        self.path: str | None = None
        self.text: str | None = None
        if isinstance(scene, Mapping):
            self.text = to_document(scene)
            folder = os.path.abspath(os.fspath(directory or os.getcwd()))
            self._scene = _halfstep.Scene(os.path.join(folder, "scene"), self.text)
        elif isinstance(scene, (str, os.PathLike)):
            self.path = os.path.abspath(path_of_scene(scene))
            self._scene = _halfstep.Scene(self.path)
        else:
            raise TypeError(f"scene: {type(scene).__name__} (valid: a path, a shipped scene's name "
                            "or a dict)")

    @classmethod
    def _of(cls, handle: Any) -> Scene:
        scene = cls.__new__(cls)
        scene.path = scene.text = None
        scene._scene = handle
        return scene

    @property
    def name(self) -> str:
        """As in its file, or the file's name."""
        return self._scene.name

    @property
    def obstacles(self) -> list[str]:
        """The names of its obstacles."""
        return self._scene.obstacles

    @property
    def no_step_areas(self) -> int:
        """How many areas of the floor no sole may touch."""
        return self._scene.no_step_areas

    @property
    def friction(self) -> float:
        """Friction coefficient between soles and floor."""
        return self._scene.friction

    @property
    def rests(self) -> bool:
        """Whether no obstacle moves."""
        return self._scene.rests()

    @property
    def warnings(self) -> list[str]:
        """What of its files was replaced by something larger, as sentences."""
        return self._scene.warnings

    def save(self, path: str | os.PathLike) -> None:
        """Writes a scene that was made of a dict as a scene file."""
        if self.text is None:
            raise ValueError("save: the scene was not made of a dict; its file is at `path`")
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.text)

    def __repr__(self) -> str:
        return f"<halfstep.Scene {self.name}: {', '.join(self.obstacles) or 'empty floor'}>"
