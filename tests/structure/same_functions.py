#!/usr/bin/env python3
"""Fails where the product calls what has other bits on another machine: the C library's sin, exp …,
of which it has variants for CPUs with and without FMA. `wpg/elementary.h` has them all.

Run: same_functions.py [NM ARCHIVE...]   (looks for calls from headers of others, Eigen's, in archives)
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMES = ("a?sinh?|a?cosh?|a?tanh?|atan2|sincos|exp|exp2|expm1|log|log2|log10|log1p|pow|hypot|cbrt|"
         "fma|erfc?|[lt]gamma")
FORBIDDEN = re.compile(rf"\bstd::(?:{NAMES})\(|\bAngleAxis|\bRotation2D|\bEulerAngles|\beulerAngles")
ALLOWED = {
    "smoothing/methods/lipm_bound.cc": "reference/lipm: a bound that no walk depends on",
    "smoothing/methods/pareto.cc": "the durations at which safest walks are sought",
    "experiments/verify/": "writes no files; the C library's functions there check ours",
}


def allowed(name):
    return next((key for key in ALLOWED if name.startswith(key)), None)


def main():
    assert FORBIDDEN.search("x = std::sin(y)") and not FORBIDDEN.search("Sin(y) + std::sqrt(y)")
    wrong, used = [], set()
    for top in ("wpg", "planner", "opt", "smoothing", "experiments"):
        for path in sorted((ROOT / top).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            if path.suffix not in (".h", ".cc"):
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if not FORBIDDEN.search(line.split("//")[0]):
                    continue
                used.add(allowed(name))
                if allowed(name) is None:
                    wrong.append(f"{name}:{number}: {line.strip()}")
    wrong += [f"{name} need not be allowed any more" for name in ALLOWED.keys() - used]
    for archive in sys.argv[2:]:
        told = subprocess.run([sys.argv[1], "-u", archive], capture_output=True, text=True).stdout
        wrong += [f"{archive}: {name}" for name in
                  sorted(set(re.findall(rf" U ((?:{NAMES})[fl]?)$", told, re.M)))]
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
