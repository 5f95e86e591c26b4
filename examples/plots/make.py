#!/usr/bin/env python3
"""Writes the folders beside it: plots of two versions of somebody's program, as SVG.

make.py [FOLDER]

old and new hold speed, error and battery over time. In new, the error is larger from 6 s on, and
the battery's curve has another colour; speed is the same."""
import math
import os
import sys

folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT, LEFT, BOTTOM = 480, 320, 50, 40


def plot(title, values, colour):
    top = max(values) * 1.1
    points = " ".join("%.1f,%.1f" % (LEFT + i * (WIDTH - LEFT - 20) / (len(values) - 1),
                                     HEIGHT - BOTTOM - v / top * (HEIGHT - BOTTOM - 40))
                      for i, v in enumerate(values))
    return "\n".join([
        '<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d">' % (WIDTH, HEIGHT),
        '<rect width="100%" height="100%" fill="white"/>',
        '<text x="%d" y="24" font-family="sans-serif" font-size="16">%s</text>' % (LEFT, title),
        '<path d="M%d 40V%dH%d" fill="none" stroke="black"/>' % (LEFT, HEIGHT - BOTTOM, WIDTH - 20),
        '<polyline points="%s" fill="none" stroke="%s" stroke-width="2"/>' % (points, colour),
        "</svg>", ""])


def write(version, name, text):
    os.makedirs(os.path.join(folder, version), exist_ok=True)
    with open(os.path.join(folder, version, name), "w") as file:
        file.write(text)


times = [i / 10 for i in range(101)]
for version in ("old", "new"):
    is_new = version == "new"
    write(version, "speed.svg", plot("Speed [m/s]", [1 + 0.5 * math.sin(t) for t in times], "#1f77b4"))
    write(version, "error.svg", plot("Error [m]", [0.2 + 0.01 * t + (0.15 if is_new and t > 6 else 0)
                                                   for t in times], "#d62728"))
    write(version, "battery.svg", plot("Battery [%]", [100 - 4 * t for t in times],
                                       "#9467bd" if is_new else "#2ca02c"))
