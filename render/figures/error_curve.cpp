#include "render/figures/error_curve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/figures/error_lines.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

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

ErrorAxis y_axis(const ErrorCurveSpec& spec) {
  std::vector<double> means, intervals;
  for (const Curve& curve : spec.curves) {
    means.insert(means.end(), curve.mean.begin(), curve.mean.end());
    intervals.insert(intervals.end(), curve.low.begin(), curve.low.end());
    intervals.insert(intervals.end(), curve.high.begin(), curve.high.end());
  }
  return error_axis(means, intervals);
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

std::string alt_text(const ErrorCurveSpec& spec, const ErrorAxis& axis) {
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
  const ErrorAxis axis = y_axis(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.caption = caption_of(spec);
  figure.alt = alt_text(spec, axis);

  if (spec.curves.empty()) figure.notes.push_back({"There are no curves.", Ink::kWarning});
  Panel& panel = figure.panels.emplace_back();
  panel.x.label = "observations (steps)";
  panel.y = {.label = spec.y_label, .scale = axis.scale, .limits = axis.limits};
  for (std::size_t i = 0; i < spec.curves.size(); ++i) {
    const Curve& curve = spec.curves[i];
    if (curve.low.empty()) continue;
    panel.layers.push_back(Band{curve.label, curve.steps, axis.raised(curve.low),
                                axis.raised(curve.high), series_ink(i),
                                Mark{curve.key + "-band", {{"curve", curve.label}}}});
  }
  for (std::size_t i = 0; i < spec.curves.size(); ++i) {
    const Curve& curve = spec.curves[i];
    const SeriesLook look = series_look(i);
    panel.layers.push_back(Polyline{curve.label, curve.steps, axis.raised(curve.mean), look.ink,
                                    look.dash, 1.0, look.marker,
                                    Mark{curve.key + "-mean", {{"curve", curve.label}}}});
  }
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
