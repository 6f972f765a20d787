#!/usr/bin/env python3
"""What the gnuplot scripts ask about a run folder.

    run_facts.py RUN method            the folder of its smoothed walk: dichotomy, or another one
    run_facts.py RUN pareto            the folder of the first method that has a pareto.csv
    run_facts.py RUN sole              length and width of the soles [m]
    run_facts.py RUN outlines FOOT M   outlines of the obstacles in the way of the foot ("left",
                                       "right") in the walks raw and M, seen from the side: x and z
                                       [cm], a polygon a block

Soles and obstacles come from the run's report.html. Without one, the soles are HRP-2's and there
are no outlines. An obstacle that moves is shown where it is at the start, its silhouette convex.
"""
import csv
import json
import sys
from pathlib import Path

HRP2_SOLE = (0.2172, 0.137)


def folders(run, file):
    names = sorted(path.parent.name for path in run.glob("*/" + file))
    return sorted(names, key=lambda name: (name == "raw", name != "dichotomy"))


def report_data(run):
    page = run / "report.html"
    if not page.is_file():
        return None
    text = page.read_text(encoding="utf-8")
    begin = text.index('id="data">') + len('id="data">')
    return json.loads(text[begin:text.index("</script", begin)])


def sole_of(data):
    return data["robots"][0]["sole"] if data else HRP2_SOLE


def hull(points):
    """Convex hull in the plane, counter-clockwise."""
    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1 and (
                    (chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1])
                    <= (chain[-1][1] - chain[-2][1]) * (p[0] - chain[-2][0])):
                chain.pop()
            chain.append(p)
        return chain[:-1]
    ordered = sorted(set(points))
    return half(ordered) + half(ordered[::-1])


def way_of(run, method, foot):
    """The least and the largest x and y of a foot's centre in the walks [m]."""
    places = []
    for name in {"raw", method}:
        with open(run / name / "trajectory.csv", encoding="utf-8") as file:
            places += [(float(row[f"{foot}_foot_x_m"]), float(row[f"{foot}_foot_y_m"]))
                       for row in csv.DictReader(file)]
    return [(min(values), max(values)) for values in zip(*places)]


def outlines(run, foot, method):
    data = report_data(run)
    if not data:
        return
    reach = max(sole_of(data)) / 2
    way = [(low - reach, high + reach) for low, high in way_of(run, method, foot)]
    for obstacle in data["scenes"][0]["obstacles"]:
        numbers = [value * 1e-4 for value in obstacle["vertices"]]
        shift = obstacle["places"][0][1:4] if "places" in obstacle else (0, 0, 0)
        points = [tuple(numbers[i + k] + shift[k] for k in range(3))
                  for i in range(0, len(numbers), 3)]
        if any(max(p[k] for p in points) < way[k][0] or min(p[k] for p in points) > way[k][1]
               for k in range(2)):
            continue
        shape = hull([(x, z) for x, _, z in points])
        for x, z in shape + shape[:1]:
            print(f"{100 * x:.4f},{100 * z:.4f}")
        print("\n")


def main():
    run, what, *more = Path(sys.argv[1]), *sys.argv[2:]
    if what == "outlines":
        outlines(run, *more)
    elif what == "sole":
        print(*sole_of(report_data(run)))
    else:
        names = folders(run, "pareto.csv" if what == "pareto" else "trajectory.csv")
        if not names:
            sys.exit(f"{run}: no method has what is asked for")
        print(names[0])


main()
