#include "render/export/figure_script.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/utf8.hpp"
#include "render/plot/layout.hpp"

namespace mapproof {
namespace {

std::string in_lines(const std::vector<std::string>& items) {
  constexpr std::size_t kLongest = 96;
  std::string out = "[";
  std::size_t begin = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out += ",";
    if (i > 0 && out.size() - begin + items[i].size() + 2 > kLongest) {
      begin = out.size() + 1;
      out += "\n    ";
    } else if (i > 0) {
      out += " ";
    }
    out += items[i];
  }
  return out + "]";
}

/// A text as a literal of Python on one line; matplotlib takes no "$" in it for mathematics.
std::string python_text(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const auto byte = static_cast<unsigned char>(text[0]);
    const std::optional<char32_t> code = take_code_point(text);
    if (!code)
      out += fmt::format("\\x{:02x}", byte);
    else if (*code == '"' || *code == '\\')
      out += fmt::format("\\{}", static_cast<char>(*code));
    else if (*code == '$')
      out += "\\\\$";
    else if (*code == '\n')
      out += "\\n";
    else if (*code < 0x20 || (*code >= 0x7F && *code < 0xA0) ||
             (*code >= 0x2028 && *code <= 0x202E) || (*code >= 0x2066 && *code <= 0x2069))
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(*code));
    else
      append_utf8(out, *code);
  }
  return out + "\"";
}

/// Numbers as they read back; NaN and infinities by their names in the script: nan, inf.
std::string python_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return csv_number(value);
}

/// "[1, 2, ...]" in lines of at most 96 characters, those after the first indented by four.
std::string python_list(const std::vector<double>& values) {
  std::vector<std::string> items;
  for (const double value : values) items.push_back(python_number(value));
  return in_lines(items);
}

std::string python_list(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(python_text(text));
  return in_lines(items);
}

/// "\"#0072b2\"".
std::string script_colour(Colour of) { return "\"" + hex(of) + "\""; }

/// Interpreter, description, imports and sizes.
std::string script_head(const std::string& id, const std::string& title, const Theme& theme) {
  return fmt::format(
      "#!/usr/bin/env python3\n"
      "# Draws {0} of mapproof by matplotlib: python3 {0}.py [FILE]; without FILE, "
      "{0}-matplotlib.pdf.\n"
      "import sys\n\n"
      "import matplotlib\n\n"
      "matplotlib.use(\"Agg\")\n"
      "import matplotlib.pyplot as plt\n"
      "import numpy as np\n"
      "from numpy import inf, nan\n\n"
      "TITLE = {1}\n"
      "plt.rcParams.update({{\n"
      "    \"font.family\": \"DejaVu Sans\", \"font.size\": {2}, \"axes.labelsize\": {2},\n"
      "    \"xtick.labelsize\": {3}, \"ytick.labelsize\": {3}, \"axes.titlesize\": {2},\n"
      "    \"legend.fontsize\": {2}, \"figure.titlesize\": {4}, \"axes.linewidth\": {5},\n"
      "    \"savefig.dpi\": {6}, \"pdf.fonttype\": 42, \"ps.fonttype\": 42,\n"
      "    \"figure.facecolor\": {7}, \"axes.facecolor\": {7},\n"
      "    \"text.color\": {8}, \"axes.labelcolor\": {8}, \"xtick.color\": {8}, \"ytick.color\": "
      "{8},\n"
      "    \"axes.edgecolor\": {8}, \"axes.axisbelow\": True,\n"
      "}})\n\n",
      id, python_text(title), python_number(theme.font_pt), python_number(theme.tick_font_pt),
      python_number(theme.title_font_pt), python_number(theme.hairline_pt),
      python_number(theme.dpi), script_colour(theme.background), script_colour(theme.text));
}

/// The function legend(ax): a legend where something has a label.
std::string script_legend() {
  return "def legend(ax):\n"
         "    \"\"\"Each label once.\"\"\"\n"
         "    handles, labels = ax.get_legend_handles_labels()\n"
         "    once = dict(zip(labels, handles))\n"
         "    if once:\n"
         "        ax.legend(once.values(), once.keys(), loc=\"best\")\n\n\n";
}

/// Title, notes, and the file that is written.
std::string script_tail(const std::string& id, const std::string& title,
                        const std::vector<Note>& notes) {
  std::string head;
  if (!title.empty()) head = title;
  for (const Note& note : notes) head += (head.empty() ? "" : "\n") + note.text;
  std::string out;
  if (!head.empty()) out += fmt::format("fig.suptitle({}, wrap=True)\n", python_text(head));
  return out +
         fmt::format("fig.savefig(sys.argv[1] if len(sys.argv) > 1 else \"{}-matplotlib.pdf\")\n",
                     id);
}

std::string axis_list(const std::vector<Point3>& points, int axis) {
  std::vector<double> values;
  for (const Point3& point : points) values.push_back(point(axis));
  return python_list(values);
}

/// Names of the data of a part in the script: x3, y3, z3.
std::string names_of(const std::string& suffix) { return fmt::format("x{0}, y{0}, z{0}", suffix); }

void put_points(const std::vector<Point3>& points, const std::string& suffix, std::string& out) {
  out += fmt::format("x{0} = {1}\ny{0} = {2}\nz{0} = {3}\n", suffix, axis_list(points, 0),
                     axis_list(points, 1), axis_list(points, 2));
}

std::string common_words(const Style& style, const Theme& theme, const std::string& label) {
  const Colour shown = mix(theme.of(style.colour), theme.background, style.share);
  return fmt::format("color={}, alpha={}{}", script_colour(shown), python_number(style.opacity),
                     label.empty() ? "" : ", label=" + python_text(label));
}

/// The colours of the tones, one a point; none: the empty text.
void put_tones(const Tones& tones, const Style& style, const Theme& theme,
               const std::string& suffix, std::string& out) {
  if (tones.values.empty()) return;
  out += fmt::format("tones{} = viridis({}, {}, {}, {})\n", suffix, python_list(tones.values),
                     python_number(tones.limits.low), python_number(tones.limits.high),
                     script_colour(theme.of(style.colour)));
}

/// The data of a part at the top of the script, and the call that draws it on `ax`.
class PartText {
 public:
  PartText(const Theme& theme, std::size_t index, std::string& data, std::string& call)
      : theme_(theme), at_(std::to_string(index + 1)), data_(data), call_(call) {}

  void operator()(const Surface& surface) {
    put_points(surface.points, at_, data_);
    put_triangles(surface.triangles);
    call_ += fmt::format("ax.plot_trisurf({}, triangles=faces{}, linewidth=0, {})\n", names_of(at_),
                         at_, common_words(surface.style, theme_, ""));
    // The legend of matplotlib 3.6 takes no surface: an empty line stands for it.
    if (!surface.label.empty())
      call_ += fmt::format("ax.plot([], [], [], linewidth=5, {})\n",
                           common_words(surface.style, theme_, surface.label));
  }
  void operator()(const Tube& tube) {
    put_points(tube.points, at_, data_);
    call_ +=
        fmt::format("ax.plot({}, linewidth={}, {})\n", names_of(at_), python_number(theme_.line_pt),
                    common_words(tube.style, theme_, tube.label));
  }
  void operator()(const Rods& rods) {
    put_points(rods.from, at_ + "a", data_);
    put_points(rods.to, at_ + "b", data_);
    call_ += fmt::format(
        "ax.add_collection3d(Line3DCollection(list(zip(zip(x{0}a, y{0}a, z{0}a), zip(x{0}b, y{0}b, "
        "z{0}b))), linewidths={1}, {2}))\n",
        at_, python_number(theme_.line_pt), common_words(rods.style, theme_, rods.label));
    if (rods.arrow)
      call_ += fmt::format("ax.scatter(x{0}b, y{0}b, z{0}b, marker=\"^\", s=9, {1})\n", at_,
                           common_words(rods.style, theme_, ""));
  }
  void operator()(const Spheres& spheres) {
    put_points(spheres.at, at_, data_);
    put_tones(spheres.tones, spheres.style, theme_, at_, data_);
    if (spheres.tones.values.empty())
      call_ += fmt::format("ax.scatter({}, s=16, {})\n", names_of(at_),
                           common_words(spheres.style, theme_, spheres.label));
    else
      call_ += fmt::format("ax.scatter({}, s=16, c=tones{}{})\n", names_of(at_), at_,
                           spheres.label.empty() ? "" : ", label=" + python_text(spheres.label));
  }
  void operator()(const Field& field) {
    put_points(field.points, at_, data_);
    data_ += fmt::format("values{} = {}\n", at_, python_list(field.tones.values));
    call_ += fmt::format(
        "image = ax.plot_trisurf({}, cmap=\"viridis\", linewidth=0)\n"
        "image.set_array(np.mean(np.asarray(values{})[image_triangles({})], axis=1))\n"
        "image.set_clim({}, {})\n",
        names_of(at_), at_, names_of(at_), python_number(field.tones.limits.low),
        python_number(field.tones.limits.high));
  }

 private:
  void put_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<double> corners;
    for (const auto& triangle : triangles)
      for (const std::uint32_t corner : triangle) corners.push_back(corner);
    data_ +=
        fmt::format("faces{} = np.reshape({}, (-1, 3)).astype(int)\n", at_, python_list(corners));
  }

  const Theme& theme_;
  std::string at_;
  std::string& data_;
  std::string& call_;
};

std::string camera_words(const Camera& camera) {
  const Point3 from = camera.eye - camera.target;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  return fmt::format("ax.view_init(elev={:.2f}, azim={:.2f})\nax.set_proj_type(\"{}\")\n",
                     std::atan2(from.z(), std::hypot(from.x(), from.y())) * kDegrees,
                     std::atan2(from.y(), from.x()) * kDegrees,
                     camera.parallel ? "ortho" : "persp");
}

void add_view(const Shot& view, const Scene& scene, const std::vector<std::string>& calls,
              const Theme& theme, std::string& out) {
  for (std::size_t p = 0; p < scene.parts.size(); ++p)
    if (shows(view, p)) out += calls[p];
  for (const SceneLabels& labels : view.labels)
    for (std::size_t i = 0; i < labels.text.size(); ++i)
      out += fmt::format("ax.text({}, {}, {}, {}, color={})\n", python_number(labels.at[i].x()),
                         python_number(labels.at[i].y()), python_number(labels.at[i].z()),
                         python_text(labels.text[i]), script_colour(theme.of(labels.colour)));
  constexpr char kAxes[] = {'x', 'y', 'z'};
  for (const Rule& rule : view.rules) {
    Eigen::Index axis = 0;
    (rule.to - rule.from).cwiseAbs().maxCoeff(&axis);
    out += fmt::format("ax.set_{}label({})\n", kAxes[axis], python_text(rule.label));
  }
  if (!view.title.empty()) out += fmt::format("ax.set_title({})\n", python_text(view.title));
  out += camera_words(view.camera) + "same_units(ax)\nlegend(ax)\n";
}

}  // namespace

std::string scene_script(const Scene& scene, const Theme& theme) {
  require_valid(scene);
  std::string out = script_head(scene.id, scene.title, theme);
  out +=
      "from matplotlib.tri import Triangulation\n"
      "from mpl_toolkits.mplot3d.art3d import Line3DCollection\n\n\n"
      "def viridis(values, low, high, other):\n"
      "    \"\"\"A colour a value; nan takes the other one.\"\"\"\n"
      "    ramp = matplotlib.cm.get_cmap if not hasattr(matplotlib, \"colormaps\") else "
      "matplotlib.colormaps.get_cmap\n"
      "    share = np.clip((np.asarray(values) - low) / ((high - low) or 1), 0, 1)\n"
      "    return [other if one != one else ramp(\"viridis\")(one) for one in share]\n\n\n"
      "def image_triangles(x, y, z):\n"
      "    \"\"\"The triangles of the plan, as plot_trisurf draws them.\"\"\"\n"
      "    return Triangulation(x, y).triangles\n\n\n"
      "def same_units(ax):\n"
      "    \"\"\"One unit is as long along each axis.\"\"\"\n"
      "    limits = np.array([ax.get_xlim3d(), ax.get_ylim3d(), ax.get_zlim3d()])\n"
      "    ax.set_box_aspect(np.ptp(limits, axis=1))\n\n\n";
  out += script_legend();
  std::string data;
  std::vector<std::string> calls(scene.parts.size());
  for (std::size_t p = 0; p < scene.parts.size(); ++p)
    std::visit(PartText(theme, p, data, calls[p]), scene.parts[p]);
  const std::size_t columns =
      scene.columns == 0 ? scene.views.size() : std::min(scene.columns, scene.views.size());
  const std::size_t rows = (scene.views.size() + columns - 1) / columns;
  out += data;
  out += fmt::format("fig = plt.figure(figsize=({}, {}))\n", python_number(theme.width_pt / 72.0),
                     python_number(static_cast<double>(rows) * theme.height_pt / 72.0));
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    out += fmt::format("\n# View {0}\nax = fig.add_subplot({1}, {2}, {0}, projection=\"3d\")\n",
                       i + 1, rows, columns);
    add_view(scene.views[i], scene, calls, theme, out);
  }
  return out + script_tail(scene.id, theme.draws_title ? scene.title : "", scene.notes);
}

namespace {

/// Names as a list. They may be of any length, and matplotlib fails on a line of more than 32,767
/// pixels.
std::string names_list(std::vector<std::string> names) {
  constexpr std::size_t kLongest = 100;  // Characters.
  for (std::string& name : names) name = printable(name, kLongest);
  return python_list(names);
}

std::string line_style(Dash dash) {
  switch (dash) {
    case Dash::kSolid:
      return "\"-\"";
    case Dash::kDashed:
      return "\"--\"";
    case Dash::kDotted:
      return "\":\"";
    case Dash::kDashDot:
      return "\"-.\"";
    case Dash::kLongDash:
      return "(0, (8, 3))";
  }
  return "\"-\"";
}

std::string marker_sign(Marker marker) {
  constexpr const char* kSigns[] = {"", "o", "s", "^", "D", "v", "x", "+"};
  return fmt::format("\"{}\"", kSigns[static_cast<std::size_t>(marker)]);
}

/// The calls that draw one layer on `ax`.
class LayerCalls {
 public:
  LayerCalls(const Theme& theme, std::size_t order, std::string& out)
      : theme_(theme), order_(order), out_(out) {}

  void operator()(const Polyline& line) {
    data("x", line.x);
    data("y", line.y);
    if (!line.values.empty()) return add_coloured(line);
    call("ax.plot(x, y, color={}, linestyle={}, linewidth={}, marker={}, markersize={}{})",
         colour(line.colour), line_style(line.dash), width(line.width), marker_sign(line.marker),
         python_number(theme_.marker_pt), common(line.label));
  }
  void operator()(const Band& band) {
    data("x", band.x);
    data("low", band.low);
    data("high", band.high);
    call("ax.fill_between(x, low, high, color={}, alpha=0.2, linewidth=0{})", colour(band.colour),
         common(band.label));
  }
  void operator()(const Scatter& points) {
    data("x", points.x);
    data("y", points.y);
    const bool crosses = points.marker == Marker::kCross || points.marker == Marker::kPlus;
    call(
        "ax.plot(x, y, linestyle=\"none\", marker={}, markersize={}, color={}, "
        "markerfacecolor={}{})",
        marker_sign(points.marker), python_number(theme_.marker_pt * points.size),
        colour(points.colour), points.filled || crosses ? colour(points.colour) : "\"none\"",
        common(points.label));
  }
  void operator()(const Segments& lines) {
    data("x0", lines.x0);
    data("y0", lines.y0);
    data("x1", lines.x1);
    data("y1", lines.y1);
    if (lines.arrow)
      call(
          "ax.quiver(x0, y0, np.subtract(x1, x0), np.subtract(y1, y0), angles=\"xy\", "
          "scale_units=\"xy\", scale=1, width=0.004, color={}{})",
          colour(lines.colour), common(lines.label));
    else
      call(
          "ax.add_collection(LineCollection(list(zip(zip(x0, y0), zip(x1, y1))), colors={}, "
          "linestyles={}, linewidths={}{}))\nax.autoscale_view()",
          colour(lines.colour), line_style(lines.dash), width(lines.width), common(lines.label));
  }
  void operator()(const PointLabels& labels) {
    data("x", labels.x);
    data("y", labels.y);
    out_ += "texts = " + names_list(labels.text) + "\n";
    call(
        "for at_x, at_y, text in zip(x, y, texts):\n"
        "    labels.append((ax, (at_x, at_y), text, dict(color={}{})))",
        colour(labels.colour), common(""));
  }
  void operator()(const Texts& shown) {
    constexpr const char* kAligned[] = {"left", "center", "right"};
    data("x", shown.x);
    data("y", shown.y);
    out_ += "texts = " + names_list(shown.text) + "\n";
    call(
        "for at_x, at_y, text in zip(x, y, texts):\n"
        "    ax.text(at_x, at_y, text, ha=\"{}\", va=\"center\", color={}{})",
        kAligned[static_cast<std::size_t>(shown.align)], colour(shown.colour), common(""));
  }
  void operator()(const Area& area) {
    data("x", area.x);
    data("y", area.y);
    call(
        "for part_x, part_y in outlines(x, y):\n"
        "    ax.fill(part_x, part_y, facecolor={}, edgecolor={}, linestyle={}, linewidth={}{})",
        face(area.fill, area.colour), area.outlined ? colour(area.colour) : "\"none\"",
        line_style(area.dash), width(area.width), common(area.label));
  }
  void operator()(const Ellipses& shapes) {
    std::vector<double> turn_deg;
    for (const double turn : shapes.rotation_rad)
      turn_deg.push_back(turn * 180.0 / std::numbers::pi);
    data("x", shapes.x);
    data("y", shapes.y);
    data("a", shapes.a);
    data("b", shapes.b);
    data("turn_deg", turn_deg);
    call(
        "for one in zip(x, y, a, b, turn_deg):\n"
        "    ax.add_patch(Ellipse(one[:2], 2 * one[2], 2 * one[3], angle=one[4], facecolor={}, "
        "edgecolor={}, linestyle={}, linewidth={}{}))\nax.autoscale_view()",
        face(shapes.fill, shapes.colour), colour(shapes.colour), line_style(shapes.dash),
        width(shapes.width), common(shapes.label));
  }
  void operator()(const Cells& cells) {
    data("values", cells.values);
    call(
        "image = ax.imshow(np.reshape(values, (-1, {})), extent=({}, {}, {}, {}), {}, "
        "aspect=\"auto\", interpolation=\"nearest\", zorder={})",
        cells.columns, python_number(cells.x.low), python_number(cells.x.high),
        python_number(cells.y.low), python_number(cells.y.high),
        colours(cells.colour_scale, cells.colour), order_);
    add_bar(cells.colour_scale);
    if (!cells.text.empty()) add_cell_texts(cells);
  }
  void operator()(const ImageLayer&) {}  // Of scenes alone.

 private:
  /// Each piece in the colour of the greater value of its ends, greater values above.
  void add_coloured(const Polyline& line) {
    data("values", line.values);
    call(
        "pieces = sorted((max(values[i:i + 2]), i) for i in range(len(x) - 1)\n"
        "                if not np.isnan([x[i:i + 2], y[i:i + 2], values[i:i + 2]]).any())\n"
        "image = ax.add_collection(LineCollection(\n"
        "    [list(zip(x[i:i + 2], y[i:i + 2])) for _, i in pieces], "
        "array=np.array([value for value, _ in pieces]),\n"
        "    {}, linewidths={}, capstyle=\"round\"{}))\nax.autoscale_view()",
        colours(line.colour_scale, line.colour), width(line.width), common(line.label));
    add_bar(line.colour_scale);
  }

  /// The words that give a collection its colours.
  std::string colours(const ColourScale& scale, ThemeColour of) const {
    const std::string map =
        scale.ramp == Ramp::kViridis
            ? "\"viridis\""
            : fmt::format("LinearSegmentedColormap.from_list(\"colour\", [\"{}\", {}])",
                          hex(theme_.background), colour(of));
    return fmt::format("cmap={}, norm={}({}, {}, clip=True)", map,
                       scale.scale == Scale::kLog ? "LogNorm" : "Normalize",
                       python_number(scale.limits.low), python_number(scale.limits.high));
  }

  void add_bar(const ColourScale& scale) {
    if (!scale.bar_label.empty())
      call("fig.colorbar(image, ax=ax, label={})", python_text(scale.bar_label));
  }

  void add_cell_texts(const Cells& cells) {
    out_ += "texts = " + python_list(cells.text) + "\n";
    call(
        "for i, text in enumerate(texts):\n"
        "    row, column = divmod(i, {})\n"
        "    ax.text({} + (column + 0.5) * {}, {} - (row + 0.5) * {}, text, ha=\"center\", "
        "va=\"center\")",
        cells.columns, python_number(cells.x.low),
        python_number((cells.x.high - cells.x.low) / static_cast<double>(cells.columns)),
        python_number(cells.y.high),
        python_number((cells.y.high - cells.y.low) / static_cast<double>(cells.rows())));
  }

  std::string colour(ThemeColour of) const { return script_colour(theme_.of(of)); }
  std::string width(double factor) const { return python_number(theme_.line_pt * factor); }

  std::string face(Fill fill, ThemeColour of) const {
    switch (fill) {
      case Fill::kNone:
        return "\"none\"";
      case Fill::kTint:
        // Opacity 0.2 as two digits: pairs of colour and opacity are of matplotlib 3.8.
        return fmt::format("\"{}33\"", hex(theme_.of(of)));
      case Fill::kSolid:
        return colour(of);
      case Fill::kPaper:
        return script_colour(theme_.background);
    }
    return "\"none\"";
  }

  /// What every call ends with: order and label.
  std::string common(const std::string& label) const {
    return fmt::format(", zorder={}{}", order_,
                       label.empty() ? "" : ", label=" + python_text(label));
  }

  void data(const char* name, const std::vector<double>& values) {
    out_ += fmt::format("{} = {}\n", name, python_list(values));
  }

  template <typename... Words>
  void call(fmt::format_string<Words...> form, Words&&... words) {
    out_ += fmt::format(form, std::forward<Words>(words)...) + "\n";
  }

  const Theme& theme_;
  std::size_t order_;
  std::string& out_;
};

void add_axis(const Axis& axis, char name, std::string& out) {
  if (!axis.label.empty())
    out += fmt::format("ax.set_{}label({})\n", name, python_text(axis.label));
  if (axis.scale == Scale::kLog) out += fmt::format("ax.set_{}scale(\"log\")\n", name);
  if (axis.limits)
    out += fmt::format("ax.set_{}lim({}, {})\n", name, python_number(axis.limits->low),
                       python_number(axis.limits->high));
  if (axis.whole)
    out += fmt::format("ax.{}axis.set_major_locator(MaxNLocator(integer=True))\n", name);
  if (!axis.names.empty())
    out += fmt::format("ax.set_{0}ticks(range({1}))\nax.set_{0}ticklabels({2})\n", name,
                       axis.names.size(), names_list(axis.names));
}

/// @param adjusts  What gives way to an equal aspect: "datalim", or "box" where both axes are
///                 shared, which matplotlib asks for.
void add_panel(const Panel& panel, const Theme& theme, std::string_view adjusts, std::string& out) {
  for (std::size_t k = 0; k < panel.layers.size(); ++k)
    std::visit(LayerCalls(theme, k + 2, out), panel.layers[k]);
  if (!panel.title.empty()) out += fmt::format("ax.set_title({})\n", python_text(panel.title));
  add_axis(panel.x, 'x', out);
  add_axis(panel.y, 'y', out);
  if (panel.equal_aspect)
    out += fmt::format("ax.set_aspect(\"equal\", adjustable=\"{}\")\n", adjusts);
  out += panel.bare ? "ax.set_axis_off()\n"
                    : fmt::format("ax.grid(True, color={}, linewidth={}, zorder=0)\n",
                                  script_colour(theme.grid), python_number(theme.hairline_pt));
  out += "legend(ax)\n";
}

/// Below the axes, so that it covers no data.
constexpr const char* kLegendBelow = R"(def legend(ax):
    """Each label once, below the axes."""
    handles, labels = ax.get_legend_handles_labels()
    once = dict(zip(labels, handles))
    if not once:
        return
    size = plt.rcParams["legend.fontsize"]
    wide = ax.get_subplotspec().get_gridspec().ncols * (max(map(len, once)) * 0.6 + 5) * size
    below = ScaledTranslation(0, -3.5 * size / 72, fig.dpi_scale_trans)
    ax.legend(once.values(), once.keys(), loc="upper center", bbox_to_anchor=(0.5, 0),
              bbox_transform=ax.transAxes + below, frameon=False, borderaxespad=0,
              ncol=max(1, min(len(once), int(72 * fig.get_figwidth() / wide))))


)";

/// As mark_labels.hpp places them, by simpler means.
constexpr const char* kPlaceLabels = R"(labels = []  # Axes, point, text and style.


def place_labels():
    """Each label where it covers fewest marks and labels; a line leads to one farther off."""
    fig.canvas.draw()
    point = fig.dpi / 72
    taken = {}
    for ax, at, text, style in labels:
        note = ax.annotate(text, at, xytext=(0, 0), textcoords="offset points", ha="center",
                           va="center", **style)
        note.set_in_layout(False)
        size = note.get_window_extent(fig.canvas.get_renderer())
        x, y = ax.transData.transform(at)
        frame = ax.get_window_extent()
        marks = [ax.transData.transform(line.get_xydata()) for line in ax.lines]
        marks = np.concatenate(marks) if marks else np.empty((0, 2))

        def cost(box):
            far, x0, y0, x1, y1 = box
            covered = (marks[:, 0] > x0 - 2 * point) & (marks[:, 0] < x1 + 2 * point) & (
                marks[:, 1] > y0 - 2 * point) & (marks[:, 1] < y1 + 2 * point)
            others = sum(x0 < b[2] and b[0] < x1 and y0 < b[3] and b[1] < y1
                         for b in taken.get(ax, []))
            outside = x0 < frame.x0 or x1 > frame.x1 or y0 < frame.y0 or y1 > frame.y1
            return covered.sum() + 3 * others + 10 * outside + far / 100

        boxes = []
        for far in (3, 7, 12, 18, 25):
            for angle in np.arange(0, 2 * np.pi, np.pi / 6):
                to_x = x + np.cos(angle) * (size.width / 2 + far * point)
                to_y = y + np.sin(angle) * (size.height / 2 + far * point)
                boxes.append((far, to_x - size.width / 2, to_y - size.height / 2,
                              to_x + size.width / 2, to_y + size.height / 2))
        far, x0, y0, x1, y1 = min(boxes, key=cost)
        taken.setdefault(ax, []).append((x0, y0, x1, y1))
        note.set_position((((x0 + x1) / 2 - x) / point, ((y0 + y1) / 2 - y) / point))
        if far > 7:
            end = ((np.clip(x, x0, x1) - x) / point, (np.clip(y, y0, y1) - y) / point)
            line = ax.annotate("", at, xytext=end, textcoords="offset points",
                               arrowprops=dict(arrowstyle="-", linewidth=0.5, shrinkA=0, shrinkB=2))
            line.set_in_layout(False)


)";

bool has_labels(const Figure& figure) {
  return std::ranges::any_of(figure.panels, [](const Panel& panel) {
    return std::ranges::any_of(panel.layers, [](const Layer& layer) {
      return std::holds_alternative<PointLabels>(layer);
    });
  });
}

/// The columns that the layout would choose at most.
std::size_t columns_of(const Figure& figure) {
  constexpr std::size_t kMost = 4;
  const std::size_t most = figure.columns == 0 ? kMost : figure.columns;
  return std::min(figure.panels.size(), most);
}

}  // namespace

std::string figure_script(const Figure& figure, const Theme& theme) {
  require_valid(figure);
  const std::size_t columns = columns_of(figure);
  const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
  std::string out = script_head(figure.id, figure.title, theme);
  out +=
      "from matplotlib.collections import LineCollection\n"
      "from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize\n"
      "from matplotlib.patches import ConnectionPatch, Ellipse\n"
      "from matplotlib.ticker import MaxNLocator\n"
      "from matplotlib.transforms import ScaledTranslation\n\n\n"
      "def outlines(x, y):\n"
      "    \"\"\"The closed outlines; nan ends one and begins the next.\"\"\"\n"
      "    ends = [i for i, one in enumerate(x) if one != one] + [len(x)]\n"
      "    begins = [0] + [end + 1 for end in ends[:-1]]\n"
      "    return [(x[b:e], y[b:e]) for b, e in zip(begins, ends) if e > b]\n\n\n";
  out += kLegendBelow;
  if (has_labels(figure)) out += kPlaceLabels;
  out += fmt::format(
      "fig, grid = plt.subplots({}, {}, figsize=({}, {}), squeeze=False, sharex={}, sharey={},\n"
      "                         layout=\"constrained\")\n"
      "panels = list(grid.flat)\n"
      "for ax in panels[{}:]:\n    ax.remove()\n",
      rows, columns, python_number(theme.width_pt / 72.0),
      python_number(static_cast<double>(rows) * theme.height_pt / 72.0),
      figure.shared_x ? "True" : "False", figure.shared_y ? "True" : "False", figure.panels.size());
  const char* adjusts = figure.shared_x && figure.shared_y ? "box" : "datalim";
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    out += fmt::format("\n# Panel {}\nax = panels[{}]\n", p + 1, p);
    add_panel(figure.panels[p], theme, adjusts, out);
  }
  for (const PanelArrow& arrow : figure.arrows)
    out += fmt::format(
        "fig.add_artist(ConnectionPatch((1.02, 0.5), (-0.02, 0.5), \"axes fraction\", \"axes "
        "fraction\",\n    axesA=panels[{}], axesB=panels[{}], arrowstyle=\"->\"))\n"
        "panels[{}].annotate({}, (1.05, 0.55), xycoords=\"axes fraction\")\n",
        arrow.from, arrow.from + 1, arrow.from, python_text(arrow.label));
  if (has_labels(figure)) out += "place_labels()\n";
  out += script_tail(figure.id, theme.draws_title ? figure.title : "",
                     draws_notes(figure, theme) ? figure.notes : std::vector<Note>());
  return out;
}

}  // namespace mapproof
