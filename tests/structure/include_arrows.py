#!/usr/bin/env python3
"""Fails on an include between folders that points backwards, and on a circle of folders.

A file of a top-level folder includes that folder and the ones below it: wpg below planner below
smoothing below experiments; opt stands beside wpg and planner, below smoothing. No chain of
includes leads from a folder (wpg/robot, smoothing/proof …) back to itself. A test includes what
the folder under test may include; opt, which includes no sibling, is open to every test.
Run: include_arrows.py [--picture]   (prints who includes whom, the bottom first)
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BELOW = {
    "wpg": [],
    "opt": [],
    "planner": ["wpg"],
    "smoothing": ["planner", "opt", "wpg"],
    "experiments": ["smoothing", "planner", "opt", "wpg"],
}


def includes_of(path):
    found = re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.M)
    return [name for name in found if (ROOT / name).exists()]


def folder_of(name):
    return str(pathlib.PurePosixPath(name).parent)


def may_include(name, target):
    """Whether the top-level folders of the two files allow it."""
    top, to = name.split("/")[0], target.split("/")[0]
    if top == "tests":
        under_test = name.split("/")[1]
        if under_test not in BELOW:  # tests of the program, studies, fixtures
            return True
        if to == "tests":
            beside = target.split("/")[1]
            return beside not in BELOW or beside in [under_test, "opt"] + BELOW[under_test]
        return to in [under_test, "opt"] + BELOW[under_test]
    return to == top or to in BELOW[top]


def reached_from(folder, arrows):
    seen, open_ends = set(), [folder]
    while open_ends:
        for target in arrows.get(open_ends.pop(), {}):
            if target not in seen:
                seen.add(target)
                open_ends.append(target)
    return seen


def main():
    wrong = []
    arrows = {}  # folder -> folder -> one pair of files
    for top in [*BELOW, "tests"]:
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            name = path.relative_to(ROOT).as_posix()
            for target in includes_of(path):
                if not may_include(name, target):
                    wrong.append(f"{name} includes {target}: backwards")
                if folder_of(name) != folder_of(target):
                    arrows.setdefault(folder_of(name), {}).setdefault(
                        folder_of(target), (name, target))
    reached = {folder: reached_from(folder, arrows) for folder in arrows}
    for folder, targets in sorted(arrows.items()):
        for target, (name, included) in sorted(targets.items()):
            if folder in reached.get(target, set()):
                wrong.append(f"{name} includes {included}: {target} includes {folder} as well, "
                             "at once or by others")
    if "--picture" in sys.argv:
        shown = [f for f in arrows if not f.startswith("tests")]
        for folder in sorted(shown, key=lambda f: (len(reached[f]), f)):
            print(f"{folder:22} includes {', '.join(sorted(arrows[folder]))}")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


sys.exit(main())
