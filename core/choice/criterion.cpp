#include "core/choice/criterion.hpp"

namespace mapproof {

std::span<const CriterionInfo> all_criteria() {
  static constexpr CriterionInfo kInfos[] = {
      {.criterion = Criterion::kStress,
       .name = "stress",
       .label = "Stress",
       .meaning = "share of the squared observation distances that the map's, scaled, do not have",
       .lower_is_better = true},
      {.criterion = Criterion::kResidualVariance,
       .name = "residual-variance",
       .label = "Residual variance",
       .meaning = "1 - R^2 of the map's distances and those along the neighbour graph",
       .lower_is_better = true},
      {.criterion = Criterion::kTrustworthiness,
       .name = "trustworthiness",
       .label = "Trustworthiness",
       .meaning = "whether neighbours on the map are neighbours in the observations",
       .lower_is_better = false},
      {.criterion = Criterion::kContinuity,
       .name = "continuity",
       .label = "Continuity",
       .meaning = "whether neighbours in the observations are neighbours on the map",
       .lower_is_better = false},
      {.criterion = Criterion::kStability,
       .name = "stability",
       .label = "Instability",
       .meaning = "how far maps of steps drawn anew lie from the map, in its size",
       .lower_is_better = true},
      {.criterion = Criterion::kAnchors,
       .name = "anchors",
       .label = "Anchors left out",
       .meaning = "how far each anchor is from where the others put it, m",
       .lower_is_better = true,
       .needs_anchors = true},
      {.criterion = Criterion::kCombined,
       .name = "combined",
       .label = "Mean rank",
       .meaning = "mean of the ranks by the other criteria",
       .lower_is_better = true},
  };
  return kInfos;
}

const CriterionInfo& info(Criterion criterion) {
  return all_criteria()[static_cast<std::size_t>(criterion)];
}

Criterion usual_criterion(bool) { return Criterion::kContinuity; }

}  // namespace mapproof
