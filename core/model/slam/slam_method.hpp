#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/model/slam/slam.hpp"

namespace mapproof {

/// The ways to a path and a map from odometry and ranges that are compared with each other.
enum class SlamMethod {
  kDeadReckoning,        ///< Odometry alone; baseline.
  kEkf,                  ///< Extended Kalman filter; baseline.
  kSpectralKnown,        ///< Algorithm 1, rank 4, known landmarks [boots2013].
  kSpectralKnown7,       ///< With heading, rank 7 [boots2013, eq. 4], known landmarks.
  kSpectral,             ///< Rank 4, no landmark known: metric upgrade.
  kSpectral7,            ///< Rank 7, no landmark known.
  kBatchFixedScale,      ///< Nonlinear least squares, range scale held at 1; baseline.
  kRefined,              ///< Nonlinear least squares, scale free, started from kSpectral.
  kRefinedFromOdometry,  ///< The same, started from dead reckoning.
  kRefinedFromRandom,    ///< The same, landmarks started at random positions.
  kRepaired,             ///< Under the cause for which the data do not fit the map.
};

/// Everything about a method that needs no solver.
struct SlamMethodInfo {
  SlamMethod method;
  std::string_view name;   ///< In files and on the command line: "spectral-known".
  std::string_view label;  ///< In figures and tables.
  std::string_view summary;
  bool baseline = false;
  bool knows_landmarks = false;             ///< Needs four or more landmarks' true positions.
  Alignment alignment = Alignment::kRigid;  ///< Under which its error is reported first.
};

/// All of them in the order of the tables.
std::span<const SlamMethodInfo> all_slam_methods();
const SlamMethodInfo& info(SlamMethod method);
std::optional<SlamMethod> slam_method_named(std::string_view name);

}  // namespace mapproof
