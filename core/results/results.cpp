#include "core/results/results.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/base/text/csv.hpp"

namespace mapproof {
namespace {

auto location_of(const Result& result) {
  return std::tie(result.at, result.method, result.quantity, result.run, result.subject);
}

auto location_of(const RunOutcome& outcome) {
  return std::tie(outcome.at, outcome.method, outcome.run);
}

}  // namespace

std::string level_text(const Level& level) {
  const auto* text = std::get_if<std::string>(&level.value);
  return text != nullptr ? *text : csv_number(std::get<double>(level.value));
}

Condition condition(std::string setup, std::vector<Level> levels) {
  std::ranges::sort(levels, {}, &Level::factor);
  return {.setup = std::move(setup), .levels = std::move(levels)};
}

bool comes_before(const Result& a, const Result& b) { return location_of(a) < location_of(b); }

void sort_results(Results& results) {
  std::ranges::stable_sort(results.rows, comes_before);
  std::ranges::stable_sort(results.outcomes, [](const RunOutcome& a, const RunOutcome& b) {
    return location_of(a) < location_of(b);
  });
}

std::string series_name(const Condition& at, const std::string& method,
                        const std::string& subject) {
  std::string name = at.setup + "/" + method;
  for (const Level& level : at.levels) {
    name += "/" + (level.factor == kStepsFactor ? "" : level.factor + "-") + level_text(level);
  }
  return subject.empty() ? name : name + "/" + subject;
}

std::string run_in_name(const Condition& at, const std::string& run) {
  return run == at.setup ? "" : run;
}

std::string record_name(const Condition& at, const std::string& method, const std::string& run) {
  const std::string first = run_in_name(at, run);
  return (first.empty() ? "" : first + "/") + series_name(at, method);
}

}  // namespace mapproof
