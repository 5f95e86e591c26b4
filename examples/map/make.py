#!/usr/bin/env python3
"""Writes the files beside it: a robot measures bearings to landmarks in a room.

make.py [FOLDER]

The room is 2.5 m x 2.5 m. At each step the robot stands at a random position with a random
heading, and measures the bearing [rad] of each landmark relative to its heading, with noise of
0.02 rad. One measurement in fifty is missing. The anchors are the landmarks nearest to the
corners."""
import csv
import math
import os
import random
import sys

SIDE_M, LANDMARKS, STEPS, NOISE_RAD, MISSING = 2.5, 30, 200, 0.02, 0.02
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
draw = random.Random(1)


def write(name, rows):
    with open(os.path.join(folder, name), "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def wrapped(angle):
    return math.remainder(angle, 2 * math.pi)


def point():
    return draw.uniform(0, SIDE_M), draw.uniform(0, SIDE_M)


landmarks = [("L%d" % (i + 1), *point()) for i in range(LANDMARKS)]
poses = [(*point(), draw.uniform(-math.pi, math.pi)) for _ in range(STEPS)]
rows = [["name"] + list(range(1, STEPS + 1))]
for name, x, y in landmarks:
    row = [name]
    for robot_x, robot_y, heading in poses:
        bearing = wrapped(math.atan2(y - robot_y, x - robot_x) - heading + draw.gauss(0, NOISE_RAD))
        row.append("" if draw.random() < MISSING else "%.3f" % bearing)
    rows.append(row)
write("bearings.csv", rows)

positions = [[name, "%.3f" % x, "%.3f" % y] for name, x, y in landmarks]
write("ground_truth.csv", [["name", "x", "y"]] + positions)
corners = [(x, y) for x in (0, SIDE_M) for y in (0, SIDE_M)]
nearest = {min(range(LANDMARKS), key=lambda i: math.dist(corner, landmarks[i][1:]))
           for corner in corners}
write("anchors.csv", [["name", "x", "y"]] + [positions[i] for i in sorted(nearest)])
