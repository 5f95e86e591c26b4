"""range_numpy.py FOLDER: numpy's singular value decomposition of the matrices in it, a line each."""
import pathlib
import sys
import time

import numpy


def least_seconds(work, tries=5):
    least = float("inf")
    for _ in range(tries):
        start = time.perf_counter()
        work()
        least = min(least, time.perf_counter() - start)
    return least


for path in sorted(pathlib.Path(sys.argv[1]).glob("*.bin")):
    rows, columns = numpy.fromfile(path, dtype=numpy.int64, count=2)
    matrix = numpy.fromfile(path, dtype=numpy.float64, offset=16).reshape((rows, columns), order="F")
    for name, work in (
        ("SVD", lambda: numpy.linalg.svd(matrix, full_matrices=False)),
        ("eigenvectors of the Gram matrix", lambda: numpy.linalg.eigh(matrix @ matrix.T)),
    ):
        print(f"{path.stem + ': numpy ' + numpy.__version__ + ', ' + name:<58} {least_seconds(work):>10.4f} s")
