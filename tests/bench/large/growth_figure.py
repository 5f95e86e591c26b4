"""The figure and the tables of scripts/bench growth: growth_figure.py LANDMARKS STEPS FIGURE.json.

LANDMARKS and STEPS have lines "NAME SIZE CPU_SECONDS PEAK_MIB", where the size is M = N, or N of 1000
landmarks. The figure is read by mapproof render: time and memory over both, all axes logarithmic.
The tables, on standard output, have the slopes of both over the last decade or less: exponents of
the size.
"""
import json
import math
import sys

NAMES = {
    "mapproof-landmark-isomap": ("mapproof, Landmark ISOMAP", "series5"),
    "mapproof-landmark-mvu": ("mapproof, Landmark MVU", "series1"),
    "mapproof-lpca": ("mapproof, LPCA", "series4"),
    "mapproof-isomap": ("mapproof, ISOMAP", "series3"),
    "mapproof-lem": ("mapproof, LEM", "series7"),
    "scipy-landmark-isomap": ("SciPy, Landmark ISOMAP", "series2"),
    "sklearn-isomap": ("scikit-learn, ISOMAP", "muted"),
}


def read(path):
    found = {}
    for line in open(path, encoding="utf-8"):
        name, *numbers = line.split()
        found.setdefault(name, []).append(tuple(float(number) for number in numbers))
    return {name: sorted(rows) for name, rows in found.items() if name in NAMES}


def slope(rows, column):
    """Of the last decade of sizes, or of as much as there is, by its ends."""
    last = rows[-1]
    first = next(row for row in rows if row[0] >= 0.099 * last[0])
    if first is last:
        return math.nan
    return math.log(last[column] / first[column]) / math.log(last[0] / first[0])


def panel(results, column, size, label):
    layers = []
    for name, rows in results.items():
        words, colour = NAMES[name]
        mark = f"{name}-{column}-{size[0]}"
        is_ours = name.startswith("mapproof")
        layers.append({"kind": "polyline", "label": words, "x": [row[0] for row in rows],
                       "y": [row[column] for row in rows], "colour": colour,
                       "dash": "solid" if is_ours else "dashed", "width": 1,
                       "marker": "circle" if is_ours else "square",
                       "mark": {"id": mark, "data": [["curve", words]]}})
    axis = {"scale": "log", "limits": None, "whole": False}
    return {"title": "", "x": {"label": size, **axis},
            "y": {"label": label, **axis}, "equal_aspect": False, "bare": False,
            "layers": layers}


def print_table(results, size):
    sizes = sorted({row[0] for rows in results.values() for row in rows})
    print(f"| {size} | " + " | ".join(NAMES[name][0] for name in results) + " |")
    print("|---" * (len(results) + 1) + "|")
    for size in sizes:
        cells = []
        for rows in results.values():
            at = [row for row in rows if row[0] == size]
            cells.append(f"{at[0][1]:.3g} s, {at[0][2]:.0f} MiB" if at else "")
        print(f"| {size:.0f} | " + " | ".join(cells) + " |")
    for words, column in (("time", 1), ("memory", 2)):
        cells = [f"{slope(rows, column):.2f}" for rows in results.values()]
        print(f"| slope of the {words} | " + " | ".join(cells) + " |")
    print()


def main(landmarks, steps, out):
    kinds = [(read(landmarks), "landmarks and steps, M = N"), (read(steps), "steps N, 1000 landmarks")]
    for results, size in kinds:
        print_table(results, size)
    text = "; ".join(f"{NAMES[name][0]} over {size}: {rows[0][1]:.3g} s at {rows[0][0]:.0f}, "
                     f"{rows[-1][1]:.3g} s at {rows[-1][0]:.0f}"
                     for results, size in kinds for name, rows in results.items())
    figure = {"schema": {"name": "mapproof.figure", "version": 1}, "id": "growth",
              "title": "Time and memory of a map over the number of landmarks and steps",
              "caption": "Processor seconds and peak memory of the whole command, "
                         "from the text file to the report.",
              "alt": f"Time and memory over M and over N, logarithmic axes. {text}.", "records": [],
              "varies": False, "notes": [],
              "panels": [panel(results, column, size, label)
                         for column, label in ((1, "time [processor s]"), (2, "peak memory [MiB]"))
                         for results, size in kinds],
              "columns": 2, "shared_x": False, "shared_y": False, "arrows": []}
    with open(out, "w", encoding="utf-8") as file:
        json.dump(figure, file)


if __name__ == "__main__":
    main(*sys.argv[1:])
