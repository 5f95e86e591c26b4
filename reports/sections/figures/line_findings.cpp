#include "reports/sections/figures/line_findings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

/// The quotient of two values of a line.
struct Ratio {
  const ErrorLine* line = nullptr;
  double value = kNaN;
};

std::string times(double ratio) { return significant(ratio, 2) + " times"; }

/// The indices of the values that are known, by their size.
std::vector<std::size_t> known_ascending(const ErrorLine& line) {
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < line.mean.size(); ++i)
    if (std::isfinite(line.mean[i])) known.push_back(i);
  std::ranges::stable_sort(known, {}, [&](std::size_t i) { return line.mean[i]; });
  return known;
}

}  // namespace

std::string change_finding(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                           const std::string& last, const std::string& first) {
  std::vector<Ratio> changes;
  for (const ErrorLine& line : lines)
    if (line.mean.size() > 1 && line.mean.front() > 0.0 &&
        std::isfinite(line.mean.front() + line.mean.back()))
      changes.push_back({&line, line.mean.back() / line.mean.front()});
  if (changes.size() < 2) return "";
  const auto [least, most] = std::ranges::minmax(changes, {}, &Ratio::value);
  const auto words = [&](const Ratio& change) {
    return fmt::format("{} ({}, {})", times(change.value), line_name(*change.line, lines),
                       quantity_text(change.line->mean.back(), quantity.unit));
  };
  const bool all_tie =
      std::ranges::all_of(changes, [](const Ratio& change) { return ends_tie(*change.line); });
  const std::string whose =
      changes.size() < lines.size() ? fmt::format(" of {} methods", changes.size()) : "";
  return fmt::format("{}, the {}{} is {} to {} that {}{}", last, quantity.label, whose,
                     words(least), words(most), first, all_tie ? "; the intervals overlap" : "");
}

std::string dependence_finding(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                               const std::string& symbol, bool names_best) {
  std::vector<Ratio> worst;
  std::vector<double> best;
  for (const ErrorLine& line : lines) {
    const std::vector<std::size_t> known = known_ascending(line);
    if (known.size() < 2 || !(line.mean[known.front()] > 0.0)) continue;
    worst.push_back({&line, line.mean[known.back()] / line.mean[known.front()]});
    best.push_back(line.x[known.front()]);
  }
  if (worst.size() < 2) return "";
  const auto [least, most] = std::ranges::minmax(worst, {}, &Ratio::value);
  const std::string depends = fmt::format("least with {} (worst {} the best), most with {} ({})",
                                          line_name(*least.line, lines), times(least.value),
                                          line_name(*most.line, lines), times(most.value));
  if (!names_best) return fmt::format("the {} depends on {} {}", quantity.label, symbol, depends);
  const auto [low, high] = std::ranges::minmax(best);
  const std::string values =
      low == high ? fmt::format("{} with {}", data_number(low),
                                best.size() < lines.size()
                                    ? fmt::format("{} of {} methods", best.size(), lines.size())
                                    : "every method")
                  : fmt::format("{} to {} by method", data_number(low), data_number(high));
  return fmt::format("the best {} is {}; the {} depends on it {}", symbol, values, quantity.label,
                     depends);
}

std::string placement_finding(const std::vector<AnchorPanel>& panels) {
  std::string worst_of_all;
  double count = kNaN;
  std::vector<double> ratios;
  for (const AnchorPanel& panel : panels) {
    std::vector<const ErrorLine*> lines;
    for (const ErrorLine& line : panel.placements)
      if (!line.mean.empty() && line.mean.back() > 0.0 && std::isfinite(line.mean.back()))
        lines.push_back(&line);
    if (lines.size() < 2 || lines.size() < panel.placements.size()) return "";
    const auto error = [](const ErrorLine* line) { return line->mean.back(); };
    const auto [best, worst] = std::ranges::minmax(lines, {}, error);
    if (ratios.empty()) worst_of_all = worst->label, count = worst->x.back();
    const bool same_count = std::ranges::all_of(
        lines, [count](const ErrorLine* line) { return line->x.back() == count; });
    if (worst->label != worst_of_all || !same_count || !(error(best) < error(worst))) return "";
    ratios.push_back(error(worst) / error(best));
  }
  if (ratios.empty()) return "";
  const auto [least, most] = std::ranges::minmax(ratios);
  const std::string low = significant(least, 2), high = significant(most, 2);
  return fmt::format(
      "with {}, {} has its highest MPE with placement \u201c{}\u201d, {} times its lowest",
      counted(std::lround(count), "anchor"),
      panels.size() > 1 ? "every method" : name_alone(panels.front().title), worst_of_all,
      low == high ? low : low + " to " + high);
}

}  // namespace mapproof
