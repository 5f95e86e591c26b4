#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/evaluate/landmark_evaluation.hpp"
#include "core/evaluate/path_evaluation.hpp"
#include "core/results/results_study.hpp"

namespace mapproof {

/// What one system estimated in one run, compared with the ground truth.
struct EvaluatedRun {
  std::string method = {};
  std::string run = {};
  std::string group = {};  ///< Of runs that depend on each other.
  std::optional<PathEvaluation> path = {};
  std::optional<LandmarkEvaluation> landmarks = {};
  bool has_path = false,
       has_landmarks = false;  ///< What was to be compared, be it possible or not.
};

/// Of the poses that could be: with fewer associated, errors are of a part of the path. Complete
/// pairs of files have 99.6 % and more, one whose ground truth pauses 75 %.
inline constexpr const char* kAssociatedPercent = "associated_percent";
inline constexpr double kFewAssociated_percent = 90.0;

/// The errors as a study of results without name, title and question. Setups: `poses` (absolute
/// errors), `distance`, `time` and `frames` (relative errors over the factors `distance_m`,
/// `seconds` and `poses`), `landmarks`. What a run should have and has not is lost.
ResultsStudy evaluation_study(const std::vector<EvaluatedRun>& runs,
                              const std::vector<PairSpacing>& spacings);

}  // namespace mapproof
