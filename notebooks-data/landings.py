#!/usr/bin/env python3
"""What another landing could do against a push: landings.py HALFSTEP FOLDER > landings.csv

A walk of HRP-2 of two short steps, and the same walk with other landings of its last step. All are
one motion until the half-step begins that brings the foot down, so a robot that is pushed before
may still take any of them. In eight directions the largest push that each survives [N s], found to
1, in open loop and by the controller dcm on servos of 10,000 N m/rad: `planned` of the walk, `best`
of all landings, as if the best one were known when the push is felt. Runs go into FOLDER.
"""
import csv
import json
import pathlib
import subprocess
import sys

COLUMNS = ["at_s", "begins_s", "lands_s", "direction", "none_n_s", "planned_n_s", "best_n_s",
           "dx_m", "dy_m"]
PLANNED = (0.0, 0.0)
LANDINGS = [PLANNED, (0.12, 0.0), (0.10, 0.04), (0.0, 0.07), (-0.12, 0.06), (-0.17, 0.0),
            (0.0, -0.03), (0.12, -0.03)]
INSTANTS = ["1.80", "1.95"]
CONFIG = """name: landing
robot: hrp2
scene: none
half_step: {{duration_s: 1.5, zmp_shift_s: 0.075}}
smoothing: {{methods: [dichotomy], margins: {{double_support_s: 0.075}}}}
footsteps:
  - {{foot: right, x_m: 0.08, y_m: -0.105}}
  - {{foot: left, x_m: {x:.4f}, y_m: {y:.4f}}}
"""


def walk(halfstep, folder, landing):
    """The run of the walk with this landing, certified."""
    run = folder / "{:+.2f}{:+.2f}".format(*landing)
    config = folder / (run.name + ".yaml")
    config.write_text(CONFIG.format(x=0.16 + landing[0], y=0.105 + landing[1]), encoding="utf-8")
    subprocess.run([halfstep, "run", config, "--out", run, "--overwrite", "--quiet"], check=True)
    return run


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def begin_of_last(run):
    """When the half-step begins that brings the foot down [s]."""
    return float(table(run / "dichotomy" / "half_steps.csv")[-1]["start_s"])


def check_same(one, other, until):
    for a, b in zip(table(one / "dichotomy" / "trajectory.csv"),
                    table(other / "dichotomy" / "trajectory.csv")):
        if float(a["t_s"]) >= until:
            return
        if any(abs(float(a[key]) - float(b[key])) > 1e-9 for key in a if key.startswith("q_")):
            sys.exit(f"{other}: another motion before {until} s, at {a['t_s']} s")


def pushes(halfstep, run, controller):
    """The largest push survived [N s] by instant and direction."""
    command = [halfstep, "replay", run, "--method", "dichotomy", "--json", "--push",
               "--push-directions", "8", "--servos", "10000,300", "--controller", controller]
    for instant in INSTANTS:
        command += ["--push-at", instant]
    out = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    return {(f"{push['at_s']:.2f}", push["direction"]): push["survived_n_s"]
            for push in json.loads(out.stdout)["methods"][0]["pushes"]}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    halfstep, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    runs = {landing: walk(halfstep, folder, landing) for landing in LANDINGS}
    begins = begin_of_last(runs[PLANNED])
    lands = begins + (1.5 - 0.075) / 2
    for run in runs.values():
        check_same(runs[PLANNED], run, begins)
    open_loop = pushes(halfstep, runs[PLANNED], "none")
    controlled = {landing: pushes(halfstep, run, "dcm") for landing, run in runs.items()}
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(COLUMNS)
    for key, none in open_loop.items():
        best = max(LANDINGS, key=lambda landing: controlled[landing][key])
        out.writerow([key[0], f"{begins:.3f}", f"{lands:.3f}", key[1], f"{none:.1f}",
                      f"{controlled[PLANNED][key]:.1f}", f"{controlled[best][key]:.1f}",
                      f"{best[0]:.2f}", f"{best[1]:.2f}"])


if __name__ == "__main__":
    main()
