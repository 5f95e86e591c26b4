#include "reports/sections/trials/trial_means.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

void check_quantity(const TrialStudy& study, std::string_view quantity) {
  const auto& quantities = study.design.quantities;
  if (std::ranges::find(quantities, quantity, &Quantity::id) == quantities.end())
    throw InvalidInput("a study of trials without that quantity");
}

/// NaN if it was not tried.
double value_in(const TrialPart& part, const Condition& at, std::string_view series,
                std::string_view quantity) {
  for (const Trial& trial : part.trials)
    if (trial.series == series && trial.at == at) return trial_value(trial, quantity);
  return kNaN;
}

}  // namespace

double trial_value(const Trial& trial, std::string_view quantity) {
  const auto found = trial.values.find(std::string(quantity));
  return found == trial.values.end() ? kNaN : found->second;
}

std::vector<double> trial_values(const TrialStudy& study, const Condition& at,
                                 std::string_view series, std::string_view quantity) {
  check_quantity(study, quantity);
  std::vector<double> values;
  for (const TrialPart& part : study.parts)
    if (const double value = value_in(part, at, series, quantity); std::isfinite(value))
      values.push_back(value);
  return values;
}

double trial_mean(const TrialStudy& study, const Condition& at, std::string_view series,
                  std::string_view quantity) {
  const std::vector<double> values = trial_values(study, at, series, quantity);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? kNaN : sum / static_cast<double>(values.size());
}

std::string level_words(const TrialSetup& setup, const Condition& at) {
  std::vector<std::string> words;
  for (const TrialFactor& factor : setup.factors) {
    const auto level = std::ranges::find(at.levels, factor.id, &Level::factor);
    if (level == at.levels.end()) continue;
    words.push_back(factor.label + " " +
                    with_unit(fmt::format("{:g}", std::get<double>(level->value)), factor.unit));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string series_label(const TrialDesign& design, std::string_view id) {
  const auto found = std::ranges::find(design.series, id, &TrialSeries::id);
  return found == design.series.end() ? std::string(id) : found->label;
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
  check_quantity(study, quantity);
  std::vector<double> differences;
  std::vector<int> layouts;
  for (const TrialPart& part : study.parts) {
    const double difference =
        value_in(part, at, series, quantity) - value_in(part, at, other, quantity);
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
