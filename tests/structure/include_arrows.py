#!/usr/bin/env python3
"""Fails on an include between folders that points backwards, and on a circle of folders.

Arrows go from left to right: wpg <- planner <- smoothing <- experiments; opt includes no sibling,
and only smoothing and experiments include it. No two folders include each other.
Run: include_arrows.py [--picture]   (prints who includes whom)
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOP = ["wpg", "opt", "planner", "smoothing", "experiments"]
MAY_INCLUDE = {
    "wpg": {"wpg"},
    "opt": {"opt"},
    "planner": {"planner", "wpg"},
    "smoothing": {"smoothing", "planner", "opt", "wpg"},
    "experiments": set(TOP),
}
# Circles that are still there: each is to go, none is to come.
KNOWN_CIRCLES = {("wpg", "wpg/input"), ("experiments", "experiments/report")}
# The program's main file and commands bring everything together; they are the folder's roof.
ROOF = {"experiments/main.cc"}


def folder_of(path):
    return str(pathlib.PurePosixPath(path).parent)


def main():
    includes = {}
    for top in TOP:
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            name = path.relative_to(ROOT).as_posix()
            found = re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.M)
            includes[name] = [f for f in found if (ROOT / f).exists()]
    wrong = []
    arrows = {}
    for name, targets in includes.items():
        top = name.split("/")[0]
        for target in targets:
            if target.split("/")[0] not in MAY_INCLUDE[top]:
                wrong.append(f"{name} includes {target}: backwards")
            if folder_of(name) != folder_of(target) and name not in ROOF:
                arrows.setdefault((folder_of(name), folder_of(target)), []).append((name, target))
    for (a, b), pairs in sorted(arrows.items()):
        if (b, a) in arrows and a < b and (a, b) not in KNOWN_CIRCLES:
            for name, target in (pairs[0], arrows[(b, a)][0]):
                wrong.append(f"{a} and {b} include each other: {name} includes {target}")
    if "--picture" in sys.argv:
        for a in sorted({a for a, _ in arrows}):
            print(a, "->", ", ".join(sorted(b for x, b in arrows if x == a)))
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


sys.exit(main())
