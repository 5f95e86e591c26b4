#include "render/figures/curves/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/layer_shapes.hpp"

namespace mapproof {
namespace {

constexpr double kLeastValue = 1e-12;  // Of the greatest value; smaller ones are not shown.
constexpr std::size_t kMostSingularValues = 16;

void require_values(const SingularValuesSpec& spec) {
  for (const SingularValues& one : spec.panels)
    for (const double value : one.values)
      if (value < 0.0 || std::isinf(value))
        throw InvalidInput("figure " + printable(spec.id) +
                           ": a singular value is negative or infinite");
}

/// The level of noise: as given, or what was dropped.
std::optional<double> floor_of(const SingularValues& one) {
  if (one.noise_level && *one.noise_level > 0.0) return one.noise_level;
  if (one.values.size() > one.rank && one.values[one.rank] > 0.0) return one.values[one.rank];
  return std::nullopt;
}

/// Last kept over the floor; NaN if there is no floor or fewer values than the rank.
double ratio_of(const SingularValues& one) {
  const auto floor = floor_of(one);
  if (!floor || one.rank == 0 || one.values.size() < one.rank) return kNaN;
  return one.values[one.rank - 1] / *floor;
}

/// Of the y axis: from below the least value or floor to above the greatest.
Range limits_of(const std::vector<const SingularValues*>& shown) {
  double most = 0.0, least = kInfinity;
  for (const SingularValues* one : shown)
    for (const double value : one->values) most = std::max(most, value);
  for (const SingularValues* one : shown) {
    for (const double value : one->values)
      if (value > kLeastValue * most) least = std::min(least, value);
    if (const auto floor = floor_of(*one))
      least = std::min(least, std::max(*floor, kLeastValue * most));
  }
  return most > 0.0 ? Range{least / 3.0, most * 3.0} : Range{0.1, 1.0};
}

Panel panel_of(const SingularValues& one, std::size_t index, const Range& y, double last) {
  Panel panel;
  panel.title = one.title;
  if (const double ratio = ratio_of(one); std::isfinite(ratio))
    panel.title += fmt::format("\ns{} over floor: {}", one.rank, significant(ratio, 2));
  Segments stems{.colour = ThemeColour::kMuted, .width = 0.7};
  Scatter kept{.label = "kept", .colour = ThemeColour::kSeries1};
  Scatter dropped{.label = "dropped", .colour = ThemeColour::kText, .filled = false};
  for (std::size_t i = 0; i < std::min(one.values.size(), kMostSingularValues); ++i) {
    if (std::isnan(one.values[i]) || one.values[i] < y.low) continue;
    const Point at{static_cast<double>(i + 1), one.values[i]};
    add_line(stems, {at.x, y.low}, at);
    Scatter& points = i < one.rank ? kept : dropped;
    add_point(points, at);
    points.marks.push_back({fmt::format("panel-{}-value-{}", index + 1, i + 1),
                            {{"value", data_number(one.values[i])}}});
  }
  Segments floor{.label = one.noise_level ? "noise floor" : "greatest dropped",
                 .colour = one.noise_level ? ThemeColour::kSeries2 : ThemeColour::kMuted,
                 .dash = one.noise_level ? Dash::kDashed : Dash::kDotted};
  if (const auto level = floor_of(one))
    add_line(floor, {0.4, std::max(*level, y.low)}, {last + 0.6, std::max(*level, y.low)});
  panel.layers = {stems, floor, kept, dropped};
  std::erase_if(panel.layers, is_empty);
  return panel;
}

constexpr double kFloor = 1e-4;  // Of the greatest; smaller shares stand at the foot.
constexpr std::size_t kMostShown = 10;

/// Whether the least eigenvalues make the map.
bool ascends(const std::vector<double>& eigenvalues) {
  return eigenvalues.size() > 1 && eigenvalues.front() < eigenvalues.back();
}

double greatest_of(const SpectrumPanel& method) {
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(method.eigenvalues.size(), kMostShown); ++i)
    most = std::max(most, method.eigenvalues[i]);
  return most;
}

/// The lower end of the axis: below the least share of all, and two decades at least.
double foot_of(const std::vector<SpectrumPanel>& methods) {
  double least = 0.02;
  for (const SpectrumPanel& method : methods) {
    const double most = greatest_of(method);
    for (std::size_t i = 0; i < std::min(method.eigenvalues.size(), kMostShown); ++i)
      if (method.eigenvalues[i] > kFloor * most)
        least = std::min(least, method.eigenvalues[i] / most);
      else if (!std::isnan(method.eigenvalues[i]))
        least = kFloor;
  }
  return std::max(kFloor, 0.5 * least);
}

/// @param foot  Where the stems end.
Panel panel_of(const SpectrumPanel& method, std::size_t index, double foot) {
  Panel panel;
  const double gap = spectral_gap(method.eigenvalues);
  panel.title = method.title;
  if (std::isfinite(gap)) panel.title += "\ngap " + significant(gap, 2);
  if (ascends(method.eigenvalues)) panel.title += "\nsmallest first";
  const std::size_t count = std::min(method.eigenvalues.size(), kMostShown);
  const double most = greatest_of(method);
  Segments stems{.colour = ThemeColour::kMuted, .width = 0.7};
  Scatter used{.label = "axis of the map", .colour = ThemeColour::kSeries2};
  Scatter rest{
      .label = "other eigenvalue", .colour = ThemeColour::kText, .filled = false, .size = 0.8};
  for (std::size_t i = 0; i < count; ++i) {
    const double value = method.eigenvalues[i];
    if (std::isnan(value) || most <= 0.0) continue;
    const Point at{static_cast<double>(i + 1), std::max(value / most, foot)};
    add_line(stems, {at.x, foot}, at);
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

Figure singular_values_figure(const SingularValuesSpec& spec) {
  require_values(spec);
  std::vector<const SingularValues*> shown;
  double last = 4.0;
  for (const SingularValues& one : spec.panels) {
    if (one.values.empty()) continue;
    shown.push_back(&one);
    last = std::max(last, static_cast<double>(std::min(one.values.size(), kMostSingularValues)));
  }
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.shared_x = figure.shared_y = shown.size() > 1;
  figure.caption =
      "Singular values of the matrix of squared ranges; filled: those of the rank of the model; "
      "dashed: the level of noise, or the greatest value that is dropped.";
  figure.alt = "Singular values, logarithmic.";
  const Range y = limits_of(shown);
  std::ptrdiff_t below = 0;
  for (const SingularValues* one : shown) {
    figure.panels.push_back(panel_of(*one, figure.panels.size(), y, last));
    figure.alt += fmt::format(" {}:", one->title);
    for (std::size_t i = 0; i < std::min(one->values.size(), kMostSingularValues); ++i)
      below += one->values[i] < y.low ? 1 : 0;
    for (std::size_t i = 0; i < std::min(one->values.size(), kMostSingularValues); ++i)
      figure.alt += fmt::format("{} {}", i == 0 ? "" : ",", significant(one->values[i]));
    figure.alt += ".";
  }
  if (below > 0)
    figure.caption += fmt::format(" Not shown, as 0 within rounding: {}.", counted(below, "value"));
  if (figure.panels.empty()) {
    figure.panels.resize(1);
    figure.notes.push_back({"There are no singular values.", ThemeColour::kWarning});
  }
  for (Panel& panel : figure.panels) {
    panel.x = {.label = "singular value", .limits = Range{0.4, last + 0.6}, .whole = true};
    panel.y = {.label = "value [m\u00B2]", .scale = Scale::kLog, .limits = y};
  }
  require_valid(figure);
  return figure;
}

double spectral_gap(const std::vector<double>& eigenvalues) {
  if (eigenvalues.size() < 3) return kNaN;
  const double second = eigenvalues[1], third = eigenvalues[2];
  if (!(second > 0.0) || !(third > 0.0)) return kNaN;
  return ascends(eigenvalues) ? third / second : second / third;
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
  const double foot = foot_of(spec.methods);
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
    figure.panels.push_back(panel_of(method, figure.panels.size(), foot));
  }
  if (figure.panels.empty()) {
    figure.panels.resize(1);
    figure.notes.push_back({"No method has eigenvalues.", ThemeColour::kWarning});
  }
  for (Panel& panel : figure.panels) {
    panel.x = {.label = "eigenvalue", .limits = Range{0.4, last + 0.6}, .whole = true};
    panel.y = {.label = "share of the greatest", .scale = Scale::kLog, .limits = Range{foot, 2.0}};
  }
  figure.caption =
      "Leading eigenvalues of each method in shares of the greatest; filled: those of the map's "
      "axes; gap: the ratio of the second and the third. The greatest come first, unless the panel "
      "has \u201csmallest first\u201d: there the least make the map.";
  if (!without.empty())
    figure.caption += " Without eigenvalues, since iterative: " + listed(without, 6) + ".";
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
