#!/usr/bin/env python3
"""Fails when a page's table is not what the schema has, and when a text names a family, a column or
a key that is not there.

schema_test.py SCHEMA. Both checks are first shown that they notice. Of texts (Markdown, comments of
configs, notebooks, scripts of figures, docstrings of Python) this is looked at:
- words in backticks with an underscore: of the schema, or of a file, or anywhere in the sources but
  those that are other implementations, or hold what is wrong;
- in backticks after or before the word "family", "column", "margin" or "key": of the schema;
- paths of keys in backticks, and keys after --set: of the schema;
- texts in quotes in notebooks and scripts of figures that end in a unit: columns, as the first.
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
TEXTS = (".md", ".ipynb", ".yaml", ".py", ".sh", ".gp")
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


def words_of_sources():
    """Every word of the product's code, and the names of its files."""
    words = set()
    for name in files(SOURCES, (*TEXT_TOPS, "tests")):
        if name.startswith(NO_SOURCES):
            continue
        text = (ROOT / name).read_text(encoding="utf-8", errors="replace")
        if name.startswith("notebooks-data/"):  # columns are not there because a figure names them
            text = re.sub(r"\"[^\"\n]*\"|'[^'\n]*'", "", text)
        words.update(re.findall(r"[A-Za-z][A-Za-z_0-9]*", text))
    for name in files(("",), (*TEXT_TOPS, "tests")):
        words.update(part.split(".")[0] for part in pathlib.Path(name).parts)
    return words


class Names:
    def __init__(self, schema, of_sources):
        families = schema["parameters"] + schema["margins"]
        self.keys = {row["name"] for rows in schema["keys"].values() for row in rows}
        self.tops = {row["name"] for row in schema["keys"]["episode"] if "." not in row["name"]}
        self.of_schema = {field["name"] for table in schema["tables"].values() for field in table}
        self.of_schema |= {family["name"] for family in families} | self.keys | OF_PROGRAMS | {
            family["values"] for family in schema["parameters"]}
        self.of_schema |= {part for key in self.keys for part in key.split(".")}
        self.known = self.of_schema | of_sources | FORMER

    def is_key(self, path):
        path = re.sub(r"\.\d+(?=\.|$)", ".N", path)
        return path in self.keys or any(
            path == own or path.startswith(f"{own}.") for own in OF_PROGRAMS | FORMER)

    def wrong_in_line(self, line, of_figures):
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
        if of_figures:
            wrong += [word for word in re.findall(rf"[\"']({WITH_UNIT})[\"']", line)
                      if word not in self.known]
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
                      for word in names.wrong_in_line(line, name.startswith("notebooks-data/"))]
    return found if lines > 5000 else [f"only {lines} lines of texts were found"]


def controls_of_names(names):
    """Lines with something wrong, each beside the same that is right."""
    pairs = [("the `via_laterall` of a step", "the `via_lateral` of a step"),
             ("what `foot_delays, zmp_shiftt` are", "what `foot_delays, zmp_shifts` are"),
             ("the family `self`", "the family `zmp`"), ("the `speed` column", "the `lambda` column"),
             ("`smoothing.margins.zmp_robot` is", "`smoothing.margins.zmp_robot_m` is"),
             ("`footsteps.3.z_m` is", "`footsteps.3.x_m` is"),
             ("run X --set half_step.duration=2", "run X --set half_step.duration_s=2"),
             ('column("zmp_margin_mm_s")', 'column("zmp_margin_m")')]
    told = []
    for bad, good in pairs:
        if not names.wrong_in_line(bad, True):
            told.append(f"not noticed: {bad}")
        told += [f"{good}: `{word}` is there" for word in names.wrong_in_line(good, True)]
    return told


def controls_of_tables(schema):
    """Pages with one thing changed."""
    smoothing, runs, robots = (
        (ROOT / page).read_text(encoding="utf-8")
        for page in ("smoothing/README.md", "experiments/README.md", "wpg/README.md"))
    changes = [(smoothing, "| `via_lateral` | m |", "| `via_lateral` | s |"),
               (smoothing, "| `foot_ramp` |", "| `foot_rampe` |"),
               (smoothing, "| m | 0.01 | 0.005 |", "| m | 0.01 | 0.006 |"),
               (smoothing, "<!-- schema: margins -->", "<!-- schema: margin -->"),
               (runs, "| `overlap_s` | Δ |\n", ""), (runs, "`left_foot_x_m` …", "`left_foot_y_m` …"),
               (runs, "| `lambda` |", "| `lambda, lambda` |"), (runs, "`valid_until_s`", "`until_s`"),
               (runs, "| `seed` | integer |", "| `seed` | number |"),
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
    return told


def main():
    schema = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    names = Names(schema, words_of_sources())
    told = controls_of_names(names) + controls_of_tables(schema) + wrong_texts(names)
    print("\n".join(told))
    sys.argv[1:] = ["--check", sys.argv[1]]
    return 1 if page_tables.main() != 0 or told else 0


if __name__ == "__main__":
    sys.exit(main())
