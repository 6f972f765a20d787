"""The overlap program, for SciPy and for solvers of one's own."""
import unittest

import numpy as np

import halfstep as hs


class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.experiment = hs.Experiment("fig3_two_half_steps")
        cls.program = hs.OverlapProgram(cls.experiment, heights=True, durations=True)

    def test_shapes_and_names(self):
        p = self.program
        self.assertEqual(p.names, ["overlap[0]", "height_scale[0]", "duration[0]", "duration[1]"])
        self.assertEqual(p.x0.shape, (4,))
        self.assertTrue((p.lower <= p.x0).all() and (p.x0 <= p.upper).all())
        rows = len(p.constraint_lower)
        self.assertEqual(p.constraints(p.x0).shape, (rows,))
        self.assertEqual(p.jacobian(p.x0).shape, (rows, 4))
        self.assertEqual(p.watched().rows, rows)

    def test_derivatives_are_those_of_differences(self):
        p = self.program
        x = p.x0 + [0.3, -0.1, -0.2, -0.15]
        jacobian = p.jacobian(x)
        dense = jacobian.toarray() if hasattr(jacobian, "toarray") else jacobian
        gradient, h = p.gradient(x), 1e-6
        for i in range(4):
            step = np.zeros(4)
            step[i] = h
            self.assertAlmostEqual(gradient[i], (p.cost(x + step) - p.cost(x - step)) / (2 * h),
                                   places=5)
            slope = (p.constraints(x + step) - p.constraints(x - step)) / (2 * h)
            np.testing.assert_allclose(dense[:, i], slope, atol=2e-3, rtol=1e-3)

    def test_a_walk_and_back(self):
        x = self.program.x0 + [0.3, -0.1, -0.2, -0.15]
        walk = self.program.walk(x)
        self.assertAlmostEqual(walk.duration, self.program.cost(x))
        np.testing.assert_allclose(self.program.to_x(walk), x, atol=1e-9)

    def test_overlaps_may_stay(self):
        program = hs.OverlapProgram(self.experiment, overlaps=False, heights=True)
        self.assertEqual(program.names, ["height_scale[0]"])
        safest = hs.OverlapProgram(self.experiment, "safest", duration_limit=3.5)
        self.assertEqual(safest.names[-1], "least_slack[0]")

    def test_refining_learns_where_a_walk_fails(self):
        program = hs.OverlapProgram(self.experiment, instants=2)
        x = np.array([1.0])
        before = program.constraints(x).min()
        found = program.refine(x)
        self.assertFalse(found.proved)
        self.assertIn("demanded", found.sentence)
        self.assertLess(program.constraints(x).min(), max(before, 0.0))


class WithSciPy(unittest.TestCase):
    def solve(self, method, **options):
        try:
            from scipy.optimize import Bounds, NonlinearConstraint, minimize
        except ImportError:
            self.skipTest("no SciPy")
        experiment = hs.Experiment("bar_8cm")
        start = experiment.smooth("dichotomy", tolerance_s=0.1).walk
        program = hs.OverlapProgram(experiment, heights=True, durations=True)
        x, best = program.to_x(start), start
        for _ in range(options.pop("rounds")):
            rows = NonlinearConstraint(program.constraints, program.constraint_lower,
                                       program.constraint_upper, jac=program.jacobian
                                       if method == "trust-constr" else
                                       lambda x: program.jacobian(x).toarray())
            x = minimize(program.cost, x, jac=program.gradient, method=method, constraints=[rows],
                         bounds=Bounds(program.lower, program.upper, keep_feasible=True),
                         options=options).x
            x = np.clip(x, program.lower, program.upper)
            if program.refine(x).proved and program.cost(x) < best.duration:
                best = program.walk(x)
        return best

    def test_slsqp_beats_the_dichotomy(self):
        walk = self.solve("SLSQP", rounds=4, maxiter=15)
        self.assertLess(walk.duration, 7.1)
        self.assertTrue(walk.certify())

    def test_trust_constr_beats_the_dichotomy(self):
        walk = self.solve("trust-constr", rounds=2, maxiter=40)
        self.assertLess(walk.duration, 7.1)
        self.assertTrue(walk.certify())


if __name__ == "__main__":
    unittest.main()
