#pragma once

#include "core/model/experiment.hpp"
#include "core/model/points.hpp"

namespace mapproof::test {

/// `rows` x `columns` points one unit apart.
Points grid(Eigen::Index rows, Eigen::Index columns);

/// n points uniform in the unit square.
Points scattered(Eigen::Index n, std::uint64_t seed);

/// Euclidean distances of all pairs.
Eigen::MatrixXd distances_of(const Points& points);

/// Largest distance between `points` and `estimate` after the best rotation, reflection, shift.
double procrustes_gap(const Points& points, const Points& estimate);

/// Largest distance between `points` and the affine image of `estimate` that fits them best.
double affine_gap(const Points& points, const Points& estimate);

/// A study that runs in milliseconds: 12 landmarks, 2 layouts x 2 poses, both sensors, all methods.
Experiment small_experiment();

}  // namespace mapproof::test
