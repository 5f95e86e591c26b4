#include "render/figures/diagrams/heat_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Core>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/layer_shapes.hpp"

namespace mapproof {
namespace {

constexpr double kWideRange = 10.0;  ///< Of greatest to least, from which colours are logarithmic.
constexpr int kCellDigits = 2;       ///< Of numbers that decimals do not show: cells are narrow.
constexpr int kHatchLines = 5;       ///< Across a missing cell, each way of its diagonal.

/// "over 1 km" in a cell.
constexpr const char* kGreatCellText = ">\u00A01\u00A0km";

bool is_great(const HeatMapSpec& spec, double value) {
  return spec.great_errors && value > kGreatestError_m;
}

std::string with_unit_of(const HeatMapSpec& spec, double value) {
  if (is_great(spec, value)) return kGreatErrorText;
  return with_plain_spaces(with_unit(rounded_text(value, spec.decimals, value), spec.unit));
}

std::string place_of(const HeatMapSpec& spec, std::size_t cell) {
  return fmt::format("{} {}, {} {}", spec.x_label, spec.x_names[cell % spec.x_names.size()],
                     spec.y_label, spec.y_names[cell / spec.x_names.size()]);
}

void check_heat_map(const HeatMapSpec& spec) {
  if (spec.x_names.empty() || spec.values.size() != spec.x_names.size() * spec.y_names.size())
    throw InvalidInput("a heat map whose values are not as many as its cells");
  if (std::ranges::none_of(spec.values, [](double value) { return std::isfinite(value); }))
    throw InvalidInput("a heat map without a value");
}

/// Parallels to the diagonal of the unit square about (x, y).
void hatch(double x, double y, Segments& lines) {
  for (int k = 1 - kHatchLines; k < kHatchLines; ++k) {
    const double shift = static_cast<double>(k) / kHatchLines;
    add_line(lines, {x - 0.5 + std::max(0.0, shift), y - 0.5 + std::max(0.0, -shift)},
             {x + 0.5 + std::min(0.0, shift), y + 0.5 - std::max(0.0, shift)});
  }
}

/// The values from the least to the greatest, and what other maps need; a little more where all are
/// the same. Without those of maps that diverged, unless all are.
Range span_of(const HeatMapSpec& spec) {
  Range range = spec.shared_span.value_or(Range{HUGE_VAL, -HUGE_VAL});
  for (const double value : spec.values) {
    if (!std::isfinite(value) || is_great(spec, value)) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  if (range.low > range.high) range = {kGreatestError_m, kGreatestError_m};
  if (range.low < range.high) return range;
  const double around = range.low == 0.0 ? 1.0 : 0.1 * std::abs(range.low);
  return {range.low - around, range.high + around};
}

/// Of colours that show this range.
Scale colour_scale_of(const HeatMapSpec& spec, const Range& limits) {
  const bool is_wide = limits.low > 0.0 && limits.high > kWideRange * limits.low;
  return is_wide && spec.unit != "%" ? Scale::kLog : Scale::kLinear;
}

/// The greatest size of a number in the cells.
double greatest_size(const HeatMapSpec& spec) {
  double greatest = 0.0;
  for (const double value : spec.values)
    if (std::isfinite(value) && !is_great(spec, value))
      greatest = std::max(greatest, std::abs(value));
  return greatest;
}

/// @param greatest  See greatest_size().
std::string cell_text(const HeatMapSpec& spec, double value, Scale scale, double greatest) {
  constexpr int kDigits = 3;
  if (is_great(spec, value)) return kGreatCellText;
  if (scale == Scale::kLinear) return rounded_text(value, spec.decimals, greatest, kCellDigits);
  const int before = static_cast<int>(std::floor(std::log10(value))) + 1;
  return rounded_text(value, std::clamp(kDigits - before, 0, spec.decimals), greatest, kCellDigits);
}

Cells cells_of(const HeatMapSpec& spec) {
  Cells cells;
  const std::size_t columns = spec.x_names.size(), rows = spec.y_names.size();
  cells.x = {-0.5, static_cast<double>(columns) - 0.5};
  cells.y = {-0.5, static_cast<double>(rows) - 0.5};
  cells.columns = columns;
  cells.colour_scale.ramp = Ramp::kViridis;
  cells.colour_scale.limits = span_of(spec);
  cells.colour_scale.scale = colour_scale_of(spec, cells.colour_scale.limits);
  cells.colour_scale.bar_label =
      spec.unit.empty() ? spec.quantity : spec.quantity + " [" + spec.unit + "]";
  const double greatest = greatest_size(spec);
  for (std::size_t row = rows; row-- > 0;)  // The uppermost first.
    for (std::size_t column = 0; column < columns; ++column) {
      const double value = spec.values[row * columns + column];
      const bool is_there = std::isfinite(value);
      cells.values.push_back(is_there ? value : kNaN);
      cells.text.push_back(is_there ? cell_text(spec, value, cells.colour_scale.scale, greatest)
                                    : "");
    }
  return cells;
}

/// The cells of the least and of the greatest value.
std::pair<std::size_t, std::size_t> extreme_cells(const HeatMapSpec& spec) {
  std::size_t least = 0, most = 0;
  const auto beats = [&](std::size_t i, std::size_t so_far, double sign) {
    const double value = spec.values[i], best = spec.values[so_far];
    return std::isfinite(value) && (!std::isfinite(best) || sign * value > sign * best);
  };
  for (std::size_t i = 0; i < spec.values.size(); ++i) {
    if (beats(i, least, -1.0)) least = i;
    if (beats(i, most, 1.0)) most = i;
  }
  return {least, most};
}

std::string description_of(const HeatMapSpec& spec) {
  const auto [least, most] = extreme_cells(spec);
  return fmt::format("Least: {} at {}; greatest: {} at {}.", with_unit_of(spec, spec.values[least]),
                     place_of(spec, least), with_unit_of(spec, spec.values[most]),
                     place_of(spec, most));
}

}  // namespace

Figure heat_map_figure(const HeatMapSpec& spec) {
  check_heat_map(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  Panel& panel = figure.panels.emplace_back();
  Cells cells = cells_of(spec);
  panel.x = {.label = spec.x_label, .limits = cells.x, .names = spec.x_names};
  panel.y = {.label = spec.y_label, .limits = cells.y, .names = spec.y_names};

  Area missing{.colour = ThemeColour::kMuted, .fill = Fill::kTint};
  Segments hatching{.colour = ThemeColour::kMuted};
  int count = 0;
  for (std::size_t i = 0; i < spec.values.size(); ++i) {
    if (std::isfinite(spec.values[i])) continue;
    const std::size_t column = i % spec.x_names.size(), row = i / spec.x_names.size();
    const auto x = static_cast<double>(column), y = static_cast<double>(row);
    add_box(missing, {x - 0.5, x + 0.5}, {y - 0.5, y + 0.5});
    hatch(x, y, hatching);
    ++count;
  }
  figure.caption = fmt::format(
      "Colours: {} over {} and {}, mean over runs{}{}.", spec.quantity, spec.x_label, spec.y_label,
      cells.colour_scale.scale == Scale::kLog ? ", on a logarithmic scale" : "",
      spec.shared_span ? ", the same for all methods" : "");
  if (count > 0) {
    figure.notes.push_back({"Hatched: " + spec.missing + ".", ThemeColour::kText});
    figure.caption += fmt::format(" Hatched, {}: {}.", counted(count, "cell"), spec.missing);
    panel.layers.emplace_back(std::move(missing));
    panel.layers.emplace_back(std::move(hatching));
  }
  panel.layers.emplace_back(std::move(cells));
  figure.alt = figure.caption + " " + description_of(spec);
  require_valid(figure);
  return figure;
}

namespace {

/// How much values differ within a row: the standard deviation, of all rows together.
double spread_in_rows(const Eigen::ArrayXXd& rows) {
  const Eigen::ArrayXXd deviations = rows.colwise() - rows.rowwise().mean();
  return std::sqrt(deviations.square().sum() /
                   static_cast<double>(rows.rows() * (rows.cols() - 1)));
}

/// "MPE depends more on side of the room than on landmarks, between 0.04 m and 0.36 m": which of
/// the factors changes the values at least twice as much as the other, as the colours show them.
/// Empty if none does, if a value is missing or great, if all are shown alike, or if a factor has
/// fewer than three levels.
std::string finding_of_factors(const HeatMapSpec& spec, const std::string& quantity) {
  // Noise alone does as much in one of 40 maps of 3 x 3 cells, but in one of four of 2 x 2.
  constexpr double kClear = 2.0;
  constexpr std::size_t kFewestLevels = 3;
  if (std::min(spec.x_names.size(), spec.y_names.size()) < kFewestLevels ||
      std::ranges::any_of(spec.values, [&](double value) {
        return !std::isfinite(value) || is_great(spec, value);
      }))
    return "";
  const auto [least, most] = std::ranges::minmax(spec.values);
  const std::string low = quantity_text(least, spec.unit), high = quantity_text(most, spec.unit);
  if (low == high) return "";  // Means of equal values differ by rounding.
  const auto columns = static_cast<Eigen::Index>(spec.x_names.size());
  const auto rows = static_cast<Eigen::Index>(spec.y_names.size());
  Eigen::ArrayXXd along_y = Eigen::Map<const Eigen::ArrayXXd>(spec.values.data(), columns, rows);
  if (colour_scale_of(spec, span_of(spec)) == Scale::kLog) along_y = along_y.log().eval();
  const double of_y = spread_in_rows(along_y), of_x = spread_in_rows(along_y.transpose());
  if (std::max(of_x, of_y) < kClear * std::min(of_x, of_y)) return "";
  const std::string x = line_axis(spec.x_label).name, y = line_axis(spec.y_label).name;
  return fmt::format("{} depends more on {} than on {}, between {} and {}", quantity,
                     of_x > of_y ? x : y, of_x > of_y ? y : x, low, high);
}

}  // namespace

std::string heat_map_finding(const HeatMapSpec& spec, const std::string& quantity) {
  check_heat_map(spec);
  if (const std::string factors = finding_of_factors(spec, quantity); !factors.empty())
    return factors;
  const auto words = [&](std::size_t cell) {
    const double value = spec.values[cell];
    return fmt::format(
        "{} at {} and {}",
        is_great(spec, value) ? kGreatErrorText : quantity_text(value, spec.unit),
        with_unit(spec.x_names[cell % spec.x_names.size()], line_axis(spec.x_label).unit),
        with_unit(spec.y_names[cell / spec.x_names.size()], line_axis(spec.y_label).unit));
  };
  const auto [least, most] = extreme_cells(spec);
  if (is_great(spec, spec.values[least]))
    return fmt::format("{} {} everywhere", quantity, kGreatErrorText);
  return fmt::format("lowest {} {}, highest {}", quantity, words(least), words(most));
}

}  // namespace mapproof
