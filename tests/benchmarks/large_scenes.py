#!/usr/bin/env python3
"""Time and memory of `halfstep plan` and `halfstep run` among many obstacles or triangles:

    large_scenes.py HALFSTEP FOLDER [CASE...] [--limit SECONDS]

writes the scenes of the cases into FOLDER, plans 1.5 m and certifies six half-steps in each, and
prints a row of a Markdown table for each case. A case is KIND:N:
  boxes:N      N boxes of 4 to 20 cm
  rocks:N      rocks of 80 triangles, N triangles in one mesh
  rocks:N:K    the same rocks in K meshes
  room:N       a room of 8 x 8 m, scanned as one surface of N triangles with its floor, no ceiling
Obstacles are scattered over a hall that grows with their number, two a square metre; those near the
walk are the same in all. So what a case takes beyond reading its files is for what is far away."""
import argparse
import math
import os
import pathlib
import random
import struct
import subprocess
import sys
import time

DENSITY = 2.0  # obstacles a square metre
DEFAULT = ["boxes:1000", "boxes:10000", "boxes:100000", "rocks:1000", "rocks:1000:8",
           "rocks:10000", "rocks:100000", "rocks:1000000", "room:1000", "room:100000",
           "room:1000000"]


def places(count, rng):
    """Twelve beside and on the way, the others anywhere in the hall but where the robot walks."""
    near = [(0.35, 0.0)] + [(0.3 * (i // 2) - 0.3, (0.55 + 0.1 * (i % 3)) * (-1) ** i)
                            for i in range(11)]
    half = max(2.0, 0.5 * math.sqrt(count / DENSITY))
    result = near[:count]
    while len(result) < count:
        x, y = rng.uniform(-half, half), rng.uniform(-half, half)
        if abs(y) > 1.2 or x < -1.0 or x > 2.7:
            result.append((x, y))
    return result


def boxes(count, folder):
    rng = random.Random(1)
    lines = ["obstacles:"]
    for i, (x, y) in enumerate(places(count, rng)):
        size = [0.04, 0.3, 0.03] if i == 0 else [rng.uniform(0.04, 0.2) for _ in range(3)]
        yaw = 0.0 if i == 0 else rng.uniform(-90, 90)
        lines.append("  - {name: b%d, box: {size_m: [%.4f, %.4f, %.4f]}, pose: {xyz: [%.4f, %.4f, "
                     "%.4f], rpy_deg: [0, 0, %.2f]}}" % (i, *size, x, y, size[2] / 2, yaw))
    return lines


def icosphere():
    """80 triangles around the origin, of radius about 1."""
    g = (1 + math.sqrt(5)) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
              (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]

    def unit(p):
        n = math.sqrt(sum(c * c for c in p))
        return tuple(c / n for c in p)

    def middle(a, b):
        return unit([(u + v) / 2 for u, v in zip(a, b)])

    corners = [unit(p) for p in points]
    small = []
    for i, j, k in faces:
        a, b, c = corners[i], corners[j], corners[k]
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        small += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return small


def write_stl(path, triangles):
    with open(path, "wb") as file:
        file.write(b"\0" * 80 + struct.pack("<I", len(triangles)))
        for t in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *t[0], *t[1], *t[2], 0))


def mesh_lines(names):
    return ["obstacles:"] + ["  - {name: %s, mesh: {file: %s.stl}}" % (n, n) for n in names]


def rocks(count, folder, parts=1):
    rng = random.Random(1)
    ball = icosphere()
    all_rocks = []
    for i, (x, y) in enumerate(places(max(1, count // len(ball)), rng)):
        r = 0.02 if i == 0 else rng.uniform(0.02, 0.1)
        squeeze = [rng.uniform(0.7, 1.0) for _ in range(3)]
        all_rocks.append([[(x + r * s[0] * p[0], y + r * s[1] * p[1], r * (1.05 + s[2] * p[2]))
                           for p in t] for t in ball for s in [squeeze]])
    names = []
    for part in range(parts):
        mine = all_rocks[part * len(all_rocks) // parts:(part + 1) * len(all_rocks) // parts]
        if mine:
            names.append("rocks%d" % part)
            write_stl(folder / (names[-1] + ".stl"), [t for rock in mine for t in rock])
    return mesh_lines(names)


def sheet(corner, along, up, columns, rows, offset):
    """2 x columns x rows triangles on a rectangle, each corner moved by offset(u, v)."""
    def at(i, j):
        d = offset(i / columns, j / rows)
        return tuple(c + a * i / columns + u * j / rows + o
                     for c, a, u, o in zip(corner, along, up, d))
    triangles = []
    for i in range(columns):
        for j in range(rows):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def room(count, folder):
    """Floor and walls, uneven by at most 1 mm and 1 cm; a bar on the floor; the walk begins in it."""
    cells = count / 2 / (8 * 8 + 4 * 8 * 2.5)
    per_metre = math.sqrt(cells)
    wide, high = max(1, round(8 * per_metre)), max(1, round(2.5 * per_metre))

    def rough(axis, size):
        def offset(u, v):
            d = [0.0, 0.0, 0.0]
            d[axis] = size * math.sin(40 * u + 1) * math.sin(30 * v + 2)
            return d
        return offset
    triangles = sheet((-3, -4, 0), (8, 0, 0), (0, 8, 0), wide, wide, rough(2, 0.001))
    for x in (-3, 5):
        triangles += sheet((x, -4, 0), (0, 8, 0), (0, 0, 2.5), wide, high, rough(0, 0.01))
    for y in (-4, 4):
        triangles += sheet((-3, y, 0), (8, 0, 0), (0, 0, 2.5), wide, high, rough(1, 0.01))
    low, top = (0.33, -0.15, 0.0), (0.37, 0.15, 0.03)
    for z in (top[2],):
        triangles += sheet((low[0], low[1], z), (0.04, 0, 0), (0, 0.3, 0), 1, 8, rough(2, 0))
    for x in (low[0], top[0]):
        triangles += sheet((x, low[1], 0), (0, 0.3, 0), (0, 0, 0.03), 8, 1, rough(2, 0))
    for y in (low[1], top[1]):
        triangles += sheet((low[0], y, 0), (0.04, 0, 0), (0, 0, 0.03), 1, 1, rough(2, 0))
    write_stl(folder / "room.stl", triangles)
    return ["obstacles:", "  - {name: room, mesh: {file: room.stl, floor: in_mesh}}"]


def write_case(case, folder):
    kind, *numbers = case.split(":")
    folder.mkdir(parents=True, exist_ok=True)
    lines = {"boxes": boxes, "rocks": rocks, "room": room}[kind](
        int(numbers[0]), folder, *(int(n) for n in numbers[1:]))
    (folder / "scene.yaml").write_text("\n".join(lines) + "\n")
    common = "robot: hrp2\nscene: scene.yaml\nsmoothing: {methods: [dichotomy]}\n"
    (folder / "plan.yaml").write_text(
        "name: plan\n" + common + "goal: {x_m: 1.5, y_m: 0, radius_m: 0.15}\n"
        "planner: {name: rrt}\n")
    (folder / "run.yaml").write_text(
        "name: run\n" + common + "footsteps:\n"
        "  - {foot: left, x_m: 0.1, y_m: 0.105}\n"
        "  - {foot: right, x_m: 0.12, y_m: -0.105}\n"
        "  - {foot: left, x_m: 0.14, y_m: 0.105}\n")


def write_apart(case, folder):
    """In a process of its own: a child's peak memory counts what its parent has when it forks."""
    pid = os.fork()
    if pid == 0:
        write_case(case, folder)
        os._exit(0)
    if os.waitpid(pid, 0)[1] != 0:
        raise RuntimeError("cannot write " + case)


def measured(command, limit):
    """Seconds by the clock and of processor time, peak memory [MB]; or why there are none."""
    begin = time.monotonic()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    while True:
        pid, status, usage = os.wait4(child.pid, os.WNOHANG)
        if pid != 0:
            break
        if time.monotonic() - begin > limit:
            child.kill()
            os.wait4(child.pid, 0)
            return "not within %g s" % limit
        time.sleep(0.01)
    told = child.stderr.read().decode().strip().splitlines()
    if os.waitstatus_to_exitcode(status) != 0:
        return "fails: " + (told[-1] if told else "")
    return "%.1f s (%.1f), %d MB" % (time.monotonic() - begin, usage.ru_utime + usage.ru_stime,
                                     usage.ru_maxrss // 1024)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("halfstep", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("cases", nargs="*", default=DEFAULT)
    parser.add_argument("--limit", type=float, default=600)
    parser.add_argument("--verify", action="store_true", help="and `halfstep verify` the run")
    options = parser.parse_args()
    options.halfstep = options.halfstep.resolve()
    print("| case | plan: wall (CPU), peak | run | " + ("verify |" if options.verify else ""))
    print("|---|---|---|" + ("---|" if options.verify else ""))
    for case in options.cases:
        folder = options.folder / case.replace(":", "_")
        write_apart(case, folder)
        plan = measured([options.halfstep, "plan", folder / "plan.yaml"], options.limit)
        run = measured([options.halfstep, "run", folder / "run.yaml", "--overwrite", "--out",
                        folder / "out"], options.limit)
        row = "| %s | %s | %s |" % (case, plan, run)
        if options.verify:
            row += " %s |" % measured([options.halfstep, "verify", folder / "out"], options.limit)
        print(row, flush=True)


if __name__ == "__main__":
    sys.exit(main())
