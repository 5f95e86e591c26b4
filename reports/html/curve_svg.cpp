#include "reports/html/curve_svg.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mapproof {
namespace {

constexpr double kWidth = 160.0, kHeight = 28.0, kMargin = 3.0;
/// The least change that fills half of the height: less would show rounding as mountains.
constexpr double kLeastPercent = 1.0;

/// Less is the same for a reader: the rule for accuracy asks for as much.
const char* class_of(double percent) {
  if (percent >= kLeastPercent) return "worse";
  return percent <= -kLeastPercent ? "better" : "same";
}

}  // namespace

std::string curve_svg(const std::vector<double>& percent) {
  double most = kLeastPercent;
  for (const double value : percent)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  const double step = percent.size() > 1
                          ? (kWidth - 2 * kMargin) / static_cast<double>(percent.size() - 1)
                          : 0.0;
  const auto x = [&](std::size_t i) { return kMargin + step * static_cast<double>(i); };
  const auto y = [&](double value) {
    return kHeight / 2 - (kHeight / 2 - kMargin) * value / most;
  };
  std::string svg = fmt::format(
      "<svg class=\"curve\" viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" "
      "aria-hidden=\"true\" focusable=\"false\"><line class=\"zero\" x1=\"0\" x2=\"{}\" "
      "y1=\"{}\" y2=\"{}\"/>",
      kWidth, kHeight, kWidth, kHeight, kWidth, kHeight / 2, kHeight / 2);
  for (std::size_t i = 0; i + 1 < percent.size(); ++i)
    if (std::isfinite(percent[i]) && std::isfinite(percent[i + 1]))
      svg += fmt::format(
          "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
          class_of(percent[i + 1]), x(i), y(percent[i]), x(i + 1), y(percent[i + 1]));
  if (!percent.empty() && std::isfinite(percent.back()))
    svg += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/>",
                       class_of(percent.back()), x(percent.size() - 1), y(percent.back()));
  return svg + "</svg>";
}

}  // namespace mapproof
