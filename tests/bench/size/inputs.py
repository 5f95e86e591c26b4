"""Inputs of `scripts/bench size`, made without mapproof and by Python's standard library alone:

inputs.py study FOLDER COUNT   results.csv, study.json and maps/*.csv of a study whose report has
                                    COUNT figures: a curve of each of COUNT / 10 sites, the rest maps
inputs.py sites FOLDER COUNT   the same, all of them curves: a section and a table a figure
inputs.py drives FOLDER COUNT  drives.json and a log of ranges, data/log, for an experiment whose report
                                    has COUNT 3-D figures, one per drive, and three times as many others
inputs.py images FOLDER COUNT  a/*.png and b/*.png of one name each, 240 x 180: of every hundred
                                    one is changed and half of the rest are compressed in another way
inputs.py changed FOLDER COUNT the same, all of them changed
inputs.py metrics FOLDER NUMBER   metrics of three studies of that nightly run; one part is 30 %
                                    slower in 50 of every 400
inputs.py copies FOLDER LAST   fills the history in FOLDER up to nightly run LAST: its runs once more,
                                    in all tables, with their folders as hard links
"""

import json
import math
import os
import pathlib
import random
import shutil
import sqlite3
import struct
import sys
import zlib


def study(folder, count, sites):
    numbers = random.Random(count)
    (folder / "maps").mkdir(parents=True)
    with open(folder / "results.csv", "w") as rows:
        rows.write("setup,method,quantity,run,value,at.noise\n")
        for site in range(sites):
            slope = numbers.uniform(0.5, 2)
            for method in ("ekf", "mcl"):
                for run in range(4):
                    for noise in (0.01, 0.02, 0.05, 0.1):
                        value = slope * noise * numbers.uniform(0.8, 1.2)
                        rows.write(f"site-{site},{method},ate_m,{run},{value:.4f},{noise}\n")
    quantity = {"id": "ate_m", "label": "absolute trajectory error", "unit": "m", "better": "lower"}
    (folder / "study.json").write_text(json.dumps(
        {"schema": {"name": "mapproof.results_study", "version": 1}, "title": "Sites",
         "name": "sites", "quantities": [quantity]}))
    for room in range(count - sites):
        lines = ["name,x_m,y_m,true_x_m,true_y_m"]
        for landmark in range(20):
            x, y = numbers.uniform(0, 9), numbers.uniform(0, 6)
            lines.append(f"l{landmark},{x + numbers.gauss(0, 0.1):.4f},"
                         f"{y + numbers.gauss(0, 0.1):.4f},{x:.4f},{y:.4f}")
        (folder / "maps" / f"room-{room}.csv").write_text("\n".join(lines) + "\n")


def drives(folder, count):
    numbers = random.Random(1)
    log = folder / "data" / "log"
    log.mkdir(parents=True)
    beacons = {f"B{i + 1}": (25 * math.cos(i), 18 * math.sin(i)) for i in range(6)}
    (log / "landmarks.csv").write_text(
        "id,x,y\n" + "".join(f"{name},{x:.3f},{y:.3f}\n" for name, (x, y) in beacons.items()))
    x, y, heading = 15.0, 0.0, math.pi / 2
    (log / "odometry_start.csv").write_text(f"t,x,y,heading\n0.0,{x},{y},{heading:.4f}\n")
    poses, odometry, ranges = ["t,x,y,heading"], ["t,ddist,dheading"], ["t,beacon,range"]
    for step in range(160):
        t = 0.2 * step
        if step > 0:
            heading += 0.017
            x, y = x + 0.25 * math.cos(heading), y + 0.25 * math.sin(heading)
            odometry.append(f"{t:.1f},{0.25 + numbers.gauss(0, 0.003):.4f},"
                            f"{0.017 + numbers.gauss(0, 0.001):.5f}")
        poses.append(f"{t:.1f},{x:.3f},{y:.3f},{heading:.4f}")
        name, beacon = list(beacons.items())[step % 6]
        distance = math.dist((x, y), beacon) + numbers.gauss(0, 0.05)
        ranges.append(f"{t:.1f},{name},{distance:.3f}")
    for file, lines in (("groundtruth", poses), ("odometry", odometry), ("ranges", ranges)):
        (log / f"{file}.csv").write_text("\n".join(lines) + "\n")
    (folder / "drives.json").write_text(json.dumps(
        {"schema": {"name": "mapproof.slam_experiment", "version": 1}, "name": "drives",
         "title": "Drives", "seed": 1,
         "world": {"landmarks": 6, "known": 4, "half_width_m": 10, "step_m": 1,
                   "heading_change_sigma_rad": 0.5},
         "data": [{"id": f"drive-{i}", "title": f"Drive {i}", "figure": f"fig-{i}",
                   "files": ["log"], "source": "simulated"} for i in range(count)],
         "methods": ["dead-reckoning", "spectral-known"]}))


WIDTH, HEIGHT = 240, 180


def plot(seed, is_changed):
    numbers = random.Random(seed)
    rows = [bytearray(b"\xff" * (3 * WIDTH)) for _ in range(HEIGHT)]

    def dot(x, y, colour, size):
        for row in range(max(0, y - size), min(HEIGHT, y + size + 1)):
            for column in range(max(0, x - size), min(WIDTH, x + size + 1)):
                rows[row][3 * column:3 * column + 3] = colour

    for x in range(20, 220):
        dot(x, 160, b"\0\0\0", 0)
    for y in range(20, 160):
        dot(20, y, b"\0\0\0", 0)
    y = numbers.randrange(40, 140)
    for x in range(22, 220):
        y = min(150, max(25, y + numbers.randrange(-2, 3)))
        dot(x, y, b"\x1f\x77\xb4", 1)
    for _ in range(12):
        dot(numbers.randrange(25, 215), numbers.randrange(25, 155), b"\xff\x7f\x0e", 2)
    if is_changed:
        dot(120, 90, b"\xd6\x27\x28", 5)
    return b"".join(b"\0" + bytes(row) for row in rows)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, pixels, level):
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(pixels, level)) + chunk(b"IEND", b""))


def images(folder, count, all_changed):
    for side in ("a", "b"):
        (folder / side).mkdir(parents=True)
    for number in range(count):
        before = plot(number, False)
        is_changed = all_changed or number % 100 == 7
        after = plot(number, True) if is_changed else before
        name = f"plot-{number:05d}.png"
        write_png(folder / "a" / name, before, 6)
        write_png(folder / "b" / name, after, 6 if is_changed or number % 2 == 0 else 1)


def metrics_of_run(folder, number):
    numbers = random.Random(number)
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("solver", "loader", "planner"):
        metrics = []
        for part in range(8):
            slowdown = 1.3 if part == 0 and number % 400 >= 350 else 1
            value = round(10 * (part + 1) * numbers.gauss(1, 0.02) * slowdown, 4)
            metrics.append({"name": f"part {part}", "unit": "ms", "value": value, "better": "lower"})
        (folder / f"{name}.json").write_text(json.dumps(
            {"schema": {"name": "mapproof.metrics", "version": 1}, "name": name,
             "commit": f"{number:010x}", "metrics": metrics}))


def copies(folder, last):
    history = sqlite3.connect(folder / "history.sqlite")

    def rows_of(table, key):
        rows = {}
        cursor = history.execute(f"SELECT * FROM {table}")
        names = [column[0] for column in cursor.description]
        for row in cursor:
            row = dict(zip(names, row))
            rows.setdefault(row[key], []).append(row)
        return rows

    def insert(table, row):
        history.execute(f"INSERT INTO {table} ({', '.join(row)}) VALUES "
                        f"({', '.join('?' * len(row))})", list(row.values()))

    runs = rows_of("nightly_runs", "number")
    studies, findings = rows_of("studies", "nightly_run"), rows_of("findings", "nightly_run")
    parts = {table: rows_of(table, "study")
             for table in ("scores", "trends", "figures", "quantities", "labels")}
    first, next_id = max(runs), max(row["id"] for rows in studies.values() for row in rows) + 1
    made = sorted(runs)
    for number in range(first + 1, last + 1):
        source = made[(number - 1) % len(made)]
        reference = runs[source][0]["reference"]
        insert("nightly_runs", {**runs[source][0], "number": number, "pinned": 0,
                                "reference": reference and number - (source - reference)})
        for row in studies[source]:
            for table, rows in parts.items():
                for part in rows.get(row["id"], []):
                    insert(table, {**part, "study": next_id})
            insert("studies", {**row, "id": next_id, "nightly_run": number})
            next_id += 1
        for row in findings.get(source, []):
            copy = {**row, "nightly_run": number, "since": number - (source - row["since"])}
            del copy["id"]
            insert("findings", copy)
        shutil.copytree(folder / "nightly_runs" / f"{source:04d}",
                        folder / "nightly_runs" / f"{number:04d}", copy_function=os.link)
    history.commit()


def main():
    what, folder, count = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])
    if what == "study":
        study(folder, count, max(1, count // 10))
    elif what == "sites":
        study(folder, count, count)
    elif what == "drives":
        drives(folder, count)
    elif what in ("images", "changed"):
        images(folder, count, what == "changed")
    elif what == "metrics":
        metrics_of_run(folder, count)
    elif what == "copies":
        copies(folder, count)
    else:
        sys.exit(__doc__)


main()
