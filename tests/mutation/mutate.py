#!/usr/bin/env python3
"""Puts wrong lines into what soundness rests on, one at a time, and tells which tests notice them.

The lists (*.mutants, format: README.md) say where, what and which tests. Every listed file is
copied once with all its wrong lines behind a switch, `kMutant… == n ? wrong : right`, compiled by
the commands of the build tree, as part of its batch where the tree has batches, and linked before
the libraries into the test executables; then the tests run once for each n. Standard library only;
needs a build tree of Ninja whose tests are built.
"""

import argparse
import collections
import concurrent.futures
import csv
import json
import os
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


class Mutant:
    """A wrong line: `new` in place of `old`, looked for by `tests` [(executable, filter)]."""

    def __init__(self, place, file, tests):
        self.place, self.file, self.tests = place, file, list(tests)
        self.old, self.new, self.why = [], [], []
        self.number, self.line, self.span = 0, 0, (0, 0)  # the number counts within the file

    @property
    def name(self):
        return f"{pathlib.Path(self.file).stem}.{self.number}"

    def text(self, lines):
        return "\n".join(lines).strip()


def read_list(path):
    """The mutants of one list; stops at what it cannot read."""
    mutants, file, tests, fresh, mutant = [], None, [], True, None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        place = f"{path.name}:{number}"
        word, _, rest = line.partition(" ")
        if word == "file":
            file, tests, fresh, mutant = rest.strip(), [], True, None
        elif word == "tests":
            if not fresh:
                tests, fresh = [], True
            executable, _, test_filter = rest.strip().partition(" ")
            tests.append((executable, test_filter.strip()))
            mutant = None
        elif word == "-":
            if mutant is None or mutant.new or mutant.why:
                if not tests:
                    sys.exit(f"{place}: no tests named before it")
                mutant = Mutant(place, file, tests)
                mutants.append(mutant)
                fresh = False
            mutant.old.append(rest)
        elif word in ("+", "?") and mutant is not None:
            (mutant.new if word == "+" else mutant.why).append(rest)
        elif line.strip() and not line.startswith("#"):
            sys.exit(f"{place}: neither file, tests, -, +, ? nor a comment")
        elif not line.strip():
            mutant = None
    return mutants


def locate(mutant, source):
    """Finds the old text, white space apart; exactly one place is right."""
    parts = mutant.text(mutant.old).split("@@")
    before, old, after = parts if len(parts) == 3 else ("", parts[0], "")

    def pattern(text):
        return r"\s+".join(re.escape(word) for word in text.split())

    expression = pattern(before) + r"\s*(" + pattern(old) + r")\s*" + pattern(after)
    found = [m.span(1) for m in re.finditer(expression, source)]
    if len(found) != 1:
        return f"{mutant.place}: {len(found)} places in {mutant.file}: {mutant.text(mutant.old)}"
    mutant.span = found[0]
    mutant.line = source.count("\n", 0, mutant.span[0]) + 1
    return None


def rewritten(file, source, mutants):
    """The file with every mutant behind its switch; spans must nest or be apart."""
    chosen = "kMutantOf_" + re.sub(r"\W", "_", file)  # files of one batch have one each

    def emit(begin, end, inside):
        out, at = [], begin
        while inside:
            first = inside[0]
            a, b = first.span
            children = [m for m in inside[1:] if m.span[0] < b]
            inside = [m for m in inside[1:] if m.span[0] >= b]
            for child in children:
                if child.span[1] > b:
                    sys.exit(f"{child.place} and {first.place} overlap, and neither holds the other")
            out.append(source[at:a])
            right, wrong = emit(a, b, children), first.text(first.new)
            if source[b - 1] in ";}":
                out.append(f"if ({chosen} == {first.number}) {{ {wrong} }} else {{ {right} }}")
            else:
                out.append(f"({chosen} == {first.number} ? ({wrong}) : ({right}))")
            at = b
        return "".join(out) + source[at:end]

    ordered = sorted(mutants, key=lambda m: (m.span[0], -m.span[1]))
    switch = f'inline const int {chosen} = HalfstepMutantOf("{file}");'
    guard = "#pragma once\n" if file.endswith(".h") else ""
    return (f'{guard}#include "halfstep_mutant.h"\n{switch}\n#line 1\n'
            + emit(0, len(source), ordered))


class Unit:
    """What one compile command compiles: a source, or a batch of them."""

    def __init__(self, command):
        self.words, self.directory = shlex.split(command["command"]), command["directory"]
        self.source = pathlib.Path(command["file"])
        self.object = self.words[self.words.index("-o") + 1]  # in the build tree
        self.owner = re.search(r"CMakeFiles/([^/]+)\.dir/", self.object).group(1)  # its target
        self.files = [os.path.relpath(self.source, ROOT)]
        self.is_batch = self.source.parent.name == "Unity"
        if self.is_batch:
            included = re.findall(r'#include "([^"]+)"', self.source.read_text())
            self.files = [os.path.relpath(file, ROOT) for file in included]


class Build:
    """Compiles rewritten files and links them into executables beside a build tree."""

    def __init__(self, tree, place):
        self.tree, self.place = tree, place
        commands = json.loads((tree / "compile_commands.json").read_text())
        self.units = [Unit(c) for c in commands if c["file"].endswith((".cc", "_cxx.cxx"))]
        self.objects = {}  # object in the tree: (object beside it, the target that it is of)

    def units_of(self, files, targets):
        """The units of these targets that hold these sources or read these headers."""
        headers = {file for file in files if file.endswith(".h")}
        for file in files - headers - {file for unit in self.units for file in unit.files}:
            sys.exit(f"{file} is compiled by no command of {self.tree}")
        readers = set()
        if headers:
            text = subprocess.run(["ninja", "-C", str(self.tree), "-t", "deps"],
                                  capture_output=True, text=True, check=True).stdout
            for block in text.split("\n\n"):
                name, _, read = block.partition(":")
                paths = {os.path.relpath(self.tree / line.strip(), ROOT)
                         for line in read.splitlines()[1:]}
                if paths & headers:
                    readers.add(name.strip())
        return [unit for unit in self.units if unit.owner in targets and
                (files.intersection(unit.files) or unit.object in readers)]

    def write(self, texts):
        """Lays the rewritten files down; those that have not changed stay as they are."""
        for file, text in texts.items():
            copy = self.place / file
            copy.parent.mkdir(parents=True, exist_ok=True)
            if not copy.exists() or copy.read_text() != text:
                copy.write_text(text)

    def compile(self, unit, texts):
        copy = self.place / unit.files[0]
        if unit.is_batch or unit.files[0] not in texts:  # a batch, or one that reads a header
            text = f'#include "{unit.source}"\n'
            if unit.is_batch:
                text = unit.source.read_text()
                for file in unit.files:
                    if file in texts:
                        text = text.replace(f'"{ROOT / file}"', f'"{self.place / file}"')
            copy = self.place / "units" / unit.object
            copy = copy.with_suffix("")  # its name, without .o
            copy.parent.mkdir(parents=True, exist_ok=True)
            if not copy.exists() or copy.read_text() != text:
                copy.write_text(text)
        output = pathlib.Path(f"{copy}.o")
        self.objects[unit.object] = (output, unit.owner)
        read = [self.place / f for f in texts if f in unit.files or f.endswith(".h")]
        sources = [copy, self.tree / unit.object, *read]
        if output.exists() and output.stat().st_mtime > max(s.stat().st_mtime for s in sources):
            return
        words = list(unit.words)
        words[words.index("-o") + 1] = str(output)
        words[words.index("-c") + 1] = str(copy)
        words[1:1] = [f"-I{self.place}"]  # rewritten headers before the right ones
        words += ["-w", "-O1", f"-I{HERE}"]  # compiled once, run for seconds
        done = subprocess.run(words, cwd=unit.directory, capture_output=True, text=True)
        if done.returncode != 0:
            output.unlink(missing_ok=True)
            sys.exit(f"{unit.source} does not compile with mutants:\n{done.stderr[:4000]}")

    def link_words(self, target):
        lines = subprocess.run(["ninja", "-C", str(self.tree), "-t", "commands", target],
                               capture_output=True, text=True, check=True).stdout.splitlines()
        links = [line for line in lines if f" -o {target} " in line]
        return shlex.split(links[-1].split("&&")[1])

    def targets_of(self, target):
        """The CMake targets whose objects are linked into an executable, itself included."""
        archives = [os.path.basename(w) for w in self.link_words(target) if w.endswith(".a")]
        return {re.sub(r"^lib|\.a$", "", a) for a in archives} | {os.path.basename(target)}

    def link(self, target):
        """The executable `target` with all rewritten objects of what it links."""
        words, linked = self.link_words(target), self.targets_of(target)
        own = {place: str(output) for place, (output, _) in self.objects.items()}
        objects = [own[place] for place, (_, owner) in self.objects.items()
                   if owner in linked and place not in words]
        words = [own.get(word, word) for word in words]
        first = next(i for i, word in enumerate(words) if word.endswith(".a"))
        output = self.place / os.path.basename(target)
        words[words.index("-o") + 1] = str(output)
        # Where archives are linked whole, what comes first counts.
        words[first:first] = ["-Wl,-z,muldefs", *objects]
        subprocess.run(words, cwd=self.tree, check=True)
        return output


Outcome = collections.namedtuple("Outcome", "noticed how test seconds")


def run(executable, test_filter, mutant, limit, command):
    """Runs tests under one mutant ("": none) up to the first that fails."""
    environment = dict(os.environ, HALFSTEP_MUTANT=mutant, HALFSTEP_COMMAND=str(command))
    words = [str(executable), f"--gtest_filter={test_filter}", "--gtest_break_on_failure"]
    begin = time.monotonic()
    process = subprocess.Popen(words, env=environment, text=True, errors="replace",
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                               start_new_session=True)
    try:
        text, _ = process.communicate(timeout=limit)
        how = "fails" if ": Failure" in text else "ends by a signal or a throw"
        noticed = process.returncode != 0
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)  # the test and what it started
        text, _ = process.communicate()
        noticed, how = True, "hangs"
    begun = re.findall(r"\[ RUN      \] (\S+)", text)
    if not begun and not noticed:
        sys.exit(f"{executable.name}: no test of the filter {test_filter}")
    return Outcome(noticed, how, begun[-1] if begun else "", time.monotonic() - begin)


def try_mutant(mutant, executables, expected, command):
    seconds = 0.0
    for name, test_filter in mutant.tests:
        limit = 10.0 + 6.0 * expected[name, test_filter]
        outcome = run(executables[name], test_filter, f"{mutant.file}:{mutant.number}", limit,
                      command)
        seconds += outcome.seconds
        if outcome.noticed:
            return outcome._replace(seconds=seconds)
    return Outcome(False, "", "", seconds)


COLUMNS = ["mutant", "where", "line", "wrong_line", "noticed_by"]


def rows(mutants, outcomes):
    """One row a mutant, of COLUMNS; white space of the lines is one blank."""
    for m in mutants:
        o = outcomes[m]
        by = f"{o.test}" + ("" if o.how == "fails" else f" ({o.how})")
        if not o.noticed:
            by = "survives: " + (m.text(m.why) or "not explained")
        texts = [m.text(m.old).replace("@@", ""), m.text(m.new), by]
        yield [m.name, f"{m.file}:{m.line}", *(" ".join(text.split()) for text in texts)]


def shares(mutants, outcomes):
    """How many are noticed, by folder, as a table in Markdown."""
    counts = collections.defaultdict(lambda: [0, 0, 0])
    for m in mutants:
        for key in (m.file.rpartition("/")[0], "all"):
            counts[key][0] += 1
            counts[key][1] += outcomes[m].noticed
            counts[key][2] += not outcomes[m].noticed and bool(m.why)
    lines = ["| folder | mutants | noticed | share | survivors explained |",
             "|---|---|---|---|---|"]
    for folder in sorted(counts, key=lambda f: (f == "all", f)):
        count, noticed, explained = counts[folder]
        lines.append(f"| {folder} | {count} | {noticed} | {100 * noticed / count:.1f} % | "
                     f"{explained} of {count - noticed} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="tree of Ninja")
    parser.add_argument("--only", default="", help="regular expression on names and files")
    parser.add_argument("--list", action="store_true", help="check and print the list, run nothing")
    parser.add_argument("--out", help="a CSV with a row for each mutant")
    parser.add_argument("--jobs", type=int, default=1, help="compilations and mutants at a time")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    mutants = [m for path in sorted(HERE.glob("*.mutants")) for m in read_list(path)]
    by_file, complaints = collections.defaultdict(list), []
    for mutant in mutants:
        by_file[mutant.file].append(mutant)
        mutant.number = len(by_file[mutant.file])
    sources = {file: (ROOT / file).read_text() for file in by_file}
    complaints = [c for c in (locate(m, sources[m.file]) for m in mutants) if c]
    if complaints:
        sys.exit("\n".join(complaints))
    chosen = [m for m in mutants if re.search(options.only, f"{m.name} {m.file}")]
    if options.list:
        print("\n".join(f"{m.name:28} {m.file}:{m.line}" for m in chosen))
        print(f"{len(chosen)} mutants")
        return

    tree = pathlib.Path(options.build).resolve()
    files = {m.file for m in chosen}
    headers = {file for file in by_file if file.endswith(".h")}
    if files & headers:  # all or none, so that what was compiled with them stays right
        files |= headers
    build = Build(tree, tree / "mutation" / ("headers" if files & headers else "sources"))
    texts = {file: rewritten(file, sources[file], by_file[file]) for file in files}
    names = {name for m in chosen for name, _ in m.tests}
    programs = {name: f"tests/{name}_tests" for name in names}
    if names & {"experiments", "verify"}:
        programs["command"] = "experiments/halfstep"
    targets = set().union(*(build.targets_of(program) for program in programs.values()))
    build.write(texts)
    units = build.units_of(files, targets)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda unit: build.compile(unit, texts), units))
    executables = {name: build.link(program) for name, program in programs.items()}
    command = executables.get("command", "")
    expected = {}
    for name, test_filter in sorted({test for m in chosen for test in m.tests}):
        outcome = run(executables[name], test_filter, "", 600.0, command)
        if outcome.noticed:
            sys.exit(f"without a mutant {outcome.test} {outcome.how}: {name} {test_filter}")
        expected[name, test_filter] = outcome.seconds
    print(f"{sum(expected.values()):.0f} s without a mutant", file=sys.stderr)

    def one(mutant):
        outcome = try_mutant(mutant, executables, expected, command)
        print(f"{mutant.name:28} {outcome.seconds:6.1f} s  "
              f"{outcome.test + ' ' + outcome.how if outcome.noticed else 'SURVIVES'}",
              file=sys.stderr, flush=True)
        return outcome

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        outcomes = dict(zip(chosen, pool.map(one, chosen)))
    print(shares(chosen, outcomes))
    if options.out:
        with open(options.out, "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows(chosen, outcomes)])
    lost = [m for m in chosen if not outcomes[m].noticed and not m.why]
    if lost:
        sys.exit("not noticed and not explained: " + ", ".join(m.name for m in lost))


if __name__ == "__main__":
    main()
