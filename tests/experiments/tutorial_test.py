#!/usr/bin/env python3
"""Does what experiments/tutorial.md says: tutorial_test.py HALFSTEP

Files of its yaml and python blocks are written under the name of their first line. Blocks of sh are
run in one folder; the lines of the text block behind one must be in what it prints, in any order;
… stands for any text. Blocks of other kinds are for reading. What needs the Python module is left
out when that is not built.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HALFSTEP = pathlib.Path(sys.argv[1]).resolve()


def blocks(text):
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, re.M | re.S)


def missing(expected, printed):
    """The expected lines that no printed line matches."""
    def told(line):
        pattern = ".*".join(re.escape(part) for part in line.split("…"))
        return re.search(f"^{pattern}$", printed, re.M)
    return [line for line in expected.splitlines() if not told(line)]


def main():
    build = HALFSTEP.parents[1]
    text = (ROOT / "experiments/tutorial.md").read_text(encoding="utf-8")
    faults, ran, left_out = [], 0, 0
    assert missing("a … c\nd", "a b c\ne") == ["d"], "it can fail"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        tools, work = folder / "tools", folder / "work"
        tools.mkdir()
        work.mkdir()
        (tools / "halfstep").symlink_to(HALFSTEP)
        (tools / "python3").symlink_to(sys.executable)
        environment = os.environ | {
            "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}", "SHARE": f"{build}/share/halfstep",
            "HALFSTEP_DATA": f"{build}/share/halfstep", "PYTHONPATH": f"{build}/python",
            "HOME": name}
        module = subprocess.run([sys.executable, "-c", "import halfstep"], env=environment,
                                capture_output=True).returncode == 0
        wanted = None  # what the command before printed
        for kind, body in blocks(text):
            if kind in ("yaml", "python"):
                (work / re.match(r"# (\S+)\n", body)[1]).write_text(body, encoding="utf-8")
            elif kind == "sh" and ("python3" not in body or module):
                done = subprocess.run(["sh", "-eu", "-c", body], cwd=work, env=environment,
                                      text=True, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT)
                wanted, ran = done.stdout, ran + 1
                if done.returncode:
                    faults.append(f"{body}exit status {done.returncode}\n{done.stdout}")
            elif kind == "sh":
                wanted, left_out = None, left_out + 1
            elif kind == "text" and wanted is not None:
                faults += [f"not told: {line}\n{wanted}" for line in missing(body, wanted)]
                wanted = None
    print("\n".join(faults) or f"{ran} blocks run, {left_out} left out")
    return 1 if faults or ran < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
