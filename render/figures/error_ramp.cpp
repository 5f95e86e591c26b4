#include "render/figures/error_ramp.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"

namespace mapproof {

double end_of_error_ramp(std::vector<double> errors_m) {
  constexpr double kPercentile = 0.95, kLeast_m = 1e-6;
  std::erase_if(errors_m, [](double error_m) { return !std::isfinite(error_m); });
  if (errors_m.empty()) return kLeast_m;
  const auto rank = static_cast<std::ptrdiff_t>(
      std::lround(kPercentile * static_cast<double>(errors_m.size() - 1)));
  const auto at = errors_m.begin() + rank;
  std::ranges::nth_element(errors_m, at);
  return std::max(*at, kLeast_m);
}

std::string error_ramp_text(double end_m) {
  return fmt::format("0 to {} m or more", significant(end_m, 2));
}

}  // namespace mapproof
