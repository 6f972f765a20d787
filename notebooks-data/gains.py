#!/usr/bin/env python3
"""The table of the README that says what is gained: gains.py HALFSTEP [--check SCENARIO]

Runs the six scenarios and writes the table below <!-- gains --> in README.md; --check: runs one
scenario and compares its row, exit status 1 where it differs. Searches end by counted work, so
every machine writes the same numbers.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
MARK = "<!-- gains -->\n"
SCENARIOS = ["fig3_two_half_steps", "fig4_raw_sequence", "fig5_box", "bar_5cm", "bar_8cm",
             "bar_10cm"]
LIMIT = {"smoothing.profile": "limit"}
FORMS = LIMIT | {f"smoothing.optimizer.{key}": "false"
                 for key in ("heights", "durations", "all_families")}
# Of each run: what it sets, and its methods with the column that each fills.
RUNS = [
    ({}, {"dichotomy": "dichotomy", "halfstep/sqp": "`halfstep/sqp`, **default demands**"}),
    # The grid is scanned to its end.
    (LIMIT | {"smoothing.optimizer.effort": "60"},
     {"dichotomy/uniform": "`limit`: best uniform T and η, then dichotomy"}),
    (FORMS, {"halfstep/sqp": "`limit`: `halfstep/sqp`, Δ alone"}),
    (FORMS | {"smoothing.optimizer.heights": "true", "smoothing.optimizer.durations": "true"},
     {"halfstep/sqp": "`limit`: `halfstep/sqp`, Δ, η, T"}),
    (LIMIT, {"halfstep/sqp": "`limit`: `halfstep/sqp`, every family"}),
]
COLUMNS = ["dichotomy", "`halfstep/sqp`, **default demands**",
           "`limit`: best uniform T and η, then dichotomy", "`limit`: `halfstep/sqp`, Δ alone",
           "`limit`: `halfstep/sqp`, Δ, η, T", "`limit`: `halfstep/sqp`, every family"]


def row_of(halfstep, scenario, folder):
    """The scenario's row: D [s] of the certified walk of each column."""
    durations = {}
    for number, (settings, methods) in enumerate(RUNS):
        out = pathlib.Path(folder) / f"{scenario}_{number}"
        command = [halfstep, "run", str(ROOT / f"experiments/configs/{scenario}.yaml"), "--quiet",
                   "--out", str(out), "--set", "output.period_s=0.1",
                   "--set", f"smoothing.methods=[{', '.join(methods)}]"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        subprocess.run(command, check=True)
        with open(out / "summary.csv", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if row["method"] in methods:
                    assert row["certified"] == "true", row
                    durations[methods[row["method"]]] = f"{float(row['duration_s']):.3f}"
    return f"| `{scenario}` | " + " | ".join(durations[column] for column in COLUMNS) + " |\n"


def main():
    if len(sys.argv) not in (2, 4):
        sys.exit(__doc__)
    halfstep, page = str(pathlib.Path(sys.argv[1]).resolve()), ROOT / "README.md"
    text = page.read_text(encoding="utf-8")
    begin = text.index(MARK) + len(MARK)
    with tempfile.TemporaryDirectory() as folder:
        if sys.argv[2:3] == ["--check"]:
            row = row_of(halfstep, sys.argv[3], folder)
            if row not in text[begin:]:
                sys.exit(f"README.md has another row than\n{row}")
            return
        table = "| D [s], certified | " + " | ".join(COLUMNS) + " |\n"
        table += "|---" * (len(COLUMNS) + 1) + "|\n"
        for scenario in SCENARIOS:
            table += row_of(halfstep, scenario, folder)
    end = begin
    while text.startswith("|", end):
        end = text.index("\n", end) + 1
    page.write_text(text[:begin] + table + text[end:], encoding="utf-8")


if __name__ == "__main__":
    main()
