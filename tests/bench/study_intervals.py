"""How the 95 % intervals of a study of yairi2007 narrow with its layouts: study_intervals.py STUDY...

STUDY is the folder of a study or of one of its shards; layouts that lack a pose are left out.

Prints two tables of Markdown, of the MPE at the last checkpoint with the settings of the paper: the mean of each
method over all layouts with its interval and the published mean, and, for groups of 5, 10, ... layouts, half the
width of the interval relative to the mean, its slope over the layouts in a double logarithmic plot, and the share
of the groups whose interval holds the mean of all layouts.
"""
import collections
import json
import math
import sys

import numpy
import pandas
from scipy.stats import t as student

SIZES = (5, 10, 20, 50, 100, 200, 500, 1000)


def half_width(means):
    return student.ppf(0.975, len(means) - 1) * means.std(ddof=1) / math.sqrt(len(means))


def method_id(published):
    names = {"K": "-K", "d": "-d", "sigma2": "-sigma2-"}
    return published["method"] + "".join(f"{name}{published[key]:g}" for key, name in names.items() if key in published)


def errors_of(folder):
    """The MPE at the last checkpoint, without side studies."""
    table = pandas.read_csv(f"{folder}/results.csv", dtype={"subject": str})
    sides = [name for name in table if name.startswith("at.") and name != "at.steps"]
    table = table[(table.quantity == "mpe_m") & table[sides].isna().all(axis=1)]
    return table[table["at.steps"] == table.groupby("setup")["at.steps"].transform("max")]


def layout_means(folders):
    """{(sensor, method): MPE of each layout, in their order}, and the experiment."""
    with open(f"{folders[0]}/study.json") as file:
        experiment = json.load(file)["experiment"]
    table = pandas.concat(errors_of(folder) for folder in folders)
    poses = table.groupby("group").run.nunique()
    table = table[table.group.isin(poses.index[poses == experiment["poses"]])]
    means = {}
    for key, rows in table.groupby(["setup", "method"]):
        by_layout = rows.groupby("group").value.mean()
        order = sorted(by_layout.index, key=lambda name: int(name.split("-")[1]))
        means[key] = by_layout[order].to_numpy()
    return means, experiment


def main():
    means, experiment = layout_means(sys.argv[1:])
    print(f"{len(next(iter(means.values())))} layouts x {experiment['poses']} poses\n")
    widths, held = collections.defaultdict(list), collections.defaultdict(list)
    print("| sensor | method | MPE, m | 95 % interval | published |\n|---|---|---|---|---|")
    for sensor, study in experiment["sensors"].items():
        for published in study["published"]["values"]:
            values = means[sensor, method_id(published)]
            values = values[numpy.isfinite(values)]
            mean, width = values.mean(), half_width(values)
            print(f"| {sensor} | {method_id(published)} | {mean:.4g} | ±{width:.2g} | {published['mpe_m']:.4g} |")
            for size in SIZES:
                groups = [values[i:i + size] for i in range(0, len(values) - size + 1, size)]
                widths[size] += [numpy.mean([half_width(group) / mean for group in groups])] if groups else []
                if len(groups) > 1:
                    held[size] += [abs(group.mean() - mean) <= half_width(group) for group in groups]
    print("\n| layouts | half of the interval, % of the mean: median | least | greatest | groups that hold the mean of all |")
    print("|---|---|---|---|---|")
    medians = {}
    for size in (size for size in SIZES if widths[size]):
        medians[size] = numpy.median(widths[size])
        share = f"{100 * numpy.mean(held[size]):.1f} % of {len(held[size])}" if held[size] else ""
        print(f"| {size} | {100 * medians[size]:.2f} | {100 * min(widths[size]):.2f} | "
              f"{100 * max(widths[size]):.2f} | {share} |")
    slope = numpy.polyfit(numpy.log(list(medians)), numpy.log(list(medians.values())), 1)[0]
    print(f"\nSlope of the median over the layouts: {slope:.2f}")


main()
