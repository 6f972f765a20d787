"""What the commands wrote and printed, for paper_claims.py. Paths are below runs/."""

import csv
import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]


class DoesNotHold(Exception):
    pass


def hold(condition, otherwise):
    if not condition:
        raise DoesNotHold(otherwise)


def rows(path):
    with open(ROOT / "runs" / path, newline="") as file:
        return list(csv.DictReader(file))


def column(path, name):
    return [float(row[name]) for row in rows(path)]


def summary(run, method="dichotomy"):
    """The row of a method; its walk must be certified."""
    row = next(row for row in rows(f"{run}/summary.csv") if row["method"] == method)
    hold(row["certified"] == "true", f"{run}: {method} is not certified")
    return row


def duration(run, method="dichotomy"):
    return float(summary(run, method)["duration_s"])


def json_of(path):
    with open(ROOT / "runs" / path) as file:
        return json.load(file)


def step_period(run, method):
    """Seconds from step to step in the middle of a walk."""
    starts = column(f"{run}/{method}/half_steps.csv", "start_s")
    middle = len(starts) // 4 * 2
    return starts[middle + 2] - starts[middle]


def study_row(printed, planner):
    """Solved, certified, median ms, 95 % ms, footsteps, nodes, queries of planner_study."""
    return next(line for line in printed.splitlines() if line.split()[1:2] == [planner]).split()[2:]
