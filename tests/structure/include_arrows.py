#!/usr/bin/env python3
"""Fails on an include between folders that points backwards, on a circle of folders, and on what
`halfstep verify` and `halfstep check` should know nothing of.

A file of a top-level folder includes that folder and the ones below it: wpg below planner below
smoothing below experiments; opt stands beside wpg and planner, below smoothing. wpg/elementary.h
lies below all. No chain of includes leads from a folder (wpg/robot, smoothing/proof …) back to
itself. A test includes what the folder under test may include; opt, which includes no other
sibling, is open to every test.
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

BELOW_ALL = "wpg/elementary.h"

# What proves again, or looks again, reads files and configs. What else it includes is here, with the
# reason.
VERIFY = "experiments/verify"
CHECKER = "experiments/checker"
FOLDERS_OF = {VERIFY: [VERIFY, "experiments/config", "wpg/files"], CHECKER: [CHECKER, "wpg/files"]}
ALLOWED_IN = {VERIFY: {
    "experiments/live/live_config.h": "the reader of an episode's config",
    "experiments/live/spare_boxes.h": "the obstacles that such a config adds to its scene",
    "experiments/tables/certificate_statement.h": "the only statement that is accepted",
    "planner/scene/scene.h": "the reader of scenes",
    "smoothing/methods/dichotomy.h": "options of the dichotomy, as a config has them",
    "smoothing/methods/solver_method_options.h": "those of solvers",
    "smoothing/margins/tube.h": "the distances of a tube, as a config has them",
    "wpg/check.h": "broken preconditions",
    "wpg/geometry/convex_body.h": "the shapes of robots and scenes",
    "wpg/geometry/foothold.h": "places of feet, in configs",
    "wpg/geometry/pose2.h": "the same, seen from above",
    "wpg/geometry/side.h": "left and right",
    "wpg/ground/ground.h": "the prisms that a scene's ground is made of",
    "wpg/nth.h": "elements by signed indices",
    "wpg/robot/not_covered.h": "the words of what is not covered",
    "wpg/robot/robot_model.h": "the reader of robots",
    "wpg/robot/torque_limits.h": "what a robot file states of torques",
}, CHECKER: {
    "experiments/config/data_folder.h": "where shipped robots and scenes are",
    "experiments/config/experiment.h": "the reader of configs",
    "experiments/live/spare_boxes.h": "the obstacles that an episode's config adds to its scene",
    "experiments/tables/csv_reader.h": "the reader of anybody's tables",
    "experiments/verify/box_index.h": "boxes in a tree, by which the triangles of meshes are found",
    "experiments/verify/certificate_text.h": "the reader of certificates",
    "experiments/verify/check_episode_proof.h": "what the config of an episode demands",
    "experiments/verify/check_episode_worlds.h": "the reader of an episode's worlds",
    "experiments/verify/config_plan.h": "the reader of a config's form of half-steps",
    "experiments/verify/csv_text.h": "the reader of a run's tables",
    "experiments/verify/episode_text.h": "the reader of an episode's tables",
    "experiments/verify/found_inputs.h": "where robot and scene of a run are",
    "experiments/verify/json_text.h": "the reader of JSON",
    "experiments/verify/robot_numbers.h": "what a robot file states, in numbers",
    "experiments/verify/run_manifest.h": "the reader of manifests",
    "experiments/verify/walk_prover.h": "what verify has proved by the checker",
    "experiments/verify/walk_text.h": "the reader of the tables that describe a walk",
    "planner/scene/scene.h": "the reader of scenes",
    "planner/scene/shape.h": "the triangles of meshes, as that reader has them",
    "planner/scene/voxel_set.h": "the cubes of a map, as that reader has them",
    "wpg/check.h": "the words of a broken precondition",
    "wpg/elementary.h": "sine and cosine, which are trusted to a unit in the last place",
    "wpg/geometry/convex_body.h": "the shapes of robots and scenes",
    "wpg/geometry/rotation.h": "rotations in doubles, of hints",
    "wpg/nth.h": "elements by signed indices",
    "wpg/robot/gravity.h": "a number",
    "wpg/robot/robot_bodies.h": "the shapes of a URDF's links",
    "wpg/robot/robot_fields.h": "the reader of robot files",
    "wpg/robot/robot_masses.h": "the mass of a body, as that reader has it",
    "wpg/robot/robot_model.h": "the reader of robots",
    "wpg/robot/sole_outline.h": "the corners of a sole",
    "wpg/robot/urdf_file.h": "the reader of URDF",
}}


def includes_of(path):
    found = re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.M)
    return [name for name in found if (ROOT / name).exists()]


def folder_of(name):
    return str(pathlib.PurePosixPath(name).parent)


def may_include(name, target):
    """Whether the top-level folders of the two files allow it."""
    if target == BELOW_ALL:
        return True
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


def independent_may_include(name, target):
    """Whether a file, if it is of verify or of the checker, may include another."""
    folder = folder_of(name)
    return (folder not in ALLOWED_IN or folder_of(target) in FOLDERS_OF[folder] or
            target in ALLOWED_IN[folder])


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
    included_by = {folder: set() for folder in ALLOWED_IN}
    for top in [*BELOW, "tests"]:
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            name = path.relative_to(ROOT).as_posix()
            for target in includes_of(path):
                if not may_include(name, target):
                    wrong.append(f"{name} includes {target}: backwards")
                if folder_of(name) in ALLOWED_IN:
                    included_by[folder_of(name)].add(target)
                if not independent_may_include(name, target):
                    wrong.append(f"{name} includes {target}: not for what proves again")
                if folder_of(name) != folder_of(target):
                    arrows.setdefault(folder_of(name), {}).setdefault(
                        folder_of(target), (name, target))
    wrong += [f"{folder} does not include {target} any more: it need not be allowed"
              for folder, allowed in ALLOWED_IN.items() for target in allowed
              if target not in included_by[folder]]
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
