"""Wrong calls: an exception of the right type with a sentence, never a crash."""
import inspect
import math
import re
import tempfile
import unittest

import numpy as np

import halfstep as hs


def edited(**changes):
    config = hs.load_config("fig3_two_half_steps")
    for key, value in changes.items():
        place, *rest = reversed(key.split("__"))
        group = config
        for name in reversed(rest):
            group = group[name]
        group[place] = value
    return hs.Experiment(config)


EXPERIMENT = hs.Experiment("fig3_two_half_steps")
WALK = EXPERIMENT.planned
PROGRAM = hs.OverlapProgram(EXPERIMENT, durations=True)
NAN, INF = math.nan, math.inf
INPUT = hs.InputError

# (type of the exception, what its sentence says, the call)
CALLS = [
    # configs
    (INPUT, "no config 'nowhere'", lambda: hs.load_config("nowhere")),
    (TypeError, "config: int", lambda: hs.load_config(3)),
    (INPUT, "nowhere.yaml", lambda: hs.load_config("nowhere.yaml")),
    (INPUT, "unknown key", lambda: hs.load_config("bar_8cm", smoothin=1)),
    (INPUT, "duration_s", lambda: hs.load_config("bar_8cm", half_step__duration_s=-1)),
    (INPUT, "duration_s", lambda: hs.load_config("bar_8cm", half_step__duration_s="long")),
    (TypeError, "no value of type object", lambda: hs.load_config("bar_8cm", name=object())),
    (INPUT, "clearance_m", lambda: edited(smoothing__margins__clearance_m=NAN)),
    (INPUT, "clearance_m", lambda: edited(smoothing__margins__clearance_m=INF)),
    (INPUT, "clearance_m", lambda: edited(smoothing__margins__clearance_m="wide")),
    (INPUT, "methods", lambda: edited(smoothing__methods=["best"])),
    (INPUT, "footsteps", lambda: edited(footsteps=[])),
    (INPUT, "foot", lambda: edited(footsteps=[{"foot": "third", "x_m": 0, "y_m": 0}])),
    (INPUT, "did you mean -10", lambda: edited(
        footsteps=[{"foot": "left", "x_m": 0.1, "y_m": 0.1, "yaw_deg": 350}])),
    (INPUT, "no sole lands exactly on a point", lambda: edited(
        footsteps=[], goal={"x_m": 1, "y_m": 0, "radius_m": 0})),
    (INPUT, "robot", lambda: edited(robot="hrp3")),
    (INPUT, "scene", lambda: edited(scene="nowhere")),
    (INPUT, "robot", lambda: hs.Experiment({})),
    (TypeError, "a key of a config is int", lambda: hs.Experiment({1: 2})),
    (TypeError, "config: list", lambda: hs.Experiment([1])),
    (TypeError, "directory", lambda: hs.Experiment("bar_8cm", directory="/")),
    (TypeError, "config: NoneType", lambda: hs.Experiment(None)),
    # places
    (INPUT, "no robot 'hrp3'", lambda: hs.Robot("hrp3")),
    (INPUT, "nowhere.yaml", lambda: hs.Robot("nowhere.yaml")),
    (TypeError, "", lambda: hs.Robot(None)),
    (INPUT, "no scene 'moon'", lambda: hs.Scene("moon")),
    (TypeError, "scene: int", lambda: hs.Scene(7)),
    (INPUT, "sphere_", lambda: hs.Scene({"obstacles": [{"name": "a", "sphere_": {}}]})),
    (INPUT, "friction", lambda: hs.Scene({"friction": NAN})),
    (ValueError, "save", lambda: hs.Scene("bar_8cm").save("x.yaml")),
    # walks
    (INPUT, "overlaps: 2 numbers", lambda: EXPERIMENT.walk(overlaps=[0.1, 0.2])),
    (INPUT, "overlaps: number 0 is not finite", lambda: EXPERIMENT.walk(overlaps=[NAN])),
    (INPUT, "overlaps[0]: 1.9 s (valid: at most 0.95 s", lambda: EXPERIMENT.walk(overlaps=[1.9])),
    (INPUT, "overlaps[0]: -1e+09 s (valid: at least", lambda: EXPERIMENT.walk(overlaps=[-1e9])),
    (INPUT, "height_scales[0]: -1 (valid: ", lambda: EXPERIMENT.walk(height_scales=[-1])),
    (INPUT, "support_points: 0 numbers (valid: 1)", lambda: EXPERIMENT.walk(support_points=[])),
    (INPUT, "foot_ramps[1]: 2 (valid: ", lambda: EXPERIMENT.walk(foot_ramps=[0.5, 2.0])),
    (INPUT, "foot_delays[0]: -1 (valid: ", lambda: EXPERIMENT.walk(foot_delays=[-1.0, 0.1])),
    (INPUT, "lift_shares[0]: 0 (valid: ", lambda: EXPERIMENT.walk(lift_shares=[0.0, 0.1])),
    (INPUT, "zmp_shifts[1]: 7 (valid: ", lambda: EXPERIMENT.walk(zmp_shifts=[0.1, 7.0])),
    (INPUT, "footstep_yaws: number 0", lambda: EXPERIMENT.walk(footstep_yaws=[INF])),
    (INPUT, "durations", lambda: EXPERIMENT.walk(durations=[[2.0, 2.0]])),
    (INPUT, "durations[0]: -1 s (valid: ", lambda: EXPERIMENT.walk(durations=[-1.0, 2.0])),
    (TypeError, "overlaps: not numbers", lambda: EXPERIMENT.walk(overlaps="much")),
    (TypeError, "height", lambda: EXPERIMENT.walk(heights=[1.0])),
    (TypeError, "a Walk is made by", lambda: hs.Walk(3)),
    (INPUT, "t: nan", lambda: WALK.at(NAN)),
    (TypeError, "t: str", lambda: WALK.at("soon")),
    (TypeError, "joints: str", lambda: WALK.at(0.1, joints="yes")),
    (INPUT, "period: 0", lambda: WALK.sample(period=0)),
    (INPUT, "period: -0.1", lambda: WALK.sample(period=-0.1)),
    (INPUT, "2e8 rows", lambda: WALK.sample(period=1e-12)),
    (TypeError, "both given", lambda: WALK.sample(period=0.1, times=[0.0])),
    (INPUT, "shape", lambda: WALK.sample(times=np.zeros((2, 2)))),
    (INPUT, "not finite", lambda: WALK.margins([0.0, INF])),
    (TypeError, "times: not numbers", lambda: WALK.margins(["a"])),
    (INPUT, "hold", lambda: WALK.sensitivities(0.1, hold="still")),
    (INPUT, "cutoff", lambda: WALK.margin_gradients(0.1, cutoff=NAN)),
    (KeyError, "no column", lambda: WALK.sample(period=1.0)["zmp"]),
    (ValueError, "different lengths", lambda: hs.Table({"a": [1], "b": [1, 2]})),
    # methods
    (INPUT, "no method 'best'", lambda: EXPERIMENT.smooth("best")),
    (INPUT, "given: its files are", lambda: EXPERIMENT.smooth("given")),
    (TypeError, "method: int", lambda: EXPERIMENT.smooth(1)),
    (TypeError, "no option 'speed'", lambda: EXPERIMENT.smooth("dichotomy", speed=1)),
    (INPUT, "tolerance_s", lambda: EXPERIMENT.smooth("dichotomy", tolerance_s=NAN)),
    (INPUT, "program", lambda: EXPERIMENT.smooth("halfstep/sqp", program="prettiest")),
    (INPUT, "deadline: -1", lambda: EXPERIMENT.smooth(deadline=-1)),
    (INPUT, "deadline: nan", lambda: EXPERIMENT.smooth(deadline=NAN)),
    (TypeError, "progress: int", lambda: EXPERIMENT.smooth(progress=1)),
    (INPUT, "no goal", lambda: EXPERIMENT.plan()),
    (INPUT, "has a goal", lambda: hs.Experiment("plan_bar_8cm").smooth()),
    (INPUT, "has a goal", lambda: hs.Experiment("plan_bar_8cm").planned),
    # programs
    (TypeError, "experiment: str", lambda: hs.OverlapProgram("bar_8cm")),
    (INPUT, "program: 'best'", lambda: hs.OverlapProgram(EXPERIMENT, "best")),
    (TypeError, "heights: int", lambda: hs.OverlapProgram(EXPERIMENT, heights=1)),
    (INPUT, "instants: 0", lambda: hs.OverlapProgram(EXPERIMENT, instants=0)),
    (TypeError, "instants: float", lambda: hs.OverlapProgram(EXPERIMENT, instants=2.5)),
    (INPUT, "sharpness", lambda: hs.OverlapProgram(EXPERIMENT, sharpness=0.0)),
    (INPUT, "weights: 1 numbers", lambda: hs.OverlapProgram(EXPERIMENT, weights=[1])),
    (INPUT, "x: 1 numbers", lambda: PROGRAM.cost([0.0])),
    (INPUT, "x: number 1 is not finite", lambda: PROGRAM.gradient([0.0, NAN, 2.0])),
    (INPUT, "x: 0 numbers", lambda: PROGRAM.constraints([])),
    (INPUT, "x: 0 numbers", lambda: PROGRAM.jacobian([])),
    (TypeError, "columns: int", lambda: hs.Table(3)),
    (INPUT, "x: shape", lambda: PROGRAM.constraints(np.zeros((3, 1)))),
    (TypeError, "x: not numbers", lambda: PROGRAM.jacobian(["a", "b", "c"])),
    (INPUT, "overlap[0] is 2.0", lambda: PROGRAM.walk([2.0, 2.0, 2.0])),
    (TypeError, "walk: list", lambda: PROGRAM.to_x([0.0])),
    (INPUT, "walk: overlaps: 7 numbers (valid: 1",
     lambda: PROGRAM.to_x(hs.Experiment("bar_8cm").planned)),
    (INPUT, "sharpness: -1", lambda: setattr(PROGRAM, "sharpness", -1)),
    # registering
    (INPUT, "built in", lambda: hs.register_smoother("dichotomy", print)),
    (INPUT, "built in", lambda: hs.register_solver("halfstep/sqp", print)),
    (TypeError, "function: int", lambda: hs.register_smoother("mine", 3)),
    (INPUT, "name: ''", lambda: hs.register_solver("", print)),
    (INPUT, "name: 'a b'", lambda: hs.register_smoother("a b", print)),
    (TypeError, "name: int", lambda: hs.register_solver(1, print)),
    (TypeError, "meaning: int", lambda: hs.register_smoother("mine/a", print, 3)),
    (TypeError, "options: int", lambda: hs.register_smoother("mine/a", print, options=3)),
    (INPUT, "options: 'a b'", lambda: hs.register_smoother("mine/a", print, options={"a b": 1})),
    (INPUT, "tilt_deg", lambda: hs.register_smoother("mine/a", print, options={"tilt_deg": 1.0})),
    (INPUT, "options: a: 'most'", lambda: hs.register_smoother(
        "mine/a", print, options={"a": {"default": 1, "most": 2}})),
    (INPUT, "options: a: default 3 (valid: from 0 to 2)", lambda: hs.register_smoother(
        "mine/a", print, options={"a": {"default": 3, "min": 0, "max": 2}})),
    (INPUT, "options: a: default 'x' (valid: y)", lambda: hs.register_smoother(
        "mine/a", print, options={"a": {"default": "x", "choices": ["y"]}})),
    (TypeError, "options: a: default: NoneType", lambda: hs.register_smoother(
        "mine/a", print, options={"a": {"unit": "s"}})),
    # text that UTF-8 cannot hold
    (INPUT, "robot: character 2 is half", lambda: hs.Robot("a\udcff")),
    (INPUT, "scene: character 1 is half", lambda: hs.Scene("\udcff.yaml")),
    (INPUT, "config: character 1 is half", lambda: hs.load_config("bar_8cm", name="\udcff")),
    (INPUT, "config: a key: character 1", lambda: hs.Scene({"\udcff": 1})),
    (INPUT, "meaning: character 1 is half",
     lambda: hs.register_smoother("mine/a", print, "\udcff")),
    # runs
    (INPUT, "tolerance: -1 (valid: ", lambda: hs.Run.verify(None, tolerance=-1)),
    (TypeError, "tolerance: str", lambda: hs.Run.verify(None, tolerance="small")),
    (INPUT, "no such run folder", lambda: hs.Run("/nowhere")),
    (TypeError, "folder: int", lambda: hs.Run(1)),
    (FileExistsError, "is there already", lambda: EXPERIMENT.run(tempfile.gettempdir())),
]


# What no message shows to somebody who called in a wrong way: our sources, types and checks.
INTERNALS = re.compile(r"std::|halfstep::|precondition|\.cc\b|\.h:|pybind|PYBIND|Eigen|Invoked with|"
                       r"incompatible (function|constructor)|numpy\.ndarray\[|unable to cast",
                       re.IGNORECASE)
ODD = [None, "x", "\udcff", b"x", -1, 10**400, 0.5j, NAN, -INF, [], [NAN], [[1.0]], {}, {"x": 1},
       object(), print, np.zeros((2, 2)), np.array(["a"]), WALK, EXPERIMENT, PROGRAM]
WRITES_OR_SHOWS = {"run", "save", "register_smoother", "register_solver"}


def public_callables():
    """(name, function) of the package and of what it makes."""
    for name in sorted(hs.__all__):
        if callable(getattr(hs, name)) and name not in WRITES_OR_SHOWS:
            yield name, getattr(hs, name)
    result = EXPERIMENT.smooth("dichotomy")
    for owner in (EXPERIMENT, WALK, PROGRAM, result, EXPERIMENT.robot, EXPERIMENT.scene,
                  WALK.sample(period=1.0), WALK.certify()):
        for name, function in inspect.getmembers(owner, callable):
            if not name.startswith("_") and name not in WRITES_OR_SHOWS:
                yield f"{type(owner).__name__}.{name}", function


class WrongCalls(unittest.TestCase):
    def test_odd_arguments_anywhere_raise_without_internals(self):
        calls = 0
        for name, function in public_callables():
            try:
                arguments = inspect.signature(function).parameters.values()
            except (TypeError, ValueError):
                continue
            named = [a.name for a in arguments if a.kind == a.POSITIONAL_OR_KEYWORD]
            needed = [a.name for a in arguments
                      if a.kind == a.POSITIONAL_OR_KEYWORD and a.default is a.empty]
            for odd in ODD:
                for argument in named or []:
                    calls += 1
                    given = {other: 0.1 for other in needed} | {argument: odd}
                    with self.subTest(call=name, argument=argument, odd=repr(odd)[:40]):
                        try:
                            function(**given)
                        except (TypeError, ValueError, KeyError, LookupError, OverflowError,
                                OSError, ImportError) as error:
                            self.assertNotRegex(str(error), INTERNALS)
        self.assertGreater(calls, 1000)

    def test_each_gives_an_exception_with_a_sentence(self):
        self.assertGreaterEqual(len(CALLS), 40)
        for number, (kind, words, call) in enumerate(CALLS):
            with self.subTest(number=number, words=words):
                with self.assertRaises(kind) as caught:
                    call()
                self.assertIn(words, str(caught.exception))
                self.assertGreater(len(str(caught.exception)), 10)
                self.assertNotRegex(str(caught.exception), INTERNALS)

    def test_an_input_error_has_every_complaint(self):
        with self.assertRaises(hs.InputError) as caught:
            edited(half_step__duration_s=-1, seed=-5)
        self.assertGreaterEqual(len(caught.exception.complaints), 2)
        self.assertTrue(all("valid:" in line for line in caught.exception.complaints))


if __name__ == "__main__":
    unittest.main()
