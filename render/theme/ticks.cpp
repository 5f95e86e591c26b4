#include "render/theme/ticks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/base/text/number_text.hpp"

namespace mapproof {
namespace {

/// Digits behind the point that distinguish multiples of `step`.
int decimals_for(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 15);
}

/// Whether the numbers of a decade are written as such: "10⁵" is shorter than "100000".
bool is_plain(int exponent) { return exponent >= -4 && exponent <= 4; }

std::string log_label(int factor, int exponent, bool plain, double greatest) {
  if (plain)
    return number_text(factor * std::pow(10.0, exponent), std::max(0, -exponent), greatest);
  return factor == 1 ? ten_to_the(exponent) : std::to_string(factor) + power_of_ten(exponent);
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

constexpr std::size_t kFewestLogLabels = 3;

/// Which multiples of a power of ten are labelled, from few to many.
constexpr std::array<std::string_view, 6> kLabelledFactors = {"1",    "13",    "125",
                                                              "1235", "12357", "123456789"};
constexpr std::size_t kOneTwoFive = 2;

int first_decade(double low) { return static_cast<int>(std::ceil(std::log10(low) - 1e-9)); }

int whole_decades(double low, double high) {
  return static_cast<int>(std::floor(std::log10(high) + 1e-9)) - first_decade(low) + 1;
}

/// Labels at every `stride`-th power of ten, and at the multiples of `detail`.
Ticks log_ticks_of(double low, double high, int stride, std::size_t detail) {
  const int first = first_decade(low), last = first + whole_decades(low, high) - 1;
  Ticks ticks;
  std::vector<std::pair<int, int>> labelled;  // Factor and exponent.
  for (int exponent = first - 1; exponent <= last; ++exponent) {
    for (int factor = 1; factor <= 9; ++factor) {
      const double value = factor * std::pow(10.0, exponent);
      if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
      const bool in_detail =
          kLabelledFactors[detail].find(static_cast<char>('0' + factor)) != std::string_view::npos;
      if (in_detail && (factor > 1 || (exponent - first) % stride == 0)) {
        ticks.at.push_back(value);
        labelled.emplace_back(factor, exponent);
      } else if (stride == 1) {
        ticks.minor.push_back(value);
      }
    }
  }
  const bool plain =
      std::ranges::all_of(labelled, [](const auto& label) { return is_plain(label.second); });
  for (const auto& [factor, exponent] : labelled)
    ticks.labels.push_back(log_label(factor, exponent, plain, ticks.at.back()));
  return ticks;
}

/// The first, the last, and the tick nearest to the middle between them.
Ticks three_of(const Ticks& all) {
  const std::size_t last = all.at.size() - 1;
  const double middle = std::sqrt(all.at.front() * all.at.back());
  std::size_t nearest = 1;
  for (std::size_t i = 2; i < last; ++i)
    if (std::abs(std::log(all.at[i] / middle)) < std::abs(std::log(all.at[nearest] / middle)))
      nearest = i;
  Ticks three{.at = {}, .labels = {}, .minor = all.minor, .factor = all.factor};
  for (const std::size_t i : {std::size_t{0}, nearest, last}) {
    three.at.push_back(all.at[i]);
    three.labels.push_back(all.labels[i]);
  }
  for (std::size_t i = 1; i < last; ++i)
    if (i != nearest) three.minor.push_back(all.at[i]);
  return three;
}

/// The smaller of the two distances of three ticks, of the axis.
double least_distance(const Ticks& three, double low, double high) {
  return std::min(std::log(three.at[1] / three.at[0]), std::log(three.at[2] / three.at[1])) /
         std::log(high / low);
}

}  // namespace

double tick_step(double low, double high, int most) {
  const double least = (high - low) / std::max(most, 2);
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  double finer = decade;
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    const double step = factor * decade;
    const double count = std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1.0;
    // One tick gives no scale: rather a few more than asked for.
    if (count < 2.0) return finer;
    if (count <= most) return step;
    finer = step;
  }
  return 50.0 * decade;
}

Ticks linear_ticks(double low, double high, double step) {
  if (const double offset = offset_below(low, high); offset != 0.0) {
    Ticks ticks = linear_ticks(low - offset, high - offset, step);
    for (double& at : ticks.at) at += offset;
    ticks.offset = offset;
    const int decimals = decimals_for(std::pow(10.0, std::floor(std::log10(high - low)) + 1.0));
    const double size = std::abs(offset);
    ticks.factor = (offset < 0.0 ? "\u2212 " : "+ ") + number_text(size, decimals, size);
    return ticks;
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  const int exponent = static_cast<int>(std::floor(std::log10(largest)));
  const bool factored = exponent >= 6 || exponent <= -4;
  const double unit = factored ? std::pow(10.0, exponent) : 1.0;
  Ticks ticks;
  ticks.unit = unit;
  if (factored) ticks.factor = power_of_ten(exponent);
  const int decimals = decimals_for(step / unit);
  const double first = std::ceil(low / step - 1e-9);
  const double last = std::floor(high / step + 1e-9);
  for (double i = first; i <= last && ticks.at.size() < 100; i += 1.0) {
    ticks.at.push_back(i * step);
    ticks.labels.push_back(number_text(i * step / unit, decimals, largest / unit));
  }
  return ticks;
}

Ticks log_ticks(double low, double high, int most) {
  const int decades = whole_decades(low, high);
  int stride = std::max(1, (decades + most - 1) / most);
  // With room for it, 1, 2 and 5 of few decades.
  std::size_t detail = decades < 3 && most > 2 ? kOneTwoFive : 0;
  Ticks ticks = log_ticks_of(low, high, stride, detail);
  // A logarithm is read from three labels: the distance of two says nothing of the next one.
  while (ticks.at.size() < kFewestLogLabels && stride > 1)
    ticks = log_ticks_of(low, high, --stride, detail);
  while (ticks.at.size() < kFewestLogLabels && detail + 1 < kLabelledFactors.size())
    ticks = log_ticks_of(low, high, stride, ++detail);
  if (ticks.at.size() >= kFewestLogLabels) return ticks;
  for (int count = std::max(most, 3); ticks.at.size() < kFewestLogLabels && count < 12; ++count)
    ticks = linear_ticks(low, high, tick_step(low, high, count));
  return ticks;
}

Ticks three_log_ticks(double low, double high) {
  constexpr double kFarEnough = 0.3;  // Of the axis; rounder numbers are preferred to more.
  Ticks best;
  for (std::size_t detail = 0; detail < kLabelledFactors.size(); ++detail) {
    const Ticks all = log_ticks_of(low, high, 1, detail);
    if (all.at.size() < kFewestLogLabels) continue;
    const Ticks three = three_of(all);
    const double distance = least_distance(three, low, high);
    if (distance >= kFarEnough) return three;
    if (best.at.empty() || distance > least_distance(best, low, high)) best = three;
  }
  return best.at.empty() ? log_ticks(low, high, 2) : best;
}

}  // namespace mapproof
