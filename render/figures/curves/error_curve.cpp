#include "render/figures/curves/error_curve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/figures/words.hpp"

namespace mapproof {
namespace {

std::string ends_of(const ErrorLine& curve) {
  const auto known = [](double value) { return std::isfinite(value); };
  const auto first = std::ranges::find_if(curve.mean, known);
  if (first == curve.mean.end()) return fmt::format(" {}: nothing known.", curve.label);
  const auto last = std::find_if(curve.mean.rbegin(), curve.mean.rend(), known);
  const auto step = [&curve](std::ptrdiff_t place) { return data_number(curve.x[place]); };
  return fmt::format(" {}: {} at {}, {} at {}.", curve.label, significant(*first),
                     step(first - curve.mean.begin()), significant(*last),
                     step(curve.mean.rend() - last - 1));
}

std::string alt_text(const ErrorCurveSpec& spec, Scale scale) {
  std::string text = fmt::format("{}: {} over observations, {}, {} axis. Mean over runs.",
                                 spec.y_label, spec.quantity, counted(spec.curves.size(), "curve"),
                                 scale == Scale::kLog ? "logarithmic" : "linear");
  for (const ErrorLine& curve : spec.curves) text.append(ends_of(curve));
  return text;
}

}  // namespace

Figure error_curve_figure(const ErrorCurveSpec& spec) {
  ErrorLinesSpec lines;
  lines.id = spec.id;
  lines.title = spec.title;
  lines.y_label = spec.y_label;
  lines.quantity = spec.quantity;
  lines.caption = spec.caption;
  lines.record_ids = spec.record_ids;
  ErrorPanel& panel = lines.panels.emplace_back();
  panel.x.label = "observations (steps)";
  panel.lines = spec.curves;
  Figure figure = error_lines_figure(lines);
  figure.alt = alt_text(spec, figure.panels.front().y.scale);
  return figure;
}

}  // namespace mapproof
