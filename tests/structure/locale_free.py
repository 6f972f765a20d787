#!/usr/bin/env python3
"""Fails where the product reads or writes numbers in the locale of the program around it.

A host program (Qt, GTK) sets the user's locale, in which 0.5 is 0,5 for printf and strtod, and for
C++ streams once their global locale is set. Numbers are written by ShortestText or Formatted and
read by ParseNumber (wpg/files), or by std::to_chars and std::from_chars.
Run: locale_free.py [NM ARCHIVE...]   (NM also looks in archives for std::to_string of a double)
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORBIDDEN = {
    "printf": r"\bv?(?:f|s|sn|as|d)?printf\s*\(",
    "scanf": r"\bv?[fs]?scanf\s*\(",
    "strtod": r"\b(?:strto(?:f|d|ld|u?ll?)|ato(?:f|i|ll?)|sto(?:f|d|ld|i|u?ll?))\s*\(",
    "stringstream": r"\b[io]?stringstream\b",
    "locale": r"\b(?:setlocale|localeconv)\s*\(|std::locale::global",
}
ALLOWED = {
    ("wpg/files/text.cc", "printf"): "Formatted, in the C locale",
    ("wpg/files/plain_locale.h", "stringstream"): "PlainStream, in the C locale",
    ("opt/problem/plain_stream.h", "stringstream"): "the same for opt, which has no siblings",
    ("wpg/check.h", "stringstream"): "the words of a broken precondition, which nobody stores",
    ("wpg/files/yaml_parser.cc", "stringstream"): "bytes for yaml-cpp",
    ("wpg/files/octomap_file.cc", "stringstream"): "bytes for octomap",
    ("experiments/replay/mujoco_compile.cc", "locale"): "MuJoCo reads by the global locale",
}


def without_comments(line):
    return "" if line.lstrip().startswith("#include") else line.split("//")[0]


def found_in(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        for what, pattern in FORBIDDEN.items():
            if re.search(pattern, without_comments(line)):
                yield what, number, line.strip()


def main():
    assert re.search(FORBIDDEN["printf"], "std::snprintf(a)"), "it can fail"
    assert not re.search(FORBIDDEN["strtod"], "ParseNumber(restored(x))"), "and need not"
    wrong, used = [], set()
    for top in ("wpg", "planner", "opt", "smoothing", "experiments"):
        for path in sorted((ROOT / top).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            # Examples are programs of a user's own, in which there is no host.
            if path.suffix not in (".h", ".cc") or name.startswith("experiments/examples/"):
                continue
            for what, number, line in found_in(path):
                used.add((name, what))
                if (name, what) not in ALLOWED:
                    wrong.append(f"{name}:{number}: {line}")
    wrong += [f"{name} needs no {what} any more" for name, what in ALLOWED.keys() - used]
    for archive in sys.argv[2:]:
        # What libstdc++'s to_string of floating point numbers is made of; integers do without.
        names = subprocess.run([sys.argv[1], "-C", archive], capture_output=True, text=True).stdout
        if "__to_xstring" in names:
            wrong.append(f"{archive}: std::to_string of a double")
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
