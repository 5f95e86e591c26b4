#include "core/base/median.hpp"

#include <algorithm>

#include "core/base/errors.hpp"

namespace mapproof {

double median(std::span<const double> values) {
  if (values.empty()) throw InvalidInput("median: no value");
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * sorted[half - 1] + 0.5 * sorted[half];
}

double upper_median(std::vector<double> values) {
  if (values.empty()) throw InvalidInput("upper_median: no value");
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace mapproof
