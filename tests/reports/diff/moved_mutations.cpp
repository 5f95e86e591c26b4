#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "tests/reports/diff/mutations.hpp"

namespace mapproof::test {
namespace {

/// The position of a marker of data, or null.
Point* data_marker(Item& item, const Drawing& drawing) {
  auto* stamp = std::get_if<Stamp>(&item.what);
  const Box frame = drawing.frames.front();
  const bool is_inside = stamp && item.panel == 0 && stamp->at.x > frame.x0 &&
                         stamp->at.x < frame.x1 && stamp->at.y > frame.y0 && stamp->at.y < frame.y1;
  return is_inside && item.item_class == ItemClass::kMarker ? &stamp->at : nullptr;
}

int data_markers(Drawing drawing) {
  int count = 0;
  for (Item& item : drawing.items) count += data_marker(item, drawing) != nullptr;
  return count;
}

/// Moves each marker of data in a different direction.
Change scattered(double sigma_px) {
  return [sigma_px](Drawing& drawing) {
    Random random(9);
    const double px = sigma_px * 72.0 / drawing.dpi;
    for (Item& item : drawing.items)
      if (Point* at = data_marker(item, drawing))
        *at = {at->x + px * random.normal(), at->y + px * random.normal()};
  };
}

/// Moves one marker of data a pixel to the right, the next one to the left, and so on.
void pushed_apart(Drawing& drawing) {
  double px = 72.0 / drawing.dpi;
  for (Item& item : drawing.items)
    if (Point* at = data_marker(item, drawing)) at->x += px, px = -px;
}

/// Aligns markers of data to whole pixels, as some programs do.
void snapped(Drawing& drawing) {
  const double px = 72.0 / drawing.dpi;
  for (Item& item : drawing.items)
    if (Point* at = data_marker(item, drawing))
      *at = {px * std::round(at->x / px), px * std::round(at->y / px)};
}

/// All of the first panel, its frame and texts apart, as if the axes ended earlier: what lies at
/// their end goes so far.
Change stretched(double by_px) {
  return [by_px](Drawing& drawing) {
    const Box frame = drawing.frames.front();
    const double px = by_px * 72.0 / drawing.dpi;
    const auto moved = [&](Point at) {
      return Point{at.x + px * (at.x - frame.x0) / frame.width(),
                   at.y - px * (frame.y1 - at.y) / frame.height()};
    };
    for (Item& item : drawing.items) {
      if (item.panel != 0 || item.item_class == ItemClass::kFrame) continue;
      if (Point* at = data_marker(item, drawing)) *at = moved(*at);
      auto* shape = std::get_if<Shape>(&item.what);
      if (shape && (item.item_class == ItemClass::kLine || item.item_class == ItemClass::kGrid ||
                    item.item_class == ItemClass::kBand || item.item_class == ItemClass::kTick))
        for (Point& point : shape->path.points) point = moved(point);
    }
  };
}

Change both(Change first, Change second) {
  return [=](Drawing& drawing) { first(drawing), second(drawing); };
}

/// The last of the axes' labels.
std::vector<std::size_t> last_label(const Drawing& drawing) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < drawing.items.size(); ++i)
    if (const auto* line = std::get_if<TextLine>(&drawing.items[i].what);
        line && drawing.items[i].item_class == ItemClass::kTickLabel &&
        line->shaped.text.find_last_of("0123456789") != std::string::npos)
      found = {i};
  return found;
}

}  // namespace

std::vector<Mutation> moved_mutations_of(const Drawing& drawing, const std::string& image) {
  std::vector<Mutation> found;
  const auto shared = std::make_shared<Drawing>(drawing);
  const auto add = [&](std::string name, const Change& before, const Change& after) {
    const auto made = [shared](const Change& change) {
      Drawing other = *shared;
      change(other);
      return drawn(other);
    };
    found.push_back({std::move(name), image, ImageState::kDifferent, [=] { return made(before); },
                     [=] { return made(after); }});
  };
  const Change none = [](Drawing&) {};
  if (data_markers(drawing) >= 6) {
    for (const double sigma : {1.0, 1.5, 2.0}) {
      add(fmt::format("markers scattered by {} px", sigma), none, scattered(sigma));
      add(fmt::format("markers on whole pixels scattered by {} px", sigma), snapped,
          both(scattered(sigma), snapped));
    }
    add("markers pushed apart by 1 px", snapped, both(snapped, pushed_apart));
  }
  // Cells are a raster that stays.
  if (std::ranges::find(drawing.items, ItemClass::kCells, &Item::item_class) != drawing.items.end())
    return found;
  // In a panel this narrow, full of lines, 1.5 px at its end are not seen: docs/diff-images.md.
  constexpr double kNarrow_px = 130.0;
  const bool is_narrow = drawing.frames.front().width() * drawing.dpi / 72.0 < kNarrow_px;
  for (const double by : {1.5, 2.0, 2.5, 3.0, 4.0})
    if (by > 1.5 || !is_narrow) add(fmt::format("stretched by {} px", by), none, stretched(by));
  for (const std::size_t i : last_label(drawing))
    for (const double by : {0.1, 0.3, 0.5, 2.0})
      for (const int further : {1, 3, 6})
        add(fmt::format("stretched by {} px, digit {} further", by, further), none,
            both(stretched(by), other_digit(i, further)));
  return found;
}

}  // namespace mapproof::test
