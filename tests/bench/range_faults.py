"""Faults put into real range logs: how often `mapproof slam` reports them and names their cause.

Usage: range_faults.py MAPPROOF PLAZA_FOLDER [PERCENT ...]

Takes windows of each log (the whole, and 60 % of its time from 0, 20 and 40 %), puts each fault into
each window at each size (default: 100 and 25 % of the full one), and counts verdicts other than
`fits`, and first causes that are the fault with its landmarks. Windows as they are come first.
"""

import bisect
import csv
import itertools
import json
import math
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

WINDOWS = ((0.0, 1.0), (0.0, 0.6), (0.2, 0.8), (0.4, 1.0))
OFFSETS = {"common_offset": 3.0, "landmark_offset": 5.0, "time_offset": 5.0, "clock_jump": 20.0,
           "landmark_moved": 10.0, "ids_exchanged": 1.0, "odometry_gap": 60.0, "odometry_frozen": 60.0}


class Log:
    """Tables of a folder, restricted to a window of their time."""

    def __init__(self, folder, window):
        def table(name):
            with open(folder / name, newline="") as file:
                head, *rows = csv.reader(file)
            return head, rows

        self.range_head, ranges = table("ranges.csv")
        recovered = "odometry_drp.csv"  # From dead reckoning: what `slam` prefers.
        self.odometry_head, odometry = table(
            recovered if (folder / recovered).exists() else "odometry.csv")
        self.landmark_head, self.landmarks = table("landmarks.csv")
        self.ground_truth_head, self.ground_truth = table("groundtruth.csv")
        self.times = [float(row[0]) for row in self.ground_truth]
        begin, end = float(ranges[0][0]), float(ranges[-1][0])
        self.first, self.last = (begin + share * (end - begin) for share in window)
        self.middle = (self.first + self.last) / 2
        self.ranges = [row for row in ranges if self.first <= float(row[0]) <= self.last]
        self.odometry = [row for row in odometry if self.first <= float(row[0]) <= self.last]
        self.names = sorted({row[1] for row in self.ranges})
        self.places = {row[0]: (float(row[1]), float(row[2])) for row in self.landmarks}

    def place(self, time):
        k = min(len(self.ground_truth) - 1, bisect.bisect(self.times, time))
        return float(self.ground_truth[k][1]), float(self.ground_truth[k][2])


def with_ranges(log, change):
    """The ranges, each changed by `change(time, name, range)`, in the order of their times."""
    rows = []
    for row in log.ranges:
        time, name, length = change(float(row[0]), row[1], float(row[2]))
        rows.append([repr(time), name, repr(length), *row[3:]])
    return sorted(rows, key=lambda row: float(row[0])), log.odometry


def moved_length(log, name, shift, time, length):
    x, y = log.place(time)
    a, b = log.places[name][0] - x, log.places[name][1] - y
    return length * math.hypot(a + shift[0], b + shift[1]) / max(1e-6, math.hypot(a, b))


def faults(log, size):
    """Code of the cause, its landmarks, and the tables of ranges and odometry."""
    full = {code: size * value for code, value in OFFSETS.items()}
    late = lambda time: time >= log.middle
    yield "common_offset", [], with_ranges(
        log, lambda t, n, r: (t, n, r + full["common_offset"]))
    yield "time_offset", [], with_ranges(log, lambda t, n, r: (t + full["time_offset"], n, r))
    yield "clock_jump", [], with_ranges(
        log, lambda t, n, r: (t + full["clock_jump"] * late(t), n, r))
    for name in log.names:
        yield "landmark_offset", [name], with_ranges(
            log, lambda t, n, r: (t, n, r + full["landmark_offset"] * (n == name)))
        for direction in ((1, 0), (0, -1)):
            shift = [full["landmark_moved"] * part for part in direction]
            yield "landmark_moved", [name], with_ranges(log, lambda t, n, r: (
                t, n, moved_length(log, n, shift, t, r) if n == name and late(t) else r))
    until = log.middle + full["ids_exchanged"] * (log.last - log.middle)
    for pair in itertools.combinations(log.names, 2):
        other = dict([pair, pair[::-1]])
        yield "ids_exchanged", list(pair), with_ranges(log, lambda t, n, r: (
            t, other.get(n, n) if log.middle <= t <= until else n, r))
    gone = lambda row, key: log.middle <= float(row[0]) < log.middle + full[key]
    yield "odometry_gap", [], (
        log.ranges, [row for row in log.odometry if not gone(row, "odometry_gap")])
    yield "odometry_frozen", [], (log.ranges, [
        [row[0]] + ["0"] * (len(row) - 1) if gone(row, "odometry_frozen") else row
        for row in log.odometry])


def fit_of(program, log, ranges, odometry):
    with tempfile.TemporaryDirectory() as folder:
        for name, head, rows in (("ranges", log.range_head, ranges),
                                 ("odometry", log.odometry_head, odometry),
                                 ("landmarks", log.landmark_head, log.landmarks),
                                 ("groundtruth", log.ground_truth_head, log.ground_truth)):
            with open(f"{folder}/{name}.csv", "w", newline="") as file:
                csv.writer(file).writerows([head, *rows])
        done = subprocess.run([program, "slam", folder, "--json", "--out", f"{folder}/out"],
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        return json.loads(done.stdout)["fit"]


def main():
    program, data = sys.argv[1], pathlib.Path(sys.argv[2])
    sizes = [float(percent) / 100 for percent in sys.argv[3:]] or [1.0, 0.25]
    logs = [(f"{folder.name} {window[0]:.0%}-{window[1]:.0%}", Log(folder, window))
            for folder in sorted(data.iterdir()) if (folder / "ranges.csv").exists()
            for window in WINDOWS]
    tasks = [(name, log, 0.0, "none", [], (log.ranges, log.odometry)) for name, log in logs]
    tasks += [(name, log, size, *fault)
              for size in sizes for name, log in logs for fault in faults(log, size)]
    counts = {}
    with ThreadPoolExecutor(2) as pool:
        fits = pool.map(lambda task: fit_of(program, task[1], *task[5]), tasks)
        for (name, _, size, code, landmarks, _), fit in zip(tasks, fits):
            first = fit["causes"][0] if fit["causes"] else {"code": "", "landmarks": []}
            reported = fit["verdict"] != "fits"
            named = (code == first["code"]
                     and (not landmarks or set(landmarks) == set(first["landmarks"])))
            count = counts.setdefault((size, code), [0, 0, 0])
            for k, value in enumerate((1, reported, named)):
                count[k] += value
            if not named and code != "none" or code == "none" and reported:
                print(f"# {name}, {code} {landmarks} {size:.0%}: {fit['verdict']}, "
                      f"{first['code']} {first['landmarks']}", flush=True)
    print("size fault logs reported named")
    for (size, code), count in counts.items():
        print(f"{size:.0%} {code}", *count)


if __name__ == "__main__":
    main()
