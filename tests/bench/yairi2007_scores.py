"""MPE and MOE as docs/methods/alignment-and-scores.md has them, in numpy over all landmarks and
triples at once."""
import functools
import itertools

import numpy


def with_ones(points):
    return numpy.hstack([points, numpy.ones((len(points), 1))])


def through_three_of_four(source, target):
    """The affine map of least summed distance of four points meets three of them."""
    A = with_ones(source)
    triples = [list(triple) for triple in itertools.combinations(range(4), 3)]
    maps = numpy.linalg.solve(A[triples], target[triples])
    sums = numpy.linalg.norm(A @ maps - target, axis=2).sum(axis=1)
    return maps[sums.argmin()]


def least_distances(source, target, rounds=30):
    """Iteratively reweighted least squares."""
    A = with_ones(source)
    weights = numpy.ones(len(A))
    for _ in range(rounds):
        weighted = A * weights[:, None]
        affine = numpy.linalg.solve(weighted.T @ A, weighted.T @ target)
        residuals = numpy.linalg.norm(A @ affine - target, axis=1)
        weights = 1.0 / numpy.maximum(residuals, 1e-9)
    return affine


@functools.lru_cache
def triples_of(count):
    return tuple(numpy.array(list(itertools.combinations(range(count), 3))).T)


def turns(points):
    """The sign of the way each triple turns."""
    x, y = points.T
    i, j, k = triples_of(len(points))
    return numpy.sign((x[j] - x[i]) * (y[k] - y[i]) - (y[j] - y[i]) * (x[k] - x[i]))


def score(embedding, ground_truth, anchors):
    fit = through_three_of_four if len(anchors) == 4 else least_distances
    estimate = with_ones(embedding) @ fit(embedding[anchors], ground_truth[anchors])
    errors = numpy.linalg.norm(estimate - ground_truth, axis=1)
    all_fitted = with_ones(embedding) @ least_distances(embedding, ground_truth)
    moe = 100.0 * numpy.mean(turns(estimate) != turns(ground_truth))
    return {"estimate": estimate, "mpe_m": numpy.delete(errors, anchors).mean(),
            "mpe_all_fitted_m": numpy.linalg.norm(all_fitted - ground_truth, axis=1).mean(),
            "moe_percent": moe, "moe_unmirrored_percent": min(moe, 100.0 - moe)}
