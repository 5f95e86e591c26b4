#include "render/figures/curves/best_line.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/number_text.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostNamed = 3;

/// A line's value at one x.
struct At {
  const ErrorLine* line = nullptr;
  std::size_t index = 0;

  double x() const { return line->x[index]; }
  double mean() const { return line->mean[index]; }
  bool has_interval() const {
    return !line->low.empty() && std::isfinite(line->low[index] + line->high[index]);
  }
};

bool overlap(const At& a, const At& b) {
  return a.has_interval() && b.has_interval() && a.line->low[a.index] <= b.line->high[b.index] &&
         b.line->low[b.index] <= a.line->high[a.index];
}

/// What the lines know at x.
std::vector<At> known_at(const std::vector<ErrorLine>& lines, double x) {
  std::vector<At> known;
  for (const ErrorLine& line : lines)
    for (std::size_t i = 0; i < line.x.size(); ++i)
      if (line.x[i] == x && std::isfinite(line.mean[i])) known.push_back({&line, i});
  return known;
}

std::vector<At> all_known(const std::vector<ErrorLine>& lines) {
  std::vector<At> known;
  for (const ErrorLine& line : lines)
    for (std::size_t i = 0; i < line.x.size(); ++i)
      if (std::isfinite(line.mean[i])) known.push_back({&line, i});
  return known;
}

At best_in(const std::vector<At>& known, const LineQuantity& quantity) {
  return *std::ranges::min_element(known, [&](const At& a, const At& b) {
    return quantity.lower_is_better ? a.mean() < b.mean() : a.mean() > b.mean();
  });
}

/// "has the lowest MPE", "have the highest share".
std::string has_the_best(const LineQuantity& quantity, bool several) {
  return fmt::format("{} the {} {}", several ? "have" : "has",
                     quantity.lower_is_better ? "lowest" : "highest", quantity.label);
}

/// "noise = 10 °".
std::string equation(const LineAxis& axis, double x) {
  return fmt::format("{} = {}", axis.name, with_unit(data_number(x), axis.unit));
}

bool is_tied(const std::vector<At>& known, const At& best) {
  return std::ranges::count(known, best.mean(), &At::mean) > 1;
}

std::string value_text(double value, const LineQuantity& quantity) {
  return with_unit(significant(value, 2), quantity.unit);
}

std::set<double> xs_of(const std::vector<ErrorLine>& lines) {
  std::set<double> xs;
  for (const At& at : all_known(lines)) xs.insert(at.x());
  return xs;
}

}  // namespace

LineAxis line_axis(const std::string& label) {
  const std::size_t unit = label.find(" [");
  if (unit == std::string::npos || label.back() != ']') return {label};
  return {label.substr(0, unit), label.substr(unit + 2, label.size() - unit - 3)};
}

std::string best_at_end(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const std::string& where) {
  const std::set<double> xs = xs_of(lines);
  if (xs.empty()) return "";
  const std::vector<At> known = known_at(lines, *xs.rbegin());
  const At best = best_in(known, quantity);
  const std::string at = fmt::format(fmt::runtime(where), data_number(best.x()));
  if (lines.size() == 1)
    return fmt::format("{} has {} of {} {}", best.line->label, quantity.label,
                       value_text(best.mean(), quantity), at);
  std::vector<std::string> names = {best.line->label};
  for (const At& other : known)
    if (other.line != best.line && overlap(other, best)) names.push_back(other.line->label);
  if (names.size() == 1)
    return fmt::format("{} {} {}, {}", names.front(), has_the_best(quantity, false), at,
                       value_text(best.mean(), quantity));
  if (names.size() == known.size() && names.size() > kMostNamed)
    return fmt::format("No method differs clearly in {} {}", quantity.label, at);
  return fmt::format("{} {} {}, from {}", listed(names, kMostNamed), has_the_best(quantity, true),
                     at, value_text(best.mean(), quantity));
}

std::string best_over(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                      const LineAxis& axis) {
  const std::set<double> xs = xs_of(lines);
  if (xs.empty()) return "";
  if (lines.size() == 1) return best_of_all(lines, quantity, axis);
  std::set<std::string> best;
  for (const double x : xs) {
    const std::vector<At> known = known_at(lines, x);
    const At at = best_in(known, quantity);
    if (is_tied(known, at)) return "";
    best.insert(at.line->label);
  }
  const At first = best_in(known_at(lines, *xs.begin()), quantity);
  const At last = best_in(known_at(lines, *xs.rbegin()), quantity);
  if (best.size() == 1)
    return fmt::format("{} {} throughout", first.line->label, has_the_best(quantity, false));
  if (first.line->label == last.line->label)
    return fmt::format("{} {} at both ends, but not throughout", first.line->label,
                       has_the_best(quantity, false));
  return fmt::format("{} {} at {}, {} at {}", first.line->label, has_the_best(quantity, false),
                     equation(axis, first.x()), last.line->label,
                     with_unit(data_number(last.x()), axis.unit));
}

std::string best_of_all(const std::vector<ErrorLine>& lines, const LineQuantity& quantity,
                        const LineAxis& axis) {
  const std::vector<At> known = all_known(lines);
  if (known.empty()) return "";
  const At best = best_in(known, quantity);
  if (lines.size() == 1)
    return fmt::format("the {} {} of {} is {} at {}",
                       quantity.lower_is_better ? "lowest" : "highest", quantity.label,
                       best.line->label, value_text(best.mean(), quantity),
                       equation(axis, best.x()));
  return fmt::format("{} {}, {} at {}", best.line->label, has_the_best(quantity, false),
                     value_text(best.mean(), quantity), equation(axis, best.x()));
}

}  // namespace mapproof
