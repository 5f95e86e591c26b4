#include "render/plot/outlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/not_finite.hpp"
#include "render/plot/short_names.hpp"
#include "render/theme/palette.hpp"

namespace mapproof {
namespace {

constexpr int kCurvePieces = 8;
constexpr int kSlices = 8;
constexpr int kShades = 32;
constexpr int kLineShades = 64;
constexpr double kTextShareOfPage = 0.37;  // The width of a text at a point.

Point cubic_at(Point a, Point b, Point c, Point d, double t) {
  const double s = 1.0 - t;
  const double wa = s * s * s, wb = 3.0 * s * s * t, wc = 3.0 * s * t * t, wd = t * t * t;
  return {wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y};
}

/// Where a value stands on the ramp, 0 to 1 within the limits.
double ramp_share(double value, const ColourScale& colours) {
  const auto [low, high] = colours.limits;
  if (colours.scale == Scale::kLog) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

/// Adds a box for each stretch of a row in which `wanted` holds.
template <typename Wanted>
void add_stretches(Outline& path, const Cells& cells, std::size_t row, const PanelMap& map,
                   Wanted wanted) {
  const auto rows = static_cast<double>(cells.rows());
  const auto columns = static_cast<double>(cells.columns);
  const auto x = [&](std::size_t c) {
    return map.x(std::lerp(cells.x.low, cells.x.high, static_cast<double>(c) / columns));
  };
  const auto y = [&](std::size_t r) {
    return map.y(std::lerp(cells.y.high, cells.y.low, static_cast<double>(r) / rows));
  };
  for (std::size_t c = 0; c < cells.columns;) {
    std::size_t end = c;
    while (end < cells.columns && wanted(row * cells.columns + end)) ++end;
    if (end > c) path.add_box({x(c), y(row), x(end), y(row + 1)});
    c = std::max(end, c + 1);
  }
}

}  // namespace

Outline area_path(const Area& area, const PanelMap& map) {
  Outline path;
  std::vector<Point> ring;
  const auto finish = [&] {
    for (std::size_t i = 0; ring.size() >= 3 && i < ring.size(); ++i)
      i == 0 ? path.move_to(ring[i]) : path.line_to(ring[i]);
    if (ring.size() >= 3) path.close();
    ring.clear();
  };
  for (std::size_t i = 0; i < area.x.size(); ++i) {
    const Point p = map(area.x[i], area.y[i]);
    std::isnan(p.x + p.y) ? finish() : ring.push_back(p);
  }
  finish();
  return path;
}

Outline ellipse_path(const Ellipses& ellipses, std::size_t i, const PanelMap& map) {
  const double c = std::cos(ellipses.rotation_rad[i]), s = std::sin(ellipses.rotation_rad[i]);
  const double a = ellipses.a[i], b = ellipses.b[i];
  if (std::isnan(ellipses.x[i] + ellipses.y[i] + a + b + c)) return {};
  Outline path;
  path.add_circle({0.0, 0.0}, 1.0);
  for (Point& p : path.points)
    p = map(ellipses.x[i] + a * c * p.x - b * s * p.y, ellipses.y[i] + a * s * p.x + b * c * p.y);
  return path;
}

std::vector<std::vector<Point>> flattened(const Outline& path) {
  std::vector<std::vector<Point>> rings;
  const Point* next = path.points.data();
  for (const PathCommand command : path.commands) {
    if (command == PathCommand::kMove) rings.emplace_back();
    if (command == PathCommand::kMove || command == PathCommand::kLine)
      rings.back().push_back(*next++);
    if (command != PathCommand::kCubic) continue;
    const Point from = rings.back().back();
    for (int piece = 1; piece <= kCurvePieces; ++piece)
      rings.back().push_back(
          cubic_at(from, next[0], next[1], next[2], static_cast<double>(piece) / kCurvePieces));
    next += 3;
  }
  return rings;
}

std::vector<Box> covering_slices(const std::vector<Point>& ring) {
  double top = kInfinity, bottom = -kInfinity;
  for (const Point p : ring) top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  std::vector<Box> slices;
  for (int i = 0; i < kSlices; ++i) {
    Box slice{kInfinity, std::lerp(top, bottom, static_cast<double>(i) / kSlices), -kInfinity,
              std::lerp(top, bottom, static_cast<double>(i + 1) / kSlices)};
    const Box strip{-1e300, slice.y0, 1e300, slice.y1};
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[(k + 1) % ring.size()];
      double enter = 0.0, leave = 0.0;
      if (!clip_line(strip, a, b, enter, leave)) continue;
      for (const double t : {enter, leave}) {
        slice.x0 = std::min(slice.x0, std::lerp(a.x, b.x, t));
        slice.x1 = std::max(slice.x1, std::lerp(a.x, b.x, t));
      }
    }
    if (slice.x0 < slice.x1) slices.push_back(slice);
  }
  return slices;
}

Colour ramp_colour(Ramp ramp, ThemeColour colour, double share, const Theme& theme) {
  if (ramp == Ramp::kViridis) return viridis(share);
  return mix(theme.of(colour), theme.background, share);
}

int shade_of(double value, const ColourScale& colours, int shades) {
  if (std::isnan(value)) return -1;
  const double share = ramp_share(value, colours);
  return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * (shades - 1)));
}

std::vector<Shape> coloured_line_shapes(const Polyline& line, const PanelMap& map,
                                        const Theme& theme) {
  std::vector<Shape> shapes(kLineShades);
  Shape rim;
  const auto at = [&](std::size_t i) { return map(line.x[i], line.y[i]); };
  const auto is_known = [&](std::size_t i) {
    return i < line.x.size() && !std::isnan(at(i).x + at(i).y) && !std::isnan(line.values[i]);
  };
  int last = -1;  // The shade of the piece that ends at i.
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    const bool leads_on = is_known(i) && is_known(i + 1);
    if (!leads_on && (last >= 0 || !is_known(i))) {
      last = -1;
      continue;
    }
    const std::size_t end = leads_on ? i + 1 : i;
    const int shade =
        shade_of(std::max(line.values[i], line.values[end]), line.colour_scale, kLineShades);
    Outline& path = shapes[static_cast<std::size_t>(shade)].path;
    if (shade != last) path.move_to(at(i));
    path.line_to(at(end));
    if (last < 0) rim.path.move_to(at(i));
    rim.path.line_to(at(end));
    last = leads_on ? shade : -1;
  }
  for (int shade = 0; shade < kLineShades; ++shade)
    shapes[static_cast<std::size_t>(shade)].stroke =
        Stroke{.colour = ramp_colour(line.colour_scale.ramp, line.colour,
                                     static_cast<double>(shade) / (kLineShades - 1), theme),
               .width = line.width * theme.line_pt,
               .dashes = {},
               .is_round = true};
  rim.stroke = Stroke{.colour = theme.muted,
                      .width = line.width * theme.line_pt + 2.0 * theme.hairline_pt,
                      .dashes = {},
                      .is_round = true};
  shapes.insert(shapes.begin(), std::move(rim));
  std::erase_if(shapes, [](const Shape& shape) { return shape.path.points.empty(); });
  return shapes;
}

std::vector<Shape> cell_shapes(const Cells& cells, const PanelMap& map, const Theme& theme) {
  std::vector<int> shades;
  shades.reserve(cells.values.size());
  std::array<bool, kShades> used{};
  for (const double value : cells.values) {
    shades.push_back(shade_of(value, cells.colour_scale, kShades));
    if (shades.back() >= 0) used[shades.back()] = true;
  }
  std::vector<Shape> shapes;
  for (int shade = 0; shade < kShades; ++shade) {
    if (!used[shade]) continue;
    Shape& shape = shapes.emplace_back();
    shape.fill = ramp_colour(cells.colour_scale.ramp, cells.colour,
                             static_cast<double>(shade) / (kShades - 1), theme);
    for (std::size_t row = 0; row < cells.rows(); ++row)
      add_stretches(shape.path, cells, row, map,
                    [&](std::size_t cell) { return shades[cell] >= shade; });
  }
  return shapes;
}

std::vector<TextLine> cell_texts(const Cells& cells, const PanelMap& map, const Theme& theme) {
  constexpr double kWidest = 0.9, kHighest = 0.75;  // Shares of a cell.
  const double em = theme.tick_font_pt;
  const auto columns = static_cast<double>(cells.columns);
  const auto rows = static_cast<double>(cells.rows());
  const double width = std::abs(map.x(cells.x.high) - map.x(cells.x.low)) / columns;
  const double height = std::abs(map.y(cells.y.high) - map.y(cells.y.low)) / rows;
  std::vector<TextLine> lines;
  if (FontFacts::kCapHeight * em > kHighest * height) return lines;
  for (std::size_t i = 0; i < cells.text.size(); ++i) {
    const int shade = shade_of(cells.values[i], cells.colour_scale, kShades);
    if (shade < 0 || cells.text[i].empty()) continue;
    const Colour below = ramp_colour(cells.colour_scale.ramp, cells.colour,
                                     static_cast<double>(shade) / (kShades - 1), theme);
    constexpr Colour kDark = colour(0x000000), kLight = colour(0xFFFFFF);
    TextLine line{.shaped = shape_text(cells.text[i], theme.font.get()),
                  .size = em,
                  .colour = contrast(kDark, below) >= contrast(kLight, below) ? kDark : kLight};
    if (line.shaped.advance * em > kWidest * width) return {};
    const std::size_t across = i % cells.columns, down = i / cells.columns;
    const double column = static_cast<double>(across) + 0.5, row = static_cast<double>(down) + 0.5;
    line.at = {
        map.x(std::lerp(cells.x.low, cells.x.high, column / columns)) -
            line.shaped.advance * em / 2.0,
        map.y(std::lerp(cells.y.high, cells.y.low, row / rows)) + FontFacts::kCapHeight * em / 2.0};
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<TextLine> placed_text(const Texts& texts, std::size_t i, const PanelMap& map,
                                  const Theme& theme) {
  const Point at = map(texts.x[i], texts.y[i]);
  if (std::isnan(at.x + at.y)) return {};
  const double em = theme.tick_font_pt, most = kTextShareOfPage * theme.width_pt / em;
  std::vector<ShapedText> shaped{shape_label_within(theme, texts.text[i], most, texts.text)};
  if (is_elided(shaped.front()) && texts.align != Align::kMiddle)
    shaped = name_lines(theme, texts.text[i], most);
  std::vector<TextLine> lines;
  const double first = -0.5 * kNameLineStep * static_cast<double>(shaped.size() - 1);
  for (ShapedText& one : shaped) {
    const double width = one.advance * em;
    const double left = texts.align == Align::kStart ? 0.0
                        : texts.align == Align::kEnd ? width
                                                     : width / 2.0;
    const double down = first + kNameLineStep * static_cast<double>(lines.size());
    TextLine& line = lines.emplace_back(
        TextLine{.shaped = std::move(one), .size = em, .colour = theme.of(texts.colour)});
    line.at = {at.x - left, at.y + (down + FontFacts::kCapHeight / 2.0) * em};
    if (line.shaped.text != texts.text[i]) line.whole = texts.text[i];
  }
  return lines;
}

}  // namespace mapproof
