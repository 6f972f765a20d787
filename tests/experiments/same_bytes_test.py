#!/usr/bin/env python3
"""Files are the same byte for byte on every machine: same_bytes_test.py HALFSTEP

Each command runs on this CPU with two threads, and once more with one thread, on one core, while
the C library is told that the CPU has neither FMA nor AVX (GLIBC_TUNABLES). What is written must
not differ, but for times that passed, hashes of files with such, and reports, which have both. Where
the C library's own sin is the same in both runs, as on CPUs without FMA, the test is skipped.
"""
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HALFSTEP = pathlib.Path(sys.argv[1]).resolve()
CONFIGS = ROOT / "experiments/configs"
HIDDEN = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX"}
SIN = ("import math, random; random.seed(1); "
       "print(hash(tuple(math.sin(random.uniform(0, 7)) for _ in range(100000))))")
TIME = re.compile(r"wall_s|processor_s|time_to_|^written$|^host$|sha256|^bytes$")  # columns and keys
COMMANDS = (
    ["plan", f"{CONFIGS}/plan_bar_8cm.yaml", "--set", "planner.name=rrt", "--set",
     "swept_volumes.cell_m=0.05", "--set", "swept_volumes.displacement_m=0.05", "--set",
     "planner.unimproved_nodes=0", "--set", "goal.radius_m=0.4"],  # a few steps over the bar
    ["run", f"{CONFIGS}/fig3_two_half_steps.yaml", "--out", "fig3", "--set",
     "smoothing.methods=[dichotomy, dichotomy/uniform, halfstep/barrier, halfstep/sqp]",
     "--set", "smoothing.optimizer.heights=true",
     "--set", "smoothing.optimizer.rounds=2", "--set", "smoothing.optimizer.effort=1"],
    ["run", f"{CONFIGS}/bar_8cm.yaml", "--out", "bar", "--set",
     "smoothing.methods=[dichotomy, reference/lipm]"],
    ["export", "bar", "--format", "hrpsys", "--out", "exported"],
    ["draw", "random_room"],
    ["live", f"{ROOT}/experiments/episodes/live_bar.yaml", "--out", "episode",
     "--set", "swept_volumes.cell_m=0.05", "--set", "swept_volumes.displacement_m=0.05"],
)
PYTHON = f"""
import halfstep as hs
walk = hs.Experiment("{CONFIGS}/bar_8cm.yaml").smooth("dichotomy").walk
print(walk.duration, [column.tolist() for column in walk.sample(0.05).values()])
"""


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(inner) for key, inner in value.items() if not TIME.search(key)}
    if isinstance(value, list):
        return [without_times(inner) for inner in value]
    return value


def content(path):
    """Of a written file, what must be the same."""
    text = path.read_bytes()
    if path.suffix == ".csv":
        rows = list(csv.reader(text.decode().splitlines()))
        kept = [i for i, name in enumerate(rows[0]) if not TIME.search(name)]
        return text if len(kept) == len(rows[0]) else [[row[i] for i in kept] for row in rows]
    if path.name == "manifest.json":
        return without_times(json.loads(text))
    return re.sub(rb"threads: *\d+", b"threads", text)


def files_of(folder):
    return {path.relative_to(folder).as_posix(): content(path) for path in sorted(folder.rglob("*"))
            if path.is_file() and path.suffix != ".html" and path.name != "timings.csv"}


def done_in(folder, prefix, environment, threads):
    """Runs everything in a folder; what was written and what Python printed."""
    folder.mkdir()
    for line in COMMANDS:
        line = [*line]
        if line[0] in ("run", "live"):
            line += ["--set", f"smoothing.threads={threads}"]
        done = subprocess.run([*prefix, HALFSTEP, *line], cwd=folder, env=environment,
                              capture_output=True, text=True)
        if line[0] in ("plan", "draw"):
            (folder / f"{line[0]}.txt").write_text(re.sub(r"\d\S* m?s\b", "", done.stdout))
        assert done.returncode == 0, (line, done.stdout, done.stderr)
    files = files_of(folder)
    if (HALFSTEP.parents[1] / "python").is_dir():
        files["Python"] = subprocess.run(
            [*prefix, sys.executable, "-c", PYTHON], cwd=folder, env=environment, check=True,
            capture_output=True, text=True).stdout
    return files


def main():
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        plain = os.environ | {"XDG_CACHE_HOME": f"{name}/cache", "GLIBC_TUNABLES": "",
                              "PYTHONPATH": str(HALFSTEP.parents[1] / "python")}
        sines = [subprocess.run([sys.executable, "-c", SIN], env=environment, check=True,
                                capture_output=True).stdout for environment in (plain, plain | HIDDEN)]
        if sines[0] == sines[1]:
            print("skipped: sin is the same with and without FMA here, so nothing can be told")
            return 77
        one = done_in(place / "with", [], plain, 2)
        core = str(min(os.sched_getaffinity(0)))
        other = done_in(place / "without", ["taskset", "-c", core], plain | HIDDEN, 1)
        wrong = sorted(f for f in one.keys() | other.keys() if one.get(f) != other.get(f))
        print(f"{len(one)} files", *(f"differs: {file}" for file in wrong), sep="\n")
        assert len(one) > 100, "fewer files than commands write"
        return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
