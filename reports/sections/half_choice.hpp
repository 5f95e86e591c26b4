#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/model/study.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

/// How the runs were parted, so that a parameter is not judged by the runs that chose it.
enum class Halves {
  kLayouts,  ///< The 1st, 3rd, … layout against the 2nd, 4th, …: no layout is in both.
  kPoses,    ///< The same with the initial poses of the one layout.
  kNone,     ///< One run or none: there are no halves.
};

/// A method whose parameter was chosen on one half of the runs and judged on the other, both ways.
struct HalfChoice {
  Method method = Method::kLpca;
  bool has_choice = false;  ///< More than one parameter was tried.
  /// Of least mean MPE on the first half, and on the second; empty if none was scored there.
  std::array<std::optional<MethodSetting>, 2> chosen;
  /// Over all runs, each with the parameter chosen on the half that it is not in.
  std::optional<MeanEstimate> mpe_m;
  std::optional<MeanEstimate> moe_percent;
  /// Over the same runs, with the parameter of least mean MPE over all of them.
  std::optional<MeanEstimate> same_runs_mpe_m;
  /// By how much choosing and judging on the same runs flatters: the former MPE less the latter,
  /// run by run.
  std::optional<MeanEstimate> optimism_m;
};

struct HalfChoices {
  Halves halves = Halves::kNone;
  std::array<std::vector<int>, 2> members;  ///< Numbers of the layouts, or of the poses.
  std::vector<HalfChoice> methods;          ///< Empty if there are no halves.
};

/// The honest twin of best_of_each_method(), for every method of `sensor` at its last checkpoint.
/// Means and intervals as in clustered_mean(); deterministic.
HalfChoices half_choices(const Study& study, const SensorStudy& sensor);

/// The optimism in percent of the MPE that it flatters; NaN if unknown.
double optimism_percent(const HalfChoice& choice);

}  // namespace mapproof
