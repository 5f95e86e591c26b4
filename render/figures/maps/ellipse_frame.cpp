#include "render/figures/maps/ellipse_frame.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr double kMostBeyond = 0.5;  // Of the width or height.

bool is_cut(const PanelLimits& box, const PanelLimits& limits) {
  return box.x.low < limits.x.low || box.x.high > limits.x.high || box.y.low < limits.y.low ||
         box.y.high > limits.y.high;
}

std::string landmark_of(const Mark& mark) {
  for (const auto& [key, value] : mark.data)
    if (key == "landmark") return value;
  return "";
}

}  // namespace

PanelLimits with_ellipses(const PanelLimits& limits, const Ellipses& ellipses) {
  const auto widen = [](Range& range, const Range& first, const Range& box) {
    const double most = kMostBeyond * (first.high - first.low);
    range.low = std::clamp(box.low, first.low - most, range.low);
    range.high = std::clamp(box.high, range.high, first.high + most);
  };
  PanelLimits all = limits;
  for (std::size_t i = 0; i < ellipses.x.size(); ++i) {
    const PanelLimits box = ellipse_box(ellipses, i);
    widen(all.x, limits.x, box.x);
    widen(all.y, limits.y, box.y);
  }
  return all;
}

std::optional<Note> cut_ellipses_note(const Ellipses& ellipses, const PanelLimits& limits,
                                      std::string_view unit, double enlarged) {
  long long count = 0;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < ellipses.x.size(); ++i) {
    if (!is_cut(ellipse_box(ellipses, i), limits)) continue;
    if (++count == 1 || ellipses.a[i] > ellipses.a[longest]) longest = i;
  }
  if (count == 0) return std::nullopt;
  return Note{fmt::format("{} beyond the frame; half the longest axis, of {}, is {}{}.",
                          counted(count, "ellipse"), landmark_of(ellipses.marks[longest]),
                          significant(ellipses.a[longest] / enlarged), unit),
              ThemeColour::kWarning};
}

}  // namespace mapproof
