#!/usr/bin/env python3
"""Writes a study that no part of mapproof made: localisers.py FOLDER [WORSE]

Three localisers on 40 runs in 10 rooms, at three noises; WORSE is added to one method's error."""
import csv
import json
import os
import random
import sys

folder, worse = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 0.0
os.makedirs(folder, exist_ok=True)
with open(os.path.join(folder, "study.json"), "w") as file:
    json.dump({
        "schema": {"name": "mapproof.results_study", "version": 1},
        "name": "localisers", "title": "Three localisers in ten rooms",
        "question": "How does the noise of the laser change the error of three localisers?",
        "quantities": [
            {"id": "ate_m", "label": "absolute trajectory error", "unit": "m", "better": "lower"},
            {"id": "found_percent", "label": "runs localised", "unit": "%", "better": "higher"}],
        "methods": [{"id": "mcl", "label": "Monte Carlo localisation"},
                    {"id": "ekf", "label": "EKF"}, {"id": "icp", "label": "Scan matching"}],
        "factors": [{"id": "noise", "label": "laser noise", "unit": "m"}]}, file, indent=1)
draw = random.Random(7)
with open(os.path.join(folder, "results.csv"), "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["setup", "method", "quantity", "run", "group", "value", "at.noise"])
    for run in range(1, 41):
        room = draw.uniform(0.8, 1.2)
        for noise in (0.01, 0.05, 0.1):
            for method, error in (("mcl", 0.10), ("ekf", 0.08), ("icp", 0.15)):
                ate = room * error * (1 + 8 * noise) * draw.uniform(0.9, 1.1)
                lost = method == "icp" and noise == 0.1 and run % 10 == 0
                ate += worse if method == "ekf" else 0.0
                key = ["indoors", method, "%s", run, "room-%d" % ((run - 1) % 10 + 1)]
                for quantity, value in (("ate_m", "" if lost else round(ate, 6)),
                                        ("found_percent", round(100 - 50 * ate, 4))):
                    table.writerow([quantity if k == "%s" else k for k in key] + [value, noise])
