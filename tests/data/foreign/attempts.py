#!/usr/bin/python3
"""Writes one simulated hall as many programs do, maps each file, and counts the attempts.

attempts.py MAPPROOF FOLDER [MARKDOWN]. The files beside this script are small, and tests read them;
these are as large as a real log, are not kept, and are other outputs of the same programs. An
attempt is one command of a user who knows the sensor and its unit; the next one takes the option or
the conversion that the error names. A map is right if it has every landmark and its error is that of the
map of the plain table. Programs that are not installed are left out, and reported.
"""
import csv
import json
import math
import os
import random
import shutil
import subprocess
import sys

import numpy as np
import pandas as pd

MAPPROOF, OUT = os.path.abspath(sys.argv[1]), sys.argv[2]
os.makedirs(OUT, exist_ok=True)
os.chdir(OUT)
draw = random.Random(21)
LANDMARKS, STEPS, SIDE_M, REACH_M = 24, 400, 6.0, 4.0
NAMES = ["L%d" % (i + 1) for i in range(LANDMARKS)]
BEARING, LIST = ["--sensor", "bearing", "--method", "smacof"], []
files, missing = [], []

# A hall, a walk, and what was observed.
places = [(draw.uniform(0.3, SIDE_M - 0.3), draw.uniform(0.3, SIDE_M - 0.3)) for _ in NAMES]
start = pd.Timestamp("2026-05-18 14:02:11.250", tz="Europe/Madrid")
rows, wide, x, y, heading = [], np.full((LANDMARKS, STEPS), np.nan), 3.0, 3.0, 0.0
for step in range(STEPS):
    heading += draw.uniform(-0.6, 0.6)
    while not (0.2 < x + 0.25 * math.cos(heading) < SIDE_M - 0.2 and
               0.2 < y + 0.25 * math.sin(heading) < SIDE_M - 0.2):
        heading += 0.5
    x, y = x + 0.25 * math.cos(heading), y + 0.25 * math.sin(heading)
    for i, (px, py) in enumerate(places):
        true = math.atan2(py - y, px - x) - heading
        bearing = math.remainder(true + draw.gauss(0, 0.02), 2 * math.pi)
        if draw.random() > 0.05:
            wide[i, step] = round(bearing, 4)
        distance = math.hypot(px - x, py - y)
        if distance < REACH_M:
            rows.append((step, start + pd.Timedelta(milliseconds=200 * step), NAMES[i],
                         round(distance + draw.gauss(0, 0.03), 3), round(bearing, 4)))
seen = pd.DataFrame(rows, columns=["step", "time", "landmark", "range", "bearing"])
seconds = (seen.time - start).dt.total_seconds()
frame = pd.DataFrame(wide.T, columns=NAMES)
timed = frame.set_index(pd.date_range(start, periods=STEPS, freq="200ms")).rename_axis("time")


def text(name, words):
    with open(name, "w", encoding="utf-8", newline="") as file:
        file.write(words)


def run(*words, given=None, to=None):
    done = subprocess.run(words, check=True, input=given, text=True, capture_output=True)
    if to:
        text(to, done.stdout)


def made(name, tool, *attempts, source=""):
    """A file, who made it, and the options of each attempt: the first is a user's, the others those
    that an error names; None is a conversion."""
    files.append((name, tool, attempts, source))


def by(program, what):
    """Makes files if the program is there."""
    if shutil.which(program):
        what()
    else:
        missing.append(program)


text("anchors.csv", "name,x,y\n" + "".join(
    "L%d,%.4f,%.4f\n" % (i + 1, *places[i]) for i in (0, 5, 11, 17)))
text("ground_truth.csv", "name,x,y\n" + "".join(
    "%s,%.4f,%.4f\n" % (name, *place) for name, place in zip(NAMES, places)))


def pandas_files():
    frame.T.to_csv("plain.csv", header=False)
    seen[["step", "landmark", "range", "bearing"]].to_csv("plain_list.csv", index=False)
    seen.pivot(index="step", columns="landmark", values="bearing").to_csv("pivot.csv")
    made("pivot.csv", "pandas pivot().to_csv", BEARING)
    timed.reset_index().melt(id_vars="time").to_csv("melt.csv", index=False)
    made("melt.csv", "pandas melt().to_csv", BEARING)
    timed.stack().to_csv("stack.csv")
    made("stack.csv", "pandas stack().to_csv", BEARING)
    seen.rename(columns={"time": "timestamp", "landmark": "marker_id", "range": "range_m",
                         "bearing": "bearing_rad"}).drop(columns="step").to_csv(
        "iso_zone.csv", index=False)
    made("iso_zone.csv", "pandas to_csv, ISO times with zone", LIST)
    frame.to_csv("tabs.tsv", sep="\t", na_rep="nan")
    made("tabs.tsv", "pandas to_csv(sep=tab, na_rep=nan)", BEARING)
    timed.to_csv("packed.csv.xz")
    made("packed.csv.xz", "pandas to_csv, xz", BEARING)
    for orient in ("records", "index", "table", "values"):
        frame.to_json(orient + ".json", orient=orient)
        unnamed = [BEARING + ["--layout", "transposed"]] if orient == "values" else []
        made(orient + ".json", "pandas to_json(orient=%s)" % orient, BEARING, *unnamed)
    seen.drop(columns="step").to_json("epoch_ms.jsonl", orient="records", lines=True)
    made("epoch_ms.jsonl", "pandas to_json(lines), epoch in ms", LIST)
    np.degrees(frame).round(2).to_csv("degrees.csv")
    made("degrees.csv", "pandas to_csv, degrees", BEARING + ["--degrees"])
    seen.assign(bearing=np.degrees(seen.bearing).round(2)).rename(
        columns={"bearing": "azimuth (deg)", "range": "distance (cm)"}).assign(
        **{"distance (cm)": lambda d: d["distance (cm)"] * 100}).to_csv("units.csv", index=False)
    made("units.csv", "pandas to_csv, cm and degrees in the header", LIST)
    timed.tz_localize(None).to_excel("frame.xlsx")
    made("frame.xlsx", "pandas to_excel", BEARING, None)
    frame.reset_index().to_stata("frame.dta")
    made("frame.dta", "pandas to_stata", BEARING, None)


def numpy_files():
    np.save("rows.npy", wide.astype("f4"))
    made("rows.npy", "numpy.save, float32", BEARING)
    np.save("steps.npy", wide.T)
    made("steps.npy", "numpy.save, rows of steps", BEARING, BEARING + ["--layout", "transposed"])
    np.savetxt("header.txt", wide, fmt="%.4f", delimiter=",", header="bearings [rad]")
    made("header.txt", "numpy.savetxt(header=...)", BEARING)
    np.savetxt("semicolons.txt", wide, fmt="%.4f", delimiter=";")
    made("semicolons.txt", "numpy.savetxt(delimiter=;)", BEARING)
    np.savez("columns.npz", timestamp=seconds.values, id=np.array([int(n[1:]) for n in seen.landmark]),
             range=seen["range"].values, bearing=seen.bearing.values)
    made("columns.npz", "numpy.savez, columns, numbers as IDs", LIST)
    np.savez("named.npz", bearings=wide)
    made("named.npz", "numpy.savez, one array", BEARING)
    np.save("records.npy", seen[["step", "range", "bearing"]].to_records(index=False))
    made("records.npy", "numpy.save, a structured array", LIST, None)


def python_files():
    with open("excel_tab.txt", "w", newline="") as file:
        out = csv.DictWriter(file, ["t", "tag", "r", "theta"], dialect="excel-tab")
        out.writeheader()
        out.writerows({"t": "%.1f" % t, "tag": row.landmark, "r": row.range, "theta": row.bearing}
                      for row, t in zip(seen.itertuples(), seconds))
    made("excel_tab.txt", "Python csv, excel-tab", LIST)
    scans = [{"stamp": "%.1f" % (0.2 * step), "detections": [
        {"id": row.landmark, "x": round(row.range * math.cos(row.bearing), 4),
         "y": round(row.range * math.sin(row.bearing), 4)} for row in group.itertuples()]}
        for step, group in seen.groupby("step")]
    text("scans.jsonl", "".join(json.dumps(scan) + "\n" for scan in scans))
    made("scans.jsonl", "Python json, a scan per line", LIST)
    text("scans.json", json.dumps(scans, indent=2))
    made("scans.json", "Python json, a list of scans", LIST)


def octave_files():
    load = "x = dlmread('plain.csv', ',', 0, 1); x(x == 0) = NaN; "
    run("octave", "-q", "--eval", load + "csvwrite('octave_csv.csv', x)")
    made("octave_csv.csv", "Octave csvwrite", BEARING)
    run("octave", "-q", "--eval", load + "dlmwrite('octave_blank.txt', x, 'delimiter', ' ', "
        "'precision', 5)")
    made("octave_blank.txt", "Octave dlmwrite, blanks", BEARING)
    run("octave", "-q", "--eval", load + "save('-text', 'octave_gz.txt.gz', '-zip', 'x')")
    made("octave_gz.txt.gz", "Octave save -text -zip", BEARING)
    run("octave", "-q", "--eval", "d = dlmread('numbers.csv', ',', 1, 0); f = fopen("
        "'octave_struct.json', 'w'); fputs(f, jsonencode(struct('time', d(:, 1), 'id', d(:, 2), "
        "'range', d(:, 3), 'bearing', d(:, 4)))); fclose(f);")
    made("octave_struct.json", "Octave jsonencode of a struct", LIST)


def r_files():
    load = "d <- read.csv('plain_list.csv'); "
    run("Rscript", "-e", load + "write.csv(d, 'r_plain.csv', quote = FALSE, row.names = FALSE)")
    made("r_plain.csv", "R write.csv, list", LIST)
    run("Rscript", "-e", load + "write.table(d, 'r_names.csv', sep = ',', col.names = NA)")
    made("r_names.csv", "R write.table(col.names = NA)", LIST)
    run("Rscript", "-e", load + "w <- reshape(d[, c('step', 'landmark', 'bearing')], idvar = 'step', "
        "timevar = 'landmark', direction = 'wide'); names(w) <- sub('bearing.', '', names(w), fixed ="
        " TRUE); write.csv(w, 'r_reshape.csv', row.names = FALSE)")
    made("r_reshape.csv", "R reshape, write.csv", BEARING)
    run("Rscript", "-e", load + "write.csv2(d, 'r_csv2_list.csv')")
    made("r_csv2_list.csv", "R write.csv2, list", LIST)


def sqlite_files():
    select = ".import --csv plain_list.csv d\n%s\nSELECT * FROM d;\n"
    for name, modes in (("sqlite_list.txt", ".headers on"), ("sqlite_json.json", ".mode json"),
                        ("sqlite_tabs.txt", ".headers on\n.mode tabs"),
                        ("sqlite_columns.txt", ".mode column"),
                        ("sqlite_bare.csv", ".mode csv")):
        run("sqlite3", ":memory:", given=select % modes, to=name)
        made(name, "sqlite3, " + modes.replace("\n", " "), LIST)


def shell_files():
    run("awk", "-F,", "NR > 1 {printf \"%.1f %s %.3f %.4f\\n\", $1 * 0.2, $2, $3, $4}",
        "plain_list.csv", to="awk.txt")
    made("awk.txt", "awk printf", LIST)
    run("column", "-t", "-s", ",", "plain_list.csv", to="column.txt")
    made("column.txt", "column -t", LIST)


def jq_files():
    run("jq", "-r", "(.[0] | keys_unsorted), (.[] | [.[]]) | @tsv", "records.json", to="jq.tsv")
    made("jq.tsv", "jq @tsv", BEARING)
    run("jq", "-c", ".[] | {header: {stamp: {sec: (.stamp | tonumber | floor), nanosec: "
        "(((.stamp | tonumber) * 10 | round) % 10 * 100000000)}}, detections: .detections}",
        "scans.json", to="ros.jsonl")
    made("ros.jsonl", "jq -c, header.stamp as of ROS 2", LIST)


def spreadsheet_files():
    def gnumeric():
        run("ssconvert", "frame.xlsx", "gnumeric.csv")
        made("gnumeric.csv", "Gnumeric, CSV", BEARING)
        run("ssconvert", "-T", "Gnumeric_stf:stf_assistant", "-O", "separator=;", "frame.xlsx",
            "gnumeric_semicolons.txt")
        made("gnumeric_semicolons.txt", "Gnumeric, semicolons", BEARING)

    def libreoffice():
        run("soffice", "--headless", "-env:UserInstallation=file://" + os.path.abspath("profile"),
            "--convert-to", "csv:Text - txt - csv (StarCalc):9,34,76", "--outdir", "libreoffice",
            "frame.xlsx")
        os.replace("libreoffice/frame.csv", "libreoffice_tabs.csv")
        made("libreoffice_tabs.csv", "LibreOffice, tabs", BEARING)

    by("ssconvert", gnumeric)
    by("soffice", libreoffice)


def documented_files():
    each = list(zip(seen.itertuples(), seconds))
    text("excel_french.csv", "\ufeffHorodatage;Balise;Distance (m);Gisement (deg)\r\n" + "".join(
        "{:%d/%m/%Y %H:%M:%S},{:03d};{};{};{}\r\n".format(
            row.time, row.time.microsecond // 1000, row.landmark, str(row.range).replace(".", ","),
            ("%.3f" % math.degrees(row.bearing)).replace(".", ",")) for row, _ in each))
    made("excel_french.csv", "Excel in French, CSV UTF-8", LIST,
         source="support.microsoft.com: import or export text (.csv) files")
    text("uwb_feet.csv", "temps;ancre;distance (ft)\n" + "".join(
        "%s;%s;%s\n" % (("%.3f" % t).replace(".", ","), row.landmark,
                        ("%.3f" % (row.range / 0.3048)).replace(".", ",")) for row, t in each))
    made("uwb_feet.csv", "a UWB logger in feet, French headers", ["--method", "smacof"],
         source="the project's own")
    text("pose_graph.g2o", "".join("VERTEX_SE2 %d 0 0 0\n" % k for k in range(STEPS)) + "".join(
        "VERTEX_XY %d 0 0\n" % (1000 + i) for i in range(LANDMARKS)) + "".join(
        "EDGE_BEARING_SE2_XY %d %d %.5f 1000\n" % (row.step, 1000 + int(row.landmark[1:]) - 1,
                                                   row.bearing) for row, _ in each))
    made("pose_graph.g2o", "g2o, EDGE_BEARING_SE2_XY", ["--method", "smacof"],
         source="github.com/RainerKuemmerle/g2o/wiki/File-Format")
    text("epoch_us.csv", "stamp,tag_id,range,bearing\n" + "".join(
        "%d,%s,%s,%s\n" % (row.time.value // 1000, row.landmark, row.range, row.bearing)
        for row, _ in each))
    made("epoch_us.csv", "a logger of microseconds since 1970", LIST, source="the project's own")


seen.assign(t=seconds, id=[int(n[1:]) for n in seen.landmark])[["t", "id", "range", "bearing"]].to_csv(
    "numbers.csv", index=False)
pandas_files()
numpy_files()
python_files()
by("octave", octave_files)
by("Rscript", r_files)
by("sqlite3", sqlite_files)
shell_files()
by("jq", jq_files)
spreadsheet_files()
documented_files()


def error_of(name, options):
    """The map's error against the ground truth, or why there is no map of all landmarks."""
    shutil.rmtree("map", ignore_errors=True)
    known = []
    for role in ("anchors", "ground_truth"):
        path = role + ".csv"
        with open(path) as file:
            points = file.read()
        # Tables of numbers and graphs have other names.
        if name in ("columns.npz", "octave_struct.json"):
            path = role + "_numbers.csv"
            text(path, points.replace("\nL", "\n"))
        if name.endswith(".g2o"):
            path = role + "_graph.csv"
            lines = points.splitlines()
            text(path, "\n".join([lines[0]] + [
                "%d,%s" % (999 + int(line[1:line.index(",")]), line.split(",", 1)[1])
                for line in lines[1:]]) + "\n")
        known += ["--" + role.replace("_", "-"), path]
    done = subprocess.run([MAPPROOF, "map", name, *options, *known, "--out", "map", "--json"],
                          text=True, capture_output=True)
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1]
    result = json.loads(done.stdout)
    if len(result["landmarks"]) != LANDMARKS or not result["score"]:
        return None, "%d landmarks" % len(result["landmarks"])
    return result["score"]["mpe_m"], ""


reference = {key: error_of(key, options)[0] for key, options in
             (("plain.csv", BEARING), ("plain_list.csv", LIST))}
sparse = error_of("plain_list.csv", BEARING)[0]
ranges = error_of("plain_list.csv", ["--sensor", "range", "--method", "smacof"])[0]
lines, first = ["| file | made by | attempts | what the first attempt said, where it was not right |",
                "|---|---|---|---|"], 0
for name, tool, attempts, source in files:
    said, count = "", 0
    for options in attempts:
        count += 1
        if options is None:
            break
        error, why = error_of(name, options)
        good = error is not None and any(
            abs(error - known) < 0.1 * known for known in (*reference.values(), sparse, ranges))
        if good:
            break
        said = said or why or "an error of %.3f m" % error
    else:
        count = 99
    first += count == 1
    lines.append("| `%s` | %s%s | %s | %s |" % (
        name, tool, " (%s)" % source if source else "", "never" if count == 99 else count,
        said.replace("|", "\\|")))
lines += ["", "%d files, %d of them made by the program itself; %d are right at the first attempt." % (
    len(files), sum(not source for *_, source in files), first)]
if missing:
    lines.append("Not installed: %s." % ", ".join(missing))
print("\n".join(lines))
if len(sys.argv) > 3:
    with open(sys.argv[3], "w") as file:
        file.write("\n".join(lines) + "\n")
