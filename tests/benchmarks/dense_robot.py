#!/usr/bin/env python3
"""Writes HRP-2 with hulls of many vertices, as other robots' meshes have them:
dense_robot.py FOLDER VERTICES [ROUNDING_MM]. Every mesh grows by a ball (3 mm), of which so many
points are taken; soles stay flat and where they are."""
import math
import pathlib
import random
import shutil
import sys

ROBOTS = pathlib.Path(__file__).resolve().parents[2] / "wpg" / "robots"


def direction(rng):
    d = [rng.gauss(0, 1) for _ in range(3)]
    length = math.sqrt(sum(x * x for x in d))
    return [x / length for x in d]


def dense(points, count, rounding, lowest, rng):
    result = []
    while len(result) < count:
        d = direction(rng)
        far = max(points, key=lambda p: sum(a * b for a, b in zip(p, d)))
        p = [a + rounding * b for a, b in zip(far, d)]
        p[2] = max(p[2], lowest)
        result.append(p)
    return result


def main():
    folder, count = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    rounding = float(sys.argv[3]) / 1000 if len(sys.argv) > 3 else 0.003
    rng = random.Random(1)
    (folder / "hrp2").mkdir(parents=True, exist_ok=True)
    for name in ("hrp2.yaml", "hrp2.urdf"):
        shutil.copy(ROBOTS / name, folder / name)
    for mesh in sorted((ROBOTS / "hrp2").glob("*.obj")):
        points = [
            [float(x) for x in line.split()[1:4]]
            for line in mesh.read_text().splitlines()
            if line.startswith("v ")
        ]
        is_foot = mesh.name.startswith("leg5_")
        lowest = min(p[2] for p in points) if is_foot else -math.inf
        points = dense(points, count, rounding, lowest, rng)
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
        # The hull is that of the vertices, whatever the triangles are.
        lines += [f"f {i} {i + 1} {i + 2}" for i in range(1, count - 1)]
        (folder / "hrp2" / mesh.name).write_text("\n".join(lines) + "\n")


main()
