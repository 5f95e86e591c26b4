#include "core/base/text/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/base/text/error_text.hpp"
#include "core/base/text/raised.hpp"
#include "core/base/text/unit_text.hpp"

namespace mapproof {
namespace {

/// Of the power of ten that a value has once it is rounded to so many significant digits: 0 of
/// 0.9996 to three, which is 1.00.
int rounded_exponent(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

/// Where the digits before the point end; without a sign, how many they are.
std::size_t end_of_whole(const std::string& text) { return std::min(text.find('.'), text.size()); }

/// "−25700.5" becomes "−25,700.5".
void set_thousands_apart(std::string& text) {
  constexpr std::size_t kGroup = 3;
  const std::size_t first = text.find_first_of("0123456789");
  for (std::size_t at = end_of_whole(text); at > first && at - first > kGroup;)
    text.insert(at -= kGroup, 1, ',');
}

}  // namespace

std::string ten_to_the(int exponent) { return "10" + raised(exponent); }

std::string power_of_ten(int exponent) { return "×" + ten_to_the(exponent); }

std::string count_text(long long count) { return count_text(count, count); }

std::string count_text(long long count, long long greatest) {
  constexpr long long kLeastGrouped = 10'000;
  const std::string sign = count < 0 ? "−" : "";
  std::string text = std::to_string(count).substr(count < 0 ? 1 : 0);
  if (std::abs(greatest) >= kLeastGrouped) set_thousands_apart(text);
  return sign + text;
}

std::string level_number_text(double value) {
  constexpr double kGreatestCount = 1e15;
  if (value == std::floor(value) && std::abs(value) < kGreatestCount)
    return count_text(std::llround(value));
  constexpr int kLeastExponent = -3;
  const int exponent = std::isfinite(value) ? rounded_exponent(value, 6) : 0;
  if (exponent >= kLeastExponent) {
    const std::string text = fmt::format("{:.6g}", value);
    return text[0] == '-' ? "−" + text.substr(1) : text;
  }
  const std::string factor = fmt::format("{:.6g}", std::abs(value) / std::pow(10.0, exponent));
  return (value < 0.0 ? "−" : "") +
         (factor == "1" ? ten_to_the(exponent) : factor + power_of_ten(exponent));
}

std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text[0] != '-') return text;
  text.erase(0, 1);
  if (text.find_first_not_of("0.") == std::string::npos) return text;
  return "−" + text;
}

std::string number_text(double value, int decimals, double greatest) {
  constexpr std::size_t kLeastGrouped = 5;  // Digits, as of count_text().
  std::string text = number_text(value, decimals);
  if (end_of_whole(number_text(std::abs(greatest), decimals)) >= kLeastGrouped)
    set_thousands_apart(text);
  return text;
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "unknown";
  if (value == 0.0) return "0";
  const int exponent = rounded_exponent(value, digits);
  if (exponent >= 6 || exponent < -6)
    return number_text(value / std::pow(10.0, exponent), digits - 1) + power_of_ten(exponent);
  const int decimals = std::max(0, digits - 1 - exponent);
  return decimals == 0 ? count_text(std::llround(value)) : number_text(value, decimals);
}

std::string rounded_text(double value, int decimals, double greatest, int digits) {
  constexpr int kMostDecimals = 6;
  std::string text = number_text(value, decimals, greatest);
  if (value == 0.0 || text.find_first_of("123456789") != std::string::npos) return text;
  return decimals >= kMostDecimals ? significant(value, digits) : "≈ 0";
}

namespace {

/// Whether a length is what rounding of coordinates leaves.
bool is_of_rounding(double length_m) { return length_m != 0.0 && std::abs(length_m) < 1e-9; }

constexpr const char* kOfRoundingText = "≈ 0 m";

}  // namespace

std::string quantity_text(double value, std::string_view unit) {
  if (unit == "m" && is_of_rounding(value)) return kOfRoundingText;
  constexpr double kGreatestCount = 1e6;
  const bool is_count =
      unit.empty() && value == std::floor(value) && std::abs(value) < kGreatestCount;
  return is_count ? count_text(std::llround(value)) : with_unit(significant(value), unit);
}

std::string error_text(double error_m) {
  if (error_m > kGreatestError_m) return kGreatErrorText;
  if (error_m < -kGreatestError_m) return kGreatGainText;
  if (is_of_rounding(error_m)) return kOfRoundingText;
  return std::isnan(error_m) ? significant(error_m) : significant(error_m) + " m";
}

std::string length_text(double length_m) {
  constexpr double kKilometre_m = 999.5;
  return length_m < kKilometre_m ? significant(length_m) + " m"
                                 : significant(length_m / 1000.0) + " km";
}

std::string seconds_text(double seconds) {
  constexpr double kLeastInMs = 0.9995e-3, kLeastInS = 0.9995;  // What is rounded to 1000 below.
  if (seconds < kLeastInMs) return significant(1e6 * seconds) + " µs";
  if (seconds < kLeastInS) return significant(1e3 * seconds) + " ms";
  return significant(seconds) + " s";
}

std::string data_number(double value) {
  std::string text = fmt::format("{:.6g}", value);
  // Who rounds it to three digits must not round twice: "0.2505" may be of 0.25049996.
  std::string digits = text.substr(0, text.find('e'));
  std::erase_if(digits, [](char c) { return c < '0' || c > '9'; });
  digits.erase(0, digits.find_first_not_of('0'));
  constexpr std::size_t kHalf = 4;
  return digits.size() == kHalf && digits.back() == '5' ? fmt::format("{:.12g}", value) : text;
}

}  // namespace mapproof
