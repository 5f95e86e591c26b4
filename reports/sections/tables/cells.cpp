#include "reports/sections/tables/cells.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr int kSignificant = 3;

/// Before the point: 2 of 12.3, −1 of 0.0123.
int digits_before(double size) { return static_cast<int>(std::floor(std::log10(size))) + 1; }

}  // namespace

Cell method_cell(Method method) { return TextCell{std::string(info(method).label)}; }

Cell parameter_cell(const std::optional<MethodSetting>& setting) {
  const std::string text = setting ? parameter_text(*setting) : "";
  if (text.empty()) return MissingCell{};
  return TextCell{text};
}

Cell mean_cell(const std::optional<MeanEstimate>& estimate, int decimals, bool with_sign) {
  if (!estimate) return MissingCell{};
  return NumberCell{estimate->mean, decimals, with_sign};
}

Cell interval_cell(const std::optional<MeanEstimate>& estimate, int decimals) {
  const auto interval = interval_of(estimate);
  if (!interval) return MissingCell{};
  return IntervalCell{interval->low, interval->high, decimals};
}

Cell difference_interval_cell(const std::optional<MeanEstimate>& estimate, int decimals) {
  if (!estimate || !estimate->half_width) return MissingCell{};
  return IntervalCell{estimate->mean - *estimate->half_width,
                      estimate->mean + *estimate->half_width, decimals};
}

int decimals_of(std::vector<double> sizes) {
  constexpr int kMostMore = 2;
  constexpr int kMost = 6;
  std::erase_if(sizes, [](double size) { return !std::isfinite(size) || size == 0.0; });
  for (double& size : sizes) size = std::abs(size);
  if (std::ranges::all_of(sizes, [](double size) { return size == std::floor(size); })) return 0;
  const int decimals = kSignificant - digits_before(median(sizes));
  const int of_least = kSignificant - digits_before(std::ranges::min(sizes));
  return std::clamp(std::clamp(of_least, decimals, decimals + kMostMore), 0, kMost);
}

int error_decimals(std::vector<double> errors_m) {
  constexpr int kFewest = 3;
  std::erase_if(errors_m, [](double error_m) { return error_m > kGreatestError_m; });
  return std::max(decimals_of(std::move(errors_m)), kFewest);
}

int mpe_decimals(const Study& study) {
  std::vector<double> errors;
  for (const SensorStudy& sensor : study.experiment.sensors)
    for (const SettingSummary& summary :
         best_of_each_method(summarize(study, sensor, last_step(sensor)))) {
      if (summary.mpe_m) errors.push_back(summary.mpe_m->mean);
      if (summary.published) errors.push_back(summary.published->mpe_m);
    }
  return error_decimals(std::move(errors));
}

int printed_decimals(double printed) {
  if (!std::isfinite(printed) || printed == 0.0) return 0;
  const std::string text = fmt::format("{:f}", printed);
  const auto needed = static_cast<int>(text.find_last_not_of('0') - text.find('.'));
  return std::max(kSignificant - digits_before(std::abs(printed)), needed);
}

int position_decimals(const Points& positions) {
  constexpr int kUsual = 3, kMost = 12;
  double extent = 0.0;
  for (const auto& axis : positions.colwise()) {
    double low = kInfinity, high = -kInfinity;
    for (const double coordinate : axis)
      if (std::isfinite(coordinate)) {
        low = std::min(low, coordinate);
        high = std::max(high, coordinate);
      }
    extent = std::max(extent, high - low);
  }
  if (!(extent > 0.0 && std::isfinite(extent))) return kUsual;
  return std::clamp(kUsual - static_cast<int>(std::floor(std::log10(extent))), kUsual, kMost);
}

Cell position_cell(double coordinate, int decimals) {
  return NumberCell{.value = coordinate, .decimals = decimals};
}

void drop_empty_columns(Table& table) {
  for (std::size_t i = table.columns.size(); i-- > 0;) {
    const bool is_empty = std::ranges::all_of(table.rows, [i](const Row& row) {
      return std::holds_alternative<MissingCell>(row.cells[i]);
    });
    if (!is_empty) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    table.columns.erase(table.columns.begin() + at);
    for (Row& row : table.rows) row.cells.erase(row.cells.begin() + at);
  }
}

std::string interval_note(bool any_interval) {
  if (any_interval)
    return "95 % intervals are Student\u2019s t over layouts, since runs in one layout are not "
           "independent; those of errors are cut at 0.";
  return "All runs share one layout: no interval can be given.";
}

}  // namespace mapproof
