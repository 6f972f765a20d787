"""Smoothers and solvers written in Python."""
import os
import tempfile
import unittest

import numpy as np

import halfstep as hs


def scale_all(problem):
    """All overlaps together, bisected."""
    program = problem.program()
    full, low, high = program.upper, 0.0, 1.0
    for _ in range(6):
        middle = 0.5 * (low + high)
        proved = problem.propose(program.walk(program.x0 + middle * (full - program.x0)))
        low, high = (middle, high) if proved else (low, middle)
        problem.tell(high)


def descend(problem, x0):
    x = x0
    for k in range(40):
        missing = np.maximum(problem.constraint_lower - problem.constraints(x), 0.0)
        slope = problem.gradient(x) - 40.0 * problem.jacobian(x).T @ missing
        x = np.clip(x - 0.05 / (1 + 0.1 * k) * slope / abs(slope).max(), problem.lower,
                    problem.upper)
    return x


class Smoothers(unittest.TestCase):
    def test_a_function_is_a_method(self):
        hs.register_smoother("mine/scale", scale_all)
        self.assertEqual(hs.methods()["mine/scale"], "All overlaps together, bisected.")
        overlaps_alone = hs.load_config("fig3_two_half_steps",
                                        smoothing__optimizer__all_families=False)
        result = hs.Experiment(overlaps_alone).smooth("mine/scale")
        self.assertEqual(result.status, "converged")
        self.assertLess(result.duration, 3.4)
        self.assertTrue(result.certify())
        self.assertEqual(result.iterates.rows, 6)

    def test_it_runs_by_name_in_a_config(self):
        hs.register_smoother("mine/scale", scale_all)
        config = hs.load_config("fig3_two_half_steps", smoothing__methods=["mine/scale"])
        with tempfile.TemporaryDirectory() as place:
            run = hs.Experiment(config).run(os.path.join(place, "run"))
            self.assertEqual(run.methods, ["raw", "mine/scale"])
            self.assertTrue(all(run.verify()))

    def test_it_has_options_of_its_own(self):
        seen = []
        hs.register_smoother("mine/options", lambda problem: seen.append(problem.options), options={
            "share": {"default": 0.5, "min": 0, "max": 1, "meaning": "of every overlap"},
            "passes": 3, "backwards": False, "order": {"default": "near", "choices": ["near", "far"]}})
        self.addCleanup(hs.register_smoother, "mine/options", print)
        config = hs.load_config("fig3_two_half_steps", smoothing__methods=["mine/options"])
        self.assertEqual(config["smoothing"]["own"]["mine/options"],
                         {"share": 0.5, "passes": 3, "backwards": False, "order": "near"})
        experiment = hs.Experiment(config)
        experiment.smooth("mine/options")
        experiment.smooth("mine/options", share=0.25, order="far")
        self.assertEqual(seen, [
            {"share": 0.5, "passes": 3, "backwards": False, "order": "near"},
            {"share": 0.25, "passes": 3, "backwards": False, "order": "far"}])
        for own, refusal in (({"share": 2}, "own.mine/options.share: 2 is out of range"),
                             ({"passes": 1.5}, "own.mine/options.passes: "),
                             ({"order": "up"}, "own.mine/options.order: "),
                             ({"shares": 1}, "own.mine/options.shares: unknown key")):
            config["smoothing"]["own"] = {"mine/options": own}
            with self.assertRaisesRegex(hs.InputError, rf":\d+:\d+: smoothing.{refusal}"):
                hs.Experiment(config)
        config["smoothing"]["own"] = {"mine/options": {"share": 0.125}}
        with tempfile.TemporaryDirectory() as place:
            run = hs.Experiment(config).run(os.path.join(place, "run"))
            self.assertEqual(run.manifest["methods"][1]["requested"]["own"]["share"], 0.125)
        self.assertEqual(seen[-1]["share"], 0.125)

    def test_nothing_unproved_is_accepted(self):
        answers = []

        def bold(problem):
            wild = problem.walk(overlaps=[0.94])
            answers.append(problem.propose(wild))
        hs.register_smoother("mine/bold", bold)
        result = hs.Experiment("fig5_box").smooth("mine/bold")
        self.assertEqual(answers, [False])
        self.assertEqual((result.status, result.duration), ("no_improvement", 4.0))

    def test_a_problem_is_over_when_the_function_returns(self):
        kept = []
        hs.register_smoother("mine/keeper", kept.append)
        hs.Experiment("fig3_two_half_steps").smooth("mine/keeper")
        self.assertTrue(kept[0].stopped)
        with self.assertRaisesRegex(ValueError, "has ended"):
            kept[0].incumbent

    def test_what_it_raises_is_raised(self):
        def broken(problem):
            raise LookupError("mine")
        hs.register_smoother("mine/broken", broken)
        with self.assertRaisesRegex(LookupError, "mine"):
            hs.Experiment("fig3_two_half_steps").smooth("mine/broken")

    def test_in_a_run_what_it_raises_is_its_own_failure(self):
        def broken(problem):
            problem.propose(problem.walk(overlaps=[0.1]))
            raise LookupError("mine")
        hs.register_smoother("mine/broken", broken)
        config = hs.load_config("fig3_two_half_steps",
                                smoothing__methods=["mine/broken", "dichotomy"])
        with tempfile.TemporaryDirectory() as place:
            with self.assertWarnsRegex(RuntimeWarning, "mine/broken: failed: LookupError: mine$"):
                run = hs.Experiment(config).run(os.path.join(place, "run"))
            raw, mine, dichotomy = run.manifest["methods"]
            self.assertEqual((mine["status"], mine["message"]), ("failed", "LookupError: mine"))
            self.assertEqual((mine["judged_by"], mine["verdict"]), ("certified", "certified"))
            self.assertAlmostEqual(mine["duration_s"], 3.9)  # what it had proved by then
            self.assertEqual(dichotomy["status"], "converged")

    def test_in_a_run_ctrl_c_keeps_its_meaning(self):
        def impatient(problem):
            raise KeyboardInterrupt
        hs.register_smoother("mine/impatient", impatient)
        config = hs.load_config("fig3_two_half_steps", smoothing__methods=["mine/impatient"])
        with tempfile.TemporaryDirectory() as place:
            with self.assertRaises(KeyboardInterrupt):
                hs.Experiment(config).run(os.path.join(place, "run"))
            self.assertEqual(os.listdir(place), [])

    def test_what_is_no_walk_is_an_input_error(self):
        def wild(problem):
            problem.walk(overlaps=[7.0])
        hs.register_smoother("mine/wild", wild)
        with self.assertRaisesRegex(hs.InputError, r"overlaps\[0\]: 7 s \(valid: at most 0.95 s"):
            hs.Experiment("fig3_two_half_steps").smooth("mine/wild")

    def test_a_deadline_stops_it(self):
        def endless(problem):
            while not problem.stopped:
                pass
        hs.register_smoother("mine/endless", endless)
        result = hs.Experiment("fig3_two_half_steps").smooth("mine/endless", deadline=0.3)
        self.assertEqual(result.status, "no_improvement")

    def test_proposing_ends_it(self):
        def stubborn(problem):
            while True:
                problem.propose(problem.walk(overlaps=[0.3]))
        hs.register_smoother("mine/stubborn", stubborn)
        result = hs.Experiment("fig3_two_half_steps").smooth("mine/stubborn", deadline=0.3)
        self.assertEqual(result.status, "deadline")
        self.assertAlmostEqual(result.duration, 3.7)


class Solvers(unittest.TestCase):
    def test_a_function_is_a_solver_and_a_method(self):
        hs.register_solver("mine/descent", descend)
        self.assertEqual(hs.solvers()["mine/descent"], "")
        experiment = hs.Experiment("fig3_two_half_steps")
        result = experiment.smooth("mine/descent", durations=True, rounds=3)
        self.assertLess(result.duration, 3.1)
        self.assertTrue(result.certify())

    def test_what_it_raises_is_raised(self):
        def broken(problem, x0):
            problem.cost(x0[:-1])
        hs.register_solver("mine/short", broken)
        with self.assertRaisesRegex(ValueError, "numbers"):
            hs.Experiment("fig3_two_half_steps").smooth("mine/short", durations=True)

    def test_what_is_no_x_is_refused(self):
        for answer in (None, [1.0], [np.nan] * 3, "x"):
            hs.register_solver("mine/odd", lambda problem, x0, answer=answer: answer)
            with self.assertRaises((ValueError, TypeError)):
                hs.Experiment("fig3_two_half_steps").smooth("mine/odd", durations=True)


if __name__ == "__main__":
    unittest.main()
