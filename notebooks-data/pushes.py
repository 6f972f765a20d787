#!/usr/bin/env python3
"""Largest pushes survived: pushes.py HALFSTEP METHOD RUN… > pushes.csv

Eight directions at a quarter, half and three quarters of each walk, open loop and controlled, on
servos of 10,000 N m/rad; found to 1 N s up to 80 [N s].
"""
import csv
import json
import pathlib
import subprocess
import sys

COLUMNS = ["walk", "controller", "at_s", "direction", "survived_n_s"]


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    for run in sys.argv[3:]:
        for controller in ("none", "dcm"):
            command = [sys.argv[1], "replay", run, "--method", sys.argv[2], "--json", "--push",
                       "--push-directions", "8", "--servos", "10000,300", "--controller",
                       controller]
            out = subprocess.run(command, stdout=subprocess.PIPE, check=True)
            for push in json.loads(out.stdout)["methods"][0].get("pushes", []):
                table.writerow([pathlib.Path(run).name, controller, f"{push['at_s']:.3f}",
                                push["direction"], f"{push['survived_n_s']:.1f}"])


if __name__ == "__main__":
    main()
