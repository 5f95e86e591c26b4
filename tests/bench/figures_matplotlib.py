"""Draws what figures_bench draws, with matplotlib: figures_matplotlib.py FOLDER."""
import os
import sys
import time

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

COUNT = 100
LABELS = ["LPCA", "SMACOF, equal weights", "SMACOF, kNN weights, K = 8", "ISOMAP, K = 6"]
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#c66fa1"]


def rows_of(path):
    with open(path, encoding="utf-8") as lines:
        return [line.split() for line in lines]


def draw_map(folder, number, target):
    rows = rows_of(f"{folder}/map-{number}.txt")
    true_x, true_y, x, y = ([float(row[k]) for row in rows] for k in (1, 2, 3, 4))
    figure, axes = pyplot.subplots(figsize=(8, 6), dpi=150)
    axes.plot([true_x, x], [true_y, y], color="#757575", linewidth=1.2)
    axes.plot([], [], color="#757575", linewidth=1.2, label="error")
    axes.plot(true_x, true_y, "o", mfc="white", mec="#1a1a1a", markersize=6, label="true position")
    axes.plot(x, y, "o", color="#0072b2", markersize=5, label="estimate")
    errors = [((a - c) ** 2 + (b - d) ** 2) ** 0.5 for a, b, c, d in zip(true_x, true_y, x, y)]
    for k in sorted(range(len(rows)), key=lambda i: -errors[i])[:5]:
        axes.annotate(rows[k][0], (true_x[k], true_y[k]), (5, 5), textcoords="offset points")
    axes.set_aspect("equal")
    axes.set(title="ISOMAP, K = 6 · visibility · 2000 steps", xlabel="x [m]", ylabel="y [m]")
    axes.grid(color="#e4e4e4")
    axes.set_axisbelow(True)
    axes.legend(loc="best")
    figure.savefig(target)
    pyplot.close(figure)


def draw_curve(folder, number, target):
    rows = rows_of(f"{folder}/curve-{number}.txt")
    curves = [[]]
    for row in rows:
        if row:
            curves[-1].append([float(value) for value in row])
        elif curves[-1]:
            curves.append([])
    figure, axes = pyplot.subplots(figsize=(8, 6), dpi=150)
    for curve, label, colour, style in zip(curves, LABELS, COLOURS, ["o-", "s--", "^-.", "D:"]):
        steps, mean, low, high = zip(*curve)
        axes.fill_between(steps, low, high, color=colour, alpha=0.2, linewidth=0)
        axes.plot(steps, mean, style, color=colour, label=label)
    axes.set(title="Mean position error over observations, visibility",
             xlabel="observations (steps)", ylabel="MPE [m]")
    axes.grid(color="#e4e4e4")
    axes.set_axisbelow(True)
    axes.legend(loc="best")
    figure.savefig(target)
    pyplot.close(figure)


def main():
    folder = sys.argv[1]
    out = f"{folder}/matplotlib"
    os.makedirs(out, exist_ok=True)
    for what, draw, ending in [("map-png", draw_map, "png"), ("curve-png", draw_curve, "png"),
                               ("map-svg", draw_map, "svg")]:
        start = time.process_time()
        targets = [f"{out}/{what}-{number}.{ending}" for number in range(COUNT)]
        for number, target in enumerate(targets):
            draw(folder, number, target)
        seconds = time.process_time() - start
        size = sum(os.path.getsize(target) for target in targets) / COUNT
        print(f"{what} matplotlib {seconds:.3f} {size:.0f}", flush=True)


if __name__ == "__main__":
    main()
