#pragma once

#include <string>
#include <vector>

#include "core/model/slam/slam_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof::test {

/// A drive of `poses` through a field of 60 m x 50 m in parallel lanes past four landmarks, with
/// its ground truth, and what five methods made of it: each is the ground truth with an error of
/// its own kind.
SlamRun sample_drive(const std::string& id, int poses, std::uint64_t seed);

/// A walk of 500 steps among six landmarks, four of them known, as the 2013 paper simulates it.
SlamRun sample_walk();

/// Falling errors: landmarks and model by the root of the number of measurements, positions not at
/// all.
ConvergenceCurve sample_convergence(const std::string& id, const std::string& title, double level);

/// Seconds that follow N^2 T.
std::vector<FactorizationCost> sample_factorization();

/// The mapping methods on ranges and squared ranges of 30 landmarks.
RangeHistoryStudy sample_histories();

/// All of it in one study, without any solver.
SlamStudy sample_slam_study();
SlamTimings sample_slam_timings();

/// The figures of range-only SLAM, with tame data and with data that is hard to draw.
std::vector<Figure> sample_slam_figures();

}  // namespace mapproof::test
