#!/usr/bin/env python3
"""Brings the tables of Markdown pages in line with the schema.

page_tables.py SCHEMA [PAGE…]     rewrites the pages (all of the project); exit status 1 when
                                  something is left to write by hand, which is told
page_tables.py --check SCHEMA …   writes nothing; exit status 1 when a page would change, too

A table that follows a line <!-- schema: WHAT --> is one of:
  parameters, margins    a row a family. Cells below `unit`, `valid`, `scale`, `raised` and
                         `demanded by default` are written here, others are the page's own
  keys of FILE           a row a key, all written here if the header is KEY_HEADER, those of a map
                         with the keys of an earlier one left out; else the page's own words of
                         every key, ` .b` after `a`: a.b
  columns of TABLE       the page's own words of every column; one row may be of several, `a, b` or
                         `a` … `d`
  tables of FOLDER       the same, a row a table: every column of it is in the second cell
"""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MARK = re.compile(r"<!-- schema: (.+?) -->")
KEY_HEADER = ["key", "type [unit], valid", "default", "meaning"]


def cells_of(row):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", row)[1:-1]]


def row_of(cells):
    return "| " + " | ".join(cells) + " |"


def number(value):
    return f"{value:g}".replace("-", "−")


def valid(family):
    least, most = number(family["least"]), family["most"]
    if family["least_itself"]:
        return f"≥ {least}" if most is None else f"{least} … {number(most)}"
    return f"> {least}" + ("" if most is None else f", ≤ {number(most)}")


def rows_of_families(families):
    """Of each family, its cells by header."""
    rows = {}
    for family in families:
        cells = rows[family["name"]] = {"family": f"`{family['name']}`"}
        cells["unit"] = "–" if family["unit"] in ("", "1") else family["unit"]
        if "least" in family:
            cells["valid"] = valid(family)
        else:
            cells["scale"] = number(family["scale"])
            cells["raised"] = "yes" if family["raised"] else ""
            cells["demanded by default"] = "`none`" if family["demanded"] is None else (
                number(family["demanded"]) + (", or `none`" if family["may_be_none"] else ""))
    return rows


def rewritten(rows, header, table):
    """The table's rows, one for each of `rows`, and complaints: own words stay with their family,
    and those of a new one are to be written."""
    own = {cells_of(row)[0].strip("`"): dict(zip(header, cells_of(row))) for row in table}
    after, told = [], []
    for name, cells in rows.items():
        after.append(row_of([cells.get(head, own.get(name, {}).get(head, "")) for head in header]))
        if not any(own.get(name, {}).get(head) for head in header if head not in cells):
            told.append(f"`{name}` has no words")
    return after, told


def named(cell, all_names):
    """What a cell names: `a, b`, `a`, `b`, or `a` … `d` of `all_names`."""
    names = [name for code in re.findall(r"`([^`]+)`", cell) for name in code.split(", ")]
    for first, last in re.findall(r"`([^`]+)` … `([^`]+)`", cell):
        first, last = first.split(", ")[-1], last.split(", ")[0]
        if first in all_names and last in all_names:
            names += all_names[all_names.index(first) + 1:all_names.index(last)]
    return names


def rows_of_keys(rows):
    """Those of explain-config --markdown, with what is valid beside the type; neighbours of which
    the same is told share a row."""
    merged = []
    for row in rows:
        key, kind, default, allowed, meaning = cells_of(row)
        number = re.fullmatch(r"number(?: \[(.+)\])?(| or none)", kind)
        if allowed and number:  # `0 … 1 m or none` in place of `number [m] or none, 0 … 1`
            kind = f"{allowed} {number[1]}" if number[1] else f"number, {allowed}"
            kind += number[2]
        elif allowed and kind == "text" and not allowed.startswith("`halfstep "):
            kind = allowed
        elif allowed:
            kind += f", {allowed}"
        above = key.rpartition(".")[0]
        if merged and above and merged[-1][0].rpartition(".")[0].endswith(above) and (
                merged[-1][1:] == [kind, default, meaning]):
            merged[-1][0] += f", {key}"
        else:
            merged.append([key, kind, default, meaning])
    told = {}  # what a map has, with the map's name
    left_out = set()
    for cells in merged:
        name = cells[0].strip("`")
        below = [(other[0].replace(f"`{name}.", "`"), *other[1:]) for other in merged
                 if other[0].startswith(f"`{name}.")]
        if len(below) < 2:
            continue
        first = told.setdefault(repr(below), name)
        if first != name:
            cells[3] += f"; its keys are those of `{first}`"
            left_out.update(other[0] for other in merged if other[0].startswith(f"`{name}."))
    return [row_of(cells) for cells in merged if cells[0] not in left_out]


def difference(named_here, there):
    """Complaints about names that are not there, there twice, or not named."""
    return ([f"`{name}` is not there" for name in named_here if name not in there] +
            [f"`{name}` is named twice" for name in there if named_here.count(name) > 1] +
            [f"`{name}` is missing" for name in there if name not in named_here])


def key_complaints(table, keys):
    """Of a page's own words: maps and what is in them may be told in one row."""
    here, above = [], []
    for row in table:
        cell = cells_of(row)[0]
        depth = len(re.match(r"`( *)", cell)[1])
        names = [name.strip() for name in named(cell, keys)]
        if depth:
            names = [up + name for up in above[depth - 1] for name in names]
        above[depth:] = [names]
        here += names
    bare = [key.replace(".N", "") for key in keys]
    told = [f"`{name}` is not there" for name in here if name not in bare]
    return told + [f"`{key}` is missing" for key in bare if not any(
        f"{key}.".startswith(f"{name}.") or f"{name}.".startswith(f"{key}.") for name in here)]


def column_complaints(table, columns, keys):
    """Columns of sweeps may be keys of the config."""
    here = [name for row in table for name in named(cells_of(row)[0], columns)]
    return difference([name for name in here if "." not in name or name not in keys], columns)


def table_complaints(table, tables):
    """A row a table."""
    told = difference([cells_of(row)[0].strip("`").removesuffix(".csv") for row in table],
                      list(tables))
    for row in table:
        name, words = cells_of(row)[0].strip("`").removesuffix(".csv"), named(cells_of(row)[1], [])
        for complaint in difference([word for word in words if word != "none"],
                                    tables.get(name, [])):
            told.append(f"{name}.csv: {complaint}")
    return told


def brought_in_line(what, header, table, schema):
    """The rows of a table as they should be, and what is left to write by hand."""
    columns = {name: [field["name"] for field in fields]
               for name, fields in schema["tables"].items()}
    keys = {name: [row["name"] for row in rows] for name, rows in schema["keys"].items()}
    kind, _, of = what.partition(" of ")
    if what in ("parameters", "margins"):
        return rewritten(rows_of_families(schema[what]), header, table)
    if kind == "keys" and of in keys:
        if header == KEY_HEADER:
            return rows_of_keys([row["row"] for row in schema["keys"][of]]), []
        return table, key_complaints(table, keys[of])
    if kind == "columns" and of in columns:
        return table, column_complaints(table, columns[of], keys["config"])
    folder = {name.split("/")[1]: all_columns for name, all_columns in columns.items()
              if name.split("/")[0] == of}
    if kind == "tables" and folder:
        return table, table_complaints(table, folder)
    return table, ["the schema has nothing of this name"]


def page_in_line(text, schema):
    """A page as it should be, and complaints, each with its line."""
    lines, told = text.split("\n"), []
    at = 0
    while at < len(lines):
        mark = MARK.fullmatch(lines[at])
        at += 1
        if not mark:
            continue
        first = next((i for i in range(at, len(lines)) if lines[i]), len(lines))
        end = next((i for i in range(first, len(lines)) if not lines[i].startswith("|")),
                   len(lines))
        if end < first + 2:
            told.append((at, f"{mark[1]}: no table follows"))
            continue
        rows, complaints = brought_in_line(mark[1], cells_of(lines[first]), lines[first + 2:end],
                                           schema)
        told += [(at, f"{mark[1]}: {complaint}") for complaint in complaints]
        lines[first + 2:end] = rows
    return "\n".join(lines), told


def project_pages():
    """Those that are under version control, or all of a copy without it."""
    listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True)
    names = listed.stdout.split() if listed.returncode == 0 else []
    return [ROOT / name for name in names] or [
        path for top in ("", "*/", "experiments/*/") for path in ROOT.glob(f"{top}*.md")]


def main():
    arguments = sys.argv[1:]
    check = arguments[:1] == ["--check"]
    schema_path, *names = arguments[1 if check else 0:]
    schema = json.loads(pathlib.Path(schema_path).read_text(encoding="utf-8"))
    good, tables = True, 0
    for page in [pathlib.Path(name) for name in names] or project_pages():
        text = page.read_text(encoding="utf-8")
        tables += len(MARK.findall(text))
        after, told = page_in_line(text, schema)
        for line, complaint in told:
            print(f"{page}:{line}: {complaint}")
        if after != text and not check:
            page.write_text(after, encoding="utf-8")
        elif after != text:
            print(f"{page}: its tables are not those of the schema (page_tables.py writes them)")
            good = False
        good = good and not told
    print(f"{tables} tables")
    return 0 if good and tables else 1


if __name__ == "__main__":
    sys.exit(main())
