#include "app/own_missing.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "core/missing/covisible.hpp"
#include "core/missing/filled.hpp"

namespace mapproof {
namespace {

constexpr const char* kCovisible = "covisible";

ProximityRule covisible_rule(MissingOutcome& outcome) {
  return [&outcome](const ObservationHistory& history, Eigen::Index steps) {
    const CovisibleOptions options;
    if (outcome.remarks.empty())
      outcome.remarks.push_back(
          fmt::format("Distances are those of landmarks often observed together: the {} of each "
                      "that share most "
                      "of its steps, {} or more of them; others take the shortest path.",
                      options.neighbours, options.least_common));
    return covisible_proximities(history, steps, options);
  };
}

ProximityRule filling_rule(Filling filling, int dimensions, MissingOutcome& outcome) {
  return [=, &outcome](const ObservationHistory& history, Eigen::Index steps) {
    FillingOptions options;
    options.filling = filling;
    options.ppca.dimensions = options.pca.dimensions = dimensions;
    FilledProximities filled = filled_proximities(history, steps, options);
    for (const Status& status : filled.statuses)
      if (std::ranges::find(outcome.statuses, status) == outcome.statuses.end())
        outcome.statuses.push_back(status);
    const auto missing = history.values.leftCols(steps).array().isNaN().count();
    if (filled.model.loadings.size() > 0 && outcome.remarks.empty())
      outcome.remarks.push_back(fmt::format(
          "Entries filled in by {2} of {1}: {0}. They count as missing at random; where "
          "distant landmarks alone are missing, common steps give better maps.",
          missing, counted(filled.model.loadings.cols(), "dimension"),
          filling == Filling::kPpca ? "PPCA" : "PCA"));
    return std::move(filled.proximities);
  };
}

}  // namespace

std::vector<std::string> missing_ways() {
  return {std::string(name(Filling::kCommonSteps)), std::string(name(Filling::kPpca)),
          std::string(name(Filling::kPca)), kCovisible};
}

ProximityRule proximity_rule(const MissingChoice& choice, Sensor sensor, MissingOutcome& outcome) {
  const std::optional<Filling> filling = filling_named(choice.way);
  const bool fills = filling == Filling::kPpca || filling == Filling::kPca;
  if (choice.dimensions && !fills)
    throw InvalidInput(fmt::format("--dimensions: --missing {} has none", choice.way));
  if (fills) return filling_rule(*filling, choice.dimensions.value_or(10), outcome);
  if (choice.way != kCovisible) return {};
  if (sensor == Sensor::kVisibility)
    throw InvalidInput(
        "--missing covisible: it is for bearings and ranges; visibility itself says what was seen");
  return covisible_rule(outcome);
}

}  // namespace mapproof
