#include "render/figures/error_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/base/span.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr double kLogFrom = 20.0;  // Greatest over least mean from which the y axis is logarithmic.
constexpr std::array kMarkers = {Marker::kCircle,  Marker::kSquare,       Marker::kTriangle,
                                 Marker::kDiamond, Marker::kTriangleDown, Marker::kPlus,
                                 Marker::kCross};
constexpr std::array kDashes = {Dash::kSolid, Dash::kDashed, Dash::kDashDot, Dash::kDotted,
                                Dash::kLongDash};

void require_consistent(const ErrorCurveSpec& spec) {
  for (const Curve& curve : spec.curves) {
    const std::size_t size = curve.steps.size();
    const bool banded = !curve.low.empty() || !curve.high.empty();
    if (curve.mean.size() != size ||
        (banded && (curve.low.size() != size || curve.high.size() != size)))
      throw InvalidInput("figure " + printable(spec.id) + ": curve " + printable(curve.label) +
                         ": steps, mean, low and high differ in length");
  }
}

/// The axis for the means' span and what must be raised to stay on it.
struct YAxis {
  Scale scale = Scale::kLinear;
  Range limits;
};

YAxis y_axis(const ErrorCurveSpec& spec) {
  Span means, all;
  for (const Curve& curve : spec.curves) {
    means.see(curve.mean);
    all.see(curve.mean);
    all.see(curve.low);
    all.see(curve.high);
  }
  if (!means.known()) return {Scale::kLinear, {0.0, 1.0}};
  if (means.low > 0.0 && means.high / means.low > kLogFrom) {
    const double low = std::max(all.low, means.low / 3.0);
    const double high = std::min(all.high, means.high * 10.0);
    const double margin = std::pow(high / low, 0.05);
    return {Scale::kLog, {low / margin, high * margin}};
  }
  const double low = std::min(all.low, 0.0);
  const double high = all.high > low ? all.high : low + 1.0;
  return {Scale::kLinear, {low, high + 0.06 * (high - low)}};
}

std::vector<double> raised(std::vector<double> values, const YAxis& axis) {
  if (axis.scale == Scale::kLog)
    for (double& value : values)
      if (!std::isnan(value)) value = std::max(value, 0.5 * axis.limits.low);
  return values;
}

std::string ends_of(const Curve& curve) {
  const auto known = [](double value) { return std::isfinite(value); };
  const auto first = std::ranges::find_if(curve.mean, known);
  if (first == curve.mean.end()) return fmt::format(" {}: nothing known.", curve.label);
  const auto last = std::find_if(curve.mean.rbegin(), curve.mean.rend(), known);
  const auto step = [&curve](std::ptrdiff_t place) { return data_number(curve.steps[place]); };
  return fmt::format(" {}: {} at {}, {} at {}.", curve.label, significant(*first),
                     step(first - curve.mean.begin()), significant(*last),
                     step(curve.mean.rend() - last - 1));
}

std::string alt_text(const ErrorCurveSpec& spec, const YAxis& axis) {
  std::string text = fmt::format("{}: {} over observations, {}, {} axis. Mean over runs.",
                                 spec.y_label, spec.quantity, counted(spec.curves.size(), "curve"),
                                 axis.scale == Scale::kLog ? "logarithmic" : "linear");
  for (const Curve& curve : spec.curves) text.append(ends_of(curve));
  return text;
}

std::string caption_of(const ErrorCurveSpec& spec) {
  if (!spec.caption.empty()) return spec.caption;
  return fmt::format("Lines: {}, mean over runs; bands: its 95 % interval.", spec.quantity);
}

}  // namespace

Figure error_curve_figure(const ErrorCurveSpec& spec) {
  require_consistent(spec);
  const YAxis axis = y_axis(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.caption = caption_of(spec);
  figure.alt = alt_text(spec, axis);

  if (spec.curves.empty()) figure.notes.push_back({"There are no curves.", Ink::kWarning});
  Panel& panel = figure.panels.emplace_back();
  panel.x.label = "observations (steps)";
  panel.y = {spec.y_label, axis.scale, axis.limits};
  for (std::size_t i = 0; i < spec.curves.size(); ++i) {
    const Curve& curve = spec.curves[i];
    if (curve.low.empty()) continue;
    panel.layers.push_back(Band{curve.label, curve.steps, raised(curve.low, axis),
                                raised(curve.high, axis), series_ink(i),
                                Mark{curve.key + "-band", {{"curve", curve.label}}}});
  }
  for (std::size_t i = 0; i < spec.curves.size(); ++i) {
    const Curve& curve = spec.curves[i];
    panel.layers.push_back(Polyline{curve.label, curve.steps, raised(curve.mean, axis),
                                    series_ink(i), kDashes[i % kDashes.size()], 1.0,
                                    kMarkers[i % kMarkers.size()],
                                    Mark{curve.key + "-mean", {{"curve", curve.label}}}});
  }
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
