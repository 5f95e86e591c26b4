#include "render/figures/diagrams/shepard.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/plot/axis_map.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostPoints = 200;  // Of more pairs the density is shown.
constexpr std::size_t kColumns = 36, kRows = 30;
constexpr double kMostOfMedian = 2.5;  // One failed map must not flatten the others.

bool known(const ShepardPanel& panel, std::size_t i) {
  return !std::isnan(panel.observed[i] + panel.mapped_m[i]);
}

double greatest(const ShepardPanel& panel, const std::vector<double>& values) {
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (known(panel, i)) most = std::max(most, values[i]);
  return most;
}

/// From 0 to what nearly all panels need.
PanelLimits limits_of(const ShepardSpec& spec) {
  double x = 0.0;
  std::vector<double> tops;
  for (const ShepardPanel& panel : spec.methods) {
    x = std::max(x, greatest(panel, panel.observed));
    if (const double top = greatest(panel, panel.mapped_m); top > 0.0) tops.push_back(top);
  }
  std::ranges::sort(tops);
  const double y =
      tops.empty() ? 1.0 : std::min(tops.back(), kMostOfMedian * tops[(tops.size() - 1) / 2]);
  return {{0.0, x > 0.0 ? 1.04 * x : 1.0}, {0.0, 1.04 * y}};
}

/// The logarithm of 1 + the number of pairs in each cell; NaN where there are none.
Cells density(const ShepardPanel& panel, const PanelLimits& limits) {
  Cells cells{.label = "pairs, few to many", .x = limits.x, .y = limits.y, .columns = kColumns};
  std::vector<double> counts(kColumns * kRows, 0.0);
  for (std::size_t i = 0; i < panel.observed.size(); ++i) {
    if (!known(panel, i) || panel.mapped_m[i] > limits.y.high) continue;
    const auto position = [](double value, double high, std::size_t count) {
      return std::min(static_cast<std::size_t>(value / high * static_cast<double>(count)),
                      count - 1);
    };
    const std::size_t column = position(panel.observed[i], limits.x.high, kColumns);
    const std::size_t row = kRows - 1 - position(panel.mapped_m[i], limits.y.high, kRows);
    counts[row * kColumns + column] += 1.0;
  }
  double most = 1.0;
  for (double& count : counts) {
    most = std::max(most, count);
    count = count > 0.0 ? std::log1p(count) : kNaN;
  }
  cells.values = std::move(counts);
  // Even a single pair is visible on the background.
  cells.colour_scale.limits = {0.4 * std::log1p(1.0), std::log1p(most)};
  cells.colour = ThemeColour::kSeries1;
  return cells;
}

Scatter dots(const ShepardPanel& panel) {
  Scatter points{.label = "pair of landmarks", .colour = ThemeColour::kSeries1, .size = 0.4};
  for (std::size_t i = 0; i < panel.observed.size(); ++i)
    if (known(panel, i)) add_point(points, {panel.observed[i], panel.mapped_m[i]});
  return points;
}

}  // namespace

ShepardFit shepard_fit(const ShepardPanel& panel) {
  if (panel.observed.size() != panel.mapped_m.size())
    throw InvalidInput("Shepard diagram " + printable(panel.title) + ": counts differ");
  ShepardFit fit;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < panel.observed.size(); ++i) {
    const double a = panel.observed[i], b = panel.mapped_m[i];
    if (std::isinf(a) || std::isinf(b) || a < 0.0 || b < 0.0)
      throw InvalidInput("Shepard diagram " + printable(panel.title) + ": no distance");
    if (!known(panel, i)) continue;
    ++fit.pairs;
    x += a, y += b, xx += a * a, xy += a * b, yy += b * b;
  }
  const auto n = static_cast<double>(fit.pairs);
  const double vx = xx - x * x / n, vy = yy - y * y / n;
  fit.correlation =
      vx > 1e-12 * xx && vy > 1e-12 * yy ? (xy - x * y / n) / std::sqrt(vx * vy) : kNaN;
  fit.slope = xx > 0.0 ? xy / xx : kNaN;
  fit.stress = yy > 0.0 ? std::sqrt(std::max(yy - fit.slope * xy, 0.0) / yy) : kNaN;
  return fit;
}

Figure shepard_figure(const ShepardSpec& spec) {
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.columns = 5;
  figure.shared_x = figure.shared_y = true;
  figure.alt = spec.y_label + " against " + spec.x_label + ". Correlation r and stress:";
  std::vector<ShepardFit> fits;
  for (const ShepardPanel& method : spec.methods) fits.push_back(shepard_fit(method));
  const PanelLimits limits = limits_of(spec);
  for (std::size_t i = 0; i < spec.methods.size(); ++i) {
    const ShepardPanel& method = spec.methods[i];
    Panel& panel = figure.panels.emplace_back();
    panel.title = fmt::format("{}\nr = {}\nstress {}", method.title,
                              significant(fits[i].correlation, 2), significant(fits[i].stress, 2));
    panel.x = {.label = spec.x_label, .limits = limits.x};
    panel.y = {.label = spec.y_label, .limits = limits.y};
    if (fits[i].pairs > kMostPoints)
      panel.layers.push_back(density(method, limits));
    else if (fits[i].pairs > 0)
      panel.layers.push_back(dots(method));
    if (fits[i].slope > 0.0)
      panel.layers.push_back(Polyline{.label = "best proportion",
                                      .x = {0.0, limits.x.high},
                                      .y = {0.0, fits[i].slope * limits.x.high},
                                      .colour = ThemeColour::kSeries2,
                                      .dash = Dash::kDashed});
    figure.alt +=
        fmt::format(" {}: r {}, stress {}, {}.", method.title, significant(fits[i].correlation),
                    significant(fits[i].stress), counted(fits[i].pairs, "pair"));
    if (greatest(method, method.mapped_m) > limits.y.high)
      figure.notes.push_back(
          {fmt::format("{}: distances up to {} m are outside the image.", method.title,
                       significant(greatest(method, method.mapped_m))),
           ThemeColour::kWarning});
  }
  figure.caption =
      "Each pair of landmarks: its distance in the observations and on the map, darker where there "
      "are more pairs; r: their correlation; dashed: the best proportion; stress: what it leaves, "
      "root mean square over that of the map distances.";
  if (figure.panels.empty()) {
    figure.panels.resize(1);
    figure.notes.push_back({"There are no methods.", ThemeColour::kWarning});
  }
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
