#include "render/plot/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr double kGreatestNumber = 1e150;  // Squares of it are still finite.

bool is_slug(std::string_view text) {
  if (text.empty()) return false;
  for (const char c : text)
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-')) return false;
  return true;
}

bool same_size(std::size_t size, std::initializer_list<std::size_t> others) {
  for (const std::size_t other : others)
    if (other != size) return false;
  return true;
}

/// Checks the parts one by one and keeps the ids found so far.
class Inspector {
 public:
  std::string figure(const Figure& figure) {
    if (!is_figure_id(figure.id))
      return "id: '" + printable(figure.id) + "' is not [a-z][a-z0-9-]* of at most 120 characters";
    if (figure.panels.empty()) return "panels: there is none";
    for (std::size_t p = 0; p < figure.panels.size(); ++p)
      if (std::string what = panel(figure.panels[p]); !what.empty())
        return fmt::format("panels/{}/{}", p, what);
    for (std::size_t a = 0; a < figure.arrows.size(); ++a)
      if (figure.arrows[a].from + 1 >= figure.panels.size())
        return fmt::format("arrows/{}/from: no panel follows", a);
    return shared_axes(figure);
  }

 private:
  std::string panel(const Panel& panel) {
    if (std::string what = axis(panel.x); !what.empty()) return "x/" + what;
    if (std::string what = axis(panel.y); !what.empty()) return "y/" + what;
    if (panel.equal_aspect && (panel.x.scale == Scale::kLog || panel.y.scale == Scale::kLog))
      return "equal_aspect: needs linear axes";
    for (std::size_t i = 0; i < panel.layers.size(); ++i) {
      const auto inspect = [&](const auto& layer) { return this->layer(layer, panel); };
      if (std::string what = std::visit(inspect, panel.layers[i]); !what.empty())
        return fmt::format("layers/{}/{}", i, what);
    }
    return {};
  }

  static std::string shared_axes(const Figure& figure) {
    const Panel& first = figure.panels.front();
    for (const Panel& panel : figure.panels) {
      if (figure.shared_x && panel.x.scale != first.x.scale) return "shared_x: scales differ";
      if (figure.shared_y && panel.y.scale != first.y.scale) return "shared_y: scales differ";
    }
    return {};
  }

  static std::string axis(const Axis& axis) {
    if (axis.scale == Scale::kLog && !axis.names.empty()) return "names: on a log axis";
    if (!axis.limits) return {};
    const auto [low, high] = *axis.limits;
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
      return "limits: not finite and ascending";
    if (axis.scale == Scale::kLog && low <= 0.0) return "limits: not positive on a log axis";
    return {};
  }

  std::string layer(const Polyline& line, const Panel& panel) {
    if (!same_size(line.x.size(), {line.y.size()})) return "y: not as long as x";
    if (std::string what = values(line.x, panel.x, "x"); !what.empty()) return what;
    if (std::string what = values(line.y, panel.y, "y"); !what.empty()) return what;
    if (std::string what = size(line.width, "width"); !what.empty()) return what;
    if (!line.values.empty()) {
      if (!same_size(line.x.size(), {line.values.size()})) return "values: not as many as x";
      if (std::string what = coloured(line.values, line.colour_scale); !what.empty()) return what;
    }
    return mark(line.mark);
  }

  std::string layer(const Band& band, const Panel& panel) {
    if (!same_size(band.x.size(), {band.low.size(), band.high.size()}))
      return "low, high: not as long as x";
    if (std::string what = values(band.x, panel.x, "x"); !what.empty()) return what;
    if (std::string what = values(band.low, panel.y, "low"); !what.empty()) return what;
    if (std::string what = values(band.high, panel.y, "high"); !what.empty()) return what;
    return mark(band.mark);
  }

  std::string layer(const Scatter& points, const Panel& panel) {
    if (!same_size(points.x.size(), {points.y.size()})) return "y: not as long as x";
    if (std::string what = values(points.x, panel.x, "x"); !what.empty()) return what;
    if (std::string what = values(points.y, panel.y, "y"); !what.empty()) return what;
    if (std::string what = size(points.size, "size"); !what.empty()) return what;
    return marks(points.marks, points.x.size());
  }

  std::string layer(const Segments& lines, const Panel& panel) {
    if (!same_size(lines.x0.size(), {lines.y0.size(), lines.x1.size(), lines.y1.size()}))
      return "y0, x1, y1: not as long as x0";
    if (std::string what = values(lines.x0, panel.x, "x0"); !what.empty()) return what;
    if (std::string what = values(lines.y0, panel.y, "y0"); !what.empty()) return what;
    if (std::string what = values(lines.x1, panel.x, "x1"); !what.empty()) return what;
    if (std::string what = values(lines.y1, panel.y, "y1"); !what.empty()) return what;
    if (std::string what = size(lines.width, "width"); !what.empty()) return what;
    return marks(lines.marks, lines.x0.size());
  }

  std::string layer(const PointLabels& labels, const Panel& panel) {
    if (!same_size(labels.x.size(), {labels.y.size(), labels.text.size()}))
      return "y, text: not as long as x";
    if (std::string what = values(labels.x, panel.x, "x"); !what.empty()) return what;
    return values(labels.y, panel.y, "y");
  }

  std::string layer(const Area& area, const Panel& panel) {
    if (!same_size(area.x.size(), {area.y.size()})) return "y: not as long as x";
    if (std::string what = values(area.x, panel.x, "x"); !what.empty()) return what;
    if (std::string what = values(area.y, panel.y, "y"); !what.empty()) return what;
    if (std::string what = size(area.width, "width"); !what.empty()) return what;
    return mark(area.mark);
  }

  std::string layer(const Ellipses& ellipses, const Panel& panel) {
    if (!is_linear(panel)) return "needs linear axes";
    if (!same_size(ellipses.x.size(), {ellipses.y.size(), ellipses.a.size(), ellipses.b.size(),
                                       ellipses.rotation_rad.size()}))
      return "y, a, b, rotation_rad: not as long as x";
    const std::array<std::pair<std::string_view, const std::vector<double>*>, 5> parts = {
        {{"x", &ellipses.x},
         {"y", &ellipses.y},
         {"a", &ellipses.a},
         {"b", &ellipses.b},
         {"rotation_rad", &ellipses.rotation_rad}}};
    for (const auto& [name, part] : parts)
      if (std::string what = values(*part, panel.x, name); !what.empty()) return what;
    for (const auto* part : {&ellipses.a, &ellipses.b})
      for (const double half : *part)
        if (half < 0.0) return "a, b: negative";
    if (std::string what = size(ellipses.width, "width"); !what.empty()) return what;
    return marks(ellipses.marks, ellipses.x.size());
  }

  std::string layer(const Cells& cells, const Panel& panel) {
    constexpr std::size_t kMostCells = 1'000'000;
    if (!is_linear(panel)) return "needs linear axes";
    if (cells.columns == 0 ? !cells.values.empty() : cells.values.size() % cells.columns != 0)
      return "values: no whole number of rows";
    if (cells.values.size() > kMostCells) return "values: more than a million";
    for (const auto& [name, range] : {std::pair{"x", cells.x}, std::pair{"y", cells.y}})
      if (!is_range(range)) return fmt::format("{}: not finite and ascending", name);
    if (std::string what = coloured(cells.values, cells.colour_scale); !what.empty()) return what;
    if (!cells.text.empty() && cells.text.size() != cells.values.size())
      return "text: not as many as values";
    return mark(cells.mark);
  }

  std::string layer(const Texts& texts, const Panel& panel) {
    if (!same_size(texts.x.size(), {texts.y.size(), texts.text.size()}))
      return "y, text: not as long as x";
    if (std::string what = values(texts.x, panel.x, "x"); !what.empty()) return what;
    return values(texts.y, panel.y, "y");
  }

  std::string layer(const ImageLayer& image, const Panel& panel) {
    if (!is_linear(panel)) return "needs linear axes";
    if (!is_range(image.x) || !is_range(image.y)) return "x, y: not finite and ascending";
    if (!same_size(image.clear_x.size(), {image.clear_y.size(), image.clear_by.size()}))
      return "clear_y, clear_by: not as long as clear_x";
    for (const auto& [name, part] :
         {std::pair{"clear_x", &image.clear_x}, std::pair{"clear_y", &image.clear_y},
          std::pair{"clear_by", &image.clear_by}})
      if (std::string what = values(*part, panel.x, name); !what.empty()) return what;
    return std::ranges::any_of(image.clear_by, [](double by) { return by < 0.0; })
               ? "clear_by: negative"
               : "";
  }

  static std::string coloured(std::span<const double> values, const ColourScale& colours) {
    if (!is_range(colours.limits)) return "limits: not finite and ascending";
    const Axis ramp{.label = {}, .scale = colours.scale};
    if (std::string what = Inspector::values(values, ramp, "values"); !what.empty()) return what;
    return colours.scale == Scale::kLog && colours.limits.low <= 0.0
               ? "limits: not positive on a log scale"
               : "";
  }

  static bool is_linear(const Panel& panel) {
    return panel.x.scale == Scale::kLinear && panel.y.scale == Scale::kLinear;
  }

  static bool is_range(const Range& range) {
    return std::isfinite(range.low) && std::isfinite(range.high) && range.low < range.high &&
           std::max(-range.low, range.high) <= kGreatestNumber;
  }

  static std::string size(double size, std::string_view name) {
    return size > 0.0 && size <= 100.0 ? "" : fmt::format("{}: not in (0, 100]", name);
  }

  static std::string values(std::span<const double> values, const Axis& axis,
                            std::string_view name) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isinf(values[i])) return fmt::format("{}/{}: infinite", name, i);
      if (std::abs(values[i]) > kGreatestNumber) return fmt::format("{}/{}: beyond 1e150", name, i);
      if (axis.scale == Scale::kLog && values[i] <= 0.0)
        return fmt::format("{}/{}: not positive on a log axis", name, i);
    }
    return {};
  }

  std::string marks(const std::vector<Mark>& marks, std::size_t points) {
    if (!marks.empty() && marks.size() != points) return "marks: not as many as points";
    for (const Mark& one : marks)
      if (std::string what = mark(one); !what.empty()) return what;
    return {};
  }

  std::string mark(const Mark& mark) {
    if (!mark.id.empty()) {
      if (!is_slug(mark.id)) return "mark: id '" + printable(mark.id) + "' is not [a-z0-9-]+";
      if (!ids_.insert(mark.id).second) return "mark: id '" + mark.id + "' is there twice";
    }
    for (const auto& [name, value] : mark.data)
      if (!is_slug(name)) return "mark: data '" + printable(name) + "' is not [a-z0-9-]+";
    return {};
  }

  std::set<std::string_view> ids_;
};

}  // namespace

ThemeColour series_colour(std::size_t i) {
  return static_cast<ThemeColour>(static_cast<std::size_t>(ThemeColour::kSeries1) +
                                  i % kSeriesCount);
}

bool is_figure_id(std::string_view id) { return is_slug(id) && id[0] >= 'a' && id.size() <= 120; }

void prefix_mark_ids(Panel& panel, const std::string& prefix) {
  const auto put = [&prefix](Mark& mark) {
    if (!mark.id.empty()) mark.id = prefix + mark.id;
  };
  for (Layer& layer : panel.layers)
    std::visit(
        [&put](auto& one) {
          if constexpr (requires { one.marks; }) std::ranges::for_each(one.marks, put);
          if constexpr (requires { one.mark; }) put(one.mark);
        },
        layer);
}

const std::string& label_of(const Layer& layer) {
  static const std::string none;
  return std::visit(
      [](const auto& one) -> const std::string& {
        if constexpr (requires { one.label; }) return one.label;
        return none;
      },
      layer);
}

void set_label(Layer& layer, const std::string& label) {
  std::visit(
      [&](auto& one) {
        if constexpr (requires { one.label; }) one.label = label;
      },
      layer);
}

bool is_empty(const Layer& layer) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.source; })
          return false;
        else if constexpr (requires { one.x0; })
          return one.x0.empty();
        else if constexpr (requires { one.x.empty(); })
          return one.x.empty();
        else
          return one.values.empty();
      },
      layer);
}

std::string problem(const Figure& figure) { return Inspector().figure(figure); }

void require_valid(const Figure& figure) {
  if (const std::string what = problem(figure); !what.empty())
    throw InvalidInput("figure " + printable(figure.id) + ": " + what);
}

}  // namespace mapproof
