#!/usr/bin/env python3
"""What steps of fast walks look like: typical_forms.py RUN… > drawn_walks/typical_forms.csv

Medians of the parameters of the steps of each class, over the walks by halfstep/sqp in folders of
`halfstep run`. The classes are those of FormOfStep (smoothing/methods/typical_start.cc), but that
steps go `over` something which are not in a class of their own and rise to more than half of what
is planned. The slowest form, `high`, is no class: it is the level one at a T of 1.3 s and a height of
0.4. TypicalForms() has these numbers, which a test compares.
"""
import csv
import math
import pathlib
import statistics
import sys

STANDING_WIDTH, COM_HEIGHT = 0.21, 0.8  # HRP-2's, as in typical_start.cc [m]
ASIDE, BACK, TURN = 0.45, 0.06, 0.2
OF_STEP = ["height_scale", "support_point_m", "via_lateral_m", "via_along_m"]
OF_HALF_STEP = ["duration_s", "foot_ramp", "foot_delay", "lift_share", "zmp_shift", "zmp_bump_ramp"]
COLUMNS = (["up_down", "down_up"] + OF_STEP +
           [f"{name}_{half}" for name in OF_HALF_STEP for half in ("up", "down")])
CLASSES = ["level", "first", "last", "turning", "backward", "sideways", "over"]


def read(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def steps_of(run):
    """The steps of a run's walk: their class and the values of COLUMNS."""
    folder = pathlib.Path(run) / "halfstep_sqp"
    half_steps, overlaps = read(folder / "half_steps.csv"), read(folder / "overlaps.csv")
    footsteps = read(pathlib.Path(run) / "footsteps.csv")
    if not set(OF_STEP) <= set(half_steps[0]):
        print(f"{run}: left out: its forms are as planned", file=sys.stderr)
        return
    at = {f["foot"]: [float(f[key]) for key in ("x_m", "y_m", "yaw_rad")] for f in footsteps[:2]}
    count = len(footsteps) - 2
    for j, footstep in enumerate(footsteps[2:]):
        foot = footstep["foot"]
        x, y, yaw = at[foot]
        at[foot] = to = [float(footstep[key]) for key in ("x_m", "y_m", "yaw_rad")]
        support = at["left" if foot == "right" else "right"][2]
        c, s = math.cos(support), math.sin(support)
        along = c * (to[0] - x) + s * (to[1] - y)
        aside = c * (to[1] - y) - s * (to[0] - x)
        up, down = half_steps[2 * j], half_steps[2 * j + 1]
        values = {name: float(up[name]) for name in OF_STEP}
        for name in OF_HALF_STEP:
            values |= {f"{name}_up": float(up[name]), f"{name}_down": float(down[name])}
        for name, i in (("up_down", 2 * j), ("down_up", 2 * j + 1)):
            if i < len(overlaps):
                values[name] = float(overlaps[i]["overlap_s"]) / float(overlaps[i]["upper_bound_s"])
        if abs(aside) > ASIDE * STANDING_WIDTH:
            yield "sideways", values
        elif values["height_scale"] > 0.5:
            yield "over", values
        elif j in (0, count - 1):
            yield "first" if j == 0 else "last", values
        elif abs(to[2] - yaw) > TURN:
            yield "turning", values
        else:
            yield "backward" if along < -BACK * COM_HEIGHT else "level", values


def main():
    if len(sys.argv) == 1:
        sys.exit(__doc__)
    steps = [step for run in sys.argv[1:] for step in steps_of(run)]
    print(",".join(["class", "steps"] + COLUMNS))
    for name in CLASSES:
        of = [values for kind, values in steps if kind == name]
        medians = (statistics.median([v[c] for v in of if c in v] or [1.0]) for c in COLUMNS)
        print(",".join([name, str(len(of))] + [f"{median:.3f}" for median in medians]))


if __name__ == "__main__":
    main()
