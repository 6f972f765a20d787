#!/usr/bin/env python3
"""How good plans are: plan_quality.py HALFSTEP COUNT FOLDER [WAY...] > plan_quality.csv
                         plan_quality.py --table plan_quality.csv...

Problems by seeds 1 to COUNT (or FIRST-LAST): rooms, cylinders, fences and islands as `halfstep draw`
and the shipped scenes have them. Each is planned in each WAY and smoothed by dichotomy; run folders
stay in FOLDER. A row a plan: the work that was counted, also until the first plan (of `default`),
and the processor time of `halfstep plan`, of which about 1.4 s certify the half-steps and read their
volumes. --table: how much longer, in seconds of the smoothed walk, a way's plans are than the best
plan of all rows of that problem.
"""
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import random
import re
import statistics
import subprocess
import sys

COLUMNS = ["seed", "scene", "way", "status", "footsteps", "nodes", "queries", "first_effort",
           "effort", "processor_s", "smoothed_s"]
# Ten times the work of a default that ends after 500 nodes without a gain, and of one that ends
# after an effort.
TEN = ["planner.unimproved_nodes=5000"]
WAYS = {
    "default": [],
    "default_10": ["planner.improving_effort=20", "planner.max_nodes=100000000"],
    "rrt_500": ["planner.name=rrt", "planner.cost=steps", "planner.unimproved_nodes=500"],
    "astar_500": ["planner.name=astar", "planner.cost=steps", "planner.unimproved_nodes=500"],
    "rrt_5000": ["planner.name=rrt", "planner.cost=steps"] + TEN,
    "astar_5000": ["planner.name=astar", "planner.cost=steps"] + TEN,
    "rrt_time_5000": ["planner.name=rrt", "planner.cost=smoothed_duration"] + TEN,
    "astar_time_5000": ["planner.name=astar", "planner.cost=smoothed_duration"] + TEN,
}
KINDS = ["random_room", "cylinders", "random_room", "cylinders", "fence", "random_room",
         "cylinders", "random_room", "cylinders", "island"]


def drawn(halfstep, kind, count, seed):
    command = [halfstep, "draw", kind, "--count", str(count), "--seed", str(seed)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def fence(draw):
    """A plate of 3 cm to 9 cm across the way."""
    height, x, yaw = draw.uniform(0.03, 0.09), draw.uniform(0.4, 0.9), draw.uniform(-25, 25)
    return (f"name: fence\nobstacles:\n  - name: plate\n"
            f"    box: {{size_m: [{draw.choice([0.001, 0.02]):.3f}, 3.0, {height:.4f}]}}\n"
            f"    pose: {{xyz: [{x:.4f}, 0, {0.5 * height:.4f}], rpy_deg: [0, 0, {yaw:.2f}]}}\n")


def island(draw):
    """A square that a ditch of 3 cm to 9 cm encloses."""
    a, width = draw.uniform(0.45, 0.7), draw.uniform(0.03, 0.09)
    b = a + width
    sides = {"ahead": [a, -b, b, b], "behind": [-b, -b, -a, b], "left": [-a, a, a, b],
             "right": [-a, -b, a, -a]}
    text = "name: island\nno_step:\n"
    for name, (x0, y0, x1, y1) in sides.items():
        text += (f"  - name: {name}\n    polygon_m: [[{x0:.4f}, {y0:.4f}], [{x1:.4f}, {y0:.4f}], "
                 f"[{x1:.4f}, {y1:.4f}], [{x0:.4f}, {y1:.4f}]]\n")
    return text


def problem(halfstep, seed):
    """Kind and texts of scene and config."""
    kind = KINDS[seed % len(KINDS)]
    draw = random.Random(seed)
    start = [0.0, 0.0, 0.0]
    if kind == "random_room":
        scene = drawn(halfstep, kind, 14, seed)
        start = [-1.5, -1.5, 0.0]
        x, y = [(1.5, 1.5), (1.5, -1.5), (-1.5, 1.5)][(seed // 2) % 3]
        room = "[-2, -2, 2, 2]"
    elif kind == "cylinders":
        scene = drawn(halfstep, kind, draw.randint(20, 80), seed)
        x, y, room = 3.0, draw.uniform(-0.3, 0.3), "[-0.5, -1.5, 3.5, 1.5]"
    else:
        scene = fence(draw) if kind == "fence" else island(draw)
        angle = draw.uniform(-0.4, 0.4) if kind == "fence" else draw.uniform(-math.pi, math.pi)
        x, y, room = 1.6 * math.cos(angle), 1.6 * math.sin(angle), "[-2.2, -2.2, 2.2, 2.2]"
        start[2] = draw.uniform(-0.5, 0.5)
    config = f"name: {kind}_{seed}\nrobot: hrp2\nscene: scene_{seed}.yaml\nstart:\n"
    for foot, side in (("left", 0.1), ("right", -0.1)):
        config += (f"  {foot}: {{x_m: {start[0] - side * math.sin(start[2]):.4f}, y_m: "
                   f"{start[1] + side * math.cos(start[2]):.4f}, "
                   f"yaw_deg: {math.degrees(start[2]):.4f}}}\n")
    config += (f"seed: {seed}\nplanner: {{workspace_m: {room}}}\n"
               "smoothing: {methods: [dichotomy]}\noutput: {period_s: 0.1}\n")
    return kind, scene, config, f"goal: {{x_m: {x:.3f}, y_m: {y:.3f}, radius_m: 0.15}}\n"


def plan(halfstep, config, keys):
    """What `halfstep plan` prints, and the processor time that it took."""
    command = [halfstep, "plan", str(config)]
    for key in keys:
        command += ["--set", key]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True) as process:
        said = process.stdout.read()
        _, _, used = os.wait4(process.pid, 0)
        process.returncode = 0
    return said, f"{used.ru_utime + used.ru_stime:.3f}"


def row_of(halfstep, folder, seed, way):
    kind, scene, config, goal = problem(halfstep, seed)
    path = folder / f"{way}_{seed}"
    path.mkdir(parents=True, exist_ok=True)
    (path / f"scene_{seed}.yaml").write_text(scene)
    (path / "config.yaml").write_text(config + goal)
    def work(said):
        return re.search(r", (\d+) nodes, (\d+) queries .* effort ([0-9.]+)", said).groups()

    first = ""
    if way == "default":
        first = work(plan(halfstep, path / "config.yaml", ["planner.unimproved_nodes=0"])[0])[2]
    said, seconds = plan(halfstep, path / "config.yaml", WAYS[way])
    if not said:
        return [seed, kind, way, "no plan", "", "", "", first, "", seconds, ""]
    nodes, queries, effort = work(said)
    (path / "planned.yaml").write_text(config + said)
    subprocess.run([halfstep, "run", str(path / "planned.yaml"), "--overwrite", "--quiet", "--out",
                    str(path / "run")], capture_output=True, text=True)
    smoothed = ""
    with open(path / "run" / "summary.csv") as file:
        for row in csv.DictReader(file):
            if row["method"] == "dichotomy" and row["certified"] == "true":
                smoothed = row["duration_s"]
    return [seed, kind, way, "solved", len(re.findall(r"foot: (?:left|right)", said)), nodes, queries,
            first, effort, seconds, smoothed]


def table(files):
    best, found, work = {}, {}, {}
    for name in files:
        for row in csv.DictReader(open(name)):
            if not row["smoothed_s"]:
                continue
            seconds = float(row["smoothed_s"])
            best[row["seed"]] = min(seconds, best.get(row["seed"], math.inf))
            found.setdefault(row["way"], {})[row["seed"]] = seconds
            work.setdefault(row["way"], []).append(
                [float(row[key] or "nan") for key in ("effort", "first_effort", "processor_s")])
    def cell(times):
        times = [t for t in times if not math.isnan(t)]
        return f"{statistics.median(times):.2f} ({max(times):.2f})" if times else "–"

    print("| way | plans | median | worst | > 1 % | > 5 % | effort, median (largest) | "
          "of the first plan | processor time [s] |")
    print("|---|---|---|---|---|---|---|---|---|")
    for way, plans in found.items():
        over = [100.0 * (seconds / best[seed] - 1.0) for seed, seconds in plans.items()]
        effort, first, time = zip(*work[way])
        more = [100.0 * sum(o > limit for o in over) / len(over) for limit in (1.0, 5.0)]
        print(f"| `{way}` | {len(plans)}/{len(best)} | {statistics.median(over):.2f} % | "
              f"{max(over):.1f} % | {more[0]:.0f} % | {more[1]:.0f} % | "
              f"{statistics.median(effort):.3f} ({max(effort):.3f}) | "
              f"{cell(first)} | {cell(time)} |")


def main():
    if len(sys.argv) > 2 and sys.argv[1] == "--table":
        table(sys.argv[2:])
        return
    if len(sys.argv) < 4 or any(way not in WAYS for way in sys.argv[4:]):
        sys.exit(__doc__ + "Ways: " + ", ".join(WAYS))
    halfstep, count, folder = sys.argv[1], sys.argv[2].split("-"), pathlib.Path(sys.argv[3])
    seeds = range(int(count[0]) if len(count) > 1 else 1, int(count[-1]) + 1)
    tasks = [(seed, way) for seed in seeds for way in sys.argv[4:] or WAYS]
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(COLUMNS)
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", "1"))) as pool:
        for row in pool.map(lambda task: row_of(halfstep, folder, *task), tasks):
            writer.writerow(row)
            sys.stdout.flush()


if __name__ == "__main__":
    main()
