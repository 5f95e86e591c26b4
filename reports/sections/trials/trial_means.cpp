#include "reports/sections/trials/trial_means.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"

namespace mapproof {

namespace {

std::size_t column_of(const TrialStudy& study, std::string_view quantity) {
  const auto& quantities = study.design.quantities;
  const auto found = std::ranges::find(quantities, quantity, &Quantity::id);
  if (found == quantities.end()) throw InvalidInput("a study of trials without that quantity");
  return static_cast<std::size_t>(found - quantities.begin());
}

/// NaN if it was not tried.
double value_of(const TrialPart& part, const Condition& at, std::string_view series,
                std::size_t column) {
  for (const Trial& trial : part.trials)
    if (trial.series == series && trial.at == at) return trial.values.at(column);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<double> trial_values(const TrialStudy& study, const Condition& at,
                                 std::string_view series, std::string_view quantity) {
  const std::size_t column = column_of(study, quantity);
  std::vector<double> values;
  for (const TrialPart& part : study.parts)
    if (const double value = value_of(part, at, series, column); std::isfinite(value))
      values.push_back(value);
  return values;
}

double trial_mean(const TrialStudy& study, const Condition& at, std::string_view series,
                  std::string_view quantity) {
  const std::vector<double> values = trial_values(study, at, series, quantity);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : sum / static_cast<double>(values.size());
}

std::string label_with_unit(const TrialFactor& factor) {
  return factor.unit.empty() ? factor.label : fmt::format("{} [{}]", factor.label, factor.unit);
}

std::string all_listed(const std::vector<std::string>& words) {
  return listed(words, words.size() + 1);
}

std::optional<MeanEstimate> trial_difference(const TrialStudy& study, const Condition& at,
                                             std::string_view series, std::string_view other,
                                             std::string_view quantity) {
  const std::size_t column = column_of(study, quantity);
  std::vector<double> differences;
  std::vector<int> layouts;
  for (const TrialPart& part : study.parts) {
    const double difference =
        value_of(part, at, series, column) - value_of(part, at, other, column);
    if (!std::isfinite(difference)) continue;
    differences.push_back(difference);
    layouts.push_back(part.run ? part.run->layout : 0);
  }
  if (differences.empty()) return std::nullopt;
  return clustered_mean(differences, layouts);
}

std::string verdict_words(const MeanEstimate& difference) {
  const char* side = difference.mean < 0.0 ? "better" : "worse";
  if (!difference.half_width) return fmt::format("{}, in one layout", side);
  if (std::abs(difference.mean) <= *difference.half_width) return "no different beyond chance";
  return side;
}

}  // namespace mapproof
