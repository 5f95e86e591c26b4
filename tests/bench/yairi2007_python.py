"""The protocol of Yairi 2007 as numpy, scikit-learn, CSDP and matplotlib do it, timed by the item.

    yairi2007_python.py STUDY HISTORIES [--whole] LAYOUT-POSE...

STUDY is a study that mapproof made of the experiment: its settings, layouts, SMACOF's iterations
and the scores to compare with are read from there. HISTORIES holds what
mapproof_yairi2007_histories wrote, so that both map the same observations. Of each run two
checkpoints are mapped with every method and parameter; semidefinite programs on the first run
alone, three parameters a checkpoint. With --whole all checkpoints of all runs are, and nothing is
left out.

Prints one line per item: "map LAYOUT POSE SENSOR STEP METHOD PARAMETER SECONDS MPE MOE" (PARAMETER is
- for methods without), "part NAME SECONDS COUNT", and "note TEXT".
"""
import json
import os
import re
import sys
import tempfile
import time
import warnings

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import numpy

import yairi2007_figures
import yairi2007_methods
import yairi2007_scores
import yairi2007_simulate

PARAMETERS = ("K", "sigma2", "d")
FIGURES_OF_A_KIND = 3
warnings.simplefilter("ignore")


class Clock:
    """Adds up the seconds and the number of each part of the protocol."""

    def __init__(self):
        self.parts = {}

    def time(self, part, work):
        start = time.perf_counter()
        result = work()
        seconds = time.perf_counter() - start
        if part:
            total, count = self.parts.get(part, (0.0, 0))
            self.parts[part] = (total + seconds, count + 1)
        return result, seconds


def read_json(path):
    with open(path, encoding="utf-8") as text:
        return json.load(text)


def settings_of(methods):
    for method, grid in methods.items():
        if not grid:
            yield method, None
        for name in PARAMETERS:
            for value in grid.get(name, []):
                yield method, value


def checkpoints_of(study, whole):
    """One half way, and the last."""
    steps = study["checkpoints"]
    return steps if whole else sorted({steps[(len(steps) - 1) // 2], steps[-1]})


def key_of(record):
    value = next((record[name] for name in PARAMETERS if name in record), None)
    return record["sensor"], record["step"], record["method"], value


def blas_in_use():
    with open("/proc/self/maps", encoding="utf-8") as lines:
        paths = {line.split()[-1] for line in lines if re.search(r"/lib(open)?blas[^/]*$", line)}
    return ", ".join(sorted(os.path.realpath(path) for path in paths)) or "unknown"


def map_checkpoint(clock, data, run, sensor, step, methods, with_sde):
    """Every map of one checkpoint; yields records as they go to disk."""
    ground_truth = numpy.array(run["world"]["landmarks_m"])
    anchors = numpy.array(run["anchors"])
    iterations = {key_of(record): record["iterations"] for record in run["records"]}
    observed, _ = clock.time("distances", lambda: yairi2007_methods.Observed(data, sensor))
    for method, value in settings_of(methods):
        if method == "sde" and value not in with_sde:
            continue
        limit = iterations[sensor, step, method, value]
        try:
            points, seconds = clock.time(None, lambda: observed.map(method, value, limit))
        except (RuntimeError, ValueError, numpy.linalg.LinAlgError) as error:
            print(f"note no map of {sensor} {step} {method} {value}: {error}")
            continue
        try:
            found, _ = clock.time("scores", lambda: yairi2007_scores.score(points, ground_truth, anchors))
        except numpy.linalg.LinAlgError as error:
            print(f"note no score of {sensor} {step} {method} {value}: {error}")
            found = {"mpe_m": numpy.nan, "moe_percent": numpy.nan, "estimate": points}
        parameter = "-" if value is None else f"{value:g}"
        print(f"map {run['run']['layout']} {run['run']['pose']} {sensor} {step} {method} "
              f"{parameter} {seconds:.7f} {found['mpe_m']:.6g} {found['moe_percent']:.6g}",
              flush=True)
        yield {"sensor": sensor, "method": method, "parameter": value, "step": step,
               "score": {name: found[name] for name in ("mpe_m", "moe_percent")},
               "estimate": found["estimate"].tolist()}


def do_run(clock, experiment, run, histories, with_sde, whole):
    layout, pose = run["run"]["layout"], run["run"]["pose"]
    world = run["world"]
    random = numpy.random.default_rng(1000 * layout + pose)
    steps = max(study["checkpoints"][-1] for study in experiment["sensors"].values())
    path, _ = clock.time("simulation",
                         lambda: yairi2007_simulate.walk(world, experiment["walk"], steps, random))
    maps = []
    for sensor, study in experiment["sensors"].items():
        clock.time(f"observation, {sensor}",
                   lambda: yairi2007_simulate.observe(world, path, sensor, study))
        values = numpy.fromfile(f"{histories}/layout-{layout}-pose-{pose}.{sensor}.f64")
        history = values.reshape(steps, -1).T
        grid = study["methods"].get("sde", {}).get("K", [])
        some = {grid[0], grid[len(grid) // 2], grid[-1]} if grid and with_sde else set()
        chosen = set(grid) if whole else some
        for step in checkpoints_of(study, whole):
            data = numpy.ascontiguousarray(history[:, :step])
            maps += map_checkpoint(clock, data, run, sensor, step, study["methods"], chosen)
    with tempfile.TemporaryFile("w", encoding="utf-8") as out:
        _, seconds = clock.time(None, lambda: json.dump(maps, out, indent=2))
    total, count = clock.parts.get("records", (0.0, 0))
    clock.parts["records"] = (total + seconds, count + len(maps))
    return maps


def print_agreement(run, maps):
    """How far the scores are from those of mapproof's maps of the same observations."""
    ours = {key_of(record): record["score"] for record in run["records"]}
    apart = {}
    for record in maps:
        score = ours[record["sensor"], record["step"], record["method"], record["parameter"]]
        if score:
            difference = abs(record["score"]["moe_percent"] - score["moe_percent"])
            apart.setdefault(record["method"], []).append(difference)
    words = [f"{method} {numpy.nanmedian(values):.2g}" for method, values in apart.items()]
    print(f"note median distance from mapproof's MOE, %, run {run['run']['layout']}-"
          f"{run['run']['pose']}: {', '.join(words)}")


def draw_figures(clock, run, maps):
    ground_truth = numpy.array(run["world"]["landmarks_m"])
    with tempfile.TemporaryDirectory() as folder:
        for number, record in enumerate(maps[:FIGURES_OF_A_KIND]):
            clock.time("figures", lambda: yairi2007_figures.draw_map(
                ground_truth, numpy.array(record["estimate"]), f"{folder}/map-{number}"))
        for number in range(FIGURES_OF_A_KIND):
            clock.time("figures",
                       lambda: yairi2007_figures.draw_curves(maps, f"{folder}/curve-{number}"))


def main():
    study, histories, runs = sys.argv[1], sys.argv[2], sys.argv[3:]
    whole = "--whole" in runs
    runs = [run for run in runs if run != "--whole"]
    experiment = read_json(f"{study}/study.json")["experiment"]
    clock = Clock()
    print(f"note BLAS of numpy and CSDP: {blas_in_use()}")
    for number, name in enumerate(runs):
        layout, pose = name.split("-")
        run = read_json(f"{study}/runs/layout-{layout}-pose-{pose}.json")
        maps = do_run(clock, experiment, run, histories, number == 0, whole)
        print_agreement(run, maps)
        if number == 0:
            draw_figures(clock, run, maps)
    for name, (seconds, count) in clock.parts.items():
        print(f"part {name.replace(' ', '_')} {seconds:.6f} {count}")


main()
