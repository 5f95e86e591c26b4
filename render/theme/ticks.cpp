#include "render/theme/ticks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mapproof {
namespace {

std::string superscript(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

/// Digits behind the point that distinguish multiples of `step`.
int decimals_for(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 15);
}

std::string log_label(int factor, int exponent) {
  if (exponent >= -4 && exponent <= 5)
    return number_text(factor * std::pow(10.0, exponent), std::max(0, -exponent));
  return (factor == 1 ? "10" : fmt::format("{}×10", factor)) + superscript(exponent);
}

/// A round number below a range that is far from 0 for its extent; 0 if it is not.
double offset_below(double low, double high) {
  constexpr double kFewestDigits = 1e5;  // Of six digits, few would change along the axis.
  constexpr double kFar = 100.0;         // Extents from 0.
  const double nearest = low > 0.0 ? low : -high;
  if (!(high > low && nearest >= kFewestDigits && nearest >= kFar * (high - low))) return 0.0;
  const double round = std::pow(10.0, std::floor(std::log10(high - low)) + 1.0);
  return std::floor(low / round) * round;
}

}  // namespace

std::string power_of_ten(int exponent) { return "×10" + superscript(exponent); }

std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text[0] != '-') return text;
  text.erase(0, 1);
  if (text.find_first_not_of("0.") == std::string::npos) return text;
  return "−" + text;
}

double tick_step(double low, double high, int most) {
  const double least = (high - low) / std::max(most, 2);
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    const double step = factor * decade;
    const double count = std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1.0;
    if (count <= most) return step;
  }
  return 50.0 * decade;
}

Ticks linear_ticks(double low, double high, double step) {
  if (const double offset = offset_below(low, high); offset != 0.0) {
    Ticks ticks = linear_ticks(low - offset, high - offset, step);
    for (double& at : ticks.at) at += offset;
    const int decimals = decimals_for(std::pow(10.0, std::floor(std::log10(high - low)) + 1.0));
    ticks.factor = (offset < 0.0 ? "\u2212 " : "+ ") + number_text(std::abs(offset), decimals);
    return ticks;
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  const int exponent = static_cast<int>(std::floor(std::log10(largest)));
  const bool factored = exponent >= 6 || exponent <= -4;
  const double unit = factored ? std::pow(10.0, exponent) : 1.0;
  Ticks ticks;
  if (factored) ticks.factor = power_of_ten(exponent);
  const int decimals = decimals_for(step / unit);
  const double first = std::ceil(low / step - 1e-9);
  const double last = std::floor(high / step + 1e-9);
  for (double i = first; i <= last && ticks.at.size() < 100; i += 1.0) {
    ticks.at.push_back(i * step);
    ticks.labels.push_back(number_text(i * step / unit, decimals));
  }
  return ticks;
}

Ticks log_ticks(double low, double high, int most) {
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  const int decades = last - first + 1;
  Ticks ticks;
  const auto within = [&](double value) {
    return value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9);
  };
  const int stride = std::max(1, (decades + most - 1) / most);
  // With room for it, 1, 2 and 5 of few decades.
  const bool fine = decades < 3 && most > 2;
  for (int exponent = first - 1; exponent <= last; ++exponent) {
    const double decade = std::pow(10.0, exponent);
    for (const int factor : {1, 2, 3, 4, 5, 6, 7, 8, 9}) {
      const double value = factor * decade;
      if (!within(value)) continue;
      const bool labelled = (factor == 1 && (exponent - first) % stride == 0) ||
                            (fine && (factor == 2 || factor == 5));
      if (labelled) {
        ticks.at.push_back(value);
        ticks.labels.push_back(log_label(factor, exponent));
      } else if (stride == 1) {
        ticks.minor.push_back(value);
      }
    }
  }
  if (ticks.at.size() < 2) return linear_ticks(low, high, tick_step(low, high, most));
  return ticks;
}

}  // namespace mapproof
