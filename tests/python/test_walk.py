"""Walks: samples, derivatives, margins, certificates."""
import unittest

import numpy as np

import halfstep as hs


class Walks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.experiment = hs.Experiment("fig3_two_half_steps")
        cls.walk = cls.experiment.walk(overlaps=[0.6])

    def test_parameters_have_the_shapes_of_the_half_steps(self):
        sizes = {name: len(values) for name, values in self.walk.parameters.items()}
        self.assertEqual(sizes, {"overlaps": 1, "height_scales": 1, "durations": 2,
                                 "support_points": 1, "via_laterals": 1, "foot_ramps": 2,
                                 "foot_delays": 2, "lift_shares": 2, "via_alongs": 1,
                                 "zmp_shifts": 2, "zmp_bump_ramps": 2, "footstep_xs": 1,
                                 "footstep_ys": 1, "footstep_yaws": 1,
                                 "rise_begins": 2, "rise_ends": 2})
        self.assertAlmostEqual(self.walk.duration, self.experiment.planned.duration - 0.6)
        np.testing.assert_allclose(self.walk.starts, [0.0, 1.4])

    def test_samples_keep_the_lipm(self):
        table = self.walk.sample(period=0.01)
        z_over_g = table["com_z_m"] / 9.80665
        for axis in "xy":
            zmp = table[f"com_{axis}_m"] - z_over_g * table[f"com_a{axis}_m_s2"]
            np.testing.assert_allclose(zmp, table[f"zmp_{axis}_m"], atol=1e-4)
        self.assertEqual(table["t_s"][-1], self.walk.duration)
        self.assertEqual(set(table["support"]), {"both", "left"})

    def test_without_joints_the_other_columns_are_the_same(self):
        times = np.linspace(-0.1, self.walk.duration + 0.1, 301)
        full, part = self.walk.sample(times=times), self.walk.sample(times=times, joints=False)
        self.assertEqual([n for n in full if not n.startswith("q_")], list(part))
        self.assertEqual(len(full) - len(part), 12)
        for name in part:
            if part[name].dtype == float:
                np.testing.assert_allclose(part[name], full[name], rtol=0, atol=1e-12)
            else:
                self.assertTrue((part[name] == full[name]).all(), name)

    def test_one_time_is_a_row_of_a_sample(self):
        row = self.walk.sample(times=[0.7]).row(0)
        self.assertEqual(self.walk.at(0.7), row)
        self.assertIsInstance(row["support"], str)

    def test_pandas_has_the_same_columns(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("no pandas")
        table = self.walk.sample(period=0.1)
        frame = table.to_pandas()
        self.assertEqual(list(frame.columns), list(table.names))
        self.assertEqual(len(frame), table.rows)

    def test_sensitivities_are_those_of_differences(self):
        h = 1e-6
        walk = self.experiment.walk(overlaps=[0.6], foot_ramps=[0.45, 0.4],
                                    foot_delays=[0.12, 0.1], lift_shares=[0.9, 0.95],
                                    via_alongs=[0.02], zmp_shifts=[0.06, 0.04],
                                    zmp_bump_ramps=[0.3, 0.8],
                                    footstep_xs=[0.01], footstep_yaws=[0.05])
        for t in (0.5, 1.2, 1.7, 2.6):
            found = walk.sensitivities(t, hold="time")
            self.assertEqual(found.value.shape, (len(found.parameters), 14))
            for i, (family, index) in enumerate(found.parameters):
                states = []
                for sign in (1, -1):
                    parameters = walk.parameters
                    parameters[family + "s"][index] += sign * h
                    row = self.experiment.walk(**parameters).at(t, joints=False)
                    states.append([row[f"{q}_{'rad' if 'yaw' in q else 'm'}"]
                                   for q in found.quantities])
                slope = np.subtract(*states) / (2 * h)
                np.testing.assert_allclose(found.value[i], slope, atol=2e-6,
                                           err_msg=f"{family} at {t} s")

    def test_margins_and_gradients(self):
        times = np.linspace(0, self.walk.duration, 50)
        margins = self.walk.margins(times)
        self.assertEqual(margins.rows, 50)
        self.assertIn("zmp_m", margins)
        near = self.walk.margin_gradients(1.5, cutoff=3.0)
        self.assertEqual(near.gradient.shape, (len(near.families), len(near.parameters)))
        self.assertGreater(len(near.families), 0)
        self.assertTrue(np.isfinite(near.gradient).all())
        least = self.walk.margins([1.5]).row(0)
        for family in set(near.families):
            column = next(name for name in least if name.startswith(family))
            values = [m for f, m in zip(near.families, near.margins) if f == family]
            self.assertAlmostEqual(min(values), least[column], places=9, msg=family)

    def test_margin_gradients_are_those_of_differences(self):
        t, h = 0.5, 1e-6  # of the first half-step, which does not move
        near = self.walk.margin_gradients(t, cutoff=10.0)
        column = near.parameters.index(("duration", 0))
        row = near.families.index("zmp")
        values = []
        for sign in (1, -1):
            durations = self.walk.parameters["durations"]
            durations[0] += sign * h
            other = self.experiment.walk(overlaps=[0.6], durations=durations)
            values.append(other.margin_gradients(t, cutoff=10.0).margins[row])
        self.assertAlmostEqual(near.gradient[row, column], (values[0] - values[1]) / (2 * h),
                               places=5)

    def test_certificates(self):
        good = self.walk.certify()
        self.assertTrue(good)
        self.assertEqual(good.status, "certified")
        self.assertGreater(good.rows.rows, 20)
        bad = self.experiment.walk(overlaps=[0.9], durations=[1.95, 1.95]).certify()
        self.assertEqual(bad.status, "violated")
        self.assertIn("demanded", bad.sentence)

    def test_a_walk_outlives_its_experiment(self):
        walk = hs.Experiment("fig3_two_half_steps").planned
        self.assertEqual(walk.sample(period=0.1).rows, 41)

    def test_a_hundred_thousand_instants(self):
        times = np.linspace(0, self.walk.duration, 100_000)
        table = self.walk.sample(times=times, joints=False)  # how fast: scipy_study.py
        self.assertEqual(table.rows, 100_000)
        self.assertTrue(np.isfinite(table["com_x_m"]).all())


if __name__ == "__main__":
    unittest.main()
