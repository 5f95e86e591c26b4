#include "core/results/great_errors.hpp"

#include <fmt/format.h>

#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"

namespace mapproof {

bool has_great_errors(const Quantity& quantity, double least_m) {
  return quantity.unit == "m" && quantity.better == Better::kLower &&
         (find_quantity(quantity.id) != nullptr || least_m <= kGreatestError_m);
}

std::string great_errors_text(double before_m, double after_m) {
  return fmt::format("{} before and after ({} times as great)", kGreatErrorText,
                     significant(after_m / before_m));
}

}  // namespace mapproof
