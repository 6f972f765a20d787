#!/usr/bin/env python3
"""HRP-2 on command, in lockstep:

    commanded_walks.py random HALFSTEP MINUTES FOLDER [SEED]   > one row a minute
    commanded_walks.py speeds HALFSTEP FOLDER                  > commanded against reached speeds

`random`: velocities (also backwards, sideways, rest), paths and lists of footsteps at random, every
1 to 8 s, for so many minutes; the folder is then verified. A row says, of one minute: half-steps
begun, commands, walks handed over, what the replanner worked for each of these on average
(Work::effort, counted), how many half-steps the walk has, and what the walks' tables take. At the end, on standard error:
half-steps that began without a grant that reached them, the largest difference of any number of a
half-step that had begun between a walk and the one that took over from it (0: they are one function,
and so are all their derivatives), and how far CoM, acceleration and ZMP are from p = c - (z/g) c''
in the first and the last minute. Exit status 1 when anything of this is not as promised.

`speeds`: straight on, sideways and turning at several speeds for 30 s each; of the last 18 s.
"""
import collections
import csv
import json
import math
import pathlib
import random
import resource
import subprocess
import sys

GRAVITY = 9.81
USED = {}  # by a command: its memory and processor time
HEAD = """name: {name}
robot: hrp2
scene: none
goal: {{x_m: 1, y_m: 0}}
half_step: {{duration_s: 1.5, zmp_shift_s: 0.075}}
smoothing: {{margins: {{double_support_s: 0.075}}}}
planner: {{max_nodes: 3000, unimproved_nodes: 200}}
live:
  longest_s: {longest}
  script:
"""


def walk(at, v):
    return f"    - {{at_s: {at:.3f}, do: walk, velocity: [{v[0]:.3f}, {v[1]:.3f}, {v[2]:.3f}]}}\n"


def random_script(seconds, draw):
    """Commands until the last 12 s, in which it comes to rest. Paths and footsteps are somewhere
    near the origin: what is too far away is refused or walked to."""
    lines, at = [], 0.0
    while at < seconds - 12:
        kind = draw.random()
        if kind < 0.1:
            points = [[draw.uniform(-2, 2), draw.uniform(-2, 2)] for _ in range(draw.randint(2, 6))]
            text = ", ".join(f"[{x:.3f}, {y:.3f}]" for x, y in points)
            lines.append(f"    - {{at_s: {at:.3f}, do: follow, path_m: [{text}], speed_m_s: "
                         f"{draw.uniform(0.03, 0.15):.3f}}}\n")
        elif kind < 0.15:
            x, y = draw.uniform(-1, 1), draw.uniform(-1, 1)
            lines.append(f"    - {{at_s: {at:.3f}, do: footsteps, footsteps: [{{foot: left, x_m: "
                         f"{x:.3f}, y_m: {y + 0.1:.3f}}}, {{foot: right, x_m: {x:.3f}, y_m: "
                         f"{y - 0.1:.3f}}}]}}\n")
        elif kind < 0.25:
            lines.append(walk(at, (0, 0, 0)))
        else:
            lines.append(walk(at, (draw.uniform(-0.1, 0.2), draw.uniform(-0.08, 0.08),
                                   draw.uniform(-0.2, 0.2))))
        at += draw.uniform(1, 8)
    return "".join(lines) + walk(seconds - 12, (0, 0, 0))


def run_and_measure(name, command):
    """Also its memory [MB] and processor time [s], in USED."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)  # ru_maxrss: of the largest so far
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    USED[name] = f"{name} {seconds:.0f} s of processor time, at most {after.ru_maxrss / 1e3:.0f} MB"
    return run


def live(halfstep, folder, name, script, longest):
    folder.mkdir(parents=True, exist_ok=True)
    config = folder / f"{name}.yaml"
    config.write_text(HEAD.format(name=name, longest=longest) + script)
    out = folder / name
    run = run_and_measure("live", [halfstep, "live", str(config), "--out", str(out), "--overwrite",
                                   "--json"])
    if run.returncode not in (0, 1) or not run.stdout:
        sys.exit(f"{name}: {run.stderr}")
    return out, json.loads(run.stdout)


def each_row(path):
    with open(path, newline="") as file:
        yield from csv.DictReader(file)


def rows_of(path):
    return list(each_row(path))


def largest_difference(out, plans):
    """Of the numbers of half-steps that had begun, between each walk and its successor, whose tables
    begin with the step that changed: those that it tells anew, where its soles stand at their
    beginning, and when the first of its half-steps begins by its overlap."""
    most, rows, soles = 0.0, [], []
    for k, plan in enumerate(plans):
        folder = out / "walks" / f"{k:03d}"
        half_steps, feet = rows_of(folder / "half_steps.csv"), rows_of(folder / "footsteps.csv")
        overlaps = rows_of(folder / "overlaps.csv")
        first, handed_over = int(half_steps[0]["half_step"]) - 1, float(plan["handed_over_s"])
        stand = {}
        for foot in soles[:2 + first // 2][-12:] if first else feet[:2]:
            stand[foot["foot"]] = foot
        begun = [row for row in rows[first:] if float(row["start_s"]) < handed_over - 1e-9]
        steps = soles[2 + first // 2:]
        pairs = [(stand[foot["foot"]], {key: foot[key] for key in ("x_m", "y_m", "yaw_rad")})
                 for foot in feet[:2]]
        pairs += list(zip(begun, half_steps)) + list(zip(steps[:len(begun) // 2], feet[2:]))
        for a, b in pairs:
            for key, value in b.items():
                try:
                    most = max(most, abs(float(value) - float(a[key])))
                except ValueError:
                    most = max(most, 0.0 if value == a[key] else math.inf)
        if first:
            start, duration = (float(rows[first - 1][key]) for key in ("start_s", "duration_s"))
            begins = start + (duration - float(overlaps[0]["overlap_s"]))
            most = max(most, abs(begins - float(half_steps[0]["start_s"])))
        rows[first:] = half_steps
        soles[2 + first // 2 if first else 0:] = feet[2:] if first else feet
    return most


def lipm_residuals(out, end):
    """Of the first and of the last minute [m]."""
    worst = {}
    for row in each_row(out / "trajectory.csv"):
        t = float(row["t_s"])
        for minute in {0 if t <= 60 else None, 1 if t >= end - 60 else None} - {None}:
            for axis in "xy":
                c, a, p = (float(row[key]) for key in
                           (f"com_{axis}_m", f"com_a{axis}_m_s2", f"zmp_{axis}_m"))
                z = float(row["com_z_m"])
                worst[minute] = max(worst.get(minute, 0.0), abs(c - z / GRAVITY * a - p))
    return worst.get(0, 0.0), worst.get(1, 0.0)


def at_random(halfstep, minutes, folder, seed):
    seconds = 60 * minutes
    draw = random.Random(seed)
    out, summary = live(halfstep, folder, f"commanded_{seed}", random_script(seconds, draw), seconds)
    plans, timings = rows_of(out / "plans.csv"), rows_of(out / "timings.csv")
    begun, grants = rows_of(out / "begun.csv"), rows_of(out / "grants.csv")
    events = rows_of(out / "events.csv")
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["minute", "half_steps_begun", "commands", "walks", "effort_per_walk",
                     "walk_length", "walks_kb"])
    sizes = [sum(file.stat().st_size for file in (out / "walks" / f"{k:03d}").iterdir())
             for k in range(len(plans))]
    of_minute = collections.defaultdict(list)
    for plan, timing in zip(plans, timings):
        of_minute[int(float(plan["handed_over_s"]) // 60)].append((plan, timing))
    for minute in range(minutes):
        walks = of_minute[minute]
        inside = [e for e in events if 60 * minute <= float(e["t_s"]) < 60 * (minute + 1)]
        effort = sum(float(timing["effort"]) for _, timing in walks) / max(1, len(walks))
        writer.writerow([minute, sum(e["event"] == "begins" for e in inside),
                         sum(e["event"] == "commanded" for e in inside), len(walks),
                         f"{effort:.4f}", 2 * int(walks[-1][0]["footsteps"]) if walks else "",
                         sum(sizes[int(plan["walk"])] for plan, _ in walks) // 1000])
    unproved = sum(int(row["half_step"]) > int(grants[int(row["grant"])]["through"])
                   for row in begun)
    difference = largest_difference(out, plans)
    first, last = lipm_residuals(out, float(summary["duration_s"]))
    verified = run_and_measure("verify", [halfstep, "verify", str(out)])
    refused = sum(e["event"] == "refused" for e in events)
    unsafe = sum(e["event"] == "unsafe" for e in events)
    record = sum(file.stat().st_size for file in out.rglob("*") if file.is_file())
    print(f"{summary['ending']} after {summary['duration_s']:.1f} s, {len(begun)} half-steps, "
          f"{len(plans)} walks, {refused} refused, {unsafe} times blocked; {unproved} half-steps "
          f"without a grant; hand-overs differ by {difference:.3g}; LIPM residual {first:.3g} m in "
          f"the first minute, {last:.3g} m in the last; {sum(sizes) / 1e6:.1f} MB of walks, "
          f"{record / 1e6:.1f} MB in all; {USED['live']}; {USED['verify']}; "
          f"{'verified' if verified.returncode == 0 else verified.stdout + verified.stderr}",
          file=sys.stderr)
    promised = summary["promise"]["status"] == "kept" and verified.returncode == 0
    return 0 if promised and unproved == 0 and difference <= 1e-9 and last <= 1e-6 else 1


def middle_of(row):
    get = lambda foot, key: float(row[f"{foot}_foot_{key}"])
    return [(get("left", key) + get("right", key)) / 2 for key in ("x_m", "y_m", "yaw_rad")]


def speeds(halfstep, folder):
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["vx_m_s", "vy_m_s", "yaw_rad_s", "reached_speed", "reached_turn"])
    commands = [(v, 0, 0) for v in (0.05, 0.1, 0.2)] + [(0, 0.05, 0)]
    commands += [(0, 0, w) for w in (0.05, 0.1, 0.2)] + [(0.1, 0, 0.1)]
    for command in commands:
        name = "speed_" + "_".join(f"{x:g}" for x in command)
        out, _ = live(halfstep, folder, name, walk(0, command), 30)
        rows = rows_of(out / "trajectory.csv")
        times = [float(row["t_s"]) for row in rows]
        # Of whole steps: from one landing of the left foot to another.
        landings = [i for i in range(1, len(rows)) if float(rows[i - 1]["left_foot_z_m"]) > 1e-9 >=
                    float(rows[i]["left_foot_z_m"])]
        inside = [i for i in landings if times[i] >= 12]
        if len(inside) < 2:
            inside = [len(rows) // 2, len(rows) - 1]
        a, b = inside[0], inside[-1]
        duration = times[b] - times[a]
        way = 0.0
        for i, j in zip(inside, inside[1:]):
            (x, y, _), (u, v, _) = middle_of(rows[i]), middle_of(rows[j])
            way += math.hypot(u - x, v - y)
        turned = middle_of(rows[b])[2] - middle_of(rows[a])[2]
        writer.writerow([*command, f"{way / duration:.4f}", f"{turned / duration:.4f}"])
        sys.stdout.flush()
    return 0


def main():
    if len(sys.argv) >= 5 and sys.argv[1] == "random":
        seed = int(sys.argv[5]) if len(sys.argv) > 5 else 1
        return at_random(sys.argv[2], int(sys.argv[3]), pathlib.Path(sys.argv[4]), seed)
    if len(sys.argv) == 4 and sys.argv[1] == "speeds":
        return speeds(sys.argv[2], pathlib.Path(sys.argv[3]))
    sys.exit(__doc__)


if __name__ == "__main__":
    sys.exit(main())
