#!/usr/bin/env python3
"""A proof's file is read back to the bit, `halfstep check` and the second checker agree on it, and
neither proves a forgery.   proof_test.py HALFSTEP"""
import copy
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy  # noqa: F401  that the second checker needs
except ImportError:
    print("NumPy (python3-numpy) is not here: the second checker was not tried")
    sys.exit(77)

HALFSTEP = sys.argv[1]
SECOND = pathlib.Path(__file__).parents[2] / "experiments/checker/second_checker.py"
CONFIG = """robot: wren
scene: scene.yaml
footsteps:
  - {foot: right, x_m: 0.06, y_m: -0.04, yaw_deg: 10}
smoothing: {methods: [dichotomy]}
"""
SCENE = """obstacles:
  - name: ball
    box: {size_m: [0.05, 0.1, 0.05]}
    pose: {xyz: [0.16, -0.6, 0.1]}
    motion:
      waypoints:
        - {t_s: 1.1, xyz: [0.2, 0.1, 0.15], yaw_deg: 70}
      error_m: 0.003
      speed_m_s: 0.004
no_step:
  - {name: hole, polygon_m: [[0.3, -0.2], [0.4, -0.2], [0.4, 0.2]]}
"""


def run(*words, cwd):
    return subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True)


def both(proof, name, folder):
    """Exit statuses and what was said."""
    path = pathlib.Path(folder) / f"{name}.json"
    path.write_text(proof if isinstance(proof, str) else json.dumps(proof))
    first = run(HALFSTEP, "check", path, cwd=folder)
    second = run(sys.executable, "-B", SECOND, path, cwd=folder)
    return (first.returncode, second.returncode), first.stdout + first.stderr, second.stdout + second.stderr


def family(proof, name):
    return next(f for f in proof["statement"]["families"] if f["family"] == name)


def raised(proof, name, kept):
    family(proof, name)["demanded"] = kept


def nudged(proof):
    proof["motion"]["overlaps_s"][0] += 0.002


def nearer(proof):
    proof["scene"]["obstacles"][0]["waypoints"][0]["position_m"][0] = 0.12


def tighter(proof):
    for joint in proof["robot"]["legs"]["right"]["joints"]:
        joint["upper_rad"] = min(joint["upper_rad"], 0.6)


def without_hint(proof):
    hints = proof["hints"]["directions"]
    longest = max((h for h in hints if h["family"] == "self_clearance"), key=lambda h: len(h["from"]))
    longest["from"] = []


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "config.yaml").write_text(CONFIG)
        (folder / "scene.yaml").write_text(SCENE)
        made = run(HALFSTEP, "run", "config.yaml", "--out", "made", "--quiet", cwd=folder)
        assert made.returncode == 0, made.stderr
        words = [HALFSTEP, "check", "made", "--method", "dichotomy", "--proof", "walk.json"]
        proved = run(*words, cwd=folder)
        assert proved.returncode == 0, proved.stderr
        text = (folder / "walk.json").read_text()
        proof = json.loads(text)
        assert proof["format"] == "halfstep proof 1" and len(proof["sources"]) > 5
        statuses, first, second = both(text, "same", folder)
        assert statuses == (0, 0), (statuses, first, second)
        assert second.startswith("proved: "), second
        print(second.splitlines()[0] + ", " + second.splitlines()[1])
        # Numbers as another program prints them.
        statuses, _, again = both(proof, "printed", folder)
        assert statuses == (0, 0) and again == second, again

        with open(folder / "made/dichotomy/trajectory.csv", encoding="utf-8", newline="") as table:
            kept = min(float(row["zmp_robot_margin_m"]) for row in csv.DictReader(table))
        forgeries = {
            "raised": lambda p: raised(p, "zmp_robot", kept + 1e-8),
            "nudged": nudged, "nearer": nearer, "tighter": tighter, "without_hint": without_hint}
        for name, forge in forgeries.items():
            forged = copy.deepcopy(proof)
            forge(forged)
            statuses, first, second = both(forged, name, folder)
            assert statuses == (1, 1), (name, statuses, first, second)
            if name == "without_hint":
                assert "hint missing" in first and "hint missing" in second, (first, second)
            print(f"{name}: {second.splitlines()[0]}")
        for name, change in {"format": ("format", "halfstep proof 2"), "robot": ("robot", {})}.items():
            forged = {**proof, change[0]: change[1]}
            statuses, first, second = both(forged, name, folder)
            assert statuses == (2, 2), (name, statuses, first, second)
        turned = copy.deepcopy(proof)
        turned["robot"]["legs"]["left"]["sole"]["R"][0][0] += 1e-6
        statuses, first, second = both(turned, "turned", folder)
        assert statuses == (2, 2), (statuses, first, second)


if __name__ == "__main__":
    main()
