#!/usr/bin/env python3
"""Writes the log beside it: a robot drives two rounds and measures ranges to six beacons.

make.py [FOLDER]

The robot drives at 1 m/s around an area of some 40 m x 24 m and measures the range to one beacon
after another, five times a second, with noise of 0.1 m. Its gyroscope drifts by 0.002 rad/s."""
import csv
import math
import os
import random
import sys

STEP_S, ROUNDS, STEPS_A_ROUND, RANGE_NOISE_M, DRIFT_RAD_S = 0.2, 2, 520, 0.1, 0.002
BEACONS = [(-24, -15), (2, -18), (25, -10), (22, 14), (-3, 17), (-25, 12)]
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
draw = random.Random(1)


def write(name, head, rows):
    with open(os.path.join(folder, name), "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head.split(",")] + rows)


def position(step):
    angle = 2 * math.pi * step / STEPS_A_ROUND
    return 20 * math.cos(angle), 12 * math.sin(angle) + 3 * math.sin(3 * angle)


def heading(step):
    (x, y), (next_x, next_y) = position(step), position(step + 1)
    return math.atan2(next_y - y, next_x - x)


steps = range(ROUNDS * STEPS_A_ROUND)
stamps = ["%.1f" % (STEP_S * step) for step in steps]
odometry = []
for step in steps[1:]:
    turn = math.remainder(heading(step) - heading(step - 1), 2 * math.pi)
    distance = math.dist(position(step), position(step - 1))
    odometry.append([stamps[step], "%.4f" % (distance * (1 + draw.gauss(0, 0.01))),
                     "%.5f" % (turn + DRIFT_RAD_S * STEP_S + draw.gauss(0, 0.001))])
ranges = []
for step in steps:
    beacon = step % len(BEACONS)
    distance = math.dist(position(step), BEACONS[beacon])
    ranges.append([stamps[step], "B%d" % (beacon + 1),
                   "%.3f" % (distance + draw.gauss(0, RANGE_NOISE_M))])
write("ranges.csv", "t,beacon,range", ranges)
write("odometry.csv", "t,ddist,dheading", odometry)
write("odometry_start.csv", "t,x,y,heading",
      [[stamps[0]] + ["%.4f" % value for value in (*position(0), heading(0))]])
write("groundtruth.csv", "t,x,y,heading",
      [[stamps[step]] + ["%.3f" % value for value in (*position(step), heading(step))]
       for step in steps])
write("landmarks.csv", "id,x,y", [["B%d" % (i + 1), x, y] for i, (x, y) in enumerate(BEACONS)])
