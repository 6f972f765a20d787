#!/usr/bin/env python3
"""Fails when a public item of the C++ headers has no comment (experiments/pages/Doxyfile).

documented_test.py. Exit status 77, a skip: there is no Doxygen.
"""
import contextlib
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "experiments/pages"
sys.dont_write_bytecode = True
sys.path.insert(0, str(PAGES))

import comments_as_written  # noqa: E402


def warnings(folder):
    """Doxygen's about the headers; they are filtered here, at once, and no page is written."""
    for top in ("wpg", "planner", "opt", "smoothing", "experiments"):
        for path in [*ROOT.glob(f"{top}/**/*.h"), *ROOT.glob(f"{top}/pages/*.dox")]:
            copy = folder / path.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            with open(copy, "w", encoding="utf-8") as file, contextlib.redirect_stdout(file):
                comments_as_written.main(path)
    settings = (PAGES / "Doxyfile").read_text(encoding="utf-8") + (
        "GENERATE_HTML = NO\nGENERATE_XML = NO\nINPUT_FILTER =\nUSE_MDFILE_AS_MAINPAGE =\n"
        f"OUTPUT_DIRECTORY = {folder}\n")
    done = subprocess.run(["doxygen", "-"], input=settings, cwd=folder, text=True,
                          capture_output=True)
    told = [line.replace(f"{folder}/", "") for line in done.stderr.splitlines()
            if "No output formats selected" not in line]
    return told + ([f"doxygen: exit status {done.returncode}"] if done.returncode else [])


def main():
    if not shutil.which("doxygen"):
        print("no doxygen: skipped")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        # It can fail: an item without a comment is told.
        (folder / "opt").mkdir()
        (folder / "opt/silent.h").write_text("namespace halfstep {\nint Silent(int x);\n}\n")
        told = warnings(folder)
    silent = [line for line in told
              if re.search(r"opt/silent\.h:2: .*Silent.* is not documented", line)]
    others = [line for line in told if line not in silent]
    print("\n".join(others))
    if not silent:
        print("an item without a comment was not told")
    return 1 if others or not silent else 0


if __name__ == "__main__":
    sys.exit(main())
