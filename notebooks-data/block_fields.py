#!/usr/bin/env python3
"""Drawn fields of blocks: block_fields.py HALFSTEP COUNT FOLDER > block_fields.csv

`plan_blocks` over the fields of seeds 1 to COUNT (`halfstep draw blocks --count 50`), odd ones by
`astar`, even ones by `rrt`: planned, smoothed by dichotomy, certified, verified, and replayed with
eight seeds by the controller on servos of 10,000 N m/rad. Runs stay in FOLDER, and what is there is
not made again. Exit status 1 when a walk falls, touches anything or is not verified.
"""
import csv
import math
import pathlib
import subprocess
import sys

from survival import SEEDS, replayed

COLUMNS = ["seed", "planner", "raw_s", "duration_s", "certified", "verified", "stands", "of", "touches",
           "tilt_deg"]
CONFIG = pathlib.Path(__file__).parent.parent / "experiments" / "configs" / "plan_blocks.yaml"
ROBOT = ["--servos", "10000,300", "--controller", "dcm", "--seeds", str(SEEDS)]


def row_of(halfstep, seed, place):
    planner = "astar" if seed % 2 else "rrt"
    scene, run = place / f"blocks_{seed}.yaml", place / f"field_{seed}"
    if not (run / "summary.csv").exists():
        drawn = subprocess.run([halfstep, "draw", "blocks", "--count", "50", "--seed", str(seed)],
                               check=True, stdout=subprocess.PIPE, text=True).stdout
        scene.write_text(drawn, encoding="utf-8")
        subprocess.run([halfstep, "run", str(CONFIG), "--quiet", "--overwrite", "--out", str(run),
                        "--set", f"scene={scene.resolve()}", "--set", f"planner.name={planner}"],
                       check=True)
    with open(run / "summary.csv", encoding="utf-8") as file:
        rows = {row["method"]: row for row in csv.DictReader(file)}
    walk = rows["dichotomy"]
    verified = subprocess.run([halfstep, "verify", str(run), "--json"], check=False,
                              stdout=subprocess.DEVNULL).returncode == 0
    seeds = replayed(halfstep, "dichotomy", str(run), ROBOT)
    return [seed, planner, f"{float(rows['raw']['duration_s']):.2f}",
            f"{float(walk['duration_s']):.2f}", walk["certified"], str(verified).lower(),
            seeds["stands"], seeds["of"], sum(one["touches"] for one in seeds["seeds"]),
            f"{math.degrees(seeds['median']['largest_tilt_rad']):.2f}"]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    place = pathlib.Path(sys.argv[3])
    place.mkdir(parents=True, exist_ok=True)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    good = True
    for seed in range(1, int(sys.argv[2]) + 1):
        row = row_of(sys.argv[1], seed, place)
        good = good and row[4:6] == ["true", "true"] and row[6] == row[7] and row[8] == 0
        table.writerow(row)
        sys.stdout.flush()
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
