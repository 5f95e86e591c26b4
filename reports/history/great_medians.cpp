#include "reports/history/great_medians.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/results/great_errors.hpp"

namespace mapproof {

bool has_great_errors(const StudyTrend& trend, const Quantity& quantity) {
  if (!has_great_errors(quantity, 0.0)) return false;
  double least = kInfinity;
  for (const auto& [id, values] : trend.medians) {
    if (id.quantity != quantity.id) continue;
    for (const double value : values)
      if (std::isfinite(value)) least = std::min(least, value);
  }
  return has_great_errors(quantity, least);
}

std::string median_text(double median, const std::string& unit, bool great_errors) {
  return great_errors && median > kGreatestError_m ? kGreatErrorText : quantity_text(median, unit);
}

std::string medians_text(double before, double after, const std::string& unit, bool great_errors) {
  const auto is_great = [&](double value) { return great_errors && value > kGreatestError_m; };
  if (is_great(before) && is_great(after)) return great_errors_text(before, after);
  const bool is_either = is_great(before) || is_great(after);
  return fmt::format("{} → {}",
                     is_either ? median_text(before, unit, great_errors) : significant(before),
                     median_text(after, unit, great_errors));
}

}  // namespace mapproof
