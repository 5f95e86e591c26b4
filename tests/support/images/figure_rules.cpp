#include "tests/support/images/figure_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <string_view>

#include <fmt/format.h>

#include "render/plot/axis_map.hpp"
#include "render/plot/layers.hpp"
#include "render/plot/layout.hpp"

namespace mapproof::test {
namespace {

constexpr std::size_t kFewestLabels = 2, kFewestLogLabels = 3;
constexpr double kRoomOfThree = 12.0;   // For three labels of numbers side by side, em.
constexpr double kUppermost = 0.7;      // Of an axis from 0: lines above it alone.
constexpr double kLeastOfPaper = 0.65;  // Of the height, for the frame of a narrow paper figure.
constexpr double kLeastOfReport = 0.5;  // Of the height below the title, on a screen.

std::string style_of(const Polyline& line) {
  return fmt::format("{}/{}/{}", static_cast<int>(line.colour), static_cast<int>(line.dash),
                     static_cast<int>(line.marker));
}

/// Whether a reader could expect more labels: not on axes of names, of one whole number, or of a
/// panel without data.
bool has_scale(const Axis& axis, Range limits) {
  return axis.names.empty() && !(axis.whole && limits.high - limits.low < 2.5);
}

class Rules {
 public:
  Rules(const Figure& figure, const Theme& theme)
      : figure_(figure), theme_(theme), drawing_(lay_out(figure, theme)) {}

  std::vector<std::string> broken() {
    for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
      const Panel& panel = figure_.panels[i];
      if (panel.bare || std::ranges::all_of(panel.layers, is_empty)) continue;
      check_labels(i);
      check_start(panel);
      check_styles(panel);
    }
    check_share();
    return std::move(broken_);
  }

 private:
  void add(const std::string& what) { broken_.push_back(theme_.name + ": " + what); }

  void check_labels(std::size_t index) {
    const Panel& panel = figure_.panels[index];
    const Box& frame = drawing_.frames[index];
    std::size_t of_x = 0, of_y = 0;
    for (const Item& item : drawing_.items) {
      if (item.panel != index || item.item_class != ItemClass::kTickLabel) continue;
      const TextLine& text = std::get<TextLine>(item.what);
      ++(text.at.x + text.shaped.advance * text.size <= frame.x0 ? of_y : of_x);
    }
    const PanelLimits limits = panel_limits(panel);
    check_axis("x", panel.x, limits.x, of_x, frame.width());
    check_axis("y", panel.y, limits.y, of_y, frame.height());
  }

  /// Axes that share their labels with a panel's beside or below have none.
  void check_axis(const char* name, const Axis& axis, Range limits, std::size_t labels,
                  double length) {
    const bool has_room = length >= kRoomOfThree * theme_.font_pt;
    const std::size_t fewest =
        axis.scale == Scale::kLog && has_room ? kFewestLogLabels : kFewestLabels;
    if (labels > 0 && labels < fewest && has_scale(axis, limits))
      add(fmt::format("{} labels on the {} axis '{}'", labels, name, axis.label));
  }

  void check_start(const Panel& panel) {
    if (panel.y.scale == Scale::kLog || !panel.y.limits || panel.y.limits->low != 0.0) return;
    double least = HUGE_VAL;
    const auto see = [&](const std::vector<double>& values) {
      for (const double y : values) least = std::min(least, std::isnan(y) ? HUGE_VAL : y);
    };
    for (const Layer& layer : panel.layers) {
      if (const auto* line = std::get_if<Polyline>(&layer)) see(line->y);
      if (const auto* band = std::get_if<Band>(&layer)) see(band->low);
    }
    if (std::isfinite(least) && least > kUppermost * panel.y.limits->high)
      add(fmt::format("an axis from 0 whose lines begin at {}", least));
  }

  void check_styles(const Panel& panel) {
    std::map<std::string, std::string> labels;
    for (const Layer& layer : panel.layers) {
      const auto* line = std::get_if<Polyline>(&layer);
      if (line == nullptr || line->label.empty()) continue;
      const auto [known, is_new] = labels.emplace(style_of(*line), line->label);
      if (!is_new && known->second != line->label)
        add(fmt::format("'{}' and '{}' have one style", known->second, line->label));
    }
  }

  void check_share() {
    if (figure_.panels.size() != 1 || figure_.panels[0].bare || figure_.panels[0].equal_aspect)
      return;
    const bool paper = theme_.name != report_theme().name;
    const Box& frame = drawing_.frames[0];
    const double share = frame.height() / (drawing_.height - (paper ? 0.0 : frame.y0));
    if (share < (paper ? kLeastOfPaper : kLeastOfReport))
      add(fmt::format("the frame takes {:.0f} % of the height", 100.0 * share));
  }

  const Figure& figure_;
  const Theme& theme_;
  Drawing drawing_;
  std::vector<std::string> broken_;
};

/// How the ids of figures begin whose curves are quantities, sizes or noises of one method.
constexpr std::array<std::string_view, 5> kOfOneMethod = {"angle-", "factorization-cost", "fig-1b",
                                                          "noise-", "positions-"};

/// The method that a label names, whatever the value of its parameter.
std::string method_in(const std::string& label) {
  static const std::regex kParameter(", [^, ]+ = [^,]+");
  return std::regex_replace(label, kParameter, "");
}

bool is_same(const std::string& a, const std::string& b) {
  return a.starts_with(b) || b.starts_with(a);
}

}  // namespace

std::vector<std::string> broken_rules(const Figure& figure, const Theme& theme) {
  return Rules(figure, theme).broken();
}

void MethodStyles::see(const Figure& figure) {
  if (std::ranges::any_of(kOfOneMethod,
                          [&](std::string_view start) { return figure.id.starts_with(start); }))
    return;
  for (const Panel& panel : figure.panels)
    for (const Layer& layer : panel.layers) {
      const auto* line = std::get_if<Polyline>(&layer);
      if (line == nullptr || line->label.empty() ||
          std::ranges::find(line->mark.data, "curve",
                            &std::pair<std::string, std::string>::first) == line->mark.data.end())
        continue;
      const std::string method = method_in(line->label);
      styles_[method].insert(style_of(*line));
      methods_[style_of(*line)].insert(method);
    }
}

std::vector<std::string> MethodStyles::conflicts() const {
  std::vector<std::string> found;
  for (const auto& [method, styles] : styles_)
    if (styles.size() > 1)
      found.push_back(fmt::format("'{}' has {} styles", method, styles.size()));
  for (const auto& [style, methods] : methods_)
    for (const std::string& method : methods)
      if (!is_same(*methods.begin(), method))
        found.push_back(fmt::format("'{}' and '{}' have one style", *methods.begin(), method));
  return found;
}

}  // namespace mapproof::test
