#!/usr/bin/env python3
"""Runs the examples in one process and looks for what each says.   run_examples.py FOLDER [NAME]"""
import contextlib
import io
import pathlib
import re
import runpy
import sys
import time

FOLDER = pathlib.Path(sys.argv[1])
WANTED = sys.argv[2] if len(sys.argv) > 2 else ""


def numbers(pattern, told):
    return [float(found) for found in re.findall(pattern, told)]


def shorter(told, first, second):
    return numbers(first, told)[0] < numbers(second, told)[0]


CHECKS = {
    "01": lambda t: shorter(t, r"overlapped: +([\d.]+)", r"isolated: +([\d.]+)"),
    "02": lambda t: t.count(" least ") >= 14 and "clearance changes by" in t,
    "03": lambda t: "certified: every demanded margin" in t and "violated" in t,
    "04": lambda t: "certified" in t and shorter(t, r": ([\d.]+) s, certified",
                                                 r"the dichotomy ([\d.]+)"),
    "05": lambda t: len(numbers(r"lifted to ([\d.]+)", t)) == 2 and t.count("certified") == 2
    and numbers(r"lifted to ([\d.]+)", t)[1] < numbers(r"lifted to ([\d.]+)", t)[0],
    "06": lambda t: "certified" in t and shorter(t, r"descent ([\d.]+)", r"dichotomy +([\d.]+)"),
    "07": lambda t: shorter(t, r"with: .*at most ([\d.]+)", r"without: .*at most ([\d.]+)"),
    "08": lambda t: t.startswith("solved") and t.rstrip().endswith("certified"),
    "09": lambda t: numbers(r"mm +([\d.]+) s", t) == sorted(numbers(r"mm +([\d.]+) s", t)),
    "10": lambda t: "mine" in t and t.rstrip().endswith("certified"),
    "11": lambda t: t.count("certified") == 2 and numbers(r"mine/scale +([\d.]+)", t)[0] < 15.0,
    "12": lambda t: " 0.10\n" in t and " 0.20\n" in t and " s, certified" in t,
}


def main():
    failed = []
    for path in sorted(FOLDER.glob(f"{WANTED}*.py" if WANTED else "[0-9][0-9]_*.py")):
        lines = path.read_text(encoding="utf-8").count("\n")
        told, begin = io.StringIO(), time.perf_counter()
        try:
            with contextlib.redirect_stdout(told):
                runpy.run_path(str(path), run_name="__main__")
            good = CHECKS[path.name[:2]](told.getvalue()) and lines <= 40
        except ModuleNotFoundError as error:
            print(f"skipped  {path.name}: {error}")
            continue
        except Exception as error:  # told with the example's name
            told.write(f"{type(error).__name__}: {error}\n")
            good = False
        print(f"{'ok' if good else 'FAILED'}  {path.name}, {lines} lines, "
              f"{time.perf_counter() - begin:.2f} s")
        if not good or WANTED:
            print(told.getvalue())
        if not good:
            failed.append(path.name)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
