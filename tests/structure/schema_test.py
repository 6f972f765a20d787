#!/usr/bin/env python3
"""Fails when a page's table is not what the schema has, and when a text names a family, a column or
a key that is not there.

schema_test.py SCHEMA. Both checks are first shown that they notice. Of texts (Markdown, configs,
notebooks, scripts of figures and pages, Python) this is looked at:
- words in backticks with an underscore: of the schema, or of a file, or anywhere in the sources but
  those that are other implementations, or hold what is wrong;
- in backticks after or before the word "family", "column", "margin" or "key": of the schema;
- paths of keys in backticks, and keys after --set: of the schema;
- texts in quotes in notebooks and scripts, and members in pages' scripts, that end in a unit: of the
  schema, or anywhere in the C++ sources, or columns of the data beside the notebooks.
"""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "experiments/schema"))

import page_tables  # noqa: E402

# Names that texts tell as those of older versions.
FORMER = {"limit_family", "limit_scale", "start_infeasible", "support_offset_m",
          "half_step.compensation", "live.refine"}
# What programs of their own add (experiments/examples/README.md).
OF_PROGRAMS = {"own", "smoothing.own", "smoothing.margins.own"}
WITH_UNIT = r"[a-z][a-z0-9_]*_(?:m|s|rad|deg|m_s|rad_s|n_m|m_s2|rad_s2|n)"
TEXTS = (".md", ".ipynb", ".yaml", ".py", ".sh", ".gp", ".js", ".mjs")
SCRIPTS = ("experiments/report/", "experiments/pages/", "experiments/paper/", "notebooks-data/")
SOURCES = (".cc", ".h", ".js", ".mjs", ".py", ".pyi", ".txt", ".cmake", ".yaml", ".sh", ".in", ".gp")
ABOUT = "(?:families|family|columns|column|margins|margin|keys|key)"


TEXT_TOPS = ("wpg", "planner", "opt", "smoothing", "experiments", "notebooks-data", "README.md",
             "CONTRIBUTING.md")
NO_SOURCES = ("experiments/verify/", "tests/fixtures/", "tests/fuzz/", "tests/mutation/",
              "tests/oracle/", "tests/structure/", "tests/verify/")


def files(endings, tops):
    """Those below folders at the top, or these files."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
    names = listed.stdout.split("\n") if listed.returncode == 0 else [
        str(path.relative_to(ROOT)) for path in ROOT.rglob("*")]
    return [name for name in names if name.split("/")[0] in tops and "node_modules" not in name and
            (name.endswith(endings) or "Snakefile" in name) and (ROOT / name).is_file()]


def words_of_sources(endings):
    """Every word of the code."""
    words = set()
    for name in files(endings, (*TEXT_TOPS, "tests")):
        if not name.startswith(NO_SOURCES):
            text = (ROOT / name).read_text(encoding="utf-8", errors="replace")
            words.update(re.findall(r"[A-Za-z][A-Za-z_0-9]*", text))
    return words


def headers_of_data():
    return {name for path in files((".csv",), ("notebooks-data",))
            for name in (ROOT / path).open(encoding="utf-8").readline().strip().split(",")}


def names_of_files():
    return {part.split(".")[0] for name in files(("",), (*TEXT_TOPS, "tests"))
            for part in pathlib.Path(name).parts}


class Names:
    def __init__(self, schema):
        families = schema["parameters"] + schema["margins"]
        self.keys = {row["name"] for rows in schema["keys"].values() for row in rows}
        self.tops = {row["name"] for row in schema["keys"]["episode"] if "." not in row["name"]}
        self.of_schema = {field["name"] for table in schema["tables"].values() for field in table}
        self.of_schema |= {family["name"] for family in families} | self.keys | OF_PROGRAMS | {
            family["values"] for family in schema["parameters"]}
        self.of_schema |= {part for key in self.keys for part in key.split(".")}
        self.of_data = self.of_schema | words_of_sources((".cc", ".h")) | headers_of_data()
        self.known = self.of_data | words_of_sources(SOURCES) | names_of_files() | FORMER

    def is_key(self, path):
        path = re.sub(r"\.\d+(?=\.|$)", ".N", path)
        return path in self.keys or any(
            path == own or path.startswith(f"{own}.") for own in OF_PROGRAMS | FORMER)

    def wrong_in_line(self, line, is_script):
        """What the line names and is not there."""
        wrong = []
        codes = [code for code in re.findall(r"`([^`]+)`", line)]
        for word in [word for code in codes for word in re.split(r"[,;] ", code)]:
            if re.fullmatch(r"[a-z][a-z0-9]+(_[a-z0-9]+)+", word) and word not in self.known:
                wrong.append(word)
            path = re.fullmatch(r"([a-z_]+)(\.[a-z_][a-z0-9_]*|\.\d+|\.N)+", word)
            if path and path[1] in self.tops and not self.is_key(word) and not re.search(
                    r"\.(yaml|csv|json|html|h|cc|js|py)$", word):
                wrong.append(word)
        about = re.findall(rf"\b{ABOUT} `([a-z_0-9]{{2,}})`", line)
        about += re.findall(rf"`([a-z_0-9]{{2,}})` {ABOUT}\b", line)
        wrong += [word for word in about if word not in self.of_schema | FORMER]
        wrong += [key for key in re.findall(r"--set ['\"]?([a-z_][a-z_.0-9]*)=", line)
                  if not self.is_key(key)]
        if is_script:
            wrong += [word for word in re.findall(rf"(?:[\"'`]|\.)({WITH_UNIT})\b(?!\()", line)
                      if word not in self.of_data]
        return wrong


def text_of(path):
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".ipynb":
        return text
    return "\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"])


def wrong_texts(names):
    found, lines = [], 0
    for name in files(TEXTS, TEXT_TOPS):
        for number, line in enumerate(text_of(ROOT / name).split("\n"), 1):
            lines += 1
            found += [f"{name}:{number}: `{word}` is not there"
                      for word in names.wrong_in_line(line, name.startswith(SCRIPTS))]
    return found if lines > 5000 else [f"only {lines} lines of texts were found"]


def controls_of_names(names):
    """Lines with something wrong, each beside the same that is right."""
    pairs = [("the `via_laterall` of a step", "the `via_lateral` of a step"),
             ("what `foot_delays, zmp_shiftt` are", "what `foot_delays, zmp_shifts` are"),
             ("the family `self`", "the family `zmp`"), ("the `speed` column", "the `lambda` column"),
             ("`smoothing.margins.zmp_robot` is", "`smoothing.margins.zmp_robot_m` is"),
             ("`footsteps.3.w_m` is", "`footsteps.3.x_m` is"),
             ("run X --set half_step.duration=2", "run X --set half_step.duration_s=2"),
             ('column("zmp_margins_m")', 'column("zmp_margin_m")'),
             ("row.reach_margin_m", "row.reach_m")]
    told = []
    for bad, good in pairs:
        if not names.wrong_in_line(bad, True):
            told.append(f"not noticed: {bad}")
        told += [f"{good}: `{word}` is there" for word in names.wrong_in_line(good, True)]
    return told


def controls_of_tables(schema):
    """Pages with one thing changed."""
    smoothing, runs, configs, episodes, robots = (
        (ROOT / page).read_text(encoding="utf-8")
        for page in ("smoothing/README.md", "experiments/files.md", "experiments/config.md",
                     "experiments/episodes.md", "wpg/README.md"))
    changes = [(smoothing, "| `via_lateral` | m |", "| `via_lateral` | s |"),
               (smoothing, "| `foot_ramp` |", "| `foot_rampe` |"),
               (smoothing, "| m | 0.01 | 0.005 |", "| m | 0.01 | 0.006 |"),
               (smoothing, "<!-- schema: margins -->", "<!-- schema: margin -->"),
               (runs, "`overlap_s`, ", ""), (runs, "`left_foot_x_m` …", "`left_foot_y_m` …"),
               (runs, "`lambda` |", "`lambda, lambda` |"),
               (episodes, "`valid_until_s`", "`until_s`"),
               (configs, "| `seed` | integer, ", "| `seed` | number, "),
               (robots, "` .sole_xyz`", "` .sole_xy`"), (robots, "| `hull_vertices` |", "| `hull` |")]
    told = []
    for page, old, new in changes:
        assert old in page, old
        changed = page.replace(old, new)
        after, complaints = page_tables.page_in_line(changed, schema)
        if after == changed and not complaints:
            told.append(f"not noticed: {new!r} in place of {old!r}")
    # What is written anew is the page as it was, with the page's own words.
    broken = smoothing.replace("| `via_lateral` | m |", "| `via_lateral` | s |")
    if page_tables.page_in_line(broken, schema)[0] != smoothing:
        told.append("a cell was not written as it was")
    # A row that is lost comes back, and lacks the page's words until somebody writes them.
    lost = "\n".join(row for row in smoothing.split("\n") if not row.startswith("| `lift_share`"))
    after, complaints = page_tables.page_in_line(lost, schema)
    if "| `lift_share` | – | 0.2 … 1 |" not in after or len(complaints) != 1 or (
            page_tables.page_in_line(after, schema) != (after, complaints)):
        told.append("a row without words was not told")
    return told


def main():
    schema = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    names = Names(schema)
    told = controls_of_names(names) + controls_of_tables(schema) + wrong_texts(names)
    print("\n".join(told))
    sys.argv[1:] = ["--check", sys.argv[1]]
    return 1 if page_tables.main() != 0 or told else 0


if __name__ == "__main__":
    sys.exit(main())
