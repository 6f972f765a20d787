"""Wrong calls: an exception of the right type with a sentence, never a crash."""
import math
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
    (ValueError, "no config 'nowhere'", lambda: hs.load_config("nowhere")),
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
    (INPUT, "robot", lambda: edited(robot="hrp3")),
    (INPUT, "scene", lambda: edited(scene="nowhere")),
    (INPUT, "robot", lambda: hs.Experiment({})),
    (TypeError, "a key of a config is int", lambda: hs.Experiment({1: 2})),
    (TypeError, "config: list", lambda: hs.Experiment([1])),
    (TypeError, "directory", lambda: hs.Experiment("bar_8cm", directory="/")),
    (TypeError, "config: NoneType", lambda: hs.Experiment(None)),
    # places
    (ValueError, "no robot 'hrp3'", lambda: hs.Robot("hrp3")),
    (INPUT, "nowhere.yaml", lambda: hs.Robot("nowhere.yaml")),
    (TypeError, "", lambda: hs.Robot(None)),
    (ValueError, "no scene 'moon'", lambda: hs.Scene("moon")),
    (TypeError, "scene: int", lambda: hs.Scene(7)),
    (INPUT, "sphere_", lambda: hs.Scene({"obstacles": [{"name": "a", "sphere_": {}}]})),
    (INPUT, "friction", lambda: hs.Scene({"friction": NAN})),
    (ValueError, "save", lambda: hs.Scene("bar_8cm").save("x.yaml")),
    # walks
    (ValueError, "overlaps: 2 numbers", lambda: EXPERIMENT.walk(overlaps=[0.1, 0.2])),
    (ValueError, "overlaps: number 0 is not finite", lambda: EXPERIMENT.walk(overlaps=[NAN])),
    (ValueError, "", lambda: EXPERIMENT.walk(overlaps=[1.9])),
    (ValueError, "durations", lambda: EXPERIMENT.walk(durations=[[2.0, 2.0]])),
    (ValueError, "", lambda: EXPERIMENT.walk(durations=[-1.0, 2.0])),
    (TypeError, "overlaps: not numbers", lambda: EXPERIMENT.walk(overlaps="much")),
    (TypeError, "height", lambda: EXPERIMENT.walk(heights=[1.0])),
    (TypeError, "a Walk is made by", lambda: hs.Walk(3)),
    (ValueError, "t: nan", lambda: WALK.at(NAN)),
    (TypeError, "t: str", lambda: WALK.at("soon")),
    (TypeError, "joints: str", lambda: WALK.at(0.1, joints="yes")),
    (ValueError, "period: 0", lambda: WALK.sample(period=0)),
    (ValueError, "period: -0.1", lambda: WALK.sample(period=-0.1)),
    (ValueError, "2e8 rows", lambda: WALK.sample(period=1e-12)),
    (TypeError, "both given", lambda: WALK.sample(period=0.1, times=[0.0])),
    (ValueError, "shape", lambda: WALK.sample(times=np.zeros((2, 2)))),
    (ValueError, "not finite", lambda: WALK.margins([0.0, INF])),
    (TypeError, "times: not numbers", lambda: WALK.margins(["a"])),
    (ValueError, "hold", lambda: WALK.sensitivities(0.1, hold="still")),
    (ValueError, "cutoff", lambda: WALK.margin_gradients(0.1, cutoff=NAN)),
    (KeyError, "no column", lambda: WALK.sample(period=1.0)["zmp"]),
    (ValueError, "different lengths", lambda: hs.Table({"a": [1], "b": [1, 2]})),
    # methods
    (ValueError, "no method 'best'", lambda: EXPERIMENT.smooth("best")),
    (ValueError, "given: its files are", lambda: EXPERIMENT.smooth("given")),
    (TypeError, "method: int", lambda: EXPERIMENT.smooth(1)),
    (TypeError, "no option 'speed'", lambda: EXPERIMENT.smooth("dichotomy", speed=1)),
    (INPUT, "tolerance_s", lambda: EXPERIMENT.smooth("dichotomy", tolerance_s=NAN)),
    (INPUT, "program", lambda: EXPERIMENT.smooth("halfstep/sqp", program="prettiest")),
    (ValueError, "deadline: -1", lambda: EXPERIMENT.smooth(deadline=-1)),
    (ValueError, "deadline: nan", lambda: EXPERIMENT.smooth(deadline=NAN)),
    (TypeError, "progress: int", lambda: EXPERIMENT.smooth(progress=1)),
    (ValueError, "no goal", lambda: EXPERIMENT.plan()),
    (ValueError, "has a goal", lambda: hs.Experiment("plan_bar_8cm").smooth()),
    (ValueError, "has a goal", lambda: hs.Experiment("plan_bar_8cm").planned),
    # programs
    (TypeError, "experiment: str", lambda: hs.OverlapProgram("bar_8cm")),
    (ValueError, "program: 'best'", lambda: hs.OverlapProgram(EXPERIMENT, "best")),
    (TypeError, "heights: int", lambda: hs.OverlapProgram(EXPERIMENT, heights=1)),
    (ValueError, "instants: 0", lambda: hs.OverlapProgram(EXPERIMENT, instants=0)),
    (TypeError, "instants: float", lambda: hs.OverlapProgram(EXPERIMENT, instants=2.5)),
    (ValueError, "sharpness", lambda: hs.OverlapProgram(EXPERIMENT, sharpness=0.0)),
    (ValueError, "weights: 1 numbers", lambda: hs.OverlapProgram(EXPERIMENT, weights=[1])),
    (ValueError, "x: 1 numbers", lambda: PROGRAM.cost([0.0])),
    (ValueError, "x: number 1 is not finite", lambda: PROGRAM.gradient([0.0, NAN, 2.0])),
    (ValueError, "x: shape", lambda: PROGRAM.constraints(np.zeros((3, 1)))),
    (TypeError, "x: not numbers", lambda: PROGRAM.jacobian(["a", "b", "c"])),
    (ValueError, "overlap[0] is 2.0", lambda: PROGRAM.walk([2.0, 2.0, 2.0])),
    (TypeError, "walk: list", lambda: PROGRAM.to_x([0.0])),
    (ValueError, "", lambda: PROGRAM.to_x(hs.Experiment("bar_8cm").planned)),
    (ValueError, "sharpness: -1", lambda: setattr(PROGRAM, "sharpness", -1)),
    # registering
    (ValueError, "built in", lambda: hs.register_smoother("dichotomy", print)),
    (ValueError, "built in", lambda: hs.register_solver("halfstep/sqp", print)),
    (TypeError, "function: int", lambda: hs.register_smoother("mine", 3)),
    (ValueError, "name: ''", lambda: hs.register_solver("", print)),
    (ValueError, "name: 'a b'", lambda: hs.register_smoother("a b", print)),
    (TypeError, "name: int", lambda: hs.register_solver(1, print)),
    # runs
    (INPUT, "no such run folder", lambda: hs.Run("/nowhere")),
    (TypeError, "folder: int", lambda: hs.Run(1)),
    (FileExistsError, "is there already", lambda: EXPERIMENT.run(tempfile.gettempdir())),
]


class WrongCalls(unittest.TestCase):
    def test_each_gives_an_exception_with_a_sentence(self):
        self.assertGreaterEqual(len(CALLS), 40)
        for number, (kind, words, call) in enumerate(CALLS):
            with self.subTest(number=number, words=words):
                with self.assertRaises(kind) as caught:
                    call()
                self.assertIn(words, str(caught.exception))
                self.assertGreater(len(str(caught.exception)), 10)

    def test_an_input_error_has_every_complaint(self):
        with self.assertRaises(hs.InputError) as caught:
            edited(half_step__duration_s=-1, seed=-5)
        self.assertGreaterEqual(len(caught.exception.complaints), 2)
        self.assertTrue(all("valid:" in line for line in caught.exception.complaints))


if __name__ == "__main__":
    unittest.main()
