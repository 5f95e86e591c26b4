#include "render/figures/curves/refinement_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/maps/path_styles.hpp"

namespace mapproof {
namespace {

constexpr double kSame = 1.01;  // Costs up to this factor of the least of an end are the same.
constexpr std::size_t kMostRows = 10;  // The last one has all ends beyond.
constexpr double kHalfBar = 0.32;      // Of a row's height.

/// In the order of the bars' parts; the fills differ in grey, too.
struct Kind {
  SlamMethod method = SlamMethod::kRefined;
  Fill fill = Fill::kSolid;
};
constexpr std::array kKinds = {Kind{SlamMethod::kRefined, Fill::kSolid},
                               Kind{SlamMethod::kRefinedFromOdometry, Fill::kNone},
                               Kind{SlamMethod::kRefinedFromRandom, Fill::kTint}};

std::string label_of(SlamMethod method) {
  return method == SlamMethod::kRefined ? "from spectral"
                                        : std::string(info(method).label).substr(9);
}

bool has_result(const RefinementStart& start) {
  return start.cost >= 0.0 && std::isfinite(start.cost);
}

double least_cost(std::span<const RefinementStart> starts) {
  double least = kInfinity;
  for (const RefinementStart& start : starts)
    if (has_result(start)) least = std::min(least, start.cost);
  return least;
}

/// A row of the figure: starts that end at one cost, or at any of several.
struct End {
  double cost = 0.0;  ///< The least of them.
  Span error_m = {};
  std::vector<SlamMethod> methods = {};  ///< One a start.
  std::size_t costs = 1;                 ///< How many different ones.
};

/// The least cost first.
std::vector<End> ends_of(std::span<const RefinementStart> starts) {
  std::vector<RefinementStart> sorted;
  std::ranges::copy_if(starts, std::back_inserter(sorted), has_result);
  std::ranges::stable_sort(sorted, {}, &RefinementStart::cost);
  std::vector<End> ends;
  double cost = kNaN;
  for (const RefinementStart& start : sorted) {
    if (!(start.cost <= kSame * cost)) {
      cost = start.cost;
      if (ends.size() < kMostRows)
        ends.push_back({.cost = cost});
      else
        ++ends.back().costs;
    }
    if (start.mean_m) ends.back().error_m.see(*start.mean_m);
    ends.back().methods.push_back(start.method);
  }
  return ends;
}

/// "812: 0.190 m"; without ground truth the cost alone.
std::string row_name(const End& end) {
  const std::string cost = significant(end.cost);
  if (end.costs > 1) return fmt::format("{} more, from {}", end.costs, cost);
  if (!end.error_m.known()) return cost;
  const std::string low = error_text(end.error_m.low), high = error_text(end.error_m.high);
  return low == high ? fmt::format("{}: {}", cost, low)
                     : fmt::format("{}: {} to {}", cost, low, high);
}

/// The parts of one bar. @return Where it ends.
Point add_bar(const End& end, std::size_t rank, double y, Panel& panel) {
  double from = 0.0;
  for (const auto& [method, fill] : kKinds) {
    const auto count = std::ranges::count(end.methods, method);
    if (count == 0) continue;
    Area part{.label = label_of(method),
              .colour = path_style(method).colour,
              .fill = fill,
              .outlined = true,
              .mark = {fmt::format("{}-end-{}", info(method).name, rank),
                       {{"kind", label_of(method)},
                        {"cost", data_number(end.cost)},
                        {"starts", std::to_string(count)}}}};
    const double to = from + static_cast<double>(count);
    add_box(part, {from, to}, {y - kHalfBar, y + kHalfBar});
    panel.layers.emplace_back(std::move(part));
    from = to;
  }
  return {from, y};
}

/// The bars, the least cost uppermost, each with its number behind it.
void add_bars(const std::vector<End>& ends, Panel& panel) {
  constexpr double kGap = 0.02, kRoom = 0.2;  // Of the longest bar, to its number and for that.
  std::vector<Point> tips;
  double most = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    tips.push_back(add_bar(ends[i], i + 1, static_cast<double>(ends.size() - 1 - i), panel));
    most = std::max(most, tips.back().x);
    panel.y.names.insert(panel.y.names.begin(), row_name(ends[i]));
  }
  if (tips.empty()) return;
  Texts counts{.align = Align::kStart};
  for (const Point& tip : tips)
    add_text(counts, {tip.x + kGap * most, tip.y}, fmt::format("{:.0f}", tip.x));
  panel.layers.emplace_back(std::move(counts));
  panel.x.limits = Range{0.0, (1.0 + kRoom) * most};
}

std::string count_words(std::span<const RefinementStart> starts) {
  std::vector<std::string> parts;
  for (const Kind& kind : kKinds)
    if (const StartCount count = starts_at_optimum(starts, kind.method); count.of > 0)
      parts.push_back(fmt::format("{} {} of {}", label_of(kind.method), count.reached, count.of));
  return parts.empty() ? "no start" : listed(parts, 3);
}

}  // namespace

StartEnds start_ends(std::span<const RefinementStart> starts) {
  StartEnds all;
  for (const End& end : ends_of(starts)) {
    if (all.different == 0) all.at_least = end.methods.size();
    all.different += end.costs;
  }
  return all;
}

StartCount starts_at_optimum(std::span<const RefinementStart> starts, SlamMethod method) {
  const double least = least_cost(starts);
  StartCount count;
  for (const RefinementStart& start : starts) {
    if (start.method != method) continue;
    ++count.of;
    count.reached += has_result(start) && start.cost <= kSame * least ? 1 : 0;
  }
  return count;
}

Figure refinement_starts_figure(const RefinementStartsSpec& spec) {
  const std::vector<End> ends = ends_of(spec.starts);
  const bool judged = std::ranges::any_of(ends, [](const End& end) { return end.error_m.known(); });
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = {spec.record_id};
  Panel& panel = figure.panels.emplace_back();
  panel.x = {.label = fmt::format("starts, {} in all", spec.starts.size()),
             .limits = Range{0.0, 1.0},
             .whole = true};
  panel.y = {.label = judged ? "final cost: mean position error" : "final cost",
             .limits = Range{-0.6, std::max(1.0, static_cast<double>(ends.size())) - 0.4}};
  add_bars(ends, panel);
  std::string rows;
  for (const End& end : ends)
    rows += fmt::format(" {}: {}.", row_name(end), counted(std::ssize(end.methods), "start"));
  const std::string reached = count_words(spec.starts);
  figure.notes.push_back({"Within 1 % of the least cost: " + reached + "."});
  if (const auto without = std::ssize(spec.starts) - std::ranges::count_if(spec.starts, has_result);
      without > 0)
    figure.notes.push_back(
        {counted(without, "start") + " without a result to show.", ThemeColour::kWarning});
  figure.caption = fmt::format(
      "Where the starts of the refinement end: one row per final cost (half the sum of robust "
      "squared residuals), the least first{}. Costs within 1 % are one. Within 1 % of the least "
      "cost: {}.",
      judged ? ", with the mean position error there" : "", reached);
  figure.alt =
      fmt::format("{} of the refinement, by final cost{}.{} Within 1 % of the least cost: {}.",
                  counted(std::ssize(spec.starts), "start"),
                  judged ? " and mean position error" : "", rows, reached);
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
