#!/usr/bin/env python3
"""How far inside the soles the robot's ZMP is to stay: zmp_shares.py HALFSTEP FOLDER CONFIG… > zmp_shares.csv

Smooths each config by halfstep/sqp with `margins.zmp_robot_m` the shares SHARES of the sole's width,
and replays the walk with eight seeds (survival.py): on the servos that replay takes for the robot,
and on some of a third of their stiffness, open loop and controlled. Runs are left in FOLDER, and
those that are there are not made again.
"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

from survival import SEEDS, replayed

METHOD = "halfstep/sqp"
SHARES = [0.0, 0.1, 0.2, 0.3]
K, D, TORQUE = 30000.0, 300.0, 56.9 * 0.705  # of replay's servos, and mass [kg] times leg [m] of HRP-2
COLUMNS = ["walk", "width_m", "share", "certified", "duration_s", "servos", "controller", "stands", "of",
           "tilt_deg", "edge_share"]


def robot_of(halfstep, config):
    """Width of the soles [m], and mass times leg [kg m] of the config's robot."""
    name = re.search(r"^robot: (\S+)", config.read_text(encoding="utf-8"), re.M).group(1)
    shipped = pathlib.Path(__file__).parent.parent / "wpg" / "robots" / f"{name}.yaml"
    file = shipped if shipped.exists() else config.parent / name
    size = re.search(r"^sole_size_m: \[\S+ (\S+)\]", file.read_text(encoding="utf-8"), re.M)
    facts = json.loads(subprocess.run([halfstep, "robot", "--check", str(file), "--json"], check=True,
                                      stdout=subprocess.PIPE, text=True).stdout)
    return float(size.group(1)), facts["mass_kg"] * facts["leg_m"]


def smoothed(halfstep, config, run, inside):
    """The row of summary.csv of METHOD."""
    if not (run / "summary.csv").exists():
        subprocess.run([halfstep, "run", str(config), "--quiet", "--out", str(run), "--set",
                        f"smoothing.methods=[{METHOD}]", "--set",
                        f"smoothing.margins.zmp_robot_m={inside}"], check=False)
    with open(run / "summary.csv", encoding="utf-8") as file:
        return next(row for row in csv.DictReader(file) if row["method"] == METHOD)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    halfstep, place = sys.argv[1], pathlib.Path(sys.argv[2])
    place.mkdir(parents=True, exist_ok=True)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    for config in map(pathlib.Path, sys.argv[3:]):
        width, torque = robot_of(halfstep, config)
        scale = torque / TORQUE
        third = ["--servos", f"{K / 3 * scale:.4g},{D * scale:.4g}"]
        for share in SHARES:
            run = place / f"{config.stem}.{share}"
            row = smoothed(halfstep, config, run, f"{share * width:.5f}")
            first = [config.stem, width, share, row["certified"]]
            if row["certified"] != "true":
                table.writerow(first + [""] * (len(COLUMNS) - len(first)))
                continue
            for servos, controller, options in (("own", "none", []), ("third", "none", third),
                                                ("third", "dcm", third)):
                seeds = replayed(halfstep, METHOD, str(run),
                                 [*options, "--controller", controller, "--seeds", str(SEEDS)])
                tilt = math.degrees(seeds["median"]["largest_tilt_rad"])
                table.writerow(first + [f"{float(row['duration_s']):.3f}", servos, controller,
                                        seeds["stands"], seeds["of"], f"{tilt:.2f}",
                                        f"{seeds['median']['edge_share']:.3f}"])
                sys.stdout.flush()


if __name__ == "__main__":
    main()
