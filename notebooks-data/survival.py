#!/usr/bin/env python3
"""How well walks stand in replay.

  survival.py HALFSTEP METHOD RUN… > survival.csv    plays the walks of a method in folders of
                                                     `halfstep run`, four at a time
  survival.py --tables survival.csv                  the tables of measurements.md and
                                                     experiments/README.md

A row is a walk on one of ROBOTS, open loop and controlled: once undisturbed (tilt, how far soles,
waist and joints are from the plan: what 95 % of the time does not exceed, and the largest), and,
on the robots of SEEDED, with eight seeds (in how many it stands, and in how many of them it touches
an obstacle; medians of the largest tilt and of the share of time at the soles' edges).
"""
import concurrent.futures
import csv
import json
import math
import pathlib
import subprocess
import sys

SEEDS = 8
ROBOTS = {
    "ideal": ["--controller", "none"],
    "ideal dcm": ["--controller", "dcm"],
    "10000": ["--servos", "10000,300", "--controller", "none"],
    "10000 dcm": ["--servos", "10000,300", "--controller", "dcm"],
    "3000": ["--servos", "3000,150", "--controller", "none"],
    "3000 dcm": ["--servos", "3000,150", "--controller", "dcm"],
    "ankle": ["--ankle", "1000,50", "--controller", "none"],
    "ankle dcm": ["--ankle", "1000,50", "--controller", "dcm"],
}
SEEDED = ["ideal", "10000", "10000 dcm", "3000 dcm", "ankle", "ankle dcm"]
PARTS = {"feet": ("foot_m", 1e3, "mm"), "waist": ("waist_m", 1e3, "mm"),
         "joints": ("joint_rad", 180 / math.pi, "deg")}
COLUMNS = ["walk", "method", "duration_s", "robot", "stands", "of", "touch", "tilt_deg",
           "edge_share", "undisturbed_stands", "undisturbed_tilt_deg"] + [
               f"{part}_{which}_{unit}" for part, (_, _, unit) in PARTS.items()
               for which in ("most", "largest")]


def replayed(halfstep, method, run, options):
    """What `halfstep replay` says of the run's walk; falls are no failure here."""
    command = [halfstep, "replay", run, "--method", method, "--json", *options]
    out = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if out.returncode not in (0, 1) or not out.stdout:
        sys.exit(f"{' '.join(command)}: exit status {out.returncode}")
    return json.loads(out.stdout)["methods"][0]


def row_of(halfstep, method, run, robot):
    once = replayed(halfstep, method, run, ROBOTS[robot])
    row = [pathlib.Path(run).name, once["method"], f"{once['duration_s']:.3f}", robot]
    if robot in SEEDED:
        seeds = replayed(halfstep, method, run, [*ROBOTS[robot], "--seeds", str(SEEDS)])
        touch = sum(seed["touches"] > 0 for seed in seeds["seeds"])
        tilt = math.degrees(seeds["median"]["largest_tilt_rad"])
        row += [seeds["stands"], seeds["of"], touch, f"{tilt:.2f}",
                f"{seeds['median']['edge_share']:.3f}"]
    else:
        row += ["", "", "", "", ""]
    off = once["tracking"]
    row += [int(once["stayed_up"]), f"{math.degrees(once['largest_tilt_rad']):.2f}"]
    for key, unit, _ in PARTS.values():
        row += [f"{unit * off[which][key]:.2f}" for which in ("most", "largest")]
    return row


def measure(halfstep, method, runs):
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        cells = [(halfstep, method, run, robot) for run in runs for robot in ROBOTS]
        for row in pool.map(lambda cell: row_of(*cell), cells):
            table.writerow(row)
            sys.stdout.flush()


def line(cells):
    print("| " + " | ".join(cells) + " |")


def tables(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    walks = list(dict.fromkeys((row["walk"], row["duration_s"]) for row in rows))
    of = {(row["walk"], row["robot"]): row for row in rows}
    line(["walk", "D [s]", *SEEDED])
    line(["---"] * (2 + len(SEEDED)))
    for walk, duration in walks:
        cells = []
        for robot in SEEDED:
            row = of[walk, robot]
            once = f"{float(row['undisturbed_tilt_deg']):.1f}" \
                if row["undisturbed_stands"] == "1" else "falls"
            touch = f", t{row['touch']}" if row["touch"] != "0" else ""
            cells.append(f"{row['stands']}, {float(row['tilt_deg']):.1f} ({once}), "
                         f"{100 * float(row['edge_share']):.0f}{touch}")
        line([f"`{walk}`", f"{float(duration):.2f}", *cells])
    print()
    line(["walk", *ROBOTS])
    line(["---"] * (1 + len(ROBOTS)))
    for walk, _ in walks:
        cells = []
        for robot in ROBOTS:
            row = of[walk, robot]
            parts = [f"{float(row['undisturbed_tilt_deg']):.2f}"]
            parts += [f"{float(row[f'{part}_most_{unit}']):.1f}, "
                      f"{float(row[f'{part}_largest_{unit}']):.1f}"
                      for part, (_, _, unit) in PARTS.items()]
            cells.append("; ".join(parts) if row["undisturbed_stands"] == "1" else "falls")
        line([f"`{walk}`", *cells])


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--tables":
        tables(sys.argv[2])
    elif len(sys.argv) > 3:
        measure(sys.argv[1], sys.argv[2], sys.argv[3:])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
