"""What the notebooks of this folder share: colours, the look of a figure, reading."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

# Colours that colour-blind readers can tell apart (after Okabe and Ito).
BLACK, ORANGE, SKY, GREEN = "#000000", "#e69f00", "#56b4e9", "#009e73"
BLUE, VERMILION, PURPLE = "#0072b2", "#d55e00", "#cc79a7"
CYCLE = [BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, BLACK]
DASHES = ["-", "--", "-.", ":"]  # lines differ in these, too

SOLE_M = (0.2172, 0.137)  # length and width of HRP-2's sole

plt.rcParams.update({
    "figure.dpi": 110, "figure.constrained_layout.use": True, "font.size": 11,
    "axes.prop_cycle": plt.cycler(color=CYCLE), "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "grid.color": "#dddddd",
    "grid.linewidth": 0.6, "axes.axisbelow": True, "axes.titlesize": "medium",
    "axes.titlelocation": "left", "legend.frameon": False, "lines.linewidth": 1.8})


def read(name):
    """A CSV file of this folder."""
    return pd.read_csv(Path(__file__).parent / name)


def sole_corners(x, y, yaw):
    """Corners of a sole whose centre is at x, y [m], as an array of four rows (x, y)."""
    half = 0.5 * np.array(SOLE_M) * [[1, 1], [-1, 1], [-1, -1], [1, -1]]
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    return half @ turn.T + [x, y]


def plain_log(axis, ticks):
    """A logarithmic axis with plain numbers at these ticks."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_ticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.set_ticks([], minor=True)
