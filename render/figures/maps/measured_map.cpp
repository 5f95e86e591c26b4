#include "render/figures/maps/measured_map.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/maps/map_ellipses.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

void require_consistent(const MeasuredMapSpec& spec) {
  const Eigen::Index rows = spec.map.estimate.rows();
  for (const MeasuredPair& pair : spec.pairs)
    if (pair.first < 0 || pair.second >= rows || pair.first >= pair.second)
      throw InvalidInput("figure " + printable(spec.id) + ": a pair of rows that are not there");
}

Segments pair_lines(const MeasuredMapSpec& spec) {
  Segments lines{.label = "measured pair", .ink = Ink::kSeries3, .width = 0.4};
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

}  // namespace

Figure measured_map_figure(const MeasuredMapSpec& spec) {
  require_consistent(spec);
  Figure figure = map_figure(spec.map, spec.id, spec.title);
  std::vector<Layer>& layers = figure.panels.front().layers;
  if (spec.certainty) add_ellipses(spec.map, *spec.certainty, figure);
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

}  // namespace mapproof
