#include "render/figures/curves/window_curve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

void require_consistent(const WindowCurveSpec& spec) {
  const WindowCurve& windows = spec.windows;
  if (windows.lengths_s.size() != windows.held_out_m.size())
    throw InvalidInput("figure " + printable(spec.id) + ": lengths and errors differ in number");
  for (const double length : windows.lengths_s)
    if (!(length > 0.0) || std::isinf(length))
      throw InvalidInput("figure " + printable(spec.id) + ": a length is not positive");
}

/// The tried lengths, ascending.
std::vector<std::size_t> by_length(const WindowCurve& windows) {
  std::vector<std::size_t> order(windows.lengths_s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return windows.lengths_s[i]; });
  return order;
}

/// Where a mark stands wholly inside the frame, above all errors.
double near_top(const ErrorAxis& axis) {
  const auto& [low, high] = axis.limits;
  constexpr double kShare = 0.97;
  return axis.scale == Scale::kLog ? low * std::pow(high / low, kShare)
                                   : std::lerp(low, high, kShare);
}

}  // namespace

Figure window_curve_figure(const WindowCurveSpec& spec) {
  require_consistent(spec);
  const WindowCurve& windows = spec.windows;
  const ErrorAxis axis = error_axis(windows.held_out_m, {}, 6.0);
  Polyline curve{.label = "held-out ranges", .marker = Marker::kCircle, .mark = {"held-out", {}}};
  Scatter failed{.label = "predicts nothing", .ink = Ink::kWarning, .marker = Marker::kCross};
  Scatter chosen{.label = "chosen", .ink = Ink::kSeries2, .filled = false, .size = 2.0};
  const double top = near_top(axis);
  Figure figure;
  figure.alt = "Typical error of held-out ranges by window length:";
  for (const std::size_t i : by_length(windows)) {
    const double length = windows.lengths_s[i], error = windows.held_out_m[i];
    const bool predicts = std::isfinite(error);
    figure.alt += fmt::format(" {:.3g} s {};", length,
                              predicts ? significant(error) + " m" : "predicts nothing");
    const Point at{length, predicts ? axis.raised({error}).front() : top};
    if (!predicts)
      add_point(failed, at);
    else
      add_point(curve, at);
    if (length != windows.chosen_s) continue;
    add_point(chosen, at);
    chosen.marks.push_back({"chosen", {{"x", data_number(length)}, {"y", data_number(error)}}});
  }
  figure.alt.back() = '.';
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = {spec.record_id};
  const std::string length = fmt::format("{:.3g}", windows.chosen_s);
  figure.caption = fmt::format(
      "Typical error of ranges that were held out, by window length; chosen: {} s, the least error "
      "among the lengths that tell ranges at the most times. No ground truth enters the choice.",
      length);
  figure.alt += fmt::format(" Chosen: {} s.", length);
  Panel& panel = figure.panels.emplace_back();
  panel.x = {.label = "window length [s]", .scale = Scale::kLog};
  panel.y = {.label = "held-out range error [m]", .scale = axis.scale, .limits = axis.limits};
  panel.layers = {curve, failed, chosen};
  std::erase_if(panel.layers, is_empty);
  if (panel.layers.empty()) figure.notes.push_back({"No length was tried.", Ink::kWarning});
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
