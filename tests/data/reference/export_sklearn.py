"""Embeddings of scikit-learn 1.2 for observations in CSV files, to hold mapproof against.

    export_sklearn.py FOLDER    writes FOLDER/NAME.json for every FOLDER/NAME.KIND.csv
    export_sklearn.py FOLDER --program build/app/mapproof
                                also maps each with the program and compares; exit code 1 if any
                                embedding differs by more than 1e-7 of its size

KIND is visibility, bearing or range; the CSV is wide, with a header, as `mapproof map` reads it, and
complete. Any such file will do: other layouts, other seeds (mapproof_reference_inputs writes some).
Left out, with a note, are settings for which scikit-learn's answer is arbitrary: neighbours that hang
on a tie, and eigenvectors that mix with the constant one because their eigenvalue is zero, too.
Run by Debian's /usr/bin/python3 with python3-sklearn. The tests need neither.
"""
import csv
import glob
import json
import os
import subprocess
import sys
import tempfile
import warnings

import numpy
from sklearn.decomposition import PCA, KernelPCA
from sklearn.manifold import Isomap, LocallyLinearEmbedding, SpectralEmbedding, smacof
from sklearn.metrics import euclidean_distances

BOUND = 1e-7
warnings.simplefilter("ignore")


def vectors(path, kind):
    """The observation vectors, one row per landmark: docs/methods/scans-and-distances.md."""
    with open(path, encoding="utf-8", newline="") as lines:
        rows = list(csv.reader(lines))[1:]
    values = numpy.array([[float(cell) for cell in row[1:]] for row in rows])
    if kind == "visibility":
        return values / numpy.linalg.norm(values, axis=1, keepdims=True)
    if kind == "bearing":
        return numpy.hstack([numpy.cos(values), numpy.sin(values)])
    squares = values ** 2
    return squares - squares.mean(axis=1, keepdims=True)


def two_digits(value):
    return float(f"{value:.1e}")


def has_tie(distances, count):
    """Whether the count-th and the next neighbour of some landmark are equally far."""
    ordered = numpy.sort(distances, axis=1)[:, 1:]
    if count >= ordered.shape[1]:
        return False
    return bool((ordered[:, count] - ordered[:, count - 1] <= 1e-9 * ordered[:, count]).any())


def affinity(distances, count):
    """1 where either landmark is among the count nearest of the other."""
    nearest = numpy.argsort(distances, axis=1, kind="stable")[:, 1:count + 1]
    joined = numpy.zeros(distances.shape)
    numpy.put_along_axis(joined, nearest, 1.0, axis=1)
    return numpy.maximum(joined, joined.T)


def pieces(joined):
    from scipy.sparse.csgraph import connected_components
    return connected_components(joined, directed=False)[0]


def graph_settings(X, distances):
    for count in (6, 8, 10):
        if count >= len(X):
            continue
        if has_tie(distances, count):
            print(f"  K = {count}: left out, neighbours are tied")
            continue
        joined = affinity(distances, count)
        if pieces(joined) > 1:
            print(f"  K = {count}: left out, the graph is in pieces")
            continue
        yield "isomap", count, Isomap(n_neighbors=count, eigen_solver="dense")
        yield "lle", count, LocallyLinearEmbedding(n_neighbors=count, eigen_solver="dense")
        yield "lem", count, (SpectralEmbedding(affinity="precomputed", eigen_solver="arpack",
                                               random_state=0), joined)
        if count == 6:  # for more it is not Donoho and Grimes'
            yield "hlle", count, LocallyLinearEmbedding(n_neighbors=count, eigen_solver="dense",
                                                        method="hessian")


def mixes_with_constant(coordinates):
    """Whether scikit-learn took a mixture of null vectors for the constant one, and dropped it."""
    return bool((numpy.abs(coordinates.sum(axis=0)) > 1e-6 * len(coordinates) ** 0.5).any())


def settings(X, distances):
    """(method, parameter, estimator or (estimator, what it takes))."""
    yield "lpca", None, PCA(n_components=2, svd_solver="full")
    squares = distances[numpy.tril_indices(len(X), -1)] ** 2
    for share in (1.0, 0.25):
        variance = two_digits(share * numpy.median(squares))
        yield "kpca-gaussian", variance, KernelPCA(n_components=2, kernel="rbf",
                                                   gamma=0.5 / variance, eigen_solver="dense")
    for degree in (2, 5):
        yield "kpca-polynomial", degree, KernelPCA(n_components=2, kernel="poly", gamma=1.0,
                                                   coef0=1.0, degree=degree, eigen_solver="dense")
    yield from graph_settings(X, distances)


def stress_of_smacof(X, distances):
    """Raw stress over the sum of squared distances, started from LPCA."""
    start = PCA(n_components=2, svd_solver="full").fit_transform(X)
    _, stress = smacof(distances, n_components=2, init=start, n_init=1, max_iter=3000, eps=1e-10,
                       normalized_stress=False)
    return float(stress / (distances ** 2).sum() * 2.0)


def reference(path, kind):
    X = vectors(path, kind)
    distances = euclidean_distances(X)
    embeddings = []
    for method, parameter, how in settings(X, distances):
        estimator, data = how if isinstance(how, tuple) else (how, X)
        coordinates = estimator.fit_transform(data)
        if method in ("lle", "hlle") and mixes_with_constant(coordinates):
            print(f"  {method} {parameter}: left out, its eigenvectors mix with the constant")
            continue
        embeddings.append({"method": method, "parameter": parameter,
                           "coordinates": coordinates.tolist()})
    return {"observations": os.path.basename(path), "sensor": kind, "embeddings": embeddings,
            "smacof_stress": stress_of_smacof(X, distances)}


def program_map(program, path, kind, method, parameter):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "map", path, "--sensor", kind, "--method", method, "--quiet", "--out",
                   os.path.join(folder, "map")]
        if parameter is not None:
            command += ["--parameter", repr(parameter)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "map", "map.csv"), encoding="utf-8", newline="") as lines:
            return numpy.array([[float(row["x"]), float(row["y"])] for row in csv.DictReader(lines)])


def gap(ours, theirs):
    """Largest distance after the best turn or mirror image, as a share of the largest coordinate."""
    U, _, V = numpy.linalg.svd(ours.T @ theirs)
    return numpy.abs(ours @ U @ V - theirs).max() / numpy.abs(theirs).max()


def main():
    folder = sys.argv[1]
    program = sys.argv[3] if len(sys.argv) > 3 and sys.argv[2] == "--program" else None
    worst = 0.0
    for path in sorted(glob.glob(os.path.join(folder, "*.*.csv"))):
        stem, kind = os.path.basename(path)[:-len(".csv")].rsplit(".", 1)
        print(stem, kind)
        if not numpy.isfinite(vectors(path, kind)).all():
            print("  left out, it has missing entries or landmarks never seen")
            continue
        result = reference(path, kind)
        with open(os.path.join(folder, f"{stem}.json"), "w", encoding="utf-8") as out:
            json.dump(result, out)
            out.write("\n")
        for item in result["embeddings"] if program else []:
            ours = program_map(program, path, kind, item["method"], item["parameter"])
            difference = gap(ours, numpy.array(item["coordinates"]))
            worst = max(worst, difference)
            print(f"  {item['method']} {item['parameter']}: {difference:.1e}")
    if program:
        print(f"largest difference {worst:.1e}")
    return 1 if worst > BOUND else 0


sys.exit(main())
