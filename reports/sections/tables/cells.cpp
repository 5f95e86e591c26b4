#include "reports/sections/tables/cells.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/not_finite.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {

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

int mpe_decimals(std::span<const SettingSummary> summaries) {
  const bool small = std::ranges::any_of(summaries, [](const SettingSummary& summary) {
    return (summary.mpe_m && summary.mpe_m->mean < 0.1) ||
           (summary.published && summary.published->mpe_m < 0.1);
  });
  return small ? 4 : 3;
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

std::string interval_note(bool any_interval) {
  if (any_interval)
    return "95 % intervals are Student\u2019s t over layouts, since runs in one layout are not "
           "independent; those of errors are cut at 0.";
  return "All runs share one layout: no interval can be given.";
}

}  // namespace mapproof
