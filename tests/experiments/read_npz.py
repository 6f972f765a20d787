"""Compares the arrays of an .npz with the columns of a CSV, to the bit.

usage: read_npz.py NPZ CSV
"""
import csv
import sys

import numpy

with open(sys.argv[2], newline="", encoding="utf-8") as file:
    header, *rows = csv.reader(file)
with numpy.load(sys.argv[1], allow_pickle=False) as archive:
    assert list(archive.files) == header, archive.files
    for place, name in enumerate(header):
        array = archive[name]
        cells = [row[place] for row in rows]
        if array.dtype.kind == "f":
            assert array.tobytes() == numpy.array([float(cell) for cell in cells]).tobytes(), name
        else:
            assert [str(value) for value in array] == cells, name
print(len(header), "arrays of", len(rows))
