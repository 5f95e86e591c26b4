#include "tests/support/images/figure_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "render/cairo/cairo_backend.hpp"
#include "render/plot/axis_map.hpp"
#include "render/plot/layers.hpp"
#include "render/plot/layout.hpp"

namespace mapproof::test {
namespace {

constexpr std::size_t kFewestLabels = 2, kFewestWithRoom = 3;
constexpr double kRoomOfThree = 12.0;    // For three labels of numbers side by side, em.
constexpr double kUppermost = 0.7;       // Of an axis from 0: lines above it alone.
constexpr double kLeastOfPaper = 0.65;   // Of the height, for the frame of a narrow paper figure.
constexpr double kHighPage = 640.0;      // In points: maps beyond would not fit on paper.
constexpr double kLeastOfWidth = 0.4;    // Of the page, for the only frame.
constexpr double kLeastOfReport = 0.5;   // Of the height below the title, on a screen.
constexpr std::size_t kMostLabels = 12;  // Of numbers on an axis.
constexpr double kLeastOfPanels = 0.2;   // Of the page below its title, for all frames.
// Of the coloured pixels, for lines, bands and cells of data; few runs have 2.9 % in quick
// profiles.
constexpr double kLeastOfData = 0.02;
constexpr double kLeastDifference = 0.1;  // Of two colours side by side, in OKLab.
constexpr double kWide = 0.75;            // Of the page: a frame that leaves room for labels alone.

std::string style_of(const Polyline& line) {
  return fmt::format("{}/{}/{}", static_cast<int>(line.colour), static_cast<int>(line.dash),
                     static_cast<int>(line.marker));
}

/// Whether a reader could expect more labels: not on axes of names, of one whole number, or of a
/// panel without data.
bool has_scale(const Axis& axis, Range limits) {
  return axis.names.empty() && !(axis.whole && limits.high - limits.low < 2.5);
}

/// Whether a label is a power of ten: "10⁵", "2×10⁻³".
bool is_power(const std::string& label) {
  static const std::regex kPower("10(⁰|¹|²|³|⁴|⁵|⁶|⁷|⁸|⁹|⁻)");
  return std::regex_search(label, kPower);
}

std::size_t decimals_in(const std::string& label) {
  const std::size_t point = label.find('.');
  return point == std::string::npos ? 0 : label.size() - point - 1;
}

bool is_coloured(const Image& image, int x, int y, Colour background) {
  const std::uint32_t paper = background.red << 16 | background.green << 8 | background.blue;
  return (image.row(y)[x] & 0xFFFFFF) != paper;
}

/// The pixels that are not paper.
double coloured_pixels(const Image& image, Colour background) {
  double count = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += is_coloured(image, x, y, background) ? 1.0 : 0.0;
  return count;
}

bool shows_data(ItemClass item_class) {
  constexpr std::array kData = {ItemClass::kBand,     ItemClass::kCells, ItemClass::kLine,
                                ItemClass::kMarker,   ItemClass::kImage, ItemClass::kCellText,
                                ItemClass::kMarkLabel};
  return std::ranges::find(kData, item_class) != kData.end();
}

/// Of two colours, in the space OKLab, where 1 is black from white.
double difference(Colour a, Colour b) {
  const auto lab = [](Colour colour) {
    const auto linear = [](std::uint8_t value) {
      const double v = value / 255.0;
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const double r = linear(colour.red), g = linear(colour.green), b = linear(colour.blue);
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return std::array{0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
                      1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
                      0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
  };
  const auto one = lab(a), two = lab(b);
  return std::hypot(one[0] - two[0], one[1] - two[1], one[2] - two[2]);
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
      check_cut_data(panel);
      check_styles(panel);
      check_colours(i);
    }
    check_cut_text();
    check_title();
    check_share();
    check_panels();
    check_data_share();
    return std::move(broken_);
  }

 private:
  void add(const std::string& what) { broken_.push_back(theme_.name + ": " + what); }

  void check_labels(std::size_t index) {
    const Panel& panel = figure_.panels[index];
    const Box& frame = drawing_.frames[index];
    std::vector<std::string> of_x, of_y;
    for (const Item& item : drawing_.items) {
      if (item.panel != index || item.item_class != ItemClass::kTickLabel) continue;
      const TextLine& text = std::get<TextLine>(item.what);
      const bool is_left = text.at.x + text.shaped.advance * text.size <= frame.x0;
      (is_left ? of_y : of_x).push_back(text.shaped.text);
    }
    const PanelLimits limits = panel_limits(panel);
    check_axis("x", panel.x, limits.x, of_x, frame.width());
    check_axis("y", panel.y, limits.y, of_y, frame.height());
  }

  /// Axes that share their labels with a panel's beside or below have none.
  void check_axis(const char* name, const Axis& axis, Range limits,
                  const std::vector<std::string>& labels, double length) {
    const bool has_room = length >= kRoomOfThree * theme_.font_pt;
    const std::size_t fewest = has_room ? kFewestWithRoom : kFewestLabels;
    const bool too_many = axis.names.empty() && labels.size() > kMostLabels;
    if (too_many || (!labels.empty() && labels.size() < fewest && has_scale(axis, limits)))
      add(fmt::format("{} labels on the {} axis '{}'", labels.size(), name, axis.label));
    if (!axis.names.empty()) return;
    if (const auto powers = std::ranges::count_if(labels, is_power);
        powers > 0 && powers < std::ssize(labels))
      add(fmt::format("plain numbers beside powers of ten on the {} axis '{}'", name, axis.label));
    if (std::set<std::string>(labels.begin(), labels.end()).size() < labels.size())
      add(fmt::format("one label twice on the {} axis '{}'", name, axis.label));
    if (axis.scale == Scale::kLinear && !std::ranges::all_of(labels, [&](const std::string& label) {
          return decimals_in(label) == decimals_in(labels.front());
        }))
      add(fmt::format("labels of several precisions on the {} axis '{}'", name, axis.label));
  }

  /// Texts of which a part is left out, in a figure whose names are ours.
  void check_cut_text() {
    constexpr std::string_view kDots = "\u2026";
    for (const Item& item : drawing_.items)
      if (const auto* text = std::get_if<TextLine>(&item.what);
          text != nullptr && text->shaped.text.find(kDots) != std::string::npos &&
          text->whole.find(kDots) == std::string::npos)
        add(fmt::format("the {} '{}' is cut", name(item.item_class), text->shaped.text));
  }

  /// A title counts nothing that it could name.
  void check_title() {
    static const std::regex kAndMore(" and [0-9]+ more");
    if (figure_.title.empty() || std::regex_search(figure_.title, kAndMore))
      add(fmt::format("the title '{}'", figure_.title));
  }

  /// Bars that end outside the frame without an arrow, bands beyond it without a note, and points
  /// at the foot of a logarithmic axis, where they may be anything below.
  void check_cut_data(const Panel& panel) {
    const PanelLimits limits = panel_limits(panel);
    const auto holds = [](Range range, double value) {
      const double rounding = 1e-9 * (std::abs(range.low) + std::abs(range.high));
      return std::isnan(value) || (value >= range.low - rounding && value <= range.high + rounding);
    };
    for (const Layer& layer : panel.layers) {
      if (const auto* bars = std::get_if<Segments>(&layer); bars != nullptr && !bars->arrow)
        for (std::size_t i = 0; i < bars->x0.size(); ++i)
          if (holds(limits.y, bars->y0[i]) != holds(limits.y, bars->y1[i])) {
            add(fmt::format("a bar of '{}' is cut by the frame", bars->label));
            break;
          }
      if (const auto* band = std::get_if<Band>(&layer); band != nullptr && !notes_frame()) {
        const auto is_cut = [&](double y) { return !holds(limits.y, y); };
        if (std::ranges::any_of(band->low, is_cut) || std::ranges::any_of(band->high, is_cut))
          add(fmt::format("the band of '{}' is cut by the frame without a note", band->label));
      }
      if (const auto* points = std::get_if<Scatter>(&layer);
          points != nullptr && panel.y.scale == Scale::kLog &&
          std::ranges::any_of(points->y, [&](double y) { return y <= limits.y.low; }))
        add(fmt::format("a point of '{}' is at the foot of its axis", points->label));
    }
  }

  /// Whether a note says what lies beyond the frame.
  bool notes_frame() const {
    return std::ranges::any_of(figure_.notes, [](const Note& note) {
      return note.text.find(" the frame") != std::string::npos;
    });
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
    const bool paper = theme_.draws_title != report_theme().draws_title;
    const bool is_map = std::ranges::any_of(figure_.panels, &Panel::equal_aspect);
    const bool is_bare = std::ranges::any_of(figure_.panels, &Panel::bare);
    if (is_bare || (!paper && (is_map || figure_.panels.size() > 1))) return;
    // Of maps that are as wide as the page the width decides, and of several the page's end.
    if (is_map && figure_.panels.size() == 1 && is_wide(drawing_.frames[0])) return;
    if (is_map && figure_.panels.size() > 1 && drawing_.height > kHighPage) return;
    if (const double width = drawing_.frames[0].width() / drawing_.width;
        figure_.panels.size() == 1 && !is_map && width < kLeastOfWidth)
      add(fmt::format("the frame takes {:.0f} % of the width", 100.0 * width));
    double top = drawing_.height;
    for (const Box& frame : drawing_.frames) top = std::min(top, frame.y0);
    const double share = height_of_rows() / (drawing_.height - (paper ? 0.0 : top));
    if (share < (paper ? kLeastOfPaper : kLeastOfReport))
      add(fmt::format("the frames take {:.0f} % of the height", 100.0 * share));
  }

  bool is_wide(const Box& frame) const { return frame.width() > kWide * drawing_.width; }

  /// Of the page, what has a frame beside it.
  double height_of_rows() const {
    std::vector<Box> parts = drawing_.frames;
    std::ranges::sort(parts, {}, &Box::y0);
    double height = 0.0, end = 0.0;
    for (const Box& part : parts) {
      height += std::max(0.0, part.y1 - std::max(part.y0, end));
      end = std::max(end, part.y1);
    }
    return height;
  }

  /// What the frames of all panels take of the page below its title.
  void check_panels() {
    if (figure_.panels.size() < 2) return;
    double area = 0.0, top = drawing_.height;
    for (const Box& frame : drawing_.frames) {
      area += frame.width() * frame.height();
      top = std::min(top, frame.y0);
    }
    const double share = area / (drawing_.width * (drawing_.height - top));
    if (share < kLeastOfPanels)
      add(fmt::format("the panels take {:.0f} % of the page", 100.0 * share));
  }

  /// What of all that is drawn shows data.
  void check_data_share() {
    // Of few points the share says nothing.
    const auto has_points_alone = [](const Panel& panel) {
      return std::ranges::all_of(panel.layers, [](const Layer& layer) {
        return !std::holds_alternative<Polyline>(layer) && !std::holds_alternative<Band>(layer) &&
               !std::holds_alternative<Segments>(layer);
      });
    };
    if (std::ranges::any_of(figure_.panels, &Panel::bare) ||
        std::ranges::any_of(figure_.panels, has_points_alone))
      return;
    const auto pixels = [&](auto wanted) {
      Drawing part = drawing_;
      std::erase_if(part.items, [&](const Item& item) { return !wanted(item.item_class); });
      return coloured_pixels(to_image(part), drawing_.background);
    };
    const double all = pixels([](ItemClass) { return true; });
    const double share = all > 0.0 ? pixels(shows_data) / all : 1.0;
    if (share < kLeastOfData)
      add(fmt::format("data are {:.1f} % of the coloured pixels", 100.0 * share));
  }

  /// Lines of two names whose colours are alike, and their dashes too, where they touch.
  void check_colours(std::size_t index) {
    std::vector<const Polyline*> lines;
    for (const Layer& layer : figure_.panels[index].layers)
      if (const auto* line = std::get_if<Polyline>(&layer); line != nullptr && !line->label.empty())
        lines.push_back(line);
    for (std::size_t a = 0; a < lines.size(); ++a)
      for (std::size_t b = a + 1; b < lines.size(); ++b) {
        const Colour one = theme_.of(lines[a]->colour), two = theme_.of(lines[b]->colour);
        if (one != two && lines[a]->dash == lines[b]->dash &&
            difference(one, two) < kLeastDifference && touch(one, two, index))
          add(fmt::format("the colours of '{}' and '{}' touch and are alike", lines[a]->label,
                          lines[b]->label));
      }
  }

  bool touch(Colour a, Colour b, std::size_t index) const {
    const auto mask = [&](Colour colour) {
      Drawing part = drawing_;
      std::erase_if(part.items, [&](const Item& item) {
        const auto* shape = std::get_if<Shape>(&item.what);
        return item.panel != index || item.item_class != ItemClass::kLine || shape == nullptr ||
               !shape->stroke || shape->stroke->colour != colour;
      });
      return to_image(part);
    };
    const Image of_a = mask(a), of_b = mask(b);
    for (int y = 0; y + 1 < of_a.height; ++y)
      for (int x = 0; x + 1 < of_a.width; ++x)
        if (is_coloured(of_a, x, y, drawing_.background) &&
            (is_coloured(of_b, x, y, drawing_.background) ||
             is_coloured(of_b, x + 1, y, drawing_.background) ||
             is_coloured(of_b, x, y + 1, drawing_.background)))
          return true;
    return false;
  }

  const Figure& figure_;
  const Theme& theme_;
  Drawing drawing_;
  std::vector<std::string> broken_;
};

/// How the ids of figures begin whose curves are quantities, sizes or noises of one method.
constexpr std::array<std::string_view, 6> kOfOneMethod = {
    "anchors-", "angle-", "factorization-cost", "fig-1b", "noise-", "positions-"};

/// The method that a label names, whatever the value of its parameter; of several the first.
std::string method_in(const std::string& label) {
  static const std::regex kParameter(", [^, ]+ = [^,]+"), kOthers(" and .*");
  return std::regex_replace(std::regex_replace(label, kOthers, ""), kParameter, "");
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
      if (line == nullptr || line->label.empty() || line->label.ends_with(" methods)") ||
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
