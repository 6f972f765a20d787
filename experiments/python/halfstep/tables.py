"""Named columns of NumPy arrays."""

from __future__ import annotations

import csv
import io
import json
import os
import pathlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

__all__ = ["Table"]

_SUPPORT = np.array(["left", "right", "both"])


class Table(Mapping):
    """Columns of equal length: ``table["zmp_y_m"]`` is a NumPy array (n).

    A mapping from names to arrays, in the order of the columns; ``dict(table)`` works. Names end
    in their unit where they have one: ``com_vx_m_s`` is in m/s.

    ``units`` and ``meanings`` say per column what it is in, and what it is.
    """

    def __init__(self, columns: Mapping[str, Any], units: Mapping[str, str] | None = None,
                 meanings: Mapping[str, str] | None = None) -> None:
        for what, given in (("columns", columns), ("units", units), ("meanings", meanings)):
            if not isinstance(given, Mapping) and (given is not None or what == "columns"):
                raise TypeError(f"{what}: {type(given).__name__} (valid: a dict by column)")
        self._columns = {name: np.asarray(values) for name, values in columns.items()}
        for name, values in self._columns.items():
            if values.ndim != 1:
                raise ValueError(f"{name}: shape {values.shape} (valid: one row of values)")
        lengths = {len(values) for values in self._columns.values()}
        if len(lengths) > 1:
            raise ValueError(f"columns of different lengths: {sorted(lengths)}")
        self._rows = lengths.pop() if lengths else 0
        self.units: dict[str, str] = dict(units or {})
        self.meanings: dict[str, str] = dict(meanings or {})

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except (KeyError, TypeError):
            raise KeyError(f"no column {name!r} (valid: {', '.join(self._columns)})") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """The number of columns; ``rows`` is that of the rows."""
        return len(self._columns)

    @property
    def rows(self) -> int:
        """The number of rows n."""
        return self._rows

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, in their order."""
        return tuple(self._columns)

    def row(self, index: int) -> dict[str, Any]:
        """One row as a dict of plain values; ``index`` counts from 0, from the end if negative."""
        return {name: values[index].item() if hasattr(values[index], "item") else values[index]
                for name, values in self._columns.items()}

    def array(self, *names: str) -> np.ndarray:
        """Some columns side by side (n×k): ``table.array("com_x_m", "com_y_m")``."""
        return np.column_stack([self[name] for name in names])

    def to_pandas(self) -> Any:
        """The table as a ``pandas.DataFrame``. Needs pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("pandas is not installed; dict(table) has the columns") from error
        return pandas.DataFrame(self._columns)

    def __repr__(self) -> str:
        return f"<halfstep.Table: {self._rows} rows of {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        from html import escape
        head = "".join(f"<th>{escape(name)}</th>" for name in self._columns)
        shown = range(self._rows) if self._rows <= 10 else [*range(5), *range(self._rows - 5,
                                                                              self._rows)]
        body = "".join("<tr>" + "".join(f"<td>{escape(str(values[i]))}</td>"
                                        for values in self._columns.values()) + "</tr>"
                       for i in shown)
        return (f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
                f"<p>{self._rows} rows</p>")


def of_arrays(parts: tuple[list, list]) -> Table:
    """A table of what the compiled part sampled."""
    columns, arrays = parts
    named: dict[str, np.ndarray] = {}
    for (name, kind, _, _), array in zip(columns, arrays):
        if kind == "string":
            named[name] = _SUPPORT[array.astype(int)]
        else:
            named[name] = array.astype(int) if kind == "integer" else array
    return Table(named, {c[0]: c[2] for c in columns}, {c[0]: c[3] for c in columns})


def _typed(kind: str, cells: list[str]) -> np.ndarray:
    if kind == "string":
        return np.array(cells, dtype=object)
    if kind == "boolean":
        return np.array([cell == "true" for cell in cells], dtype=bool)
    if kind == "integer" and all(cells):
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    return np.array([float(cell) if cell else np.nan for cell in cells], dtype=float)


def of_text(parts: tuple[list, str]) -> Table:
    """A table of a CSV text and what its columns are; empty cells of numbers are NaN."""
    columns, text = parts
    rows = list(csv.reader(io.StringIO(text)))[1:]
    named = {column[0]: _typed(column[1], [row[c] for row in rows])
             for c, column in enumerate(columns)}
    return Table(named, {c[0]: c[2] for c in columns}, {c[0]: c[3] for c in columns})


def of_file(path: str | os.PathLike) -> Table:
    """A table of NAME.csv, with the types and units of NAME.schema.json beside it, or, of one of
    many such tables, in the folder above."""
    schema = pathlib.Path(path).with_suffix(".schema.json")
    if not schema.exists():
        schema = schema.parent.parent / schema.name
    with open(schema, encoding="utf-8") as file:
        fields = json.load(file)["fields"]
    columns = [(f["name"], f["type"], f.get("unit", ""), f.get("description", "")) for f in fields]
    with open(path, encoding="utf-8", newline="") as file:
        return of_text((columns, file.read()))
