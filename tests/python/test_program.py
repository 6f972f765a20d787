"""The overlap program, for SciPy and for solvers of one's own."""
import unittest
import warnings

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
    """bar_8cm over overlaps, heights and durations; the dichotomy ends at 7.2 s."""

    @classmethod
    def setUpClass(cls):
        try:
            from scipy import optimize
        except ImportError:
            raise unittest.SkipTest("no SciPy") from None
        cls.optimize = optimize
        cls.experiment = hs.Experiment(hs.load_config("bar_8cm", smoothing__profile="limit"))

    def minimize(self, program, x, method, room, **options):
        def jacobian(x):
            rows = program.jacobian(x)
            return rows.toarray() if method == "SLSQP" else rows
        rows = self.optimize.NonlinearConstraint(program.constraints, program.constraint_lower,
                                                 program.constraint_upper, jac=jacobian)
        bounds = self.optimize.Bounds(np.maximum(program.lower, x - room),
                                      np.minimum(program.upper, x + room))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # SciPy steps over bounds, and says so
            found = self.optimize.minimize(program.cost, x, jac=program.gradient, method=method,
                                           constraints=[rows], bounds=bounds, options=options).x
        return np.clip(found, program.lower, program.upper)

    def test_slsqp_beats_the_dichotomy(self):
        program = hs.OverlapProgram(self.experiment, heights=True, durations=True, sharpness=20.0)
        x = best = program.to_x(self.experiment.smooth("dichotomy", tolerance_s=0.1).walk)
        for _ in range(4):  # refused or not, the program has learned from it where to look
            x = self.minimize(program, best, "SLSQP", 0.2, maxiter=6)
            if program.refine(x).proved and program.cost(x) < program.cost(best):
                best = x
        walk = program.walk(best)
        self.assertLess(walk.duration, 7.1)
        self.assertTrue(walk.certify())

    def test_trust_constr_beats_the_dichotomy(self):
        program = hs.OverlapProgram(self.experiment, heights=True, durations=True)
        x, best = program.x0, program.x0
        for _ in range(3):
            x = self.minimize(program, x, "trust-constr", np.inf, maxiter=60, initial_tr_radius=0.1)
            if program.refine(x).proved and program.cost(x) < program.cost(best):
                best = x
        walk = program.walk(best)
        self.assertLess(walk.duration, 7.1)
        self.assertTrue(walk.certify())


if __name__ == "__main__":
    unittest.main()
