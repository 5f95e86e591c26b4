#include "render/figures/curves/log_log.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "render/base/span.hpp"
#include "render/figures/layer_shapes.hpp"

namespace mapproof {
namespace {

constexpr double kAbove = 1.8;        // Factor of a guide over the highest first value.
constexpr double kAxisMargin = 0.06;  // Of an axis' length, at both ends.
constexpr double kLeastSpan = 2.0;    // Of the greatest over the least value on an axis.
constexpr double kLowestBar = 3.0;    // Factor below the least mean to which bars widen the axis.

bool is_shown(double value) { return value > 0.0 && std::isfinite(value); }

void require_consistent(const LogLogSpec& spec) {
  for (const LogLogPanel& panel : spec.panels)
    for (const auto* lines : {&panel.lines, &panel.bounds})
      for (const ErrorLine& line : *lines) {
        const std::size_t size = line.x.size();
        const bool barred = !line.low.empty() || !line.high.empty();
        if (line.mean.size() != size ||
            (barred && (line.low.size() != size || line.high.size() != size)))
          throw InvalidInput("figure " + printable(spec.id) + ": line " + printable(line.label) +
                             ": x, mean, low and high differ in length");
      }
}

Range widened(const Span& span) {
  if (!span.known()) return {0.1, 1.0};
  const double least = std::max(kLeastSpan / (span.high / span.low), 1.0);
  const double factor =
      std::sqrt(least) * std::pow(std::max(span.high / span.low, kLeastSpan), kAxisMargin);
  return {span.low / factor, span.high * factor};
}

class PanelBuilder {
 public:
  explicit PanelBuilder(const LogLogPanel& from) : from_(from) {
    for (const auto* lines : {&from.lines, &from.bounds})
      for (const ErrorLine& line : *lines) see(line);
    see_lows();
  }

  Panel build() {
    Panel panel;
    panel.title = from_.title;
    const Polyline guide = this->guide();
    y_.see(guide.y);
    panel.x = {.label = from_.x_label, .scale = Scale::kLog, .limits = widened(x_)};
    panel.y = {.label = from_.y_label, .scale = Scale::kLog, .limits = widened(y_)};
    low_end_ = panel.y.limits->low;
    panel.layers.push_back(guide);
    for (const ErrorLine& bound : from_.bounds)
      panel.layers.push_back(line(bound, {ThemeColour::kText, Dash::kDashed, Marker::kNone}));
    for (std::size_t i = 0; i < from_.lines.size(); ++i) {
      const SeriesStyle style = series_style(from_.lines[i].series.value_or(i));
      for (const bool is_open : {false, true})
        panel.layers.push_back(bars(from_.lines[i], style, aside(i), is_open));
      panel.layers.push_back(line(from_.lines[i], style));
    }
    std::erase_if(panel.layers, is_empty);
    return panel;
  }

 private:
  void see(const ErrorLine& line) {
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!is_shown(line.x[i]) || !is_shown(line.mean[i])) continue;
      x_.see(line.x[i]);
      y_.see(line.mean[i]);
      if (!line.high.empty() && is_shown(line.high[i])) y_.see(line.high[i]);
      if (!line.low.empty()) lows_.push_back(line.low[i]);
    }
  }

  /// Widens the axis for the lower ends of bars: for those that reach to 0 or far down, which end
  /// in arrows, by as much as arrows need.
  void see_lows() {
    if (!y_.known()) return;
    const double lowest = y_.low / kLowestBar;
    for (const double low : lows_) y_.see(std::max(low, lowest));
  }

  static Polyline line(const ErrorLine& from, const SeriesStyle& style) {
    Polyline line{.label = from.label,
                  .colour = style.colour,
                  .dash = style.dash,
                  .marker = style.marker,
                  .mark = {from.key + "-mean", {{"curve", from.label}}}};
    for (std::size_t i = 0; i < from.x.size(); ++i)
      if (is_shown(from.x[i]) && is_shown(from.mean[i])) add_point(line, {from.x[i], from.mean[i]});
    return line;
  }

  /// Factor by which the bars of a line stand aside, so that those of several lines are seen.
  double aside(std::size_t line) const {
    constexpr double kStep = 0.008;  // Of the axis.
    const double middle = 0.5 * static_cast<double>(from_.lines.size() - 1);
    const double steps = static_cast<double>(line) - middle;
    return x_.known() ? std::pow(std::max(x_.high / x_.low, kLeastSpan), kStep * steps) : 1.0;
  }

  /// @param is_open  Those that end below the frame, as arrows down to it; else the others.
  Segments bars(const ErrorLine& from, const SeriesStyle& style, double aside, bool is_open) const {
    Segments bars{.colour = style.colour, .width = 1.6, .arrow = is_open};
    for (std::size_t i = 0; i < from.low.size(); ++i) {
      if (!is_shown(from.x[i]) || !is_shown(from.mean[i]) || !is_shown(from.high[i])) continue;
      if (is_open != (from.low[i] < low_end_)) continue;
      const Point high{aside * from.x[i], from.high[i]};
      if (is_open)
        add_line(bars, high, {high.x, low_end_});
      else
        add_line(bars, {high.x, from.low[i]}, high);
      bars.marks.push_back({"", {{"curve", from.label}, {"kind", "interval"}}});
    }
    return bars;
  }

  /// Over the whole span, above all of the lines at their first point.
  Polyline guide() const {
    Polyline guide{.label = "", .colour = ThemeColour::kMuted, .dash = Dash::kLongDash};
    if (!from_.guide || !(x_.low < x_.high)) return guide;
    double above = 0.0;
    for (const ErrorLine& line : from_.lines)
      for (std::size_t i = 0; i < line.x.size(); ++i)
        if (is_shown(line.x[i]) && is_shown(line.mean[i]))
          above = std::max(above, line.mean[i] / std::pow(line.x[i] / x_.low, from_.guide->slope));
    guide.label = from_.guide->label;
    for (const double x : {x_.low, x_.high})
      add_point(guide, {x, kAbove * above * std::pow(x / x_.low, from_.guide->slope)});
    return guide;
  }

  const LogLogPanel& from_;
  Span x_, y_;
  std::vector<double> lows_;
  double low_end_ = 0.0;
};

std::string line_words(const ErrorLine& line) {
  std::size_t first = line.x.size(), last = first;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!is_shown(line.x[i]) || !is_shown(line.mean[i])) continue;
    if (first == line.x.size()) first = i;
    last = i;
  }
  if (last == line.x.size()) return fmt::format(" {}: nothing known.", line.label);
  std::string text = fmt::format(" {}: {} at {}", line.label, significant(line.mean[first]),
                                 data_number(line.x[first]));
  if (last == first) return text + ".";
  text += fmt::format(", {} at {}", significant(line.mean[last]), data_number(line.x[last]));
  if (const double slope = log_log_slope(line.x, line.mean); std::isfinite(slope))
    text += ", slope " + slope_words(slope);
  return text + ".";
}

std::string alt_of(const LogLogSpec& spec) {
  std::string text;
  for (const LogLogPanel& panel : spec.panels) {
    text += fmt::format("{}{} over {}, both axes logarithmic:", text.empty() ? "" : " ",
                        panel.y_label, panel.x_label);
    for (const auto* lines : {&panel.lines, &panel.bounds})
      for (const ErrorLine& line : *lines) text += line_words(line);
    if (panel.lines.empty()) text += " nothing.";
  }
  return text;
}

}  // namespace

double log_log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  double count = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!is_shown(x[i]) || !is_shown(y[i])) continue;
    const double a = std::log(x[i]), b = std::log(y[i]);
    count += 1.0, sum_x += a, sum_y += b, sum_xx += a * a, sum_xy += a * b;
  }
  const double spread = count * sum_xx - sum_x * sum_x;
  if (count < 2.0 || !(spread > 1e-12 * count * sum_xx)) return kNaN;
  return (count * sum_xy - sum_x * sum_y) / spread;
}

std::string slope_words(double slope) {
  if (!std::isfinite(slope)) return "unknown";
  return fmt::format("{}{:.2f}", slope < 0.0 ? "\u2212" : "", std::abs(slope));
}

Figure log_log_figure(const LogLogSpec& spec) {
  require_consistent(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.caption = spec.caption;
  figure.alt = alt_of(spec);
  figure.record_ids = spec.record_ids;
  figure.varies = spec.varies;
  figure.notes = spec.notes;
  figure.columns = spec.columns;
  bool any = false;
  for (const LogLogPanel& panel : spec.panels) {
    figure.panels.push_back(PanelBuilder(panel).build());
    any = any || !figure.panels.back().layers.empty();
  }
  if (figure.panels.empty()) figure.panels.resize(1);
  if (!any) figure.notes.push_back({"There are no curves.", ThemeColour::kWarning});
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
