#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace mapproof {

/// What can be told of a map without knowing the truth.
enum class Criterion {
  kStress,
  kResidualVariance,
  kTrustworthiness,
  kContinuity,
  kStability,
  kAnchors,
  kCombined,
};

inline constexpr std::size_t kCriteria = 7;

struct CriterionInfo {
  Criterion criterion;
  std::string_view name;   ///< In files: "residual-variance".
  std::string_view label;  ///< In tables and figures.
  std::string_view meaning;
  bool lower_is_better;
  bool needs_anchors = false;
};

/// All of them, in the order of the enumeration.
std::span<const CriterionInfo> all_criteria();

const CriterionInfo& info(Criterion criterion);

/// A value a criterion; NaN: it could not be told.
using CriterionValues = std::array<double, kCriteria>;

inline double& value_of(CriterionValues& values, Criterion criterion) {
  return values[static_cast<std::size_t>(criterion)];
}

inline double value_of(const CriterionValues& values, Criterion criterion) {
  return values[static_cast<std::size_t>(criterion)];
}

/// The criterion that picked best in the study of choice, with anchors or without.
Criterion usual_criterion(bool with_anchors);

}  // namespace mapproof
