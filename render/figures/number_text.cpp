#include "render/figures/number_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/text/error_text.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "unknown";
  if (value == 0.0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  if (exponent >= 6 || exponent < -6)
    return number_text(value / std::pow(10.0, exponent), digits - 1) + power_of_ten(exponent);
  return number_text(value, std::max(0, digits - 1 - exponent));
}

std::string rounded_text(double value, int decimals, int digits) {
  constexpr int kMostDecimals = 6;
  std::string text = number_text(value, decimals);
  if (value == 0.0 || text.find_first_of("123456789") != std::string::npos) return text;
  return decimals >= kMostDecimals ? significant(value, digits) : "≈ 0";
}

std::string error_text(double error_m, int digits) {
  return error_m > kGreatestError_m ? kGreatErrorText : significant(error_m, digits) + " m";
}

std::string seconds_text(double seconds) {
  if (seconds < 1e-3) return significant(1e6 * seconds, 2) + " µs";
  if (seconds < 1.0) return significant(1e3 * seconds, 2) + " ms";
  return significant(seconds, 2) + " s";
}

std::string data_number(double value) { return fmt::format("{:.6g}", value); }

}  // namespace mapproof
