"""Times scikit-learn on what embed_bench times: embed_sklearn.py FOLDER SENSOR M WHAT [ITERATIONS].

Prints processor seconds: "M WHAT scikit-learn SECONDS PEAK_MIB". Both begin with the same matrix, of vectors or of
visibility, and include the products and distances. SMACOF is given its start, and as many iterations as ours took.
"""
import os
import resource
import sys
import time
import warnings

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import numpy
from sklearn.decomposition import PCA, KernelPCA
from sklearn.manifold import Isomap, LocallyLinearEmbedding, SpectralEmbedding, smacof
from sklearn.metrics import euclidean_distances
from sklearn.neighbors import kneighbors_graph

K = 8
VARIANCE = {"bearing": 4000.0, "visibility": 0.5}
warnings.simplefilter("ignore")


def classical_start(X):
    squares = euclidean_distances(X, squared=True)
    centre = numpy.eye(len(X)) - 1.0 / len(X)
    values, vectors = numpy.linalg.eigh(-0.5 * centre @ squares @ centre)
    return vectors[:, -2:] * numpy.sqrt(values[-2:])


def laplacian(X):
    directed = kneighbors_graph(X, K)
    affinity = directed.maximum(directed.T)
    return SpectralEmbedding(affinity="precomputed", random_state=0).fit_transform(affinity)


def of_unit_length(X):
    return X / numpy.sqrt((X * X).sum(1, keepdims=True))


def work_of(what, X, iterations, variance):
    if what == "smacof":
        start = classical_start(X)
        return lambda: smacof(euclidean_distances(X), n_components=2, init=start, n_init=1,
                              max_iter=iterations, eps=0.0)
    return {
        "gram": lambda: euclidean_distances(X),
        "lpca": lambda: PCA(2, svd_solver="arpack").fit_transform(X),
        "kpca-gaussian": lambda: KernelPCA(2, kernel="rbf", gamma=0.5 / variance).fit_transform(X),
        "kpca-polynomial": lambda: KernelPCA(2, kernel="poly", gamma=1.0, coef0=1.0,
                                             degree=2).fit_transform(X),
        "isomap": lambda: Isomap(n_neighbors=K).fit_transform(X),
        "lle": lambda: LocallyLinearEmbedding(n_neighbors=K, random_state=0).fit_transform(X),
        "hlle": lambda: LocallyLinearEmbedding(n_neighbors=K, method="hessian",
                                               random_state=0).fit_transform(X),
        "lem": lambda: laplacian(X),
    }[what]


def main():
    folder, sensor, landmarks, what = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4]
    iterations = int(sys.argv[5]) if len(sys.argv) > 5 else 300
    values = numpy.fromfile(f"{folder}/{sensor}-{landmarks}.f64")
    X = numpy.ascontiguousarray(values.reshape(-1, landmarks).T)
    if sensor == "visibility":
        X = of_unit_length(X)
    work = work_of(what, X, iterations, VARIANCE[sensor])
    best, total, rounds = float("inf"), 0.0, 0
    while rounds < 2 or (total < 0.3 and rounds < 100):
        start = time.process_time()
        try:
            work()
        except (RuntimeError, ValueError) as error:  # a factor at exactly 0, as of HLLE
            print(f"{landmarks} {what}: scikit-learn: {error}", file=sys.stderr)
            best = float("nan")
            break
        best = min(best, time.process_time() - start)
        total += time.process_time() - start
        rounds += 1
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(f"{landmarks} {what} scikit-learn {best:.6f} {peak:.0f}")


main()
