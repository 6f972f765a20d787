#!/usr/bin/env python3
"""Drawn episodes over levels: level_episodes.py HALFSTEP COUNT FOLDER > level_episodes.csv

Stairs up or down, a platform or stones of HRP-2's size, with one to three boxes that stand on them
or are carried across at drawn times, by seeds 1 to COUNT. Each episode runs in lockstep and is
verified; folders stay in FOLDER. Exit status 1 when an obstacle that kept to its r and v was
touched, a folder is not verified, or a run fails.
"""
import concurrent.futures
import csv
import json
import pathlib
import random
import subprocess
import sys

COLUMNS = ["seed", "ground", "ending", "end_s", "half_steps", "replanned", "promise", "verified"]
GROUNDS = ["up", "down", "platform", "stones"]


def ground_of(kind, draw):
    """Surfaces, and heights of the ground along x from 0 in steps: [(x_end, height)]."""
    rise, run = draw.uniform(0.04, 0.1), draw.uniform(0.29, 0.36)
    if kind == "platform":
        heights = [0.0, rise, rise, rise, 0.0]
    elif kind == "stones":
        heights = [0.0] + [draw.choice([-0.04, 0.0, 0.04]) for _ in range(3)] + [0.0]
    else:
        heights = [k * rise for k in range(4)] + [3 * rise]
    if kind == "down":
        heights.reverse()
    ends = [0.16 + k * run for k in range(4)] + [3.0]
    return list(zip(ends, heights))


def scene_of(ground, boxes):
    lines, begin = ["name: levels", "floor: none", "surfaces:"], -1.0
    for k, (end, height) in enumerate(ground):
        lines.append(f"  - {{name: s{k}, height_m: {height:.3f}, thickness_m: {height + 0.2:.3f}, "
                     f"polygon_m: [[{begin:.3f}, -1.2], [{end:.3f}, -1.2], [{end:.3f}, 1.2], "
                     f"[{begin:.3f}, 1.2]]}}")
        begin = end
    lines.append("obstacles:")
    for k, (x, y, z) in enumerate(boxes):
        lines.append(f"  - {{name: box{k}, box: {{size_m: [0.16, 0.16, 0.12]}}, pose: {{xyz: "
                     f"[{x:.3f}, {y:.3f}, {z:.3f}]}}, motion: {{speed_m_s: 0.15}}}}")
    return "\n".join(lines) + "\n"


def episode_of(seed):
    """Texts of scene and episode, and the kind of ground."""
    draw = random.Random(seed)
    kind = GROUNDS[seed % len(GROUNDS)]
    ground = ground_of(kind, draw)
    boxes, script = [], []
    for k in range(draw.randint(1, 3)):
        x, side = draw.uniform(0.4, 1.8), draw.choice([-1, 1])
        z = next(height for end, height in ground if x <= end) + 0.12
        boxes.append((x, side * draw.uniform(0.75, 1.0), z))
        if draw.random() < 0.8:
            script.append(f"    - {{at_s: {draw.uniform(0.1, 6):.2f}, do: carry, obstacle: box{k}, "
                          f"xyz: [{x:.3f}, {side * draw.uniform(-0.8, 0.5):.3f}, {z:.3f}], "
                          f"speed_m_s: {draw.uniform(0.08, 0.15):.3f}}}")
    script.sort(key=lambda line: float(line.split()[2].rstrip(",")))
    z = ground[0][1]
    episode = f"""name: levels_{seed}
robot: hrp2
scene: scene_{seed}.yaml
start:
  left:  {{x_m: -0.15, y_m: 0.085, z_m: {z:.3f}}}
  right: {{x_m: -0.15, y_m: -0.085, z_m: {z:.3f}}}
goal: {{x_m: 1.9, y_m: 0, radius_m: 0.2}}
seed: {seed}
planner: {{name: astar, max_nodes: 1200, unimproved_nodes: 0, workspace_m: [-0.6, -0.9, 2.4, 0.9]}}
live:
  sensing: {{rests_after_s: 6}}
"""
    return scene_of(ground, boxes), episode + ("  script:\n" + "\n".join(script) if script else ""), kind


def row_of(halfstep, folder, seed):
    scene, episode, kind = episode_of(seed)
    (folder / f"scene_{seed}.yaml").write_text(scene, encoding="utf-8")
    config = folder / f"episode_{seed}.yaml"
    config.write_text(episode, encoding="utf-8")
    run = folder / str(seed)
    subprocess.run([halfstep, "live", config, "--out", run, "--overwrite", "--quiet"], check=False)
    manifest = json.loads((run / "manifest.json").read_text(encoding="utf-8"))
    verified = subprocess.run([halfstep, "verify", run, "--quiet"], check=False).returncode == 0
    plans, begun = ([*csv.DictReader((run / name).open(encoding="utf-8"))]
                    for name in ("plans.csv", "begun.csv"))
    return [seed, kind, manifest["ending"], manifest["end_s"], len(begun),
            sum(plan["kind"] == "changed" for plan in plans[1:]), manifest["promise"]["status"],
            int(verified)]


def main():
    halfstep, count, folder = sys.argv[1], int(sys.argv[2]), pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    wrong = False
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for row in pool.map(lambda seed: row_of(halfstep, folder, seed), range(1, count + 1)):
            table.writerow(row)
            sys.stdout.flush()
            wrong = wrong or row[-2] == "touched" or not row[-1]
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
