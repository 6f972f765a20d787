#!/usr/bin/env python3
"""Tubes of measured size: tubes.py HALFSTEP FOLDER CONFIG… > tubes.txt

Smooths each config by halfstep/sqp, replays the walk with eight seeds and `--controller dcm` on the
servos of SERVOS, and smooths again with the tube that replay suggests, as it is and in the ways of
WAYS. Prints a table; runs are left in FOLDER, and those that are there are not made again.
"""
import csv
import json
import pathlib
import subprocess
import sys

METHOD = "halfstep/sqp"
SERVOS = {"ideal": [], "10 000": ["--servos", "10000,300"]}
# What is demanded beyond the tube, and the keys of it that are left out.
NOTHING = ["smoothing.margins.clearance_m=0", "smoothing.margins.floor_m=0",
           "smoothing.margins.zmp_robot_m=0"]
WAYS = {
    "as demanded": ([], []),
    "nothing beyond": (NOTHING, []),
    "and no speeds": (NOTHING, ["joint_speed_rad_s"]),
}


def call(words, statuses=(0, 1)):
    """The output of a command; 1 is a walk that falls or is not certified."""
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode not in statuses:
        sys.exit(f"{' '.join(words)}: exit status {done.returncode}\n{done.stderr}")
    return done.stdout


def smoothed(halfstep, config, folder, settings):
    """The row of summary.csv of METHOD, and of the planned walk; none where there is no plan."""
    if not (folder / "summary.csv").exists():
        words = [halfstep, "run", config, "--set", f"smoothing.methods=[{METHOD}]"]
        for setting in settings:
            words += ["--set", setting]
        call(words + ["--out", str(folder), "--quiet"], (0, 1, 2))  # 2: no half-step keeps the tube
    if not (folder / "summary.csv").exists():
        return None, None
    with open(folder / "summary.csv", encoding="utf-8") as file:
        rows = {row["method"]: row for row in csv.DictReader(file)}
    return rows[METHOD], rows["raw"]


def suggested(halfstep, folder, servos):
    """`suggested_tube` of a run's walk."""
    kept = folder.parent / f"{folder.name}.{servos.replace(' ', '')}.json"
    if not kept.exists():
        words = [halfstep, "replay", str(folder), "--method", METHOD, "--seeds", "8",
                 "--controller", "dcm", "--suggest-tube", "--json"]
        kept.write_text(call(words + SERVOS[servos]), encoding="utf-8")
    return json.loads(kept.read_text(encoding="utf-8"))["methods"][0]["suggested_tube"]


def verdict(row, raw, before):
    """D and its price, or what fails."""
    if row is None:
        return "no half-step"
    if row["certified"] == "true":
        after = float(row["duration_s"])
        return f"{after:.2f} ({100 * (after / before - 1):+.0f} %)"
    return f"plan: {raw['worst_margin_name']} {float(raw['worst_margin']):.3g}"


def sizes(tube):
    """Distances in a cell: feet [mm, deg], waist [mm, deg], joints [rad, rad/s], ZMP [mm]."""
    def both(key, scale, digits):
        return f"{scale * tube['most'][key]:.{digits}f}, {scale * tube['largest'][key]:.{digits}f}"
    return [both("foot_m", 1e3, 1), both("foot_deg", 1, 2), both("waist_m", 1e3, 1),
            both("waist_deg", 1, 2), both("joint_rad", 1, 4), both("joint_speed_rad_s", 1, 2),
            both("zmp_m", 1e3, 0)]


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    halfstep, place = sys.argv[1], pathlib.Path(sys.argv[2])
    place.mkdir(parents=True, exist_ok=True)
    columns = ["walk", "servos", "stands", "feet [mm]", "[deg]", "waist [mm]", "[deg]",
               "joints [rad]", "[rad/s]", "ZMP [mm]", "D [s]"] + list(WAYS)
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    for config in sys.argv[3:]:
        name = pathlib.Path(config).stem
        row, _ = smoothed(halfstep, config, place / name, [])
        before = float(row["duration_s"])
        for servos in SERVOS:
            tube = suggested(halfstep, place / name, servos)
            cells = [f"`{name}`", servos, f"{tube['stands']} of {tube['of']}"] + sizes(tube)
            cells.append(f"{before:.2f}")
            for number, (way, left_out) in enumerate(WAYS.values()):
                if tube["tube"] is None:
                    cells.append("no tube")
                    continue
                settings = [f"smoothing.tube.{key}={value}"
                            for key, value in tube["tube"].items() if key not in left_out]
                folder = place / f"{name}.{servos.replace(' ', '')}.{number}"
                cells.append(verdict(*smoothed(halfstep, config, folder, settings + way), before))
            print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
