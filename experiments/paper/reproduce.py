#!/usr/bin/env python3
"""Runs the claims of paper_claims.py and sets what was found in the table of
notebooks-data/reproduction.md.

The commands are run as they stand in the table. Called by reproduce.sh, which builds first.
"""

import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from paper_claims import CLAIMS
from run_tables import ROOT, DoesNotHold, hold

BEGIN, END = "<!-- reproduced: begin -->", "<!-- reproduced: end -->"


class NotThere(Exception):
    pass


class Commands:
    """Runs each command once, in the project's folder with an empty cache of swept volumes."""

    def __init__(self, cache):
        build = ROOT / "build" / "release"
        self.environment = {**os.environ, "XDG_CACHE_HOME": cache, "PATH": os.pathsep.join(
            [f"{build}/experiments", f"{build}/tests", os.environ["PATH"]])}
        self.done = {}

    def __call__(self, command):
        """What it printed and how long it took [s]."""
        if command not in self.done:
            start, words = time.monotonic(), shlex.split(command)
            if not shutil.which(words[0], path=self.environment["PATH"]):
                raise NotThere(f"not run: {words[0]} is not built")
            with subprocess.Popen(words, cwd=ROOT, env=self.environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                try:
                    printed, complaint = process.communicate()
                except BaseException:
                    process.terminate()
                    raise
            # That there is no plan may be the claim; it is printed.
            fine = (0, 1) if command.startswith("halfstep plan") else (0,)
            hold(process.returncode in fine, f"{command}: {complaint.strip()}")
            self.done[command] = printed, time.monotonic() - start
        return self.done[command]


def run(what, paper, commands, function, execute):
    """The claim's row, and whether nothing failed."""
    seconds, ours, fine = 0.0, "–", True
    try:
        printed = []
        for command in commands:
            text, took = execute(command)
            printed.append(text)
            seconds += took
        ours, status = function(*printed)
    except NotThere as reason:
        status = str(reason)
    except (DoesNotHold, OSError, LookupError, ValueError, AttributeError, StopIteration) as reason:
        status, fine = f"**does not hold**: {reason}", False
    print(f"{ours}; {status}", file=sys.stderr)
    listed = "<br>".join(f"`{command}`" for command in commands) or "–"
    took = f"{seconds:.1f}" if commands else "–"
    return f"| {what} | {listed} | {took} | {paper} | {ours} | {status} |", fine


def write(table, page):
    """Between the markers, whole or not at all."""
    text = page.read_text()
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    partial = page.with_suffix(".md.partial")
    partial.write_text(f"{text[:begin]}\n{table}\n{text[end:]}")
    partial.replace(page)


def main(claims=CLAIMS, page=ROOT / "notebooks-data/reproduction.md"):
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    load, start = os.getloadavg()[0], time.monotonic()
    version = subprocess.run(["git", "describe", "--always"], cwd=ROOT, text=True,
                             capture_output=True).stdout.strip() or "no commit"
    results = []
    with tempfile.TemporaryDirectory() as cache:
        execute = Commands(cache)
        for number, entry in enumerate(claims, 1):
            print(f"{number:2}/{len(claims)}  {entry[0]} … ", end="", file=sys.stderr, flush=True)
            results.append(run(*entry, execute))
    write("\n".join([
        "", "| figure or claim | command | time [s] | paper | ours | status |",
        "|---|---|---|---|---|---|", *(row for row, _ in results), "",
        f"*{version}, {os.cpu_count()} cores at a load of {load:.1f} when it began; "
        f"{time.monotonic() - start:.0f} s in all.*", ""]), page)
    failed = sum(not fine for _, fine in results)
    print(f"{page.name}: {len(results)} rows, {failed} that do not hold", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        print("\nstopped; the table is as it was", file=sys.stderr)
        sys.exit(130)
