#!/usr/bin/env python3
"""How often walks stand in replay: survival.py HALFSTEP METHOD RUN… > survival.csv

Plays the walks of a method in folders of `halfstep run` with eight seeds each on the robots of
ROBOTS, open loop and controlled. A row says in how many of the seeds a walk stands; the medians over the seeds
of its largest tilt, of the share of time in which the pressure is at an edge of the soles, and of
the peak force; and the largest time in flight.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys

SEEDS = 8
ROBOTS = {
    "ideal": [],
    "10000": ["--servos", "10000,300"],
    "10000 dcm": ["--servos", "10000,300", "--controller", "dcm"],
    "3000": ["--servos", "3000,150"],
    "3000 dcm": ["--servos", "3000,150", "--controller", "dcm"],
    "ankle": ["--ankle", "1000,50"],
    "ankle dcm": ["--ankle", "1000,50", "--controller", "dcm"],
}
COLUMNS = ["walk", "method", "duration_s", "robot", "stands", "of", "tilt_deg", "edge_share",
           "peak_weights", "flight_s"]


def played(halfstep, method, run, robot):
    """What `halfstep replay` says of the run's walk; falls are no failure here."""
    command = [halfstep, "replay", run, "--method", method, "--seeds", str(SEEDS), "--json"]
    command += ROBOTS[robot]
    out = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if out.returncode not in (0, 1):
        sys.exit(f"{' '.join(command)}: exit status {out.returncode}")
    return json.loads(out.stdout)["methods"][0]


def rows_of(halfstep, method, run, robots):
    """The rows of COLUMNS of a run's walk, one a robot."""
    for robot in robots:
        walk = played(halfstep, method, run, robot)
        median, largest = walk["median"], walk["largest"]
        yield [pathlib.Path(run).name, walk["method"], f"{walk['duration_s']:.3f}", robot,
               walk["stands"], walk["of"], f"{math.degrees(median['largest_tilt_rad']):.2f}",
               f"{median['edge_share']:.3f}", f"{median['peak_weights']:.2f}",
               f"{largest['flight_s']:.3f}"]


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    for run in sys.argv[3:]:
        for row in rows_of(sys.argv[1], sys.argv[2], run, ROBOTS):
            table.writerow(row)
            sys.stdout.flush()


if __name__ == "__main__":
    main()
