#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/method.hpp"
#include "core/model/slam/slam_method.hpp"

namespace mapproof {

/// What is wrong with simulated ranges.
struct RangeNoiseModel {
  std::string id;          ///< [a-z][a-z0-9-]*: "white".
  std::string title;       ///< For readers: "white noise, 1 % of range".
  double noise_m = 0;      ///< Standard deviation, m.
  double share = 0;        ///< The same as a share of the range; both add as variances.
  double correlation = 0;  ///< Of errors to one landmark one step apart, in [0, 1).
  bool plain_svd = false;  ///< What noise adds to the Gram matrix is left in, as the paper has it.
};

/// Random worlds of points that are ranged to at every step [boots2013, Figure 1]. What the paper
/// does not give is ours.
struct SlamWorldOptions {
  int landmarks = 6;
  int known = 4;               ///< The first so many have a known position.
  double half_width_m = 10.0;  ///< Landmarks and path lie in [-half_width, half_width]^2.
  double step_m = 1.0;
  double heading_change_sigma_rad = 0.5;  ///< Of the heading from step to step.
};

/// One world and walk that are shown.
struct SlamExample {
  std::string figure;  ///< Id of its figure: "fig-1a".
  int steps = 500;
  RangeNoiseModel noise;  ///< Its id is that of the run.
};

/// Errors over many random pairs of path and world, as measurements come in.
struct ConvergenceOptions {
  int pairs = 1000;
  /// Worlds whose known landmarks lie so near a line or circle that this condition number is
  /// exceeded are drawn again: a few of them would dominate the means.
  double most_condition = 1e6;
  std::vector<int> steps;  ///< Ascending.
  std::vector<RangeNoiseModel> noises;
};

/// What a paper prints of the drive it used.
struct PublishedDrive {
  double length_km = 0.0;
  long poses = 0;
  long measurements = 0;
};

/// A robot's log that is not part of the program.
struct SlamDataSet {
  std::string id;                  ///< [a-z][a-z0-9-]*: "plaza-1".
  std::string title;               ///< "Plaza 1".
  std::string figure;              ///< Id of the figure of its paths: "fig-2b".
  std::vector<std::string> files;  ///< Where it may be in the folder of the data; the first counts.
  std::string source;              ///< How to get it, a sentence.
  std::optional<PublishedDrive> published;
};

/// The mapping methods [yairi2007] on ranges of one world.
struct RangeHistoryOptions {
  int landmarks = 60;
  int steps = 1000;
  RangeNoiseModel noise;
  int neighbours = 8;  ///< K of the methods that have one; sigma2 and d are the usual ones.
  std::vector<Method> methods;
};

/// A flight in space over landmarks that are ranged to at every step.
struct SpaceFlightOptions {
  int landmarks = 12;
  int known = 6;  ///< The first so many have a known position.
  int steps = 400;
  double half_width_m = 10.0;  ///< Landmarks and flight lie in [-half_width, half_width]^2,
  double height_m = 8.0;       ///< from the ground to this height.
  double step_m = 1.0;
  double heading_change_sigma_rad = 0.3;  ///< Of the direction from step to step.
  RangeNoiseModel noise;
};

/// What the factorisation and upgrade are timed on.
struct FactorizationGrid {
  std::vector<int> landmarks;  ///< Ascending.
  std::vector<int> steps;      ///< Ascending.
};

/// A range-only study as it is ordered.
struct SlamExperiment {
  std::string name;  ///< Letters, digits, '-' and '_'.
  std::string title;
  std::uint64_t seed = 0;
  SlamWorldOptions world;
  std::optional<SlamExample> example;
  std::optional<ConvergenceOptions> convergence;
  std::vector<SlamDataSet> data;
  std::vector<SlamMethod> methods;  ///< Tried on each data set, in the order of the tables.
  int random_starts = 12;           ///< Of the refinement on each data set.
  std::optional<RangeHistoryOptions> histories;
  std::optional<SpaceFlightOptions> space;
  FactorizationGrid factorization;
};

}  // namespace mapproof
