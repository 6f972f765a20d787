"""Run folders as objects."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from . import _halfstep
from .config import load_config
from .errors import InputError
from .place import NotCovered
from .replay import Replay, play
from .tables import Table, of_file
from .walk import number

__all__ = ["Run", "Verification"]


class Verification(NamedTuple):
    """What ``halfstep verify`` found about one method of a run."""

    method: str
    """The method's folder."""
    verified: bool
    """Whether all that its certificate claims holds."""
    report: str
    """The lines that ``halfstep verify`` prints."""
    complaints: list[str]
    """What of the files cannot be read."""

    def __bool__(self) -> bool:
        return self.verified


class Run:
    """A folder that ``Experiment.run`` or ``halfstep run`` wrote.

    Files are read when they are asked for. In a notebook a Run shows its report.
    """

    def __init__(self, folder: str | os.PathLike) -> None:
        if not isinstance(folder, (str, os.PathLike)):
            raise TypeError(f"folder: {type(folder).__name__} (valid: a path)")
        self.folder: str = os.path.abspath(os.fspath(folder))
        """Its path."""
        if not os.path.isfile(os.path.join(self.folder, "manifest.json")):
            raise InputError(f"{self.folder}: no such run folder (valid: a folder that `halfstep "
                             "run` wrote)")

    @property
    def config(self) -> dict[str, Any]:
        """The config with every key, planned footsteps in place of a goal."""
        return load_config(os.path.join(self.folder, "config.yaml"))

    @property
    def manifest(self) -> dict[str, Any]:
        """manifest.json: versions, options and hashes of files."""
        return self._json("manifest.json")

    @property
    def not_covered(self) -> list[NotCovered]:
        """What the run's certificates do not speak of, each with the reason."""
        return [NotCovered(one["kind"], one["subject"], one["sentence"])
                for one in self.manifest["not_covered"]]

    @property
    def summary(self) -> Table:
        """One row a method, "raw" first: summary.csv."""
        return self._table("summary.csv")

    @property
    def methods(self) -> list[str]:
        """The names of the methods, "raw" first."""
        return [str(name) for name in self.summary["method"]]

    @property
    def footsteps(self) -> Table:
        """footsteps.csv."""
        return self._table("footsteps.csv")

    def trajectory(self, method: str) -> Table:
        """trajectory.csv of a method."""
        return self._table(self._place(method), "trajectory.csv")

    def half_steps(self, method: str) -> Table:
        """half_steps.csv of a method."""
        return self._table(self._place(method), "half_steps.csv")

    def overlaps(self, method: str) -> Table:
        """overlaps.csv of a method: each junction's overlap, what holds it and what that costs."""
        return self._table(self._place(method), "overlaps.csv")

    def iterates(self, method: str) -> Table:
        """iterates.csv of a method: every candidate."""
        return self._table(self._place(method), "iterates.csv")

    def certificate(self, method: str) -> dict[str, Any]:
        """certificate.json of a method: verdict, statement, demands, what is not covered, hashes."""
        return self._json(self._place(method), "certificate.json")

    @property
    def infeasible(self) -> dict[str, Any]:
        """infeasible.json: by the name of each walk that is not feasible ("raw", "given") what the
        config may have wrong, what is missed, the worst first, and what would help; else empty."""
        if not os.path.exists(os.path.join(self.folder, "infeasible.json")):
            return {}
        return self._json("infeasible.json")

    def verify(self, method: str | None = None, tolerance: float | None = None) -> list[Verification]:
        """Checks the certificates without the smoothing code, as ``halfstep verify``; one entry a
        method. ``tolerance``: how far the played motion may leave the certified walk [m]; None: 1 mm
        for HRP-2, and for other robots by the length of their legs."""
        name = None if method is None else self._place(method)
        if tolerance is not None and not 0.0 <= number("tolerance", tolerance) <= 1.0:
            raise InputError(f"tolerance: {tolerance} (valid: 0 ... 1 m)")
        return [Verification(*found) for found in _halfstep.verify(self.folder, name, tolerance)]

    def replay(self, method: str, controller: str | Callable[[], Any] | None = None,
               servos: Sequence[float] | None = None, ankle: Sequence[float] | None = None,
               torque_limits: bool = False, seeds: int | None = None, sensor_delay: float = 0.005,
               sensor_seed: int | None = None, suggest_tube: bool = False,
               progress: Callable[[str, float], None] | None = None) -> Replay:
        """Plays a method's walk on a simulated robot, as ``halfstep replay`` does with options of
        these names.

        ``controller``: None (servos get the plan itself), a name ("dcm"), or a function without
        arguments, such as a class, that makes a controller of yours. It is called once for every
        simulation. A controller has ``command(measured, then, next)``, which is called every 5 ms
        with ``Measured``, and ``PlannedInstant`` for measured.t and for the end of the 5 ms that
        begin, and returns joint angles [rad] and speeds [rad/s] for that end (2×6 each; left,
        right). What it raises is raised here. ``servos``, ``ankle``: K [N m/rad], D [N m s/rad].
        ``sensor_delay`` [s]. ``suggest_tube``: ``told`` has ``suggested_tube``.
        """
        self._place(method)
        return play(self.folder, method, controller, servos, ankle, torque_limits, seeds,
                    sensor_delay, sensor_seed, suggest_tube, progress)

    def show(self, height: int = 800) -> Any:
        """The report as something that a notebook displays; ``height`` in pixels. Needs IPython."""
        try:
            from IPython.display import HTML
        except ImportError as error:
            raise ImportError("show needs IPython; report.html in the folder opens in a browser"
                              ) from error
        return HTML(self._frame(height))

    def _repr_html_(self) -> str:
        return self._frame(800)

    def _frame(self, height: int) -> str:
        path = os.path.join(self.folder, "report.html")
        if not os.path.exists(path):
            return f"<p>{html.escape(repr(self))} has no report.html</p>"
        with open(path, encoding="utf-8") as file:
            page = html.escape(file.read(), quote=True)
        return (f'<iframe srcdoc="{page}" width="100%" height="{int(height)}" '
                'style="border: 0"></iframe>')

    def _place(self, method: str) -> str:
        if not isinstance(method, str):
            raise TypeError(f"method: {type(method).__name__} (valid: a method's name)")
        if method not in self.methods:
            raise InputError(f"no method {method!r} (valid: {', '.join(self.methods)})")
        return _halfstep.method_folder(method)

    def _table(self, *parts: str) -> Table:
        path = os.path.join(self.folder, *parts)
        if not os.path.exists(path):
            raise ValueError(f"{path}: is not there (`raw` has neither overlaps nor iterates)")
        return of_file(path)

    def _json(self, *parts: str) -> dict[str, Any]:
        with open(os.path.join(self.folder, *parts), encoding="utf-8") as file:
            return json.load(file)

    def __repr__(self) -> str:
        return f"<halfstep.Run {self.folder}>"
