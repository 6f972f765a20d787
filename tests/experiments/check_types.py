"""Loads every CSV below a folder with pandas as it comes and compares its columns' types with the
schema beside it or, of one of many, in the folder above. Exit status 1 and a line for each difference; without rows there are no types."""
import json
import pathlib
import sys

import pandas

DTYPES = {"integer": "int64", "number": "float64", "boolean": "bool", "string": "object"}

wrong = files = 0
for path in sorted(pathlib.Path(sys.argv[1]).rglob("*.csv")):
    schema = path.with_suffix(".schema.json")
    if not schema.exists():
        schema = schema.parent.parent / schema.name
    fields = json.loads(schema.read_text())["fields"]
    table = pandas.read_csv(path)
    files += 1
    if list(table.columns) != [field["name"] for field in fields]:
        print(f"{path}: its columns are not the schema's")
        wrong += 1
    for field in fields if len(table) > 0 else []:
        dtype = str(table[field["name"]].dtype)
        if dtype != DTYPES[field["type"]]:
            print(f"{path}: {field['name']} is {dtype}, the schema says {field['type']}")
            wrong += 1
print(f"{files} files")
sys.exit(1 if wrong > 0 else 0)
