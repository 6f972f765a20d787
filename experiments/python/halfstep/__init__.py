"""halfstep: humanoid walks of overlapping half-steps, certified for all times.

    import halfstep as hs

    experiment = hs.Experiment("bar_8cm")            # a shipped config, a path or a dict
    result = experiment.smooth("dichotomy")          # one of hs.methods()
    table = result.walk.sample(period=0.005)         # named columns of NumPy arrays
    result.walk.certify().status                     # "certified": for all times

A walk is a row of half-steps that overlap. ``Experiment`` loads and smooths, ``Walk`` is a pure
function of time with margins, derivatives and certificates, ``OverlapProgram`` is the nonlinear
program for solvers of your own, ``register_smoother`` and ``register_solver`` put methods of your
own beside those built in, ``Run`` is a folder of results. Lengths in m, angles in rad, times in s.
Mistakes in files and dicts raise ``InputError`` with every complaint.
"""

from . import _halfstep
from .check import Check, Finding, check
from .config import configs, load_config, methods, planners, robots, scenes, solvers
from .errors import InputError, SolveStopped
from .experiment import Experiment, Plan
from .extension import SmoothingProblem, SolverProblem, register_smoother, register_solver
from .place import NotCovered, Robot, Scene
from .program import OverlapProgram, Refinement
from .replay import Measured, PlannedInstant, Replay
from .result import Result
from .run import Run, Verification
from .tables import Table
from .walk import Certificate, MarginGradients, Sensitivities, Walk

__version__: str = _halfstep.version

__all__ = [
    "Certificate", "Check", "Experiment", "Finding", "InputError", "MarginGradients", "Measured", "NotCovered",
    "OverlapProgram", "Plan", "PlannedInstant", "Refinement", "Replay", "Result", "Robot", "Run", "Scene", "Sensitivities", "SmoothingProblem",
    "SolveStopped", "SolverProblem", "Table", "Verification", "Walk", "check", "configs", "load_config",
    "methods", "planners", "register_smoother", "register_solver", "robots", "scenes", "solvers"]
