#!/usr/bin/env python3
"""What each demand of the profile walkable costs and buys: demands.py HALFSTEP > demands.csv

Walks by halfstep/sqp under each demand alone, without each of them, and with further ones; how long
they last, and in how many of eight seeds they stand in open loop (survival.py).
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

from survival import COLUMNS, rows_of

WALKS = ["bar_8cm", "fig4_raw_sequence", "island", "fence"]
ROBOTS = ["ideal", "10000"]
LIMIT = ["smoothing.profile=limit"]
ZMP, FRICTION, SUPPORT = (f"smoothing.margins.{demand}" for demand in
                          ("zmp_robot_m=0.0274", "friction=0.3", "double_support_s=0.08"))
DEMANDS = {
    "none: limit": LIMIT,
    "zmp_robot": LIMIT + [ZMP],
    "friction": LIMIT + [FRICTION],
    "double_support": LIMIT + [SUPPORT],
    "all but zmp_robot": LIMIT + [FRICTION, SUPPORT],
    "all but friction": LIMIT + [ZMP, SUPPORT],
    "all but double_support": LIMIT + [ZMP, FRICTION],
    "all three: walkable": [],
    "and landing at 0.3 m/s": ["smoothing.limits.landing_speed_m_s=0.3"],
    "and 60 rad/s² of joints": ["smoothing.limits.joint_acceleration_rad_s2=60"],
}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    halfstep = sys.argv[1]
    configs = pathlib.Path(__file__).parent.parent / "experiments" / "configs"
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["demands"] + COLUMNS)
    with tempfile.TemporaryDirectory() as work:
        for demands, keys in DEMANDS.items():
            for walk in WALKS:
                run = f"{work}/{walk}"
                command = [halfstep, "run", f"{configs}/{walk}.yaml", "--quiet", "--overwrite",
                           "--out", run, "--set", "smoothing.methods=[halfstep/sqp]"]
                for key in keys:
                    command += ["--set", key]
                subprocess.run(command, check=True)
                for row in rows_of(halfstep, "halfstep/sqp", run, ROBOTS):
                    table.writerow([demands] + row)
                sys.stdout.flush()


if __name__ == "__main__":
    main()
