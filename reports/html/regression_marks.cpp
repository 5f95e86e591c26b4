#include "reports/html/regression_marks.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "render/svg/svg.hpp"

namespace mapproof {
namespace {

/// The value of an attribute of an element; empty if it has none.
std::string_view attribute(std::string_view element, std::string_view name) {
  const std::string begin = fmt::format(" {}=\"", name);
  const std::size_t at = element.find(begin);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + begin.size();
  return element.substr(from, element.find('"', from) - from);
}

/// The x values of "6, 0.14;8, 0.1".
std::vector<std::string_view> x_values(std::string_view points) {
  std::vector<std::string_view> values;
  while (!points.empty()) {
    const std::size_t end = std::min(points.find(';'), points.size());
    values.push_back(points.substr(0, std::min(points.find(','), end)));
    points.remove_prefix(std::min(end + 1, points.size()));
  }
  return values;
}

/// An x value as a drawing's data-points has it.
std::string marker_x(double x) { return fmt::format("{:.6g}", x); }

/// The ID of the ring of a drawing: that of the marker's symbol with "ring" for its number.
std::string ring_id(std::string_view marker) {
  const std::string_view symbol = attribute(marker, "href");
  std::string id(symbol.substr(0, symbol.rfind('-')));
  id.erase(0, 1);  // The #.
  return id + "-ring";
}

/// Defines the ring, in the red of findings, which is visible in the light and in the dark theme.
std::string ring_definition(const std::string& id) {
  return fmt::format(
      "<defs><circle id=\"{}\" r=\"7\" fill=\"none\" stroke=\"#d3382f\" "
      "stroke-width=\"2\"/></defs>\n",
      id);
}

/// The ring around a marker. It is a <use> like the marker, so that zooming moves both.
std::string ring_at(std::string_view marker) {
  return fmt::format("<use class=\"got-worse\" href=\"#{}\" x=\"{}\" y=\"{}\"/>\n", ring_id(marker),
                     attribute(marker, "x"), attribute(marker, "y"));
}

/// Counts the panels of a drawing: each ends with its frame.
class PanelCount {
 public:
  /// Which panel a place is in.
  /// @param place  Where an element begins, behind the one asked for before; what is inserted
  ///               stands behind it.
  std::size_t at(std::string_view svg, std::size_t place) {
    constexpr std::string_view kFrame = "<g class=\"frame\"";
    const std::string_view between = svg.substr(seen_, place - seen_);
    for (std::size_t frame = between.find(kFrame); frame != std::string_view::npos;
         frame = between.find(kFrame, frame + 1))
      ++panel_;
    seen_ = place;
    return panel_;
  }

 private:
  std::size_t seen_ = 0;
  std::size_t panel_ = 0;
};

}  // namespace

std::size_t mark_curve(const RegressedCurve& curve, std::string& svg) {
  std::string label, rings, ring;
  append_xml(label, curve.label);
  const std::string of_curve = fmt::format(" data-curve=\"{}\"", label);
  const std::string of_panel = fmt::format("-c{})", curve.panel);  // Its frame cuts the line.
  std::vector<std::string> wanted;
  for (const double x : curve.at) wanted.push_back(marker_x(x));
  std::set<std::string> ringed;  // Single runs at the same x get none.
  PanelCount panels;
  std::size_t count = 0;
  for (std::size_t at = svg.find(of_curve); at != std::string::npos;
       at = svg.find(of_curve, at + 1)) {
    const std::size_t begin = svg.rfind('<', at), end = svg.find("</g>", at);
    if (begin == std::string::npos || end == std::string::npos) break;
    const std::string_view group = std::string_view(svg).substr(begin, end - begin);
    const std::string_view tag = group.substr(0, group.find('>'));
    const auto is_wanted = [&wanted](std::string_view x) {
      return wanted.empty() || std::ranges::find(wanted, x) != wanted.end();
    };
    if (tag.starts_with("<use ")) {  // A mean above the frame, to which no line leads.
      const std::string_view x = attribute(tag, "data-x");
      if (panels.at(svg, begin) != curve.panel || !is_wanted(x) || !ringed.emplace(x).second)
        continue;
      ring = ring_id(tag);
      ++count;
      svg.insert(svg.find('>', begin) + 1, "\n" + ring_at(tag));
      continue;
    }
    // Of one item alone, such as a line without a marker, no group is made.
    if (!tag.starts_with("<g ") || !attribute(group, "clip-path").ends_with(of_panel)) continue;
    const std::vector<std::string_view> x = x_values(attribute(tag, "data-points"));
    rings.clear();
    std::size_t point = 0;
    constexpr std::string_view kMarker = "<use class=\"marker\"";
    for (std::size_t use = group.find(kMarker); use != std::string_view::npos && point < x.size();
         use = group.find(kMarker, use + 1), ++point) {
      ringed.emplace(x[point]);
      if (!is_wanted(x[point])) continue;
      const std::string_view marker = group.substr(use, group.find('>', use) - use);
      ring = ring_id(marker);
      rings += ring_at(marker);
      ++count;
    }
    svg.insert(end, rings);
  }
  // Once in a drawing, outside its groups, which a page may leave out.
  if (!ring.empty() && svg.find(fmt::format(" id=\"{}\"", ring)) == std::string::npos)
    svg.insert(svg.rfind("</svg>"), ring_definition(ring));
  return count;
}

}  // namespace mapproof
