"""Configs as dicts, methods, plans and run folders."""
import os
import signal
import tempfile
import threading
import time
import unittest

import numpy as np

import halfstep as hs

SCENE = {"name": "crate", "obstacles": [{"name": "crate", "box": {"size_m": [0.2, 0.2, 0.3]},
                                         "pose": {"xyz": [0.5, 0.9, 0.15]}}]}


class Configs(unittest.TestCase):
    def test_a_config_is_a_dict_that_can_be_edited(self):
        config = hs.load_config("bar_8cm", half_step__duration_s=1.5)
        self.assertEqual(config["half_step"]["duration_s"], 1.5)
        self.assertTrue(os.path.isabs(config["scene"]))
        config["smoothing"]["margins"]["clearance_m"] = np.float64(0.02)
        config["smoothing"]["margins"]["zmp_robot_m"] = None
        again = hs.Experiment(config).config
        self.assertEqual(again["smoothing"]["margins"]["clearance_m"], 0.02)
        self.assertIsNone(again["smoothing"]["margins"]["zmp_robot_m"])
        self.assertEqual(hs.Experiment(again).config, again)

    def test_what_is_shipped(self):
        self.assertIn("hrp2", hs.robots())
        self.assertIn("bar_8cm", hs.scenes())
        self.assertIn("bar_8cm", hs.configs())
        self.assertIn("dichotomy", hs.methods())
        self.assertEqual(hs.solvers()["halfstep/sqp"], "")
        self.assertIn("rrt", hs.planners())

    def test_places(self):
        robot = hs.Robot("hrp2")
        self.assertEqual(robot.joints.rows, 12)
        self.assertEqual(robot.sole_size.shape, (2,))
        self.assertEqual(hs.Scene("bar_8cm").obstacles, ["bar"])
        self.assertEqual(hs.Scene(SCENE).obstacles, ["crate"])

    def test_a_scene_made_of_a_dict(self):
        experiment = hs.Experiment("fig3_two_half_steps", scene=SCENE)
        self.assertEqual(experiment.scene.obstacles, ["crate"])
        self.assertLess(experiment.planned.margins([0.0])["clearance_m"][0], 100.0)
        self.assertEqual(hs.Experiment("fig3_two_half_steps", scene="box").scene.name, "box")


class NotCovered(unittest.TestCase):
    def test_every_object_with_a_certificate_has_the_one_list(self):
        config = hs.load_config("fig3_two_half_steps")
        config["smoothing"]["margins"]["zmp_robot_m"] = None
        experiment = hs.Experiment(config)
        told = {(one.kind, one.subject): one.sentence for one in experiment.not_covered}
        self.assertEqual(told["family", "zmp_robot"],
                         "zmp_robot: nothing is demanded: the config says none")
        self.assertIn("no effort limit of a leg joint", told["family", "torque"])
        self.assertIn(("assumed", "friction"), told)
        self.assertEqual(experiment.planned.certify().not_covered, experiment.not_covered)
        of_robot = hs.Robot("hrp2").not_covered
        self.assertEqual(experiment.not_covered[-len(of_robot):], of_robot)
        self.assertEqual({one.kind for one in of_robot}, {"mass", "pair"})
        with tempfile.TemporaryDirectory() as folder:
            run = experiment.run(os.path.join(folder, "run"))
            self.assertEqual(run.not_covered, experiment.not_covered)
            self.assertTrue(all(run.verify()))


class Smoothing(unittest.TestCase):
    def test_the_dichotomy_as_the_command_does_it(self):
        told = []
        result = hs.Experiment("fig3_two_half_steps").smooth(
            "dichotomy", progress=lambda what, done: told.append((what, done)))
        self.assertAlmostEqual(result.duration, 3.179, places=3)
        self.assertEqual((result.status, result.judged_by), ("converged", "certified"))
        self.assertTrue(result.certify().certified)
        self.assertGreater(result.iterates.rows, 3)
        self.assertEqual(result.overlaps.rows, 1)
        self.assertEqual(told[-1][0], "dichotomy")

    def test_options_of_the_method(self):
        experiment = hs.Experiment("fig3_two_half_steps")
        coarse = experiment.smooth("dichotomy", tolerance_s=0.3)
        self.assertGreater(coarse.duration, 3.19)
        both = experiment.smooth("halfstep/sqp", heights=True, durations=True, rounds=8)
        self.assertLess(both.duration, 2.2)
        self.assertFalse(np.allclose(both.parameters["durations"], 2.0))

    def test_a_deadline_keeps_what_was_found(self):
        result = hs.Experiment("bar_8cm").smooth("dichotomy", deadline=1e-3)
        self.assertIn(result.status, ("deadline", "no_improvement"))

    def test_the_same_effort_finds_the_same_walk(self):
        found = [hs.Experiment("fig3_two_half_steps").smooth(
            "halfstep/sqp", heights=True, durations=True, effort=0.2) for _ in range(2)]
        self.assertEqual(found[0].duration, found[1].duration)
        self.assertEqual(found[0].instants, found[1].instants)
        self.assertIn(found[0].status, ("limit", "converged", "no_improvement"))

    def test_what_a_plan_misses(self):
        self.assertEqual(hs.Experiment("fig3_two_half_steps").missed(), [])
        config = hs.load_config("fig3_two_half_steps", half_step__duration_s=0.7)
        self.assertGreater(len(hs.Experiment(config).missed()), 0)

    def test_a_mistake_in_the_config_is_told_before_what_it_causes(self):
        config = hs.load_config("fig3_two_half_steps")
        config["start"] = {"left": {"x_m": 0, "y_m": -0.105}, "right": {"x_m": 0, "y_m": 0.105}}
        told = hs.Experiment(config).missed()
        self.assertRegex(told[0], "^start: the left foot is 0.21 m to the right of the right foot")
        self.assertGreater(len(told), 2)

    def test_control_c_ends_a_search(self):
        threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            hs.Experiment("fig4_raw_sequence").smooth("halfstep/sqp", heights=True, durations=True)
        self.assertLess(time.monotonic() - begin, 60.0)

    def test_other_threads_go_on_meanwhile(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)
        thread = threading.Thread(target=count)
        thread.start()
        before = counted[0]
        hs.Experiment("bar_8cm").smooth("dichotomy")
        during = counted[0] - before
        done.set()
        thread.join()
        self.assertGreater(during, 5)

    def test_nothing_is_registered_during_a_search(self):
        refused = []

        def progress(what, done):
            try:
                hs.register_smoother("mine/late", print)
            except ValueError as error:
                refused.append(str(error))
        hs.Experiment("fig3_two_half_steps").smooth("dichotomy", progress=progress)
        self.assertIn("a search is under way", refused[0])

    def test_an_exception_of_progress_is_raised(self):
        def progress(what, done):
            raise LookupError("enough")
        with self.assertRaisesRegex(LookupError, "enough"):
            hs.Experiment("bar_8cm").smooth("dichotomy", progress=progress)


class Runs(unittest.TestCase):
    def test_a_run_folder_is_an_object(self):
        with tempfile.TemporaryDirectory() as place:
            out = os.path.join(place, "run")
            config = hs.load_config("fig3_two_half_steps", smoothing__methods=["dichotomy"])
            experiment = hs.Experiment(config, scene=SCENE)
            run = experiment.run(out)
            self.assertEqual(run.methods, ["raw", "dichotomy"])
            self.assertEqual(run.certificate("dichotomy")["verdict"], "certified")
            self.assertEqual(run.overlaps("dichotomy").rows, 1)
            self.assertEqual(run.half_steps("dichotomy").rows, 2)
            table = run.trajectory("dichotomy")
            overlap = run.overlaps("dichotomy")["overlap_s"]
            sampled = experiment.walk(overlaps=overlap).sample(period=0.005)
            for name in ("zmp_y_m", "com_vx_m_s", "right_foot_z_m"):
                np.testing.assert_array_equal(table[name], sampled[name], err_msg=name)
            self.assertTrue(all(run.verify("dichotomy")))
            self.assertIn("report", run._repr_html_() + "report")
            with self.assertRaises(FileExistsError):
                experiment.run(out)
            again = hs.Experiment(run.config).run(out, overwrite=True)
            self.assertEqual(again.summary["duration_s"][1], run.summary["duration_s"][1])


if __name__ == "__main__":
    unittest.main()
