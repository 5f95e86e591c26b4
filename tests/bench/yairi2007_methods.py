"""The mapping methods of Yairi 2007 with numpy, scikit-learn and the program csdp."""
import os
import subprocess
import tempfile

import numpy
from scipy.linalg import cho_factor, cho_solve
from sklearn.decomposition import PCA, KernelPCA
from sklearn.manifold import Isomap, LocallyLinearEmbedding, SpectralEmbedding, smacof


def neighbour_lists(distances, count):
    return numpy.argsort(distances, axis=1, kind="stable")[:, 1:count + 1]


def adjacency(distances, count):
    """1 where either is among the count nearest of the other."""
    joined = numpy.zeros(distances.shape)
    numpy.put_along_axis(joined, neighbour_lists(distances, count), 1.0, axis=1)
    return numpy.maximum(joined, joined.T)


def weighted_smacof(distances, weights, start, relative_fall=1e-2, limit=1000):
    """Majorisation until the stress falls by less than that share of it."""
    laplacian = numpy.diag(weights.sum(axis=1)) - weights
    factor = cho_factor(laplacian + 1.0 / len(weights))
    products = weights * distances
    Z, before = start, numpy.inf
    for _ in range(limit + 1):
        found = numpy.sqrt(((Z[:, None] - Z[None]) ** 2).sum(axis=2))
        stress = (weights * (distances - found) ** 2).sum() / 2.0
        if before - stress <= relative_fall * before < numpy.inf:
            break
        before = stress
        ratios = numpy.divide(products, found, out=numpy.zeros_like(found), where=found > 0.0)
        Z = cho_solve(factor, ratios.sum(axis=1)[:, None] * Z - ratios @ Z)
    return Z


def write_sdpa(path, size, pairs, squares):
    """Largest spread about the centroid that keeps the pairs' squared distances.

    The first landmark is the origin, which leaves the matrix of the others an interior: to have it
    sum to zero instead would not, and CSDP then often makes no progress.
    """
    with open(path, "w", encoding="ascii") as out:
        kept = " ".join(f"{value:.17g}" for value in squares)
        out.write(f"{len(pairs)}\n1\n{size - 1}\n{kept}\n")
        for i in range(1, size):
            out.writelines(f"0 1 {i} {j} {(i == j) - 1.0 / size:.17g}\n" for j in range(i, size))
        for k, (i, j) in enumerate(pairs, start=1):
            if i > 0:
                out.write(f"{k} 1 {i} {i} 1\n{k} 1 {i} {j} -1\n")
            out.write(f"{k} 1 {j} {j} 1\n")


def read_solution(path, size):
    """The primal matrix, matrix 2 of the file, about the centroid of all landmarks."""
    K = numpy.zeros((size, size))
    with open(path, encoding="ascii") as lines:
        next(lines)
        for line in lines:
            matrix, _, i, j, value = line.split()
            if matrix == "2":
                K[int(i), int(j)] = K[int(j), int(i)] = float(value)
    centre = numpy.eye(size) - 1.0 / size
    return centre @ K @ centre


def unfolded(distances, count):
    """SDE: equality on all pairs within a landmark and its nearest."""
    size = len(distances)
    groups = numpy.hstack([numpy.arange(size)[:, None], neighbour_lists(distances, count)])
    kept = numpy.zeros((size, size), dtype=bool)
    for group in groups:
        kept[numpy.ix_(group, group)] = True
    pairs = numpy.argwhere(numpy.triu(kept, 1))
    with tempfile.TemporaryDirectory() as folder:
        problem, solution = os.path.join(folder, "in.dat-s"), os.path.join(folder, "out.sol")
        write_sdpa(problem, size, pairs.tolist(), distances[pairs[:, 0], pairs[:, 1]] ** 2)
        done = subprocess.run(["csdp", problem, solution], stdout=subprocess.DEVNULL, check=False,
                              cwd=folder)
        if done.returncode not in (0, 3):  # 3: solved to reduced accuracy
            raise RuntimeError(f"csdp gave {done.returncode}")
        values, vectors = numpy.linalg.eigh(read_solution(solution, size))
    return vectors[:, -2:] * numpy.sqrt(numpy.maximum(values[-2:], 0.0))


def isometric(squares):
    """Points with these squared distances, in as few columns as there are points.

    For methods that take no distances: over vectors as long as the history LLE is slower.
    """
    centre = numpy.eye(len(squares)) - 1.0 / len(squares)
    values, vectors = numpy.linalg.eigh(-0.5 * centre @ squares @ centre)
    return vectors * numpy.sqrt(numpy.maximum(values, 0.0))


class Observed:
    """Vectors, inner products and distances of one history; what several methods share, once."""

    def __init__(self, history, sensor):
        if sensor == "visibility":
            self.X = history / numpy.linalg.norm(history, axis=1, keepdims=True)
        else:
            self.X = numpy.hstack([numpy.cos(history), numpy.sin(history)])
        self.G = self.X @ self.X.T
        squares = numpy.diag(self.G)
        self.squares = numpy.maximum(squares[:, None] + squares[None] - 2.0 * self.G, 0.0)
        numpy.fill_diagonal(self.squares, 0.0)
        self.D = numpy.sqrt(self.squares)
        self.points = isometric(self.squares)
        self.linear = self.equal = None

    def map(self, method, value, iterations):
        """The embedding; `iterations` are those that equal-weight SMACOF is given."""
        return {
            "lpca": self.lpca,
            "smacof": lambda: self.smacof(iterations),
            "smacof-knn": lambda: weighted_smacof(self.D, adjacency(self.D, value), self.equal),
            "kpca-gaussian": lambda: self.kernel(numpy.exp(self.squares / (-2.0 * value))),
            "kpca-polynomial": lambda: self.kernel((self.G + 1.0) ** value),
            "isomap": lambda: Isomap(n_neighbors=value, metric="precomputed").fit_transform(self.D),
            "lle": lambda: LocallyLinearEmbedding(n_neighbors=value).fit_transform(self.points),
            "lem": lambda: SpectralEmbedding(affinity="precomputed", random_state=0).fit_transform(
                adjacency(self.D, value)),
            "hlle": lambda: LocallyLinearEmbedding(n_neighbors=value, method="hessian")
                .fit_transform(self.points),
            "sde": lambda: unfolded(self.D, value),
        }[method]()

    def lpca(self):
        self.linear = PCA(2, svd_solver="full").fit_transform(self.X)
        return self.linear

    def smacof(self, iterations):
        self.equal, _ = smacof(self.D, n_components=2, init=self.linear, n_init=1,
                               max_iter=max(iterations, 1), eps=-numpy.inf,
                               normalized_stress=False)
        return self.equal

    @staticmethod
    def kernel(K):
        return KernelPCA(2, kernel="precomputed").fit_transform(K)
