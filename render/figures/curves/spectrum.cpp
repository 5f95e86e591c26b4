#include "render/figures/curves/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr double kFloor = 1e-4;  // Of the greatest; smaller shares stand at the foot.
constexpr std::size_t kMostShown = 10;

Panel panel_of(const SpectrumPanel& method, std::size_t index) {
  Panel panel;
  const double gap = spectral_gap(method.eigenvalues);
  panel.title = method.title;
  if (std::isfinite(gap)) panel.title += "\ngap " + significant(gap, 2);
  const std::size_t count = std::min(method.eigenvalues.size(), kMostShown);
  double most = 0.0;
  for (std::size_t i = 0; i < count; ++i) most = std::max(most, method.eigenvalues[i]);
  Segments stems{.ink = Ink::kMuted, .width = 0.7};
  Scatter used{.label = "axis of the map", .ink = Ink::kSeries2};
  Scatter rest{.label = "other eigenvalue", .ink = Ink::kText, .filled = false, .size = 0.8};
  for (std::size_t i = 0; i < count; ++i) {
    const double value = method.eigenvalues[i];
    if (std::isnan(value) || most <= 0.0) continue;
    const Point at{static_cast<double>(i + 1), std::max(value / most, kFloor)};
    add_line(stems, {at.x, kFloor}, at);
    Scatter& points = i < 2 ? used : rest;
    add_point(points, at);
    points.marks.push_back({fmt::format("method-{}-value-{}", index + 1, i + 1),
                            {{"method", method.title}, {"eigenvalue", data_number(value)}}});
  }
  panel.layers = {stems, used, rest};
  std::erase_if(panel.layers, is_empty);
  return panel;
}

}  // namespace

double spectral_gap(const std::vector<double>& eigenvalues) {
  if (eigenvalues.size() < 3) return NAN;
  const double second = eigenvalues[1], third = eigenvalues[2];
  if (!(second > 0.0) || !(third > 0.0)) return NAN;
  return eigenvalues.front() >= eigenvalues.back() ? second / third : third / second;
}

Figure spectrum_figure(const SpectrumSpec& spec) {
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.columns = 5;
  figure.shared_x = figure.shared_y = true;
  figure.alt =
      "Eigenvalues in shares of the greatest, logarithmic. Ratio of the second and the "
      "third:";
  std::vector<std::string> without;
  double last = 3.0;
  for (const SpectrumPanel& method : spec.methods) {
    for (const double value : method.eigenvalues)
      if (std::isinf(value))
        throw InvalidInput("figure " + printable(spec.id) + ": an infinite eigenvalue");
    if (method.eigenvalues.empty()) {
      without.push_back(method.title);
      continue;
    }
    last = std::max(last, static_cast<double>(std::min(method.eigenvalues.size(), kMostShown)));
    figure.alt +=
        fmt::format(" {} {}.", method.title, significant(spectral_gap(method.eigenvalues)));
    figure.panels.push_back(panel_of(method, figure.panels.size()));
  }
  if (figure.panels.empty()) {
    figure.panels.resize(1);
    figure.notes.push_back({"No method has eigenvalues.", Ink::kWarning});
  }
  for (Panel& panel : figure.panels) {
    panel.x = {.label = "eigenvalue", .limits = Range{0.4, last + 0.6}, .whole = true};
    panel.y = {
        .label = "share of the greatest", .scale = Scale::kLog, .limits = Range{kFloor, 2.0}};
  }
  figure.caption =
      "Leading eigenvalues of each method in shares of the greatest; filled: those of the map's "
      "axes; gap: the ratio of the second and the third. Where the least eigenvalues make the map, "
      "they ascend.";
  if (!without.empty())
    figure.caption += " Without eigenvalues, since iterative: " + listed(without, 6) + ".";
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
