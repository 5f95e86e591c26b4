#include "reports/diff/verdict/tolerances.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mapproof {
namespace {

Tolerance changed_or(const Tolerances& changed, std::string_view id, const Tolerance& usual) {
  const auto found = changed.find(id);
  return found == changed.end() ? usual : found->second;
}

}  // namespace

Tolerance tolerance_of(const Quantity& quantity, const Tolerances& changed) {
  return changed_or(changed, quantity.id, quantity.rounding);
}

Tolerance tolerance_of_others(const Tolerances& changed) {
  return changed_or(changed, kOtherNumbers, Quantity{}.rounding);
}

std::pair<std::string, std::string> distinguished(double baseline, double current, int digits) {
  constexpr int kAll = 17;
  const auto text = [&](double value) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("none");
  };
  while (digits < kAll && baseline != current && text(baseline) == text(current)) ++digits;
  return {text(baseline), text(current)};
}

std::string change_text(double baseline, double current, std::string_view unit) {
  const auto [from, to] = distinguished(baseline, current, 3);
  return fmt::format("{} \u2192 {}{}{}", from, to, unit.empty() ? "" : " ", unit);
}

}  // namespace mapproof
