#!/usr/bin/env python3
"""Writes the files beside it: a robot observes landmarks in a hall.

make.py [FOLDER]

The hall is 2.5 m x 2.5 m. At each step the robot stands at a random position with a random
heading. bearings.csv has the bearing [rad] of each landmark relative to its heading, with noise of
0.02 rad, and ranges.csv the distance [m], with noise of 2 %. One measurement in fifty is missing.
range_bearing.csv has both of the landmarks within 1 m, one scan every half second, and
detections.csv when each of them was seen. The anchors are the landmarks nearest to the corners."""
import csv
import math
import os
import random
import sys

SIDE_M, LANDMARKS, STEPS, NOISE_RAD, MISSING = 2.5, 30, 200, 0.02, 0.02
RANGE_NOISE, REACH_M, SECONDS = 0.02, 1.0, 0.5
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

ranges = [["name"] + list(range(1, STEPS + 1))]
for name, x, y in landmarks:
    measured = [math.dist((x, y), pose[:2]) * (1 + draw.gauss(0, RANGE_NOISE)) for pose in poses]
    ranges.append([name] + ["" if draw.random() < MISSING else "%.3f" % r for r in measured])
write("ranges.csv", ranges)

scans, seen = [["time", "landmark", "range", "bearing"]], [["time", "landmark"]]
for step, (robot_x, robot_y, heading) in enumerate(poses):
    for name, x, y in landmarks:
        distance = math.dist((x, y), (robot_x, robot_y))
        if distance > REACH_M:
            continue
        bearing = wrapped(math.atan2(y - robot_y, x - robot_x) - heading + draw.gauss(0, NOISE_RAD))
        time = "%.1f" % (step * SECONDS)
        scans.append([time, name, "%.3f" % (distance * (1 + draw.gauss(0, RANGE_NOISE))),
                      "%.3f" % bearing])
        seen.append([time, name])
write("range_bearing.csv", scans)
write("detections.csv", seen)
