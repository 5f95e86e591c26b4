#include "render/figures/curves/error_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/curves/diverged.hpp"
#include "render/plot/layers.hpp"

namespace mapproof {
namespace {

constexpr std::array<Marker, kMarkerCount> kMarkers = {
    Marker::kCircle,       Marker::kSquare, Marker::kTriangle, Marker::kDiamond,
    Marker::kTriangleDown, Marker::kPlus,   Marker::kCross};
constexpr std::array kDashes = {Dash::kSolid, Dash::kDashed, Dash::kDashDot, Dash::kDotted,
                                Dash::kLongDash};

constexpr double kLeastOfHeight = 0.3;  // What lines take of an axis from 0.

/// "; bands: its 95 % interval", or bars where bands would hide each other; empty without
/// intervals.
std::string interval_words(const std::vector<Panel>& panels) {
  bool bands = false, bars = false;
  for (const Panel& panel : panels) {
    const bool hidden = bands_hide_each_other(panel);
    bars |= hidden;
    bands |= !hidden && std::ranges::any_of(panel.layers, [](const Layer& layer) {
      return std::holds_alternative<Band>(layer);
    });
  }
  if (!bands && !bars) return "";
  return fmt::format("; {}: its 95 % interval", !bars   ? "bands"
                                                : bands ? "bands and bars"
                                                        : "bars");
}

void require_consistent(const ErrorLinesSpec& spec) {
  for (const ErrorPanel& panel : spec.panels)
    for (const ErrorLine& line : panel.lines) {
      const std::size_t size = line.x.size();
      const bool banded = !line.low.empty() || !line.high.empty();
      if (line.mean.size() != size ||
          (banded && (line.low.size() != size || line.high.size() != size)))
        throw InvalidInput("figure " + printable(spec.id) + ": line " + printable(line.label) +
                           ": x, mean, low and high differ in length");
    }
}

void append(std::vector<double>& all, const std::vector<double>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

double divergence_of(const ErrorLinesSpec& spec) {
  return divergence_in(line_axis(spec.y_label).unit, spec.great_errors);
}

/// The ceiling of the spec, and not above what diverged unless all means did.
double ceiling_of(const ErrorLinesSpec& spec) {
  std::vector<double> means;
  for (const ErrorPanel& panel : spec.panels)
    for (const ErrorLine& line : panel.lines) append(means, line.mean);
  return std::min(spec.ceiling, axis_ceiling(means, divergence_of(spec)));
}

/// NaN where the mean lies above the ceiling: the band towards it would fill the frame.
std::vector<double> within_ceiling(const ErrorLine& line, std::vector<double> ends,
                                   double ceiling) {
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (line.mean[i] > ceiling) ends[i] = kNaN;
  return ends;
}

ErrorAxis axis_of(const ErrorLinesSpec& spec, double ceiling) {
  std::vector<double> means, intervals, points;
  for (const ErrorPanel& panel : spec.panels) {
    for (const ErrorLine& line : panel.lines) {
      append(means, line.mean);
      append(intervals, within_ceiling(line, line.low, ceiling));
      append(intervals, within_ceiling(line, line.high, ceiling));
    }
    for (const ErrorPoint& point : panel.points) points.push_back(point.y);
  }
  const auto beyond = [&](double value) { return value > ceiling; };
  std::erase_if(means, beyond);
  std::erase_if(points, beyond);
  std::ranges::replace_if(intervals, beyond, ceiling);
  return error_axis(means, intervals, spec.log_from, points);
}

/// Labels in the order of their first appearance, and the style of each.
struct Labels {
  std::vector<std::string> labels;
  std::vector<std::size_t> series;
};

Labels labels_of(const ErrorLinesSpec& spec) {
  Labels all;
  std::vector<std::optional<std::size_t>> asked;
  for (const ErrorPanel& panel : spec.panels)
    for (const ErrorLine& line : panel.lines) {
      if (std::ranges::find(all.labels, line.label) != all.labels.end()) continue;
      all.labels.push_back(line.label);
      asked.push_back(line.series);
    }
  all.series = series_of(asked);
  return all;
}

/// "3 intervals end above the frame."
void note_count(long long count, std::string_view what, std::string_view predicate,
                std::string_view side, Figure& figure) {
  if (count > 0)
    figure.notes.push_back({fmt::format("{} {}{} {} the frame.", counted(count, what), predicate,
                                        count == 1 ? "s" : "", side),
                            ThemeColour::kMuted});
}

/// Notes how many means and points lie above the frame, how many points lie below it, and how many
/// intervals end above or below it whose means do not lie above.
void note_beyond(const ErrorLinesSpec& spec, const ErrorAxis& axis, Figure& figure) {
  const auto is_above = [&](double value) { return value > axis.limits.high; };
  const auto is_below = [&](double value) { return value < axis.limits.low; };
  long long values = 0, points_below = 0, above = 0, below = 0;
  for (const ErrorPanel& panel : spec.panels) {
    for (const ErrorLine& line : panel.lines) {
      values += std::ranges::count_if(line.mean, is_above);
      for (std::size_t i = 0; i < line.high.size(); ++i) {
        if (is_above(line.mean[i])) continue;
        above += is_above(line.high[i]) ? 1 : 0;
        below += is_below(line.low[i]) ? 1 : 0;
      }
    }
    values += std::ranges::count_if(panel.points, is_above, &ErrorPoint::y);
    points_below += std::ranges::count_if(panel.points, is_below, &ErrorPoint::y);
  }
  note_count(values, "value", "lie", "above", figure);
  note_count(points_below, "value", "lie", "below", figure);
  note_count(above, "interval", "end", "above", figure);
  note_count(below, "interval", "end", "below", figure);
}

/// By line.
std::vector<DivergedCount> count_diverged(const ErrorLinesSpec& spec) {
  std::vector<DivergedCount> counts;
  const double divergence = divergence_of(spec);
  for (const ErrorPanel& panel : spec.panels)
    for (const ErrorLine& line : panel.lines) {
      auto count = std::ranges::find(counts, line.label, &DivergedCount::label);
      if (count == counts.end()) count = counts.insert(count, {.label = line.label});
      for (const double mean : line.mean) count->see(mean, divergence);
    }
  return counts;
}

/// What an axis calls a value: its number, or the name that the axis has for it.
std::string tick_words(const Axis& axis, double x) {
  const bool has_name = x >= 0.0 && x < static_cast<double>(axis.names.size());
  return has_name ? axis.names[static_cast<std::size_t>(x)] : data_number(x);
}

/// @param divergence  Above which the number says nothing.
std::string words_of(const ErrorLine& line, const Axis& axis, double divergence) {
  const auto words = [divergence](double mean) {
    return mean > divergence ? kGreatErrorText : significant(mean);
  };
  const std::string& name = line.setting.empty() ? line.label : line.setting;
  std::size_t best = line.mean.size(), last = line.mean.size();
  for (std::size_t i = 0; i < line.mean.size(); ++i) {
    if (!std::isfinite(line.mean[i])) continue;
    if (best == line.mean.size() || line.mean[i] < line.mean[best]) best = i;
    last = i;
  }
  if (last == line.mean.size()) return fmt::format(" {}: nothing known.", name);
  std::string text = fmt::format(" {}: least {} at {}", name, words(line.mean[best]),
                                 tick_words(axis, line.x[best]));
  if (last != best)
    text += fmt::format(", {} at {}", words(line.mean[last]), tick_words(axis, line.x[last]));
  return text + ".";
}

std::string alt_of(const ErrorLinesSpec& spec, const ErrorAxis& axis) {
  std::string text = fmt::format("{}: {}, {} axis.", spec.y_label, spec.quantity,
                                 axis.scale == Scale::kLog ? "logarithmic" : "linear");
  for (const ErrorPanel& panel : spec.panels) {
    text += fmt::format(" Over {}{}:", panel.x.label,
                        panel.title.empty() ? "" : " (" + panel.title + ")");
    for (const ErrorLine& line : panel.lines) text += words_of(line, panel.x, divergence_of(spec));
    if (panel.lines.empty()) text += " nothing.";
  }
  return text;
}

using MarkData = std::vector<std::pair<std::string, std::string>>;

/// What the marks of a line name, and its points.
/// @param more  What else the mark says.
MarkData curve_data(const std::string& label, const std::string& setting, MarkData more = {}) {
  MarkData data = {{"curve", label}};
  if (!setting.empty()) data.emplace_back("setting", setting);
  data.insert(data.end(), more.begin(), more.end());
  return data;
}

class Builder {
 public:
  Builder(const ErrorLinesSpec& spec, const ErrorAxis& axis, double ceiling)
      : spec_(spec), axis_(axis), ceiling_(ceiling), labels_(labels_of(spec)) {}

  Panel panel(std::size_t index) const {
    const ErrorPanel& from = spec_.panels[index];
    const std::string prefix = spec_.panels.size() == 1 ? "" : fmt::format("panel-{}-", index + 1);
    Panel panel;
    panel.title = from.title;
    panel.x = from.x;
    panel.y = {.label = spec_.y_label, .scale = axis_.scale, .limits = axis_.limits};
    for (const ErrorLine& line : from.lines)
      if (!line.low.empty())
        panel.layers.push_back(
            Band{line.label, line.x, axis_.raised(within_ceiling(line, line.low, ceiling_)),
                 axis_.raised(within_ceiling(line, line.high, ceiling_)), style(line.label).colour,
                 Mark{prefix + line.key + "-band", curve_data(line.label, line.setting)}});
    // Below the lines, which then show through.
    for (const ErrorPoint& point : from.points) {
      Scatter one{.label = point.label,
                  .x = {point.x},
                  .y = axis_.raised({point.y}),
                  .colour = style(point.line).colour,
                  .marker = point.marker,
                  .filled = false,
                  .size = point.size};
      one.marks.push_back({"", curve_data(point.line, point.setting,
                                          {{"kind", point.label},
                                           {"x", data_number(point.x)},
                                           {"y", data_number(point.y)}})});
      panel.layers.push_back(std::move(one));
    }
    for (const ErrorLine& line : from.lines) {
      const SeriesStyle style = this->style(line.label);
      panel.layers.push_back(Polyline{line.label, line.x, axis_.raised(within_frame(line.mean)),
                                      style.colour, style.dash, 1.0, style.marker,
                                      mark_of(line, prefix)});
    }
    for (const ErrorLine& line : from.lines)
      if (Scatter above = above_frame(line); !above.x.empty())
        panel.layers.push_back(std::move(above));
    if (PointLabels ends = end_labels(from.lines); !ends.text.empty())
      panel.layers.push_back(std::move(ends));
    return panel;
  }

 private:
  /// `over`, above which the page says "over 1 km", where some of these values are.
  MarkData over(const std::vector<double>& values) const {
    const double divergence = divergence_of(spec_);
    if (std::ranges::none_of(values, [&](double value) { return value > divergence; })) return {};
    return {{"over", data_number(divergence)}};
  }

  Mark mark_of(const ErrorLine& line, const std::string& prefix) const {
    return {prefix + line.key + "-mean", curve_data(line.label, line.setting, over(line.mean))};
  }

  bool is_above(double mean) const { return std::isfinite(ceiling_) && mean > axis_.limits.high; }

  /// NaN above the frame: a line towards such a value would be read at its edge.
  std::vector<double> within_frame(std::vector<double> means) const {
    std::ranges::replace_if(
        means, [this](double mean) { return is_above(mean); }, kNaN);
    return means;
  }

  Scatter above_frame(const ErrorLine& line) const {
    Scatter above{.label = "above the frame",
                  .colour = style(line.label).colour,
                  .marker = Marker::kTriangle,
                  .filled = false,
                  .size = 1.6};
    for (std::size_t i = 0; i < line.mean.size(); ++i) {
      if (!is_above(line.mean[i])) continue;
      above.x.push_back(line.x[i]);
      above.y.push_back(near_end(axis_.scale, axis_.limits));
      MarkData data = {{"x", data_number(line.x[i])}, {"y", data_number(line.mean[i])}};
      std::ranges::copy(over({line.mean[i]}), std::back_inserter(data));
      above.marks.push_back({"", curve_data(line.label, line.setting, std::move(data))});
    }
    return above;
  }

  PointLabels end_labels(const std::vector<ErrorLine>& lines) const {
    PointLabels ends;
    for (const ErrorLine& line : lines) {
      const std::vector<double> shown = axis_.raised(within_frame(line.mean));
      std::size_t count = shown.size();
      while (count > 0 && !std::isfinite(shown[count - 1])) --count;
      if (line.end_label.empty() || count == 0) continue;
      ends.x.push_back(line.x[count - 1]);
      ends.y.push_back(shown[count - 1]);
      ends.text.push_back(line.end_label);
    }
    return ends;
  }

  SeriesStyle style(const std::string& label) const {
    return series_style(labels_.series[static_cast<std::size_t>(
        std::ranges::find(labels_.labels, label) - labels_.labels.begin())]);
  }

  const ErrorLinesSpec& spec_;
  const ErrorAxis& axis_;
  double ceiling_;
  Labels labels_;
};

}  // namespace

LineAxis line_axis(const std::string& label) {
  const std::size_t unit = label.find(" [");
  if (unit == std::string::npos || label.back() != ']') return {label};
  return {label.substr(0, unit), label.substr(unit + 2, label.size() - unit - 3)};
}

SeriesStyle series_style(std::size_t i) {
  // After ten the colours come again, each time with the next dash and marker: both come again
  // together after 35 times.
  const std::size_t colour = i % kSeriesCount, round = i / kSeriesCount;
  return {series_colour(i), kDashes[(colour + round) % kDashes.size()],
          kMarkers[(colour + 3 * (colour / kMarkers.size()) + round) % kMarkers.size()]};
}

std::vector<std::size_t> free_series(const std::vector<std::size_t>& taken, std::size_t count,
                                     std::size_t from) {
  std::vector<std::size_t> free;
  std::set<std::size_t> styles(taken.begin(), taken.end()), colours;
  for (const std::size_t one : taken) colours.insert(one % kSeriesCount);
  std::size_t next = taken.empty() ? 0 : from;
  while (free.size() < count) {
    if (colours.size() == kSeriesCount) colours.clear();
    while (styles.contains(next) || colours.contains(next % kSeriesCount)) ++next;
    styles.insert(next);
    colours.insert(next % kSeriesCount);
    free.push_back(next);
  }
  return free;
}

std::vector<std::size_t> series_of(const std::vector<std::optional<std::size_t>>& asked) {
  std::vector<std::size_t> series(asked.size());
  std::vector<std::size_t> left;
  std::set<std::size_t> taken;
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (asked[i] && taken.insert(*asked[i]).second)
      series[i] = *asked[i];
    else
      left.push_back(i);
  const std::vector<std::size_t> free =
      free_series(std::vector(taken.begin(), taken.end()), left.size(), kMethodStyles);
  for (std::size_t k = 0; k < left.size(); ++k) series[left[k]] = free[k];
  return series;
}

ErrorAxis error_axis(const std::vector<double>& means, const std::vector<double>& intervals,
                     double log_from, const std::vector<double>& points) {
  Span of_means, lines, all;
  for (Span* span : {&of_means, &lines, &all}) span->see(means);
  for (Span* span : {&lines, &all}) span->see(intervals);
  all.see(points);
  for (const double point : points)
    if (point != 0.0) of_means.see(point);  // Of a single run 0 is by chance.
  if (!of_means.known()) return {Scale::kLinear, {0.0, 1.0}};
  if (of_means.low > 0.0 && of_means.high / of_means.low > log_from) {
    // Below, intervals end near a 0 that the axis has not; above, they may take as much of it as
    // the means do.
    const double low = std::max(all.low, of_means.low / 3.0);
    const double high = std::min(all.high, of_means.high * (of_means.high / of_means.low));
    const double margin = std::pow(high / low, 0.05);
    return {Scale::kLog, {low / margin, high * margin}};
  }
  // From 0, unless all the lines would lie in the frame's uppermost part.
  const double extent = all.high - all.low;
  const bool is_high = extent < kLeastOfHeight * all.high ||
                       (all.low > 0.0 && lines.low > (1.0 - kLeastOfHeight) * 1.06 * all.high);
  if (extent > 0.0 && is_high)
    return {Scale::kLinear, {all.low - 0.06 * extent, all.high + 0.06 * extent}};
  const double low = std::min(all.low, 0.0);
  const double high = all.high > low ? all.high : low + 1.0;
  return {Scale::kLinear, {low, high + 0.06 * (high - low)}};
}

std::vector<double> ErrorAxis::raised(std::vector<double> values) const {
  if (scale == Scale::kLog)
    for (double& value : values)
      if (!std::isnan(value)) value = std::max(value, 0.5 * limits.low);
  return values;
}

Figure error_lines_figure(const ErrorLinesSpec& spec) {
  require_consistent(spec);
  const double ceiling = ceiling_of(spec);
  const ErrorAxis axis = axis_of(spec, ceiling);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.alt = spec.alt.empty() ? alt_of(spec, axis) : spec.alt;
  figure.notes = spec.notes;
  note_beyond(spec, axis, figure);
  note_diverged(count_diverged(spec), "at", "points", figure.notes);
  const Builder builder(spec, axis, ceiling);
  for (std::size_t i = 0; i < spec.panels.size(); ++i) figure.panels.push_back(builder.panel(i));
  if (labels_of(spec).labels.empty())
    figure.notes.push_back({"There are no curves.", ThemeColour::kWarning});
  if (figure.panels.empty()) {
    figure.panels.resize(1);
    figure.panels[0].y.label = spec.y_label;
  }
  figure.caption = spec.caption.empty()
                       ? fmt::format("Lines: {}{}{}{}.{}", spec.quantity, spec.over,
                                     spec.has_runs ? ", mean over runs" : "",
                                     interval_words(figure.panels), spec.remark)
                       : spec.caption;
  figure.shared_y = figure.panels.size() > 1;
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
