#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "render/export/matplotlib_script.hpp"
#include "render/export/python_text.hpp"
#include "render/export/scene_script.hpp"

namespace mapproof {
namespace {

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

}  // namespace mapproof
