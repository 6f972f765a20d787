#!/usr/bin/env python3
"""Runs the examples in C++ and looks for what each says.   examples_test.py FOLDER_OF_PROGRAMS"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv[1]).resolve()
SOURCE = pathlib.Path(__file__).resolve().parents[2]
CACHE = str(FOLDER.parents[1] / "cache_of_tests")  # of swept volumes, as for the examples in Python


def number(pattern, text):
    return float(re.search(pattern, text).group(1))


class Examples(unittest.TestCase):
    def told_by(self, name, *arguments):
        with tempfile.TemporaryDirectory() as place:
            done = subprocess.run([FOLDER / name, *arguments], cwd=place, text=True,
                                  env=os.environ | {"XDG_CACHE_HOME": CACHE}, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_01(self):
        told = self.told_by("01_walk_from_footsteps")
        self.assertLess(number(r"overlapped: ([\d.]+)", told), number(r"isolated:  ([\d.]+)", told))

    def test_02(self):
        self.assertEqual(self.told_by("02_margins").count("\n"), 16)  # 15 families, and a heading

    def test_03(self):
        self.assertIn("certified: yes", self.told_by("03_dichotomy_and_certificate"))

    def test_04(self):
        told = self.told_by("04_program_by_ipopt")
        if "Not compiled in" not in told:
            self.assertLess(number(r"([\d.]+) s, certified", told), 8.0)

    def test_05(self):
        lifted = re.findall(r"lifted by ([\d.]+) m", self.told_by("05_own_objective"))
        self.assertLess(float(lifted[1]), float(lifted[0]))

    def test_06(self):
        told = self.told_by("06_own_solver")
        self.assertLess(number(r"mine/descent +([\d.]+)", told), number(r"dichotomy +([\d.]+)", told))
        self.assertIn("mine/descent", self.told_by("06_own_solver", "list", "methods"))

    def test_07(self):
        without = number(r"at most ([\d.]+) m/s", self.told_by("07_own_margin", "without"))
        told = self.told_by("07_own_margin")
        self.assertGreater(without, 0.3)
        self.assertLessEqual(number(r"at most ([\d.]+) m/s", told), 0.3)
        self.assertIn("own of CoM's speed", told)

    def test_a_run_with_an_own_margin_is_verified_but_for_that(self):
        told, verified = self.run_of("07_own_margin", "dichotomy")
        self.assertIn("certified", told)
        self.assertEqual(verified.count("\n  verified\n"), 2, verified)  # raw and dichotomy
        self.assertEqual(verified.count("not examined: whether the family `own` holds (1 "), 2)

    def test_a_run_of_an_own_smoother_is_verified(self):
        told, verified = self.run_of("11_own_smoother", "mine/scale")
        self.assertIn("mine/scale             converged", told)
        self.assertEqual(verified.count("\n  verified\n"), 2, verified)
        self.assertIn("does not have: the method mine/scale", verified)

    def run_of(self, name, method):
        """What `run` of a program with RunExperiment says, and then `halfstep verify`."""
        with tempfile.TemporaryDirectory() as place:
            run = pathlib.Path(place) / "run"
            config = SOURCE / "experiments/configs/fig3_two_half_steps.yaml"
            told = self.told_by(name, "run", str(config), "--out", str(run), "--set",
                                f"smoothing.methods=[{method}]")
            done = subprocess.run([FOLDER.parent / "halfstep", "verify", "--verbose", run],
                                  text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return told, done.stdout

    def test_08(self):
        self.assertGreater(self.told_by("08_plan_in_own_scene").count("left"), 1)

    def test_09(self):
        rows = [line.split() for line in self.told_by("09_sweep_and_plot").splitlines()[1:]]
        self.assertGreaterEqual(len(rows), 3)
        self.assertGreater(float(rows[-1][1]), float(rows[0][1]))

    def test_10(self):
        self.assertIn("wren", self.told_by("10_own_robot"))

    def test_11(self):
        told = self.told_by("11_own_smoother")
        self.assertLess(number(r"mine/scale +proved, ([\d.]+)", told), 15.0)  # raw: 16 s
        self.assertIn("mine/scale", self.told_by("11_own_smoother", "list", "methods"))

    def test_12(self):
        heights = re.findall(r"([\d.]+)$", self.told_by("12_up_the_stairs"), re.M)
        self.assertEqual(heights[-2:], ["0.10", "0.20"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
