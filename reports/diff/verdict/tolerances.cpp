#include "reports/diff/verdict/tolerances.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/results/great_errors.hpp"

namespace mapproof {
namespace {

Tolerance changed_or(const Tolerances& changed, std::string_view id, const Tolerance& usual) {
  const auto found = changed.find(id);
  return found == changed.end() ? usual : found->second;
}

/// In as few characters as so many significant digits take; "none" for NaN.
std::string short_text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("none");
}

/// How many significant digits distinguish two numbers, at least the given count.
int distinguishing_digits(double baseline, double current, int digits) {
  constexpr int kAll = 17;
  while (digits < kAll && baseline != current &&
         short_text(baseline, digits) == short_text(current, digits))
    ++digits;
  return digits;
}

}  // namespace

Tolerance tolerance_of(const Quantity& quantity, const Tolerances& changed) {
  return changed_or(changed, quantity.id, quantity.rounding);
}

Tolerance tolerance_of_others(const Tolerances& changed) {
  return changed_or(changed, kOtherNumbers, Quantity{}.rounding);
}

std::pair<std::string, std::string> distinguished(double baseline, double current, int digits) {
  const int enough = distinguishing_digits(baseline, current, digits);
  return {short_text(baseline, enough), short_text(current, enough)};
}

std::pair<std::string, std::string> changed_numbers(double baseline, double current) {
  constexpr double kGreatestCount = 1e6;
  const auto is_count = [](double value) {
    return value == std::floor(value) && std::abs(value) < kGreatestCount;
  };
  const bool are_counts = is_count(baseline) && is_count(current);
  const int digits = distinguishing_digits(baseline, current, 3);
  const auto text = [&](double value) {
    if (!std::isfinite(value)) return std::string("none");
    return are_counts ? count_text(std::llround(value)) : significant(value, digits);
  };
  return {text(baseline), text(current)};
}

std::string change_text(double baseline, double current, std::string_view unit, bool errors_m) {
  const auto is_great = [errors_m](double value) { return errors_m && value > kGreatestError_m; };
  if (is_great(baseline) && is_great(current)) return great_errors_text(baseline, current);
  const auto [from, to] = changed_numbers(baseline, current);
  const std::string in_unit = unit.empty() ? "" : fmt::format(" {}", unit);
  if (is_great(baseline)) return fmt::format("{} \u2192 {}{}", kGreatErrorText, to, in_unit);
  if (is_great(current)) return fmt::format("{}{} \u2192 {}", from, in_unit, kGreatErrorText);
  return fmt::format("{} \u2192 {}{}", from, to, in_unit);
}

}  // namespace mapproof
