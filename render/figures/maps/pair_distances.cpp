#include "render/figures/maps/pair_distances.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/intervals.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/maps/map_ellipses.hpp"

namespace mapproof {
namespace {

void require_consistent(const MeasuredMapSpec& spec) {
  const Eigen::Index rows = spec.map.estimate.rows();
  for (const MeasuredPair& pair : spec.pairs)
    if (pair.first < 0 || pair.second >= rows || pair.first >= pair.second)
      throw InvalidInput("figure " + printable(spec.id) + ": a pair of rows that are not there");
}

Segments pair_lines(const MeasuredMapSpec& spec) {
  Segments lines{.label = "measured pair", .colour = ThemeColour::kMuted, .width = 0.3};
  for (const MeasuredPair& pair : spec.pairs) {
    const auto from = spec.map.estimate.row(pair.first), to = spec.map.estimate.row(pair.second);
    if (!from.allFinite() || !to.allFinite()) continue;
    add_line(lines, point_of(from), point_of(to));
    Mark mark{fmt::format("pair-{}-{}", pair.first + 1, pair.second + 1), {}};
    mark.data = {{"first", spec.map.names[static_cast<std::size_t>(pair.first)]},
                 {"second", spec.map.names[static_cast<std::size_t>(pair.second)]},
                 {"distance", data_number(pair.distance_m)},
                 {"scans", std::to_string(pair.scans)}};
    lines.marks.push_back(std::move(mark));
  }
  return lines;
}

/// Distances of the pairs between known positions, compared with those measured.
struct Distances {
  const char* where;  ///< "in the map".
  Scatter against;    ///< Measured and known distance.
  Scatter off;        ///< Known distance, and what the measured one is longer.
};

Distances distances_in(const Points& positions_shown_m, const PairDistancesSpec& spec,
                       const char* where, ThemeColour colour, Marker marker) {
  Distances result{where, Scatter{.label = where, .colour = colour, .marker = marker, .size = 0.5},
                   Scatter{.label = where, .colour = colour, .marker = marker, .size = 0.5}};
  for (const MeasuredPair& pair : spec.pairs) {
    const double known_m =
        (positions_shown_m.row(pair.first) - positions_shown_m.row(pair.second)).norm();
    if (std::isnan(known_m)) continue;
    Mark mark;
    mark.data = {{"first", spec.map.names[static_cast<std::size_t>(pair.first)]},
                 {"second", spec.map.names[static_cast<std::size_t>(pair.second)]},
                 {"scans", std::to_string(pair.scans)}};
    const std::string id =
        fmt::format("{}-{}-{}", marker == Marker::kCircle ? "map" : "ground-truth", pair.first + 1,
                    pair.second + 1);
    mark.id = id;
    add_point(result.against, {known_m, pair.distance_m});
    result.against.marks.push_back(mark);
    mark.id = "off-" + id;
    add_point(result.off, {known_m, pair.distance_m - known_m});
    result.off.marks.push_back(std::move(mark));
  }
  return result;
}

double median_off(const Distances& distances) {
  std::vector<double> off;
  for (const double y : distances.off.y) off.push_back(std::abs(y));
  return off.empty() ? kNaN : median(off);
}

void require_pairs(const PairDistancesSpec& spec) {
  const Eigen::Index rows = spec.map.estimate.rows();
  for (const MeasuredPair& pair : spec.pairs)
    if (pair.first < 0 || pair.first >= pair.second || pair.second >= rows)
      throw InvalidInput("figure " + printable(spec.id) + ": a pair of rows that are not there");
}

/// The line on which both distances are the same, or nothing is off.
Polyline right_line(double longest, double slope) {
  return {.label = "no error",
          .x = {0.0, longest},
          .y = {0.0, slope * longest},
          .colour = ThemeColour::kMuted,
          .dash = Dash::kDashed};
}

}  // namespace

Figure measured_map_figure(const MeasuredMapSpec& spec) {
  require_consistent(spec);
  Figure figure = map_figure(spec.map, spec.id, spec.title);
  std::vector<Layer>& layers = figure.panels.front().layers;
  if (spec.uncertainty) add_ellipses(spec.map, *spec.uncertainty, figure);
  const Segments lines = pair_lines(spec);
  if (!lines.x0.empty()) {
    layers.insert(layers.begin(), lines);
    figure.caption += fmt::format(" Thin lines: {} whose distance was measured.",
                                  counted(lines.x0.size(), "pair"));
    figure.alt += fmt::format(" {} measured.", counted(lines.x0.size(), "pair"));
  }
  require_valid(figure);
  return figure;
}

Figure pair_distances_figure(const PairDistancesSpec& spec) {
  require_pairs(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = {spec.map.id};
  const bool is_fitted = !spec.map.anchors.empty();
  std::vector<Distances> known = {distances_in(spec.map.estimate, spec,
                                               is_fitted ? "in the map as fitted" : "in the map",
                                               ThemeColour::kSeries1, Marker::kCircle)};
  if (spec.map.ground_truth_m)
    known.push_back(distances_in(*spec.map.ground_truth_m, spec, "in the ground truth",
                                 ThemeColour::kSeries2, Marker::kCross));
  double longest = 0.0;
  for (const Distances& distances : known)
    for (const double x : distances.against.x) longest = std::max(longest, x);
  figure.panels.resize(2);
  Panel& against = figure.panels[0];
  Panel& off = figure.panels[1];
  against.x.label = off.x.label = "distance [m]";
  against.y.label = "measured distance [m]";
  off.y.label = "measured less distance [m]";
  figure.caption =
      "Each pair of landmarks that scans showed together: its measured distance against that of "
      "their positions, and the difference.";
  if (is_fitted)
    figure.caption +=
        " The map is fitted to its anchors, which may stretch it: distances before that are in the "
        "table.";
  figure.alt = fmt::format("{} measured.", counted(known[0].against.x.size(), "pair"));
  if (longest > 0.0) {
    against.layers.emplace_back(right_line(longest, 1.0));
    off.layers.emplace_back(right_line(longest, 0.0));
  } else {
    figure.notes.push_back({"No measured pair has a position.", ThemeColour::kWarning});
  }
  for (Distances& distances : known) {
    if (distances.against.x.empty()) continue;
    const std::string words = fmt::format(" Half of them are within {} m {}.",
                                          significant(median_off(distances)), distances.where);
    figure.caption += words;
    figure.alt += words;
    against.layers.emplace_back(std::move(distances.against));
    off.layers.emplace_back(std::move(distances.off));
  }
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
