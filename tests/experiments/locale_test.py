#!/usr/bin/env python3
"""Every command writes the same files in a program with a German locale: locale_test.py HALFSTEP LIB

LIB is preloaded and sets the locale of the environment, as graphical programs do before they call
a library (host_locale.cc). Each command runs twice, in C and in de_DE.UTF-8, which is generated
here; the files must be the same byte for byte. Of those that hold times that passed, and of what is
printed, all but the numbers must be, and no number may have a comma.
"""
import ctypes.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HALFSTEP, HOST = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
CONFIGS = ROOT / "experiments/configs"
TIMED = re.compile(r"(manifest\.json|iterates\.csv|summary\.csv|timings\.csv|report\.html|"
                   r"compared/.*|bar\.html)$")
# Of what `compare` makes of times there are more rows or fewer.
BY_THE_CLOCK = ("compared/performance_profile.csv", "compared/report.html")
PLAN = """robot: hrp2
scene: none
goal: {x_m: 0.6, y_m: 0.1, radius_m: 0.05}
step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21, spacing_m: 0.2, yaws_rad: [0]}
swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}
planner: {unimproved_nodes: 0, max_nodes: 2000}
"""
EPISODE = """name: beside
robot: hrp2
scene: beside.yaml
goal: {x_m: 0.4, y_m: 0.1, radius_m: 0.05}
half_step: {duration_s: 1.5, zmp_shift_s: 0.075}
smoothing: {margins: {double_support_s: 0.075}}
step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21, spacing_m: 0.2, yaws_rad: [0]}
swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}
planner: {unimproved_nodes: 0, max_nodes: 2000}
output: {period_s: 0.01}
live:
  horizon_s: 4
  sensing: {rests_after_s: 0.5}
  script:
    - {at_s: 0.3, do: jump, obstacle: bar, xyz: [0.4, 0.95, 0.5]}
    - {at_s: 1.5, do: goal, goal_m: [0.6, 0.1]}
"""
SCENE = """name: beside
obstacles:
  - name: bar
    box: {size_m: [0.1, 0.1, 1.0]}
    pose: {xyz: [0.4, 1.5, 0.5]}
    motion: {speed_m_s: 0.05}
"""
SWEEP = f"""config: {CONFIGS}/fig3_two_half_steps.yaml
vary:
  - {{key: output.period_s, values: [0.1, 0.25]}}
  - {{key: smoothing.methods, values: ['[dichotomy]']}}
"""
PYTHON = """
import halfstep as hs
experiment = hs.Experiment("plan.yaml").plan().experiment
result = experiment.smooth("dichotomy")
result.walk.certify()
open("python.txt", "w").write(repr(result.duration))
"""


def commands():
    walk = [f"{CONFIGS}/bar_8cm.yaml", "--set", "output.period_s=0.025", "--set"]
    yield from (["init", "walk", "--goal", "1.5", "0.25"], ["explain-config", "--robot", "wren"],
                ["explain-config", "--json-schema"], ["list", "methods"], ["list", "robots", "--json"],
                ["draw", "cylinders", "--count", "5"], ["draw", "random_room"],
                ["draw", "walks", "--count", "2", "--out", "drawn"],
                ["robot", f"{ROOT}/wpg/robots/wren.urdf", "--width", "0.0951",
                 "--package", f"wren_bodies={ROOT}/wpg/robots/wren", "--out", "guess.yaml"],
                ["bake", "plan.yaml"], ["plan", "plan.yaml"], ["plan", "plan.yaml", "--json"],
                ["list", "half-steps", "plan.yaml"],
                ["run", f"{CONFIGS}/fig3_two_half_steps.yaml", "--out", "fig3", "--set",
                 "smoothing.methods=[dichotomy, dichotomy/uniform, reference/lipm, ipopt, "
                 "nlopt/ccsaq, halfstep/sqp]", "--set", "smoothing.optimizer.heights=true",
                 "--set", "smoothing.optimizer.rounds=1", "--set", "smoothing.optimizer.effort=0.5"],
                ["run", *walk, "smoothing.methods=[dichotomy]", "--set",
                 "smoothing.margins.clearance_m=0.0045", "--out", "bar"],
                ["smooth", "fig3", "--method", "dichotomy/uniform", "--given",
                 "fig3/dichotomy/overlaps.csv", "--out", "smoothed"],
                ["certify", "bar"], ["verify", "bar", "--tolerance", "0.0015"],
                ["compare", "bar", "fig3", "--out", "compared"],
                ["sweep", "sweep.yaml", "--jobs", "1", "--out", "swept"],
                ["report", "bar", "--out", "bar.html"],
                ["live", "episode.yaml", "--out", "episode"],
                ["verify", "episode"])
    for form in ("csv", "npz", "hrpsys", "joint_trajectory", "mjcf"):
        yield ["export", "bar", "--format", form, "--period", "0.05", "--out", f"bar-{form}"]
    yield ["replay", "fig3", "--method", "raw"]


def shape(text):
    """A text without what differs from run to run: hashes, and the size of numbers."""
    text = re.sub(rb"\b[0-9a-f]{64}\b", b"HASH", text)
    return re.sub(rb"[-+]?\d+(\.\d+)?(e[-+]?\d+)?|\bnan\b|-?\binf\b", b"#", text)


def done_in(folder, locale, environment):
    """Runs everything; what was printed, by command."""
    folder.mkdir()
    (folder / "plan.yaml").write_text(PLAN, encoding="utf-8")
    (folder / "sweep.yaml").write_text(SWEEP, encoding="utf-8")
    (folder / "episode.yaml").write_text(EPISODE, encoding="utf-8")
    (folder / "beside.yaml").write_text(SCENE, encoding="utf-8")
    environment = environment | {"LC_ALL": locale, "LANG": locale, "LD_PRELOAD": HOST}
    build = pathlib.Path(HALFSTEP).parents[1]
    python = [sys.executable, "-c", PYTHON]
    lines = [[HALFSTEP, *line] for line in commands()]
    if (build / "python").is_dir():
        lines.append(python)
    told = {}
    for line in lines:
        done = subprocess.run(line, cwd=folder, env=environment, capture_output=True)
        name = " ".join(line[1:]).replace(str(ROOT), "")
        texts = [shape(text.replace(os.fsencode(folder), b"FOLDER"))
                 for text in (done.stdout, done.stderr) if line[1] != "compare"]
        told[name] = (done.returncode, *texts)
    return told


def files_of(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def make_locale(folder):
    """Whether de_DE.UTF-8 is there now."""
    if shutil.which("localedef") is None:
        return False
    folder.mkdir()
    subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", folder / "de_DE.UTF-8"],
                   capture_output=True)
    return (folder / "de_DE.UTF-8").is_dir()


def comma_of(environment):
    """How the C library writes ½ in the host program."""
    code = ("import ctypes; text = ctypes.create_string_buffer(9); "
            "ctypes.CDLL(None).snprintf(text, 9, b'%.1f', ctypes.c_double(.5)); print(text.value)")
    return subprocess.run([sys.executable, "-c", code], env=environment | {"LD_PRELOAD": HOST},
                          capture_output=True, text=True).stdout.strip()


def main():
    assert shape(b"wall 0.52 s") != shape(b"wall 0,52 s"), "it can fail"
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        if not make_locale(place / "locales"):
            print("skipped: localedef cannot make de_DE.UTF-8 (Debian: the package `locales`)")
            return 77
        build = pathlib.Path(HALFSTEP).parents[1]
        environment = {key: value for key, value in os.environ.items()
                       if not key.startswith("LC_")} | {
            "LOCPATH": f"{place}/locales", "HOME": name, "PYTHONPATH": f"{build}/python"}
        german = "de_DE.UTF-8"
        comma = comma_of(environment | {"LC_ALL": german})
        assert comma == "b'0,5'", f"the host program is not German: {comma}"
        told = [done_in(place / folder / "work", locale, environment)
                for folder, locale in ((".c", "C"), (".de", german)) if not (place / folder).mkdir()]
        files = [files_of(place / folder / "work") for folder in (".c", ".de")]
        faults = [f"{line}:\n  C      {one}\n  German {told[1][line]}"
                  for line, one in told[0].items() if one != told[1][line]]
        faults += [f"only one of them writes {name}" for name in files[0].keys() ^ files[1].keys()]
        for file in files[0].keys() & files[1].keys():
            one, other = files[0][file], files[1][file]
            if TIMED.search(file):
                one, other = shape(one), shape(other)
            if one != other and file not in BY_THE_CLOCK:
                at = next((i for i, pair in enumerate(zip(one, other)) if pair[0] != pair[1]),
                          min(len(one), len(other)))
                begin = max(0, at - 60)
                faults.append(f"{file}, byte {at}:\n  C      {one[begin:at + 60]}\n"
                              f"  German {other[begin:at + 60]}")
        # What is built without reports or MuJoCo says so.
        failed = [line for line, one in told[0].items() if one[0] != 0]
        faults += [f"{line}: {told[0][line]}" for line in failed
                   if not line.startswith(("replay", "report"))]
        print(f"{len(told[0])} commands, {len(files[0])} files; without: {failed}")
        if len(files[0]) < 100:
            faults.append("fewer files than commands write")
        for fault in faults:
            print(fault)
        return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
