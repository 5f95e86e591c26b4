"""Errors of t-SNE maps, worked out from files of `mapproof export` by scikit-learn and numpy alone.

python3 tsne_by_hand.py FOLDER PERPLEXITY prints MPE [m] and MOE [%] of each checkpoint as JSON.
"""
import csv
import itertools
import json
import pathlib
import sys

import numpy
from sklearn.manifold import TSNE


def positions(path):
    with open(path, newline="") as file:
        return {row["name"]: (float(row["x_m"]), float(row["y_m"])) for row in csv.DictReader(file)}


def turns(points):
    for i, j, k in itertools.combinations(range(len(points)), 3):
        a, b = points[j] - points[i], points[k] - points[i]
        yield a[0] * b[1] - a[1] * b[0]


folder, perplexity = pathlib.Path(sys.argv[1]), float(sys.argv[2])
errors = {}
with open(folder / "checkpoints.csv", newline="") as file:
    checkpoints = list(csv.DictReader(file))
for checkpoint in checkpoints:
    run = folder / checkpoint["run"]
    true_m = positions(run / "ground-truth.csv")
    names = list(true_m)
    anchors = [names.index(name) for name in positions(run / "anchors.csv")]
    true_m = numpy.array([true_m[name] for name in names])
    distances = numpy.load(run / checkpoint["sensor"] / checkpoint["steps"] / "distances.npy")
    seen = numpy.flatnonzero(numpy.isfinite(distances).sum(axis=1) > 1)
    tsne = TSNE(metric="precomputed", init="random", perplexity=perplexity, learning_rate="auto",
                random_state=int(checkpoint["seed"]) % 2**32)
    shape = numpy.full((len(names), 2), numpy.nan)
    shape[seen] = tsne.fit_transform(distances[numpy.ix_(seen, seen)]).astype(float)
    # The affine map with the least squared distances at the anchors.
    used = [i for i in anchors if i in seen]
    fit, *_ = numpy.linalg.lstsq(numpy.c_[shape[used], numpy.ones(len(used))], true_m[used],
                                 rcond=None)
    placed = numpy.c_[shape, numpy.ones(len(names))] @ fit
    off = numpy.linalg.norm(placed - true_m, axis=1)
    pairs = list(zip(turns(true_m[seen]), turns(placed[seen])))
    errors["/".join([checkpoint["sensor"], checkpoint["run"], checkpoint["steps"]])] = {
        "mpe_m": off[[i for i in seen if i not in anchors]].mean(),
        "moe_percent": 100 * sum(a * b <= 0 for a, b in pairs) / len(pairs)}
print(json.dumps(errors))
