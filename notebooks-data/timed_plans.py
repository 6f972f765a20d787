#!/usr/bin/env python3
"""Drawn scenes with carts and doors: timed_plans.py HALFSTEP COUNT FOLDER [RUNS] > timed_plans.csv

By seeds 1 to COUNT: carts that cross the way, a door that opens, a gap that closes. HRP-2 plans
among them in time, with obstacles everywhere that they ever are, and after all have come to rest
(`at_rest`: when they rest, and the raw walk from then on; whether it is touched while it waits is
not looked at). The first RUNS (all) solved ones are smoothed by dichotomy, certified and verified.
Folders stay in FOLDER. Exit status 1 when a run is not certified or not verified.
"""
import csv
import json
import pathlib
import random
import subprocess
import sys

COLUMNS = ["seed", "kind", "status", "footsteps", "rest_s", "raw_s", "effort", "everywhere",
           "at_rest", "smoothed", "certified", "verified"]
KINDS = ["carts", "door", "gap"]
HALF_STEP_S = 2.0


def box(name, size, way):
    """An obstacle: full edges, and where its middle is at which times: [(t, x, y)], the first at 0."""
    height = 0.5 * size[2]
    text = (f"  - name: {name}\n    box: {{size_m: [{size[0]:.3f}, {size[1]:.3f}, {size[2]:.3f}]}}\n"
            f"    pose: {{xyz: [{way[0][1]:.3f}, {way[0][2]:.3f}, {height:.3f}]}}\n")
    if len(way) > 1:
        text += "    motion:\n      error_m: 0.01\n      waypoints:\n" + "".join(
            f"        - {{t_s: {t:.3f}, xyz: [{x:.3f}, {y:.3f}, {height:.3f}]}}\n"
            for t, x, y in way[1:])
    return text


def obstacles_of(seed):
    """The obstacles as (name, size, way), and the kind of scene."""
    draw = random.Random(seed)
    kind = KINDS[seed % len(KINDS)]
    if kind == "carts":
        carts = []
        for k in range(draw.randint(1, 3)):
            x, side = draw.uniform(0.45, 1.3), draw.choice([-1, 1])
            leaves = draw.uniform(0.1, 4 + 12 * x)  # about when the robot comes there
            lasts = draw.uniform(4, 14)
            carts.append((f"cart_{k}", (draw.uniform(0.25, 0.5), draw.uniform(0.3, 0.5), 0.9),
                          [(0, x, 1.6 * side), (leaves, x, 1.6 * side),
                           (leaves + lasts, x, -1.6 * side)]))
        return carts, kind
    x, width = draw.uniform(0.6, 1.0), 0.9
    walls = [("wall_right", (0.1, 1.6, 1.0), [(0, x, -0.8 - 0.5 * width)])]
    if kind == "door":  # the only way, and shut until it opens
        walls.append(("wall_left", (0.1, 1.6, 1.0), [(0, x, 0.8 + 0.5 * width)]))
        opens, lasts = draw.uniform(2, 30), draw.uniform(1, 4)
        walls.append(("door", (0.04, width, 1.0),
                      [(0, x, 0), (opens, x, 0), (opens + lasts, x, draw.choice([-1, 1]) * width)]))
        return walls, kind
    # The way straight on shuts; there is a longer one to the left.
    walls.append(("wall_left", (0.1, 0.3, 1.0), [(0, x, 0.15 + 0.5 * width)]))
    shuts, lasts = draw.uniform(4, 40), draw.uniform(1, 4)
    walls.append(("gate", (0.04, width, 1.0),
                  [(0, x, -width), (shuts, x, -width), (shuts + lasts, x, 0)]))
    return walls, kind


def scene_of(obstacles):
    return "obstacles:\n" + "".join(box(*one) for one in obstacles)


def config_of(name, scene):
    return f"""name: {name}
robot: hrp2
scene: {scene}
start:
  left:  {{x_m: 0, y_m: 0.105}}
  right: {{x_m: 0, y_m: -0.105}}
goal: {{x_m: 1.6, y_m: 0, radius_m: 0.15}}
planner: {{workspace_m: [-0.5, -0.7, 2.0, 1.5]}}
smoothing: {{methods: [dichotomy]}}
"""


def plan(halfstep, config, *more):
    done = subprocess.run([halfstep, "plan", config, "--json", *more], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, check=False, text=True)
    return json.loads(done.stdout)


def raw_of(found):
    return sum(2 * HALF_STEP_S + place.get("rest_s", 0) + place.get("rest_on_one_foot_s", 0)
               for place in found["places"])


def run_of(halfstep, config, folder):
    """How long the smoothed walk is, whether it is certified, and whether all of it is verified."""
    subprocess.run([halfstep, "run", config, "--out", folder, "--overwrite", "--quiet"], check=False)
    verified = subprocess.run([halfstep, "verify", folder, "--quiet"], check=False).returncode == 0
    rows = {row["method"]: row for row in csv.DictReader((folder / "summary.csv").open(encoding="utf-8"))}
    certified = all(row["certified"] == "true" for row in rows.values())
    return float(rows["dichotomy"]["duration_s"]), int(certified), int(verified)


def main():
    halfstep, count, folder = sys.argv[1], int(sys.argv[2]), pathlib.Path(sys.argv[3])
    runs = int(sys.argv[4]) if len(sys.argv) > 4 else count
    folder.mkdir(parents=True, exist_ok=True)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    wrong = False
    for seed in range(1, count + 1):
        obstacles, kind = obstacles_of(seed)
        still = [(name, size, [(0, *way[-1][1:])]) for name, size, way in obstacles]
        for name, scene in [(f"moving_{seed}", obstacles), (f"still_{seed}", still)]:
            (folder / f"{name}_scene.yaml").write_text(scene_of(scene), encoding="utf-8")
            (folder / f"{name}.yaml").write_text(config_of(name, f"{name}_scene.yaml"), encoding="utf-8")
        config = folder / f"moving_{seed}.yaml"
        found = plan(halfstep, config)
        everywhere = plan(halfstep, config, "--set", "planner.moving=everywhere")
        waited = plan(halfstep, folder / f"still_{seed}.yaml")
        row = [seed, kind, found["status"], found["footsteps"], "", "", f"{found['effort']:.2f}",
               everywhere["status"], ""]
        if waited["status"] == "solved":
            settles = max(way[-1][0] for _, _, way in obstacles)
            row[-1] = f"{settles + raw_of(waited):.2f}"
        if found["status"] == "solved":
            raw = raw_of(found)
            row[4:6] = [f"{raw - 2 * HALF_STEP_S * found['footsteps']:.2f}", f"{raw:.2f}"]
            if runs > 0:
                runs -= 1
                smoothed, certified, verified = run_of(halfstep, config, folder / str(seed))
                row += [f"{smoothed:.2f}", certified, verified]
                wrong = wrong or not certified or not verified
        table.writerow(row + [""] * (len(COLUMNS) - len(row)))
        sys.stdout.flush()
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
