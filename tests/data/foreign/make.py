#!/usr/bin/env python3
"""Makes the files beside it: the same observations, as forty programs and exports write them.

make.py [FOLDER]. Needs pandas, NumPy, openpyxl, OpenCV, AprilTag's Python module, LibreOffice,
Gnumeric, Octave, R, sqlite3 and jq (Debian: python3-pandas python3-openpyxl python3-opencv
python3-apriltag libreoffice-calc-nogui gnumeric octave r-base-core sqlite3 jq). The tests read the
files that are kept; nothing needs the programs. files.json says of each who made it, what it holds,
the options that read it, and how many attempts a user needs.
"""
import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import apriltag
import cv2
import numpy as np
import pandas as pd

OUT = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
os.chdir(OUT)
draw = random.Random(4)
NAMES = ["door", "desk", "plant", "shelf", "lamp", "clock"]
TIMES = pd.date_range("2026-11-03 09:15:00", periods=9, freq="500ms")
SEEN = [3, 7, 12]
files = []


def made(name, tool, ground_truth, options, attempts=1, source=""):
    files.append({"file": name, "tool": tool, "ground_truth": ground_truth, "options": options,
                  "attempts": attempts, **({"source": source} if source else {})})


def run(*words, text=None):
    subprocess.run(words, check=True, input=text, text=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def output(*words):
    return subprocess.run(words, check=True, text=True, capture_output=True).stdout


# What was observed: bearings [rad] of six landmarks at nine times, and range and bearing of three.
bearings = pd.DataFrame({name: [None if draw.random() < 0.1 else round(draw.uniform(-3.1, 3.1), 3)
                                for _ in TIMES] for name in NAMES}).astype(float)
detections = pd.DataFrame([{"time": time, "tag_id": tag, "range": round(draw.uniform(0.5, 4), 2),
                            "bearing": round(draw.uniform(-1.5, 1.5), 3)}
                           for time in TIMES for tag in SEEN if draw.random() < 0.8])
seconds = (detections.time - TIMES[0]).dt.total_seconds() + TIMES[0].timestamp()
bearings.T.to_csv("ground_truth_bearings.csv", header=False)
ground_truth = detections.assign(time=seconds.map("{:.3f}".format)).rename(columns={"tag_id": "landmark"})
ground_truth.to_csv("ground_truth_detections.csv", index=False)
timed = bearings.set_index(TIMES).rename_axis("time")
TABLE, LIST = ["--sensor", "bearing"], []

# pandas
bearings.to_csv("pandas_default.csv")
made("pandas_default.csv", "pandas to_csv", "bearings", TABLE)
bearings.T.to_csv("pandas_transposed.csv")
made("pandas_transposed.csv", "pandas T.to_csv", "bearings", TABLE)
timed.to_csv("pandas_datetime.csv")
made("pandas_datetime.csv", "pandas to_csv, DatetimeIndex", "bearings", TABLE)
timed.to_csv("pandas_german.csv", sep=";", decimal=",")
made("pandas_german.csv", 'pandas to_csv(sep=";", decimal=",")', "bearings", TABLE)
timed.tz_localize("UTC").tz_convert("Europe/Berlin").to_csv("pandas_zone.csv", na_rep="NA")
made("pandas_zone.csv", 'pandas to_csv(na_rep="NA"), with zone', "bearings", TABLE)
bearings.to_csv("pandas_gzip.csv.gz", compression={"method": "gzip", "mtime": 1})
made("pandas_gzip.csv.gz", "pandas to_csv, gzip", "bearings", TABLE)
bearings.to_csv("pandas_utf16.csv", encoding="utf-16")
made("pandas_utf16.csv", 'pandas to_csv(encoding="utf-16")', "bearings", TABLE)
bearings.to_json("pandas_columns.json")
made("pandas_columns.json", "pandas to_json", "bearings", TABLE)
bearings.to_json("pandas_records.jsonl", orient="records", lines=True)
made("pandas_records.jsonl", "pandas to_json(lines=True)", "bearings", TABLE)
bearings.to_json("pandas_split.json", orient="split")
made("pandas_split.json", 'pandas to_json(orient="split")', "bearings", TABLE)
with open("pandas_string.txt", "w") as file:
    file.write(bearings.to_string() + "\n")
made("pandas_string.txt", "pandas to_string", "bearings", TABLE)
detections.to_csv("pandas_long.csv")
made("pandas_long.csv", "pandas to_csv, long", "detections", LIST)
angles = detections.assign(bearing=detections.bearing.map(math.degrees).round(4))
angles.rename(columns={"time": "Zeit", "range": "Entfernung", "bearing": "Peilung [°]"}).to_csv(
    "pandas_cp1252.csv", sep=";", decimal=",", index=False, encoding="cp1252")
made("pandas_cp1252.csv", 'pandas to_csv(encoding="cp1252")', "detections", LIST)
bearings.to_pickle("pandas.pkl", protocol=4)
made("pandas.pkl", "pandas to_pickle", "refused", TABLE, 2)

# NumPy
values = bearings.values.T
np.save("numpy.npy", values)
made("numpy.npy", "numpy.save", "unnamed", TABLE)
np.save("numpy_fortran.npy", np.asfortranarray(values.astype(">f4")))
made("numpy_fortran.npy", "numpy.save, Fortran order, >f4", "unnamed", TABLE)
np.savez_compressed("numpy_columns.npz", time=seconds.values, tag_id=detections.tag_id.values,
                    range=detections.range.values, bearing=detections.bearing.values)
made("numpy_columns.npz", "numpy.savez_compressed, columns", "detections", LIST)
np.savetxt("numpy_savetxt.txt", values)
made("numpy_savetxt.txt", "numpy.savetxt", "unnamed", TABLE)
np.savetxt("numpy_steps.csv", values.T, delimiter=",", fmt="%.3f")
made("numpy_steps.csv", 'numpy.savetxt(delimiter=","), rows of steps', "unnamed",
     TABLE + ["--layout", "transposed"], 2)

# openpyxl, LibreOffice, Gnumeric
timed.to_excel("openpyxl.xlsx", engine="openpyxl")
made("openpyxl.xlsx", "openpyxl", "refused", TABLE, 2)
with tempfile.TemporaryDirectory() as folder:
    def convert(kind, name):
        run("soffice", "--headless", f"-env:UserInstallation=file://{folder}/profile",
            "--convert-to", kind, "--outdir", folder, "openpyxl.xlsx")
        os.replace(os.path.join(folder, "openpyxl." + kind.split(":")[0]), name)

    convert("csv", "libreoffice.csv")
    convert("csv:Text - txt - csv (StarCalc):59,34,76", "libreoffice_semicolons.csv")
    convert("ods", "libreoffice.ods")
made("libreoffice.csv", "LibreOffice, CSV", "bearings", TABLE)
made("libreoffice_semicolons.csv", "LibreOffice, CSV with semicolons", "bearings", TABLE)
made("libreoffice.ods", "LibreOffice, ODS", "refused", TABLE, 2)
run("ssconvert", "openpyxl.xlsx", "gnumeric.csv")
made("gnumeric.csv", "Gnumeric, CSV", "bearings", TABLE)
run("ssconvert", "-T", "Gnumeric_stf:stf_assistant", "-O", "separator='\t'", "openpyxl.xlsx",
    "gnumeric_tabs.txt")
made("gnumeric_tabs.txt", "Gnumeric, tabs", "bearings", TABLE)

# Octave, R
octave = "x = dlmread('ground_truth_bearings.csv', ',', 0, 1); x(x == 0) = NaN; "
run("octave", "-q", "--eval", octave + "save('-ascii', 'octave_ascii.txt', 'x')")
made("octave_ascii.txt", "Octave, save -ascii", "unnamed", TABLE)
run("octave", "-q", "--eval", octave + "save('-text', 'octave_text.txt', 'x')")
made("octave_text.txt", "Octave, save -text", "unnamed", TABLE)
run("octave", "-q", "--eval", octave + "dlmwrite('octave_dlm.csv', x, ';')")
made("octave_dlm.csv", "Octave, dlmwrite", "unnamed", TABLE)
frame = "x <- read.csv('pandas_datetime.csv')[, -1]; "
run("Rscript", "-e", frame + "write.csv(x, 'r_csv.csv')")
made("r_csv.csv", "R, write.csv", "bearings", TABLE)
run("Rscript", "-e", frame + "write.table(x, 'r_table.txt')")
made("r_table.txt", "R, write.table", "bearings", TABLE)
run("Rscript", "-e", frame + "write.csv2(x, 'r_csv2.csv', row.names = FALSE)")
made("r_csv2.csv", "R, write.csv2", "bearings", TABLE)
run("Rscript", "-e", "options(digits.secs = 3); d <- read.csv('pandas_long.csv')[, -1]; d$time <- "
    "as.POSIXct(d$time, tz = 'UTC'); write.table(d, 'r_long.txt', sep = '\\t', quote = FALSE)")
made("r_long.txt", "R, write.table(sep = \"\\t\")", "detections", LIST)


# OpenCV's ArUco and AprilTag: markers drawn into images, and what the detectors find in them.
def image_of(markers, dictionary):
    image = np.full((480, 640), 255, np.uint8)
    for tag, x, z in markers:
        size = round(600 * 0.2 / z)
        u, v = round(320 + 600 * x / z), 240
        marker = cv2.aruco.drawMarker(dictionary, tag, 200)
        image[v - size // 2:v - size // 2 + size, u - size // 2:u - size // 2 + size] = cv2.resize(
            marker, (size, size), interpolation=cv2.INTER_AREA)
    return image


scenes = [[(tag, -0.8 + 0.8 * i + draw.uniform(-0.1, 0.1), draw.uniform(1.8, 2.6))
           for i, tag in enumerate(SEEN)] for _ in range(5)]
with open("ground_truth_markers.csv", "w") as file:
    file.write("step,landmark,range,bearing\n")
    for k, scene in enumerate(scenes):
        for tag, x, z in scene:
            file.write("%d,%d,%.4f,%.4f\n" % (k, tag, math.hypot(x, z), math.atan2(-x, z)))
K = np.array([[600, 0, 320], [0, 600, 240], [0, 0, 1]], float)
aruco, april = (cv2.aruco.Dictionary_get(getattr(cv2.aruco, name))
                for name in ("DICT_4X4_50", "DICT_APRILTAG_36h11"))
rows, lines, tags = [], [], []
for k, scene in enumerate(scenes):
    corners, ids, _ = cv2.aruco.detectMarkers(image_of(scene, aruco), aruco)
    _, places, _ = cv2.aruco.estimatePoseSingleMarkers(corners, 0.2, K, np.zeros(5))
    for (tag,), (place,) in zip(ids.tolist(), places.tolist()):
        rows.append([k, tag] + ["%.4f" % value for value in place])
    lines.append({"frame": k, "markers": [{"marker_id": tag, "tvec": [round(v, 4) for v in place]}
                                          for (tag,), (place,) in zip(ids.tolist(), places.tolist())]})
    for found in apriltag.apriltag("tag36h11").detect(image_of(scene, april)):
        tags.append([k, found["id"], "%.2f" % math.degrees(math.atan2(320 - found["center"][0], 600))])
with open("aruco.csv", "w", newline="") as file:
    csv.writer(file).writerows([["frame", "marker_id", "tvec_x", "tvec_y", "tvec_z"]] + rows)
made("aruco.csv", "OpenCV, estimatePoseSingleMarkers", "markers", LIST)
with open("aruco.jsonl", "w") as file:
    file.write("".join(json.dumps(line) + "\n" for line in lines))
made("aruco.jsonl", "OpenCV, JSON lines", "markers", LIST)
with open("apriltag.csv", "w", newline="") as file:
    csv.writer(file).writerows([["frame", "tag_id", "bearing_deg"]] + tags)
made("apriltag.csv", "AprilTag, bearings alone", "marker_bearings", LIST)

# sqlite3, jq
run("sqlite3", ":memory:", text=".import --csv pandas_long.csv d\n.headers on\n.mode csv\n"
    ".once sqlite.csv\nSELECT time, tag_id, range, bearing FROM d;\n")
made("sqlite.csv", "sqlite3 -csv", "detections", LIST)
with open("jq.csv", "w") as file:
    file.write(output("jq", "-r", ".[] | [.door, .desk, .plant, .shelf, .lamp, .clock] | @csv",
                      "-s", "pandas_records.jsonl"))
made("jq.csv", "jq @csv, rows of steps", "unnamed", TABLE + ["--layout", "transposed"], 2)


# Written here to formats that are documented.
def write(name, text, tool, source, ground_truth="detections", options=LIST):
    with open(name, "w", encoding="utf-8", newline="") as file:
        file.write(text)
    made(name, tool, ground_truth, options, 1, source)


def degrees(row):
    return "%.4f" % math.degrees(row.bearing)


each = list(zip(detections.itertuples(), seconds))
write("excel_german.csv", "\ufeff" + "Zeit;Landmark ID;Entfernung [m];Peilung [Grad]\r\n" + "".join(
    "{:%d.%m.%Y %H:%M:%S},{:03d};{};{};{}\r\n".format(
        row.time, row.time.microsecond // 1000, row.tag_id, str(row.range).replace(".", ","),
        degrees(row).replace(".", ",")) for row, _ in each),
      "Excel, CSV UTF-8 in German", "support.microsoft.com: import or export text (.csv) files")
write("rostopic.csv", "%time,field.header.seq,field.id,field.range,field.bearing\n" + "".join(
    "%d,%d,%d,%s,%s\n" % (round(time * 1e9), i, row.tag_id, row.range, row.bearing)
    for i, (row, time) in enumerate(each)), "rostopic echo -p", "wiki.ros.org/rostopic")
write("matlab.csv", "time,tag_id,range,bearing\n" + "".join(
    "{:%d-%b-%Y %H:%M:%S}.{:03d},{},{},{}\n".format(
        row.time, row.time.microsecond // 1000, row.tag_id, row.range, row.bearing)
    for row, _ in each), "MATLAB, writetable", "mathworks.com/help/matlab/ref/writetable.html")
write("slam.g2o", "".join("VERTEX_SE2 %d 0 0 0\n" % k for k in range(len(TIMES))) + "".join(
    "EDGE_SE2_XY %d %d %.6f %.6f 100 0 100\n" % (
        round(2 * (time - TIMES[0].timestamp())), row.tag_id, row.range * math.cos(row.bearing),
        row.range * math.sin(row.bearing)) for row, time in each), "g2o, EDGE_SE2_XY",
      "github.com/RainerKuemmerle/g2o/wiki/File-Format")
write("gtsam.txt", "".join("BR %d %d %s %s 0.1 0.1\n" % (
    round(2 * (time - TIMES[0].timestamp())), row.tag_id, row.bearing, row.range)
    for row, time in each), "GTSAM, BR", "gtsam/slam/dataset.cpp of github.com/borglab/gtsam")
files.sort(key=lambda one: one["file"])
with open("files.json", "w") as file:
    file.write(json.dumps(files, indent=1) + "\n")
print(len(files), "files;", sum("source" not in one for one in files), "by the tool itself;",
      sum(one["attempts"] == 1 for one in files), "at the first attempt")
