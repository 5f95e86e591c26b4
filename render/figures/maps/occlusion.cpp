#include "render/figures/maps/occlusion.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "render/base/span.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/number_text.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

constexpr int kMostBins = 12;

void require_consistent(const OcclusionSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  for (const double share : spec.hidden_share)
    if (!(share >= 0.0 && share <= 1.0)) refuse("a share is not in 0 to 1");
  for (const OcclusionMethod& method : spec.methods)
    if (method.mpe_m.size() != spec.hidden_share.size())
      refuse("method " + printable(method.label) + " has not as many errors as there are runs");
}

std::vector<double> percent(const std::vector<double>& shares) {
  std::vector<double> values;
  for (const double share : shares) values.push_back(100.0 * share);
  return values;
}

/// The number of runs in bins of a round width.
Panel histogram(const std::vector<double>& shares) {
  Panel panel;
  panel.title = "Runs";
  panel.y.label = "runs";
  panel.y.whole = true;
  Span span;
  span.see(shares);
  Area bars{.colour = ThemeColour::kSeries1, .outlined = true, .width = 0.8};
  double most = 0.0;
  if (span.known()) {
    const double width = std::max(tick_step(span.low, span.high + 1e-9, kMostBins), 0.1);
    const double first = std::floor(span.low / width);
    std::vector<double> counts(static_cast<std::size_t>(std::floor(span.high / width) - first) + 1);
    for (const double share : shares)
      counts[static_cast<std::size_t>(std::floor(share / width) - first)] += 1.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double low = (first + static_cast<double>(i)) * width;
      if (counts[i] > 0.0) add_box(bars, {low, low + width}, {0.0, counts[i]});
      most = std::max(most, counts[i]);
    }
  }
  panel.y.limits = Range{0.0, most > 0.0 ? 1.08 * most : 1.0};
  if (!bars.x.empty()) panel.layers.push_back(std::move(bars));
  return panel;
}

Panel errors(const OcclusionSpec& spec, const std::vector<double>& shares) {
  Panel panel;
  panel.title = "Error against it";
  std::vector<double> all;
  for (const OcclusionMethod& method : spec.methods)
    all.insert(all.end(), method.mpe_m.begin(), method.mpe_m.end());
  const ErrorAxis axis = error_axis(all, {});
  panel.y.label = "MPE [m]";
  panel.y.scale = axis.scale;
  panel.y.limits = axis.limits;
  std::vector<std::optional<std::size_t>> asked;
  for (const OcclusionMethod& method : spec.methods) asked.push_back(method.series);
  const std::vector<std::size_t> series = series_of(asked);
  for (std::size_t i = 0; i < spec.methods.size(); ++i) {
    const OcclusionMethod& method = spec.methods[i];
    const SeriesStyle style = series_style(series[i]);
    Scatter points{.label = method.label,
                   .colour = style.colour,
                   .marker = style.marker,
                   .filled = i % 2 == 0,
                   .size = 0.8};
    points.x = shares;
    points.y = axis.raised(method.mpe_m);
    for (std::size_t run = 0; run < shares.size(); ++run)
      points.marks.push_back(
          {fmt::format("{}-{}", method.key, run + 1),
           {{"method", method.label}, {"error", data_number(method.mpe_m[run])}}});
    if (!points.x.empty()) panel.layers.push_back(std::move(points));
  }
  return panel;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0.0, sx = 0.0, sy = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!std::isfinite(x[i] + y[i])) continue;
    n += 1.0, sx += x[i], sy += y[i];
    xx += x[i] * x[i], xy += x[i] * y[i], yy += y[i] * y[i];
  }
  const double vx = xx - sx * sx / n, vy = yy - sy * sy / n;
  if (n < 3.0 || vx <= 1e-12 * xx || vy <= 1e-12 * yy) return kNaN;
  return (xy - sx * sy / n) / std::sqrt(vx * vy);
}

Figure occlusion_figure(const OcclusionSpec& spec) {
  require_consistent(spec);
  const std::vector<double> shares = percent(spec.hidden_share);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.columns = 2;
  figure.shared_x = true;
  figure.panels = {histogram(shares), errors(spec, shares)};
  for (Panel& panel : figure.panels)
    panel.x.label = "scans within reach that occlusion decides [%]";
  figure.caption =
      "Share of the scans of landmarks within reach in which another landmark hides the one "
      "observed, so that visibility does not depend on robot and landmark alone; the number of "
      "runs, and "
      "the error of each run's maps.";
  if (shares.empty()) {
    figure.notes.push_back({"There are no runs.", ThemeColour::kWarning});
    figure.alt = "No runs.";
  } else {
    const auto [low, high] = std::ranges::minmax(shares);
    const std::string share = fmt::format(
        "Occlusion decides {} % of the scans within reach on average over {}, {} to {} %.",
        significant(mean(shares)), counted(static_cast<long long>(shares.size()), "run"),
        significant(low), significant(high));
    figure.caption += " " + share;
    figure.alt = share;
    if (!spec.methods.empty()) figure.alt += " Correlation with the error:";
    for (const OcclusionMethod& method : spec.methods)
      figure.alt +=
          fmt::format(" {} {}.", method.label, significant(correlation(shares, method.mpe_m), 2));
  }
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
