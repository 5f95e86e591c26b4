"""Maps what mapproof_large_world wrote: large_python.py FOLDER isomap|landmark-isomap [K] [L].

isomap: scikit-learn's Isomap of the normalised rows. landmark-isomap: numpy and SciPy, neighbours by
a sparse product of blocks, paths by scipy.sparse.csgraph, references at random. Prints
"M N PEER SECONDS PEAK_MIB MPE_M" (MPE over all landmarks, after the affine map that fits best).
"""
import os
import resource
import sys

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import numpy
import pandas
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components, dijkstra


def read(folder):
    table = pandas.read_csv(f"{folder}/observations.csv")
    names, rows = numpy.unique(table["landmark"], return_inverse=True)
    _, steps = numpy.unique(table["step"], return_inverse=True)
    seen = csr_matrix((numpy.ones(len(table), numpy.float32), (rows, steps)))
    ground_truth = pandas.read_csv(f"{folder}/ground_truth.csv", index_col="name").loc[names]
    counts = numpy.asarray(seen.sum(axis=1)).ravel()
    return csr_matrix(seen.multiply(1.0 / numpy.sqrt(counts)[:, None])), ground_truth.to_numpy()


def neighbour_graph(X, K, block=2000):
    transposed = X.T.tocsr()
    rows, columns, lengths = [], [], []
    for first in range(0, X.shape[0], block):
        cosines = (X[first:first + block] @ transposed).tocsr()
        for i in range(cosines.shape[0]):
            begin, end = cosines.indptr[i], cosines.indptr[i + 1]
            others, values = cosines.indices[begin:end], cosines.data[begin:end]
            keep = others != first + i
            others, values = others[keep], values[keep]
            if len(values) > K:
                best = numpy.argpartition(-values, K)[:K]
                others, values = others[best], values[best]
            rows.extend([first + i] * len(others))
            columns.extend(others)
            lengths.extend(numpy.sqrt(numpy.maximum(2.0 - 2.0 * values, 1e-12)))
    graph = csr_matrix((lengths, (rows, columns)), shape=(X.shape[0],) * 2)
    return graph.maximum(graph.T)


def landmark_isomap(X, K, L):
    graph = neighbour_graph(X, K)
    _, label = connected_components(graph, directed=False)
    largest = numpy.flatnonzero(label == numpy.bincount(label).argmax())
    graph = graph[largest][:, largest]
    references = numpy.random.default_rng(0).choice(len(largest), min(L, len(largest)), False)
    squares = dijkstra(graph, directed=False, indices=references) ** 2
    among = squares[:, references]
    centre = numpy.eye(len(references)) - 1.0 / len(references)
    values, vectors = numpy.linalg.eigh(-0.5 * centre @ among @ centre)
    inverse = vectors[:, -2:] / numpy.sqrt(values[-2:])
    coordinates = numpy.full((X.shape[0], 2), numpy.nan)
    coordinates[largest] = (-0.5 * inverse.T @ (squares - among.mean(axis=0)[:, None])).T
    return coordinates


def isomap(X, K):
    from sklearn.manifold import Isomap
    # Of a sparse array it takes many times as long.
    return Isomap(n_neighbors=K, n_components=2).fit_transform(X.toarray())


def mpe_m(coordinates, ground_truth):
    mapped = numpy.isfinite(coordinates[:, 0])
    A = numpy.column_stack([coordinates[mapped], numpy.ones(mapped.sum())])
    fit, *_ = numpy.linalg.lstsq(A, ground_truth[mapped], rcond=None)
    return numpy.linalg.norm(A @ fit - ground_truth[mapped], axis=1).mean()


def main():
    folder, method = sys.argv[1], sys.argv[2]
    K = int(sys.argv[3]) if len(sys.argv) > 3 else 6
    L = int(sys.argv[4]) if len(sys.argv) > 4 else 200
    X, ground_truth = read(folder)
    used = resource.getrusage(resource.RUSAGE_SELF)
    before = used.ru_utime + used.ru_stime
    coordinates = isomap(X, K) if method == "isomap" else landmark_isomap(X, K, L)
    used = resource.getrusage(resource.RUSAGE_SELF)
    peer = "scikit-learn" if method == "isomap" else "SciPy"
    print(f"{X.shape[0]} {X.shape[1]} {peer}-{method} {used.ru_utime + used.ru_stime - before:.2f} "
          f"{used.ru_maxrss / 1024.0:.0f} {mpe_m(coordinates, ground_truth):.3f}")


main()
