#include "reports/sections/topics/topic_means.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {
namespace {

void check_quantity(const TopicStudy& study, std::string_view quantity) {
  const auto& quantities = study.design.quantities;
  if (std::ranges::find(quantities, quantity, &Quantity::id) == quantities.end())
    throw InvalidInput("the study of a topic without that quantity");
}

/// NaN if it was not tried.
double value_in(const TopicPart& part, const Condition& at, std::string_view method,
                std::string_view quantity) {
  for (const TopicOutcome& outcome : part.outcomes)
    if (outcome.method == method && outcome.at == at) return topic_value(outcome, quantity);
  return kNaN;
}

}  // namespace

double topic_value(const TopicOutcome& outcome, std::string_view quantity) {
  const auto found = outcome.values.find(std::string(quantity));
  return found == outcome.values.end() ? kNaN : found->second;
}

std::vector<double> topic_values(const TopicStudy& study, const Condition& at,
                                 std::string_view method, std::string_view quantity) {
  check_quantity(study, quantity);
  std::vector<double> values;
  for (const TopicPart& part : study.parts)
    if (const double value = value_in(part, at, method, quantity); std::isfinite(value))
      values.push_back(value);
  return values;
}

double topic_mean(const TopicStudy& study, const Condition& at, std::string_view method,
                  std::string_view quantity) {
  const std::vector<double> values = topic_values(study, at, method, quantity);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? kNaN : sum / static_cast<double>(values.size());
}

std::string level_words(const TopicSetup& setup, const Condition& at) {
  std::vector<std::string> words;
  for (const SetupFactor& factor : setup.factors) {
    const auto level = std::ranges::find(at.levels, factor.id, &Level::factor);
    if (level == at.levels.end()) continue;
    words.push_back(factor.label + " " +
                    with_unit(level_number_text(std::get<double>(level->value)), factor.unit));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string series_label(const TopicDesign& design, std::string_view id) {
  const auto found = std::ranges::find(design.methods, id, &StudiedMethod::id);
  return found == design.methods.end() ? std::string(id) : found->label;
}

std::string label_with_unit(const SetupFactor& factor) {
  return factor.unit.empty() ? factor.label : fmt::format("{} [{}]", factor.label, factor.unit);
}

std::string all_listed(const std::vector<std::string>& words) {
  return listed(words, words.size() + 1);
}

std::optional<MeanEstimate> topic_difference(const TopicStudy& study, const Condition& at,
                                             std::string_view method, std::string_view other,
                                             std::string_view quantity) {
  return topic_difference(study, std::vector{at}, method, other, quantity);
}

std::optional<MeanEstimate> topic_difference(const TopicStudy& study,
                                             const std::vector<Condition>& conditions,
                                             std::string_view method, std::string_view other,
                                             std::string_view quantity) {
  check_quantity(study, quantity);
  std::vector<double> differences;
  std::vector<int> layouts;
  for (const TopicPart& part : study.parts)
    for (const Condition& at : conditions) {
      const double difference =
          value_in(part, at, method, quantity) - value_in(part, at, other, quantity);
      if (!std::isfinite(difference)) continue;
      differences.push_back(difference);
      layouts.push_back(part.run ? part.run->layout : 0);
    }
  if (differences.empty()) return std::nullopt;
  return clustered_mean(differences, layouts);
}

std::vector<Condition> all_conditions(const TopicStudy& study) {
  std::vector<Condition> all;
  for (const TopicSetup& setup : study.design.setups)
    for (Condition& at : conditions_of(setup)) all.push_back(std::move(at));
  return all;
}

int layouts_of(const TopicStudy& study) {
  std::set<int> layouts;
  for (const TopicPart& part : study.parts) layouts.insert(part.run ? part.run->layout : 0);
  return static_cast<int>(layouts.size());
}

bool has_few_layouts(const TopicStudy& study) {
  return std::cmp_less(layouts_of(study), kFewestGroups);
}

std::string few_layouts_words(const TopicStudy& study) {
  return has_few_layouts(study)
             ? "; too few runs to test differences, in " + counted(layouts_of(study), "layout")
             : "";
}

bool has_few_layouts(const MeanEstimate& difference) {
  return std::cmp_less(difference.clusters, kFewestGroups);
}

bool is_apart_from_0(const MeanEstimate& difference) {
  return difference.half_width && !has_few_layouts(difference) &&
         std::abs(difference.mean) > *difference.half_width;
}

bool is_better(const MeanEstimate& difference) {
  return is_apart_from_0(difference) && difference.mean < 0.0;
}

std::string verdict_words(const MeanEstimate& difference) {
  if (has_few_layouts(difference))
    return fmt::format("too few runs to test the difference, in {}",
                       counted(difference.clusters, "layout"));
  if (!is_apart_from_0(difference)) return "not significantly different";
  return difference.mean < 0.0 ? "better" : "worse";
}

}  // namespace mapproof
