#!/usr/bin/env python3
"""Drawn scenes with carts and doors: timed_plans.py STEP PROGRAM FOLDER timed_plans.csv [COUNT]

By seeds 1 to COUNT (60): carts that cross the way, a door that opens, a gap that closes. Each STEP
fills in columns of the table, and goes on where it was stopped; folders stay in FOLDER:

    plan        HRP-2 plans among them in time; `processor_s` of that, of which about 1.4 s certify
                the half-steps and read their volumes
    run         what was planned is smoothed by dichotomy, certified, verified; exit status 1 when
                one is not
    at_rest     planned after all have come to rest: when they rest, and the raw walk from then on;
                whether it is touched while it waits is not looked at
    everywhere  planned with obstacles everywhere that they ever are
    reference   among carts (a door asks for turned half-steps, which that search does not take):
                when the walk of a brute search in time ends, and its footsteps; PROGRAM is
                timed_reference_study, and for the other steps halfstep
"""
import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys

COLUMNS = ["seed", "kind", "status", "footsteps", "rest_s", "raw_s", "effort", "processor_s",
           "everywhere", "at_rest", "smoothed", "certified", "verified", "reference_s",
           "reference_footsteps"]
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


def config_of(name, scene, way="goal: {x_m: 1.6, y_m: 0, radius_m: 0.15}"):
    return f"""name: {name}
robot: hrp2
scene: {scene}
start:
  left:  {{x_m: 0, y_m: 0.105}}
  right: {{x_m: 0, y_m: -0.105}}
{way}
planner: {{workspace_m: [-0.5, -0.7, 2.0, 1.5]}}
smoothing: {{methods: [dichotomy]}}
"""


def plan(halfstep, config, *more):
    """What the program says, and the processor time that it took."""
    with subprocess.Popen([halfstep, "plan", config, "--json", *more], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True) as process:
        said = process.stdout.read()
        _, _, used = os.wait4(process.pid, 0)
        process.returncode = 0
    return json.loads(said), used.ru_utime + used.ru_stime


def footsteps_of(found):
    text = "footsteps:"
    for place in found["places"]:
        text += (f"\n  - {{foot: {place['foot']}, x_m: {place['x_m']!r}, y_m: {place['y_m']!r}, "
                 f"yaw_deg: {math.degrees(place['yaw_rad'])!r}")
        for key in ("rest_s", "rest_on_one_foot_s"):
            if place.get(key, 0) > 0:
                text += f", {key}: {place[key]!r}"
        text += "}"
    return text


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


def write_configs(seed, obstacles, folder):
    still = [(name, size, [(0, *way[-1][1:])]) for name, size, way in obstacles]
    for name, scene in [(f"moving_{seed}", obstacles), (f"still_{seed}", still)]:
        (folder / f"{name}_scene.yaml").write_text(scene_of(scene), encoding="utf-8")
        (folder / f"{name}.yaml").write_text(config_of(name, f"{name}_scene.yaml"), encoding="utf-8")


def plan_step(halfstep, folder, row):
    obstacles, row["kind"] = obstacles_of(int(row["seed"]))
    write_configs(row["seed"], obstacles, folder)
    found, seconds = plan(halfstep, folder / f"moving_{row['seed']}.yaml")
    (folder / f"found_{row['seed']}.json").write_text(json.dumps(found), encoding="utf-8")
    row |= {"status": found["status"], "footsteps": found["footsteps"],
            "effort": f"{found['effort']:.2f}", "processor_s": f"{seconds:.2f}"}
    if found["status"] == "solved":
        raw = raw_of(found)
        row["rest_s"] = f"{raw - 2 * HALF_STEP_S * found['footsteps']:.2f}"
        row["raw_s"] = f"{raw:.2f}"


def run_step(halfstep, folder, row):
    seed = row["seed"]
    found = json.loads((folder / f"found_{seed}.json").read_text(encoding="utf-8"))
    config = folder / f"planned_{seed}.yaml"
    config.write_text(config_of(f"moving_{seed}", f"moving_{seed}_scene.yaml", footsteps_of(found)),
                      encoding="utf-8")
    smoothed, row["certified"], row["verified"] = run_of(halfstep, config, folder / seed)
    row["smoothed"] = f"{smoothed:.2f}"


def at_rest_step(halfstep, folder, row):
    waited, _ = plan(halfstep, folder / f"still_{row['seed']}.yaml")
    settles = max(way[-1][0] for _, _, way in obstacles_of(int(row["seed"]))[0])
    solved = waited["status"] == "solved"
    row["at_rest"] = f"{settles + raw_of(waited):.2f}" if solved else waited["status"]


def everywhere_step(halfstep, folder, row):
    row["everywhere"] = plan(halfstep, folder / f"moving_{row['seed']}.yaml", "--set",
                             "planner.moving=everywhere")[0]["status"]


def reference_step(study, folder, row):
    said = subprocess.run([study, folder / f"moving_{row['seed']}.yaml"], check=True,
                          capture_output=True, text=True).stdout
    row["reference_s"], row["reference_footsteps"] = said.split()[:2]


STEPS = {"plan": ("status", plan_step), "run": ("certified", run_step),
         "at_rest": ("at_rest", at_rest_step), "everywhere": ("everywhere", everywhere_step),
         "reference": ("reference_s", reference_step)}


def main():
    if len(sys.argv) < 5 or sys.argv[1] not in STEPS:
        sys.exit(__doc__)
    column, step = STEPS[sys.argv[1]]
    program, folder, path = sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
    folder.mkdir(parents=True, exist_ok=True)
    count = int(sys.argv[5]) if len(sys.argv) > 5 else 60
    rows = {str(seed): dict.fromkeys(COLUMNS, "") | {"seed": str(seed)}
            for seed in range(1, count + 1)}
    if path.exists():
        with path.open(encoding="utf-8") as file:
            rows |= {row["seed"]: row for row in csv.DictReader(file)}
    for row in rows.values():
        if row[column] or (column == "certified" and row["status"] != "solved"):
            continue
        if column == "reference_s" and row["kind"] != "carts":
            continue
        step(program, folder, row)
        with path.open("w", encoding="utf-8") as file:
            table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            table.writeheader()
            table.writerows(rows.values())
    return int(any(row[key] == "0" for row in rows.values() for key in ("certified", "verified")))


if __name__ == "__main__":
    sys.exit(main())
