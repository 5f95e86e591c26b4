"""Times Python on what scripts/bench csv times: csv_numpy.py READER LAYOUT FILE.

Reads the table, makes the inner products of its directions and ISOMAP of their distances. READER is
loadtxt, genfromtxt or fromstring of numpy, or pandas. Prints "READ_S ALL_S PEAK_MIB": processor
seconds of reading, and of the whole process.
"""
import gzip
import os
import resource
import sys
import time
import warnings

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import numpy

warnings.simplefilter("ignore")


def opened(path):
    return gzip.open(path, "rt") if path.endswith(".gz") else open(path)


def bearings(reader, layout, path):
    """Steps x landmarks."""
    if reader == "fromstring":
        if layout == "wide":
            with opened(path) as rows:
                return numpy.array([numpy.fromstring(row[row.index(",") + 1:], sep=",")
                                    for row in rows]).T
        with opened(path) as table:
            width = table.readline().count(",") + 1
            text = table.read().replace("\n", ",")
        return numpy.fromstring(text, sep=",").reshape(-1, width)[:, 1:]
    if layout == "wide":
        raise SystemExit(f"{reader} takes minutes for rows of a million cells")
    if reader == "loadtxt":
        return numpy.loadtxt(path, delimiter=",", skiprows=1)[:, 1:]
    if reader == "genfromtxt":
        return numpy.genfromtxt(path, delimiter=",", skip_header=1)[:, 1:]
    import pandas
    return pandas.read_csv(path).to_numpy()[:, 1:]


def main():
    start = time.process_time()
    angles = bearings(*sys.argv[1:4])
    read = time.process_time() - start
    cosines, sines = numpy.cos(angles), numpy.sin(angles)
    products = cosines.T @ cosines + sines.T @ sines
    squares = numpy.diag(products)
    distances = numpy.sqrt(numpy.maximum(squares[:, None] + squares - 2.0 * products, 0.0))
    numpy.fill_diagonal(distances, 0.0)
    from sklearn.manifold import Isomap
    Isomap(n_neighbors=6, metric="precomputed").fit_transform(distances)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(f"{read:.2f} {time.process_time():.2f} {peak:.0f}")


main()
