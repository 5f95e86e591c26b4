#include "render/figures/maps/submaps.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/layer_shapes.hpp"

namespace mapproof {
namespace {

double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Point> hull_of(const Points& positions) {
  std::vector<Point> points;
  for (Eigen::Index i = 0; i < positions.rows(); ++i) points.push_back(point_of(positions.row(i)));
  std::ranges::sort(points, [](const Point& a, const Point& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  std::vector<Point> hull;
  const auto grow = [&](const Point& point, std::size_t least) {
    while (hull.size() >= least + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Point& point : points) grow(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t k = points.size(); k-- > 0;) grow(points[k], lower);
  hull.pop_back();
  return hull;
}

Area outline(const Submap& map, std::size_t number) {
  Area area{.colour = series_colour(number), .outlined = true, .width = 0.8};
  for (const Point& corner : hull_of(map.positions)) add_corner(area, corner);
  area.mark = {fmt::format("submap-{}", number + 1),
               {{"landmarks", std::to_string(map.landmarks.size())}}};
  return area;
}

Segments residuals(const JoinedSubmaps& joined, const std::vector<std::string>& names) {
  Segments lines{.label = "residual", .colour = ThemeColour::kText, .width = 0.6};
  for (std::size_t g = 0; g < joined.submaps.size(); ++g) {
    const Submap& map = joined.submaps[g];
    for (std::size_t k = 0; map.placed && k < map.landmarks.size(); ++k) {
      const auto mean = joined.positions.row(map.landmarks[k]);
      const auto position = map.positions.row(static_cast<Eigen::Index>(k));
      if (!mean.allFinite() || mean == position) continue;
      add_line(lines, point_of(mean), point_of(position));
      lines.marks.push_back({fmt::format("residual-{}-{}", g + 1, map.landmarks[k] + 1),
                             {{"landmark", names[static_cast<std::size_t>(map.landmarks[k])]},
                              {"residual", data_number((position - mean).norm())}}});
    }
  }
  return lines;
}

Scatter landmarks(const JoinedSubmaps& joined, const std::vector<std::string>& names) {
  Scatter points{.label = "joined landmark", .colour = ThemeColour::kText, .size = 0.7};
  for (Eigen::Index i = 0; i < joined.positions.rows(); ++i) {
    if (!joined.positions.row(i).allFinite()) continue;
    add_point(points, point_of(joined.positions.row(i)));
    points.marks.push_back(
        {fmt::format("landmark-{}", i + 1), {{"landmark", names[static_cast<std::size_t>(i)]}}});
  }
  return points;
}

double largest_residual(const JoinedSubmaps& joined) {
  double largest = 0.0;
  for (const SubmapJoin& join : joined.joins)
    if (std::isfinite(join.residual)) largest = std::max(largest, join.residual);
  return largest;
}

}  // namespace

Figure submaps_figure(const JoinedSubmaps& joined, const std::vector<std::string>& names,
                      const std::string& id) {
  if (std::ssize(names) != joined.positions.rows())
    throw InvalidInput("figure " + printable(id) + ": not one name a landmark");
  const auto placed = std::ranges::count(joined.submaps, true, &Submap::placed);
  Figure figure;
  figure.id = id;
  figure.title = "Sub-maps and their joins";
  Panel panel;
  panel.equal_aspect = true;
  panel.x.label = "x (arbitrary unit)";
  panel.y.label = "y (arbitrary unit)";
  std::size_t number = 0;
  for (const Submap& map : joined.submaps) {
    if (map.placed && map.positions.rows() > 2) panel.layers.emplace_back(outline(map, number));
    ++number;
  }
  panel.layers.emplace_back(residuals(joined, names));
  panel.layers.emplace_back(landmarks(joined, names));
  std::erase_if(panel.layers, is_empty);
  figure.panels.push_back(std::move(panel));
  const std::string what = fmt::format(
      "{} of {} joined at {}; the two maps of a join are up to {:.1f} % of their overlap's radius "
      "apart.",
      placed, counted(std::ssize(joined.submaps), "sub-map"),
      counted(std::ssize(joined.joins), "overlap"), 100.0 * largest_residual(joined));
  figure.caption = what +
                   " Outlines: hulls of the sub-maps; dots: joined landmarks; lines: from a dot to "
                   "where each sub-map has it.";
  figure.alt = what;
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
