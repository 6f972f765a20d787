"""Trajectories of arrays and files, proved between their knots."""
import os
import tempfile
import unittest

import numpy as np

import halfstep as hs

URDF = """<robot name='hopper'><link name='trunk'/><link name='leg'><collision><origin xyz='0 0 -0.5'/>
<geometry><sphere radius='0.01'/></geometry></collision></link><joint name='hip' type='revolute'>
<parent link='trunk'/><child link='leg'/><axis xyz='0 1 0'/>
<limit lower='-2' upper='2' velocity='9' effort='9'/></joint></robot>"""
SWING = np.arccos(1 - 0.001 / 0.5)  # by which the foot sinks by 1 mm between both knots
TIMES = [0.0, 1.0]
HIP = np.array([[-SWING], [SWING]])
BASE = np.array([[0, 0, 0.5 * np.cos(SWING) + 0.01, 1, 0, 0, 0]] * 2)
INPUT = hs.InputError


class Checks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.robot = self.file("hopper.urdf")
        with open(self.robot, "w", encoding="utf-8") as file:
            file.write(URDF)

    def file(self, name):
        return os.path.join(self.folder, name)

    def check(self, *args, **options):
        return hs.check(*(args or (TIMES, HIP)), **{"robot": self.robot, **options})

    def test_a_foot_that_sinks_between_knots_is_found(self):
        found = self.check(joints=["hip"], base=BASE, ground=1e-4)
        self.assertFalse(found)
        [foot] = found.missed
        self.assertEqual((foot.kind, foot.subject), ("ground", "leg"))
        self.assertAlmostEqual(foot.at, 0.5, places=1)
        self.assertGreater(foot.at_knots, -1e-9)
        self.assertTrue(0.001 <= foot.holds < 0.001002)
        self.assertTrue(self.check(joints=["hip"], base=BASE, ground=0.00101))
        self.assertIn("proved", repr(found))

    def test_files_say_the_same_as_arrays(self):
        arrays = {"times": TIMES, "joints": ["hip"], "positions": HIP, "base": BASE}
        np.savez(self.file("a.npz"), **arrays)
        with open(self.file("a.csv"), "w", encoding="utf-8") as file:
            file.write("t,hip,base_x,base_y,base_z,base_qw,base_qx,base_qy,base_qz\n")
            for t, q, pose in zip(TIMES, HIP, BASE):
                file.write(",".join(repr(float(x)) for x in (t, *q, *pose)) + "\n")
        options = {"ground": 1e-4, "contacts": ["leg", ("leg", 0.0, 0.5)]}
        told = [self.check(*args, **more, **options) for args, more in (
            ((), {"joints": ["hip"], "base": BASE}), ((self.file("a.npz"),), {}),
            ((self.file("a.csv"),), {}))]
        self.assertEqual(told[0].findings, told[1].findings)
        self.assertEqual(told[0].findings, told[2].findings)
        self.assertEqual(len([one for one in told[0].missed if one.kind.startswith("contact")]), 4)

    def test_velocities_of_the_root_are_taken(self):
        rest = {"joints": ["hip"], "velocities": 0 * HIP, "base": BASE}
        sinks = BASE.copy()
        sinks[:, 2] += [0.01, 0.02]
        speeds = np.zeros((2, 6))
        speeds[0, 2] = -0.5  # 6 cm down between knots
        straight, cubic = (self.check(TIMES, HIP, **{**rest, "base": sinks}, ground=0.01, **more)
                           for more in ({}, {"base_velocities": speeds}))
        self.assertTrue(straight)
        self.assertEqual([one.subject for one in cubic.missed], ["leg"])
        np.savez(self.file("v.npz"), times=TIMES, positions=HIP, velocities=0 * HIP,
                 joints=["hip"], base=sinks, base_velocities=speeds)
        self.assertEqual(self.check(self.file("v.npz"), ground=0.01).findings, cubic.findings)

    def test_obstacles_are_looked_at(self):
        ball = {"obstacles": [{"name": "ball", "sphere": {"radius_m": 0.05},
                               "pose": {"xyz": [0, 0, -0.5]}}]}
        found = self.check(joints=["hip"], scene=ball)
        self.assertEqual([one.subject for one in found.missed], ["leg - ball"])

    def test_wrong_calls_have_a_sentence(self):
        np.savez(self.file("b.npz"), times=TIMES, q=HIP)
        for kind, words, call in (
                (INPUT, "joints: are missing", lambda: self.check()),
                (INPUT, "positions: shape (2, 1) (valid: (2, 2))",
                 lambda: self.check(joints=["hip", "knee"])),
                (INPUT, "knee: is no joint", lambda: self.check(joints=["knee"])),
                (INPUT, "base: shape", lambda: self.check(joints=["hip"], base=BASE[:, :6])),
                (INPUT, "base_velocities: shape (2, 7) (valid: (2, 6))",
                 lambda: self.check(joints=["hip"], base=BASE, base_velocities=BASE)),
                (INPUT, "base: is missing",
                 lambda: self.check(joints=["hip"], base_velocities=BASE[:, :6])),
                (INPUT, "--zmp: no contact is claimed",
                 lambda: self.check(joints=["hip"], zmp=0.01)),
                (INPUT, "friction: -1", lambda: self.check(joints=["hip"], friction=-1)),
                (INPUT, "base: knot 1: is no pose",
                 lambda: self.check(joints=["hip"], base=0 * BASE)),
                (TypeError, "positions: not numbers",
                 lambda: self.check(TIMES, "much", joints=["hip"])),
                (INPUT, "b.npz: q (valid: arrays times", lambda: self.check(self.file("b.npz"))),
                (INPUT, "interpolation: 'round'",
                 lambda: self.check(joints=["hip"], interpolation="round")),
                (INPUT, "ground: -1", lambda: self.check(joints=["hip"], ground=-1)),
                (INPUT, "no such link", lambda: self.check(joints=["hip"], contacts=["toe"])),
                (INPUT, "contacts: 3", lambda: self.check(joints=["hip"], contacts=[3])),
                (INPUT, "no robot", lambda: self.check(joints=["hip"], robot="nobody"))):
            with self.subTest(words=words):
                with self.assertRaises(kind) as caught:
                    call()
                self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
