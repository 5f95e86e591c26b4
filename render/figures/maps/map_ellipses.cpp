#include "render/figures/maps/map_ellipses.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/maps/ellipse_frame.hpp"

namespace mapproof {
namespace {

constexpr double kLongest = 0.25;  // An axis longer than this share of the map is cut.

bool shown(const Panel& panel, double x, double y) {
  const auto within = [](const std::optional<Range>& limits, double at) {
    return !limits || (limits->low <= at && at <= limits->high);
  };
  return within(panel.x.limits, x) && within(panel.y.limits, y);
}

Ellipses ellipses_of(const MapRecord& record, const MapUncertainty& uncertainty,
                     const Panel& panel) {
  Ellipses shapes{
      .label = "95 % ellipse", .colour = ThemeColour::kSeries1, .fill = Fill::kTint, .width = 0.6};
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i) {
    const double x = record.estimate(i, 0), y = record.estimate(i, 1);
    const auto ellipse = confidence_ellipse(uncertainty, i);
    if (!ellipse || !std::isfinite(x + y) || !shown(panel, x, y)) continue;
    shapes.x.push_back(x), shapes.y.push_back(y);
    shapes.a.push_back(ellipse->a), shapes.b.push_back(ellipse->b);
    shapes.rotation_rad.push_back(ellipse->rotation_rad);
    shapes.marks.push_back({fmt::format("ellipse-{}", i + 1),
                            {{"landmark", record.names[static_cast<std::size_t>(i)]},
                             {"kind", "ellipse"},
                             {"a", data_number(ellipse->a)},
                             {"b", data_number(ellipse->b)}}});
  }
  return shapes;
}

/// An ellipse as large as the map must not make all the rest small.
void limit(const MapRecord& record, const Ellipses& shapes, Panel& panel) {
  if (panel.x.limits || shapes.a.empty()) return;
  Span x, y;
  const auto see = [&](const Points& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      if (points.row(i).allFinite()) x.see(points(i, 0)), y.see(points(i, 1));
  };
  see(record.estimate);
  if (record.ground_truth_m && record.frame == Frame::kGroundTruth) see(*record.ground_truth_m);
  const double side = std::max(x.high - x.low, y.high - y.low);
  if (!(side > 0.0) || std::ranges::max(shapes.a) <= kLongest * side) return;
  const double by = kLongest * side;
  panel.x.limits = Range{x.low - by, x.high + by};
  panel.y.limits = Range{y.low - by, y.high + by};
}

}  // namespace

void add_ellipses(const MapRecord& record, const MapUncertainty& uncertainty, Figure& figure) {
  if (std::ssize(uncertainty.covariances) != record.estimate.rows())
    throw InvalidInput("a map's ellipses need a covariance a landmark");
  Panel& panel = figure.panels.at(0);
  Ellipses shapes = ellipses_of(record, uncertainty, panel);
  if (shapes.x.empty()) return;
  limit(record, shapes, panel);
  panel.layers.insert(panel.layers.begin(), shapes);
  const char* unit = record.frame == Frame::kGroundTruth ? " m" : "";
  if (auto note = cut_ellipses_note(shapes, panel_limits(panel), unit))
    figure.notes.push_back(*std::move(note));
  figure.caption += " " + ellipse_words(uncertainty);
}

std::string ellipse_words(const MapUncertainty& uncertainty) {
  std::string words = fmt::format(
      "Ellipses ({:g} %): where the mean of the maps of other such walks would lie, by {} of "
      "blocks of {}, as bootstrap resamples; a bias that all these maps share is not included.",
      100.0 * uncertainty.confidence, counted(uncertainty.maps, "map"),
      counted(uncertainty.block_steps, "step"));
  if (uncertainty.maps < uncertainty.replicates)
    words += fmt::format(" {} of {} draws gave no map.", uncertainty.replicates - uncertainty.maps,
                         uncertainty.replicates);
  return words;
}

}  // namespace mapproof
