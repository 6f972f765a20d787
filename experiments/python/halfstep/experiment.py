"""Experiments: plan, smooth, run."""

from __future__ import annotations

import copy
import math
import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _halfstep
from .config import load_config, methods, path_of_config, path_of_scene, to_document
from .errors import InputError
from .parameters import given_values, takes_values
from .place import NotCovered, Robot, Scene
from .result import Result
from .tables import Table
from .walk import Walk, vector

if TYPE_CHECKING:
    from .run import Run

__all__ = ["Experiment", "Plan"]

Progress = Callable[[str, float], Any]


class Plan:
    """What a planner found.

    ``status``: "solved", "no_plan", "start_blocked", "budget", "interrupted" or "refused";
    ``sentence`` says it in words; ``footsteps`` is a table (``foot``, ``x_m``, ``y_m``,
    ``z_m``, ``yaw_rad``), empty without a plan; ``wall`` is the time of the search [s]. True if solved.
    """

    def __init__(self, status: str, sentence: str, footsteps: Table, wall: float,
                 config: dict[str, Any] | None, scene: Scene | None) -> None:
        self.status = status
        self.sentence = sentence
        self.footsteps = footsteps
        self.wall = wall
        self._config = config
        self._scene = scene

    @property
    def config(self) -> dict[str, Any]:
        """The config with these footsteps in place of its goal."""
        if self._config is None:
            raise ValueError(f"there is no plan: {self.sentence}")
        return copy.deepcopy(self._config)

    @property
    def experiment(self) -> Experiment:
        """The experiment of these footsteps."""
        return Experiment(self.config, scene=self._scene)

    def __bool__(self) -> bool:
        return self.status == "solved"

    def __repr__(self) -> str:
        return f"<halfstep.Plan {self.status}: {self.footsteps.rows} footsteps; {self.sentence}>"


class Experiment:
    """A robot, a scene, footsteps or a goal, and what is demanded: everything that a config says.

    ``config``: a shipped config's name, a path, or a dict with the keys of config files, such as
    ``load_config`` gives. Relative paths in a dict refer to ``directory`` (default: the working
    directory); a bare scene name is a shipped scene. ``scene`` takes the place of the config's:
    a Scene, a dict, a path or a name. Raises InputError with every complaint::

        config = hs.load_config("bar_8cm")
        config["smoothing"]["margins"]["clearance_m"] = 0.01
        result = hs.Experiment(config).smooth("halfstep/sqp", heights=True, durations=True)
    """

    def __init__(self, config: str | os.PathLike | Mapping[str, Any],
                 directory: str | os.PathLike | None = None,
                 scene: Scene | Mapping[str, Any] | str | os.PathLike | None = None) -> None:
        if isinstance(config, Mapping):
            self._config = copy.deepcopy(dict(config))
            folder = os.path.abspath(os.fspath(directory or os.getcwd()))
            self._path = os.path.join(folder, "config")
        else:
            if directory is not None:
                raise TypeError("directory: the config is a file, whose folder counts (valid: with "
                                "a dict)")
            self._path = os.path.abspath(path_of_config(config))
            self._config = load_config(self._path)
        if scene is None and isinstance(self._config.get("scene"), (Scene, Mapping)):
            scene = self._config["scene"]
        if isinstance(scene, Mapping):
            scene = Scene(scene, os.path.dirname(self._path))
        self._scene = scene if isinstance(scene, Scene) and scene.path is None else None
        if isinstance(scene, Scene):
            self._config["scene"] = scene.path
        elif scene is not None:
            self._config["scene"] = os.path.abspath(path_of_scene(scene))
        elif isinstance(self._config.get("scene"), str) and self._config["scene"] != "none":
            here = os.path.join(os.path.dirname(self._path), self._config["scene"])
            if not os.path.exists(here):
                self._config["scene"] = _shipped_scene(self._config["scene"])
        self._experiment = _halfstep.Experiment(
            self._path, self._text(), None if self._scene is None else self._scene._scene)

    @property
    def config(self) -> dict[str, Any]:
        """The config with every key, as ``load_config`` gives it; a copy."""
        return _halfstep.resolve_config(self._path, self._text())

    @property
    def robot(self) -> Robot:
        """The robot."""
        return Robot._of(self._experiment.robot)

    @property
    def scene(self) -> Scene:
        """The scene."""
        return Scene._of(self._experiment.scene)

    @property
    def not_covered(self) -> list[NotCovered]:
        """What certificates of this experiment do not speak of, each with the reason: margin
        families of which nothing is demanded, limits that are not known or placeholders, values
        that are assumed, mass without bodies, pairs of bodies that are not watched."""
        return [NotCovered(*one) for one in self._experiment.not_covered]

    @property
    def planned(self) -> Walk:
        """The planned motion: every half-step from rest to rest, one after the other."""
        return Walk(self._experiment.walk({}))

    @takes_values
    def walk(self, *values: Sequence[float] | None, **named: Sequence[float] | None) -> Walk:
        """The walk at given parameters; what is not given is as planned.

        For n half-steps:

        <families>

        Numbers of form are as the keys of ``half_step`` in configs say. An overlap beyond its
        natural bound is a ValueError. Whether the walk is feasible is for ``Walk.certify`` to say.
        """
        sizes = {name: len(row) for name, row in self.planned.parameters.items()}
        return Walk(self._experiment.walk({
            name: list(vector(name, row, sizes[name]))
            for name, row in given_values(self.walk, values, named).items()}))

    def missed(self) -> list[str]:
        """Sentences, empty when the planned motion is feasible: first what the config may have
        wrong, such as left and right exchanged, then what is missed of the demanded margins, the
        worst first."""
        return self._experiment.missed()

    def plan(self, progress: Progress | None = None) -> Plan:
        """Finds footsteps to the goal of the config. ``progress(what, done)`` is told the part that
        is under way and the fraction of it that is done. Ctrl-C ends it."""
        if not self.config.get("goal"):
            raise InputError("plan: the config has footsteps and no goal (valid: a `goal`)")
        status, sentence, steps, wall, config = self._experiment.plan(_progress(progress))
        table = Table({"foot": np.array([s[0] for s in steps], dtype=object),
                       **{name: np.array([s[i + 1] for s in steps], dtype=float)
                          for i, name in enumerate(("x_m", "y_m", "z_m", "yaw_rad"))}})
        if not steps:
            config = None
        elif self._scene is not None:
            config["scene"] = None
        return Plan(status, sentence, table, wall, config, self._scene)

    def smooth(self, method: str = "dichotomy", progress: Progress | None = None,
               deadline: float | None = None, **options: Any) -> Result:
        """Smooths the walk by a method (``hs.methods()``), from the planned motion.

        ``options`` are the keys of the method's group in the config: of ``smoothing.dichotomy``,
        ``smoothing.optimizer`` (``heights=True``, ``durations=True``, ``program="safest"`` ...),
        ``smoothing.horizon`` or ``smoothing.own``. A search by a solver ends after its ``effort``
        (5 by default), always with the same walk; ``deadline`` [s] is an emergency stop by the
        clock, which keeps what was found. Ctrl-C ends it, and raises KeyboardInterrupt. An
        exception in a function of yours is raised here.
        """
        if not isinstance(method, str):
            raise TypeError(f"method: {type(method).__name__} (valid: a method's name)")
        if method not in methods():
            raise InputError(f"no method {method!r} (valid: {', '.join(methods())})")
        if method == "given":
            raise InputError("given: its files are for run() (valid here: walk(overlaps=…), which "
                             "needs no method)")
        limit = math.inf
        if deadline is not None:
            if isinstance(deadline, bool) or not isinstance(deadline, (int, float)):
                raise TypeError(f"deadline: {type(deadline).__name__} (valid: seconds)")
            if not deadline > 0.0:
                raise InputError(f"deadline: {deadline} (valid: above 0 s)")
            limit = float(deadline)
        own = any(path[0] == "own" for path, _ in _halfstep.option_groups(method))
        text = self._with_options(method, options) if options or own else ""
        return Result(self._experiment.smooth(method, text, limit, _progress(progress)))

    def run(self, out: str | os.PathLike, overwrite: bool = False,
            progress: Progress | None = None) -> Run:
        """Does what ``halfstep run --out`` does: plans if there is a goal, smooths by every method
        of the config, certifies and writes the run folder ``out``.

        A scene that was made of a dict is written beside the folder, as OUT_scene.yaml. Raises
        FileExistsError when the folder is there and ``overwrite`` is False. A method that fails,
        also because a function of yours raised, has the status "failed" in the folder and is a
        RuntimeWarning; the others are written all the same.
        """
        from .run import Run
        out = os.path.abspath(os.fspath(out))
        if os.path.exists(out) and not overwrite:
            raise FileExistsError(f"{out}: is there already (overwrite=True replaces it)")
        text = self._text()
        if self._scene is not None:
            self._scene.save(out + "_scene.yaml")
            text = to_document({**self._config, "scene": out + "_scene.yaml"})
        refusal, failed = _halfstep.run(self._path, text, out, bool(overwrite),
                                        _progress(progress))
        if refusal:
            raise ValueError(refusal)
        for sentence in failed:
            warnings.warn(sentence, RuntimeWarning, stacklevel=2)
        return Run(out)

    def _text(self) -> str:
        return to_document(self._config)

    def _with_options(self, method: str, options: Mapping[str, Any]) -> str:
        config = self.config
        known = {key: path for path, keys in reversed(_halfstep.option_groups(method))
                 for key in keys}
        for key, value in options.items():
            if key not in known:
                valid = ", ".join(known) or "none"
                raise TypeError(f"{method} has no option {key!r} (valid: {valid})")
            group = config["smoothing"]
            for part in known[key]:
                group = group.setdefault(part, {})
            group[key] = value
        if self._scene is not None:
            config["scene"] = None
        return to_document(config)

    def __repr__(self) -> str:
        return f"<halfstep.Experiment of {self.robot.name} in {self.scene.name}>"


def _shipped_scene(scene: str) -> str:
    try:
        return path_of_scene(scene)
    except ValueError:
        return scene  # refused with its place in the config


def _progress(progress: Any) -> Any:
    if progress is not None and not callable(progress):
        raise TypeError(f"progress: {type(progress).__name__} (valid: a function of what and done)")
    return progress
