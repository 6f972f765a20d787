#!/usr/bin/env python3
"""How well walks stand in replay.

  survival.py HALFSTEP METHOD RUN… > survival.csv    plays the walks of a method in folders of
                                                     `halfstep run`, four at a time
  survival.py HALFSTEP --levels RUN… > levels_survival.csv   the same of `dichotomy` and `halfstep/sqp`
                                                     over levels, on LEVELS, all with seeds
  survival.py --tables survival.csv                  the tables of measurements.md and
                                                     experiments/replay.md

A row is a walk on one of ROBOTS, open loop and controlled: once undisturbed (tilt, how far soles,
waist and joints are from the plan: what 95 % of the time does not exceed, and the largest), and
on the robots of SEEDED, with eight seeds (in how many it stands, and in how many of them it touches
an obstacle or the side of a level; medians of the largest tilt and of the share of time at the
soles' edges).
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
LEVELS = ["ideal", "ideal dcm", "10000", "10000 dcm", "3000", "3000 dcm"]
LEVEL_METHODS = ["dichotomy", "halfstep/sqp"]
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


def row_of(halfstep, method, run, robot, seeded):
    once = replayed(halfstep, method, run, ROBOTS[robot])
    row = [pathlib.Path(run).name, once["method"], f"{once['duration_s']:.3f}", robot]
    if robot in seeded:
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


def certified(run):
    """Methods of a run that found a certified walk."""
    with open(pathlib.Path(run) / "summary.csv", encoding="utf-8") as file:
        return [row["method"] for row in csv.DictReader(file)
                if row["certified"] == "true" and row["method"] in LEVEL_METHODS]


def measure(halfstep, walks, robots, seeded):
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        cells = [(halfstep, method, run, robot, seeded)
                 for run, method in walks for robot in robots]
        for row in pool.map(lambda cell: row_of(*cell), cells):
            table.writerow(row)
            sys.stdout.flush()


def line(cells):
    print("| " + " | ".join(cells) + " |")


NONE = "–"  # not measured


def once_cell(row, cell):
    """`cell` of a walk that stands undisturbed."""
    if not row["undisturbed_stands"]:
        return NONE
    return cell(row) if row["undisturbed_stands"] == "1" else "falls"


def seeds_cell(row):
    once = once_cell(row, lambda row: f"{float(row['undisturbed_tilt_deg']):.1f}")
    if not row["stands"]:
        return f"{NONE} ({once})"
    touch = f", t{row['touch']}" if row["touch"] != "0" else ""
    return (f"{row['stands']}, {float(row['tilt_deg']):.1f} ({once}), "
            f"{100 * float(row['edge_share']):.0f}{touch}")


def tracking_cell(row):
    parts = [f"{float(row['undisturbed_tilt_deg']):.2f}"]
    parts += [f"{float(row[f'{part}_most_{unit}']):.1f}, "
              f"{float(row[f'{part}_largest_{unit}']):.1f}"
              for part, (_, _, unit) in PARTS.items()]
    return "; ".join(parts)


def tables(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    walks = list(dict.fromkeys((row["walk"], row["method"], row["duration_s"]) for row in rows))
    of = {(row["walk"], row["method"], row["robot"]): row for row in rows}
    robots = list(dict.fromkeys(row["robot"] for row in rows))
    seeded = list(dict.fromkeys(row["robot"] for row in rows if row["stands"]))
    several = len({method for _, method, _ in walks}) > 1

    def name_of(walk, method):
        return [f"`{walk}`", f"`{method}`"] if several else [f"`{walk}`"]

    head = ["walk", "method"] if several else ["walk"]
    line([*head, "D [s]", *seeded])
    line(["---"] * (len(head) + 1 + len(seeded)))
    for walk, method, duration in walks:
        cells = [seeds_cell(row) if (row := of.get((walk, method, robot))) else NONE
                 for robot in seeded]
        line([*name_of(walk, method), f"{float(duration):.2f}", *cells])
    print()
    line([*head, *robots])
    line(["---"] * (len(head) + len(robots)))
    for walk, method, _ in walks:
        cells = [once_cell(row, tracking_cell) if (row := of.get((walk, method, robot))) else NONE
                 for robot in robots]
        line([*name_of(walk, method), *cells])


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--tables":
        tables(sys.argv[2])
    elif len(sys.argv) > 3 and sys.argv[2] == "--levels":
        walks = [(run, method) for run in sys.argv[3:] for method in certified(run)]
        measure(sys.argv[1], walks, LEVELS, LEVELS)
    elif len(sys.argv) > 3:
        measure(sys.argv[1], [(run, sys.argv[2]) for run in sys.argv[3:]], list(ROBOTS), SEEDED)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
