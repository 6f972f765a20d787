"""Walks on a simulated robot, and controllers written in Python."""
import os
import tempfile
import unittest

import numpy as np

import halfstep as hs


class PlanItself:
    """The plan, one command after the other; counts them."""

    made = 0
    seen: list = []

    def __init__(self):
        PlanItself.made += 1

    def command(self, measured, then, next):
        PlanItself.seen.append((measured, then, next))
        return next.q, next.speeds


class WrongSign:
    """Doubles what joints are off, in place of taking it away."""

    def command(self, measured, then, next):
        return next.q + 2.0 * (measured.q - then.q), next.speeds


class Returns:
    """Whatever it was made of."""

    def __init__(self, value):
        self.value = value

    def command(self, measured, then, next):
        if isinstance(self.value, Exception):
            raise self.value
        return self.value


class Replays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.place.cleanup)
        config = hs.load_config("fig3_two_half_steps", smoothing__methods=["dichotomy"])
        cls.run_ = hs.Experiment(config).run(os.path.join(cls.place.name, "run"))
        try:
            cls.plan = cls.run_.replay("dichotomy", servos=(10000, 300))
        except hs.InputError as error:
            raise unittest.SkipTest(str(error)) from error

    def replay(self, controller, **more):
        return self.run_.replay("dichotomy", controller, servos=(10000, 300), **more)

    def test_the_plan_from_python_is_the_plan(self):
        PlanItself.made, PlanItself.seen = 0, []
        replay = self.replay(PlanItself)
        self.assertTrue(replay)
        self.assertEqual(PlanItself.made, 1)
        self.assertEqual(replay.table.names, self.plan.table.names)
        off = abs(replay.table.array("waist_x_m", "waist_z_m", "tilt_rad") -
                  self.plan.table.array("waist_x_m", "waist_z_m", "tilt_rad")).max()
        self.assertLess(off, 1e-9)  # the same cubics, rounded otherwise
        measured, then, after = PlanItself.seen[100]
        self.assertEqual(measured.t, then.t)
        self.assertAlmostEqual(after.t - then.t, 0.01)
        self.assertLess(abs(measured.q - then.q).max(), 0.02)
        self.assertAlmostEqual(measured.forces.sum(), then.force, delta=0.2 * then.force)
        self.assertEqual(then.X_WB.shape, (4, 4))
        np.testing.assert_allclose(then.X_WL[:3, 3], [0, 0.105, 0], atol=0.3)

    def test_a_wrong_sign_falls(self):
        replay = self.replay(WrongSign, seeds=1)
        self.assertFalse(replay)
        self.assertEqual(replay.stands, 0)

    def test_each_seed_gets_a_controller_of_its_own(self):
        PlanItself.made = 0
        replay = self.replay(PlanItself, seeds=2)
        self.assertEqual((replay.stands, replay.of, PlanItself.made), (2, 2, 2))
        self.assertEqual(replay.table.rows, 2)

    def test_what_it_raises_is_raised(self):
        for value, kind, words in (
                (ZeroDivisionError("of mine"), ZeroDivisionError, "of mine"),
                (3, TypeError, "returned int"),
                ((np.zeros((2, 6)), np.zeros(6)), hs.InputError, r"speeds of shape \(6,\)"),
                ((np.full((2, 6), np.nan), np.zeros((2, 6))), hs.InputError, "not finite")):
            with self.assertRaisesRegex(kind, words):
                self.replay(lambda value=value: Returns(value), seeds=2)
        with self.assertRaisesRegex(TypeError, "an object with command"):
            self.replay(object)
        with self.assertRaisesRegex(TypeError, "PlanItself .valid: a name, or a function"):
            self.replay(PlanItself())
        with self.assertRaisesRegex(hs.InputError, "controller: 'pid' .valid: none, dcm, or"):
            self.replay("pid")
        with self.assertRaisesRegex(hs.InputError, "servos: is no spring"):
            self.run_.replay("dichotomy", servos=(1, 2, 3))
        with self.assertRaisesRegex(hs.InputError, "seeds: 0"):
            self.replay(None, seeds=0)


if __name__ == "__main__":
    unittest.main()
