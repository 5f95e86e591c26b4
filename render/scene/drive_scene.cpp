#include "render/scene/drive_scene.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/model/slam/method_record.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/error_ramp.hpp"
#include "render/figures/maps/path_map.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

// Shares of the longer side of the ground.
constexpr double kPathStep = 0.004;  // Between neighbouring points of a path that are drawn.
constexpr double kTruePathWidth = 0.013, kPathWidth = 0.0065, kPlainWidth = 0.0035;
constexpr double kPillarRadius = 0.009, kPillarHeight = 0.1, kBallRadius = 0.016;
constexpr double kTolerance = 5e-4;  // Of a path that is thinned.

/// Values are kept to that share of a length: a drive has thousands of positions, each twice in a
/// file.
constexpr double kPrecision = 1e-5;

/// To a decimal that `whole` is 1e5 of or more; NaN stays.
double rounded(double value, double whole) {
  const double decimal = std::pow(10.0, std::floor(std::log10(kPrecision * whole)));
  // By the reciprocal, a whole number, where it is one: the nearest double has a short text.
  return decimal < 1.0 ? std::round(value * std::round(1.0 / decimal)) / std::round(1.0 / decimal)
                       : std::round(value / decimal) * decimal;
}

/// A flat line on the ground; positions that are not shown break it.
class Ribbon {
 public:
  /// @param side  Of the ground.
  Ribbon(double width, double height, double side)
      : half_(width / 2.0), height_(height), side_(side) {}

  /// @param value  Of its tones, if those of the ribbon are used.
  /// @param lift   Above the ribbon's height: where a path crosses itself, the later part is seen.
  void add(const Eigen::RowVector2d& at, double value, double lift = 0.0) {
    if (!at.allFinite()) {
      end_piece();
      return;
    }
    piece_.push_back({at, value, height_ + lift});
  }

  Surface make(const std::string& label, const Style& style, std::optional<Range> limits) {
    end_piece();
    surface_.label = label;
    surface_.style = style;
    surface_.style.lit = false;
    if (limits)
      surface_.tones.limits = *limits;
    else
      surface_.tones.values.clear();
    return std::move(surface_);
  }

 private:
  struct At {
    Eigen::RowVector2d at;
    double value;
    double height;
  };

  /// Across the path at a point, by the mean of the directions to and from it.
  Eigen::RowVector2d across(std::size_t i) const {
    Eigen::RowVector2d along = Eigen::RowVector2d::Zero();
    if (i > 0) along += (piece_[i].at - piece_[i - 1].at).normalized();
    if (i + 1 < piece_.size()) along += (piece_[i + 1].at - piece_[i].at).normalized();
    const double length = along.norm();
    if (!(length > 1e-6)) return Eigen::RowVector2d(0.0, 0.0);
    return Eigen::RowVector2d(-along.y(), along.x()) / length;
  }

  void end_piece() {
    for (std::size_t i = 0; i < piece_.size() && piece_.size() > 1; ++i) {
      const auto next = static_cast<std::uint32_t>(surface_.points.size());
      const Eigen::RowVector2d side = half_ * across(i);
      for (const double sign : {-1.0, 1.0}) {
        const Eigen::RowVector2d edge = piece_[i].at + sign * side;
        surface_.points.emplace_back(rounded(edge.x(), side_), rounded(edge.y(), side_),
                                     piece_[i].height);
      }
      surface_.tones.values.insert(surface_.tones.values.end(), 2, piece_[i].value);
      if (i == 0) continue;
      surface_.triangles.push_back({next - 2, next, next + 1});
      surface_.triangles.push_back({next - 2, next + 1, next - 1});
    }
    piece_.clear();
  }

  double half_, height_, side_;
  std::vector<At> piece_;
  Surface surface_;
};

class DriveScene {
 public:
  explicit DriveScene(const DriveSceneSpec& spec)
      : spec_(spec),
        run_(spec.run),
        record_(*record_of(spec.run, spec.method)),
        view_(
            path_view({spec.id, spec.title, spec.run, {SlamMethod::kDeadReckoning, spec.method}})) {
    const auto& [x, y] = view_.limits;
    ground_ = {{x.low, y.low}, {x.high, y.high}};
    side_ = ground_.side();
  }

  Scene make() {
    scene_.id = spec_.id;
    scene_.title = spec_.title;
    scene_.record_ids = spec_.record_ids;
    scene_.lights = usual_lights();
    scene_.parts = {floor_of(ground_), walls_of(ground_, kKerbShare * side_), grid_of(ground_)};
    if (run_.log.ground_truth)
      add(plain(*run_.log.ground_truth, kTruePathWidth, 2, "true path", {.colour = kTrueColour}));
    if (const SlamRecord* unaided = record_of(run_, SlamMethod::kDeadReckoning);
        unaided != nullptr && spec_.method != SlamMethod::kDeadReckoning)
      add(plain(unaided->estimate.path, kPlainWidth, 3, std::string(info(unaided->method).label),
                {.colour = path_style(unaided->method).colour}));
    add_path();
    add_landmarks();
    std::vector<Point3> tops;
    for (const SceneLabels& labels : labels_)
      tops.insert(tops.end(), labels.at.begin(), labels.at.end());
    Shot view = ground_view(ground_, kKerbShare * side_, tops);
    view.labels = std::move(labels_);
    scene_.views.push_back(std::move(view));
    describe();
    require_valid(scene_);
    return std::move(scene_);
  }

 private:
  void add(Part part) {
    if (const auto* surface = std::get_if<Surface>(&part);
        surface != nullptr && surface->triangles.empty())
      return;
    scene_.parts.push_back(std::move(part));
  }

  bool is_shown(const Eigen::RowVector2d& at) const { return view_.shows(at); }

  Ribbon ribbon(double width, int layer) const {
    return {width * side_, rounded(kFlatLayer * layer * side_, kFlatLayer * side_), side_};
  }

  /// A path in one colour.
  Surface plain(const Trajectory& path, double width, int layer, const std::string& label,
                const Style& style) const {
    Ribbon line = ribbon(width, layer);
    const ThinLine thin = thin_path(path, kTolerance * side_);
    for (std::size_t i = 0; i < thin.x.size(); ++i) {
      const Eigen::RowVector2d at(thin.x[i], thin.y[i]);
      line.add(is_shown(at) ? at : Eigen::RowVector2d(kNaN, kNaN), kNaN);
    }
    return line.make(label, style, std::nullopt);
  }

  /// A path coloured by its values, of points a step of the eye apart.
  Surface toned(const Trajectory& path, const std::vector<double>& values, const Range& limits,
                const std::string& label) const {
    Ribbon line = ribbon(kPathWidth, 4);
    Eigen::RowVector2d before(kNaN, kNaN);
    const double layer = kFlatLayer * side_;
    double greatest = kNaN;  // Since the point before: no peak is lost.
    for (Index i = 0; i < path.size(); ++i) {
      const Eigen::RowVector2d at = path.positions_m.row(i);
      if (!is_shown(at)) {
        line.add({kNaN, kNaN}, kNaN);
        before.setConstant(kNaN);
        continue;
      }
      greatest = std::fmax(greatest, values[static_cast<std::size_t>(i)]);
      if ((at - before).norm() < kPathStep * side_ && i + 1 < path.size()) continue;
      line.add(at, rounded(greatest, limits.high - limits.low),
               rounded(layer * static_cast<double>(i) / static_cast<double>(path.size()), layer));
      before = at;
      greatest = kNaN;
    }
    Surface surface = line.make(label, {.colour = path_style(record_.method).colour}, limits);
    if (has_errors_) surface.tones.bar_label = "error of the path [m]";
    return surface;
  }

  void add_path() {
    const Trajectory& path = record_.estimate.path;
    std::vector<double> values = record_.error_m;
    std::string label;
    Range limits{0.0, 1.0};
    has_errors_ = std::ranges::any_of(values, [](double v) { return std::isfinite(v); });
    if (has_errors_) {
      limits.high = end_of_error_ramp(values);
      label = "path";
    } else {
      values.assign(static_cast<std::size_t>(path.size()), 0.0);
      for (Index i = 0; i < path.size(); ++i) values[static_cast<std::size_t>(i)] = path.time_s(i);
      limits = {path.time_s(0), std::max(path.time_s(path.size() - 1), path.time_s(0) + 1e-9)};
      label = "path, start (dark) to end";
    }
    limits_ = limits;
    add(toned(path, values, limits, label));
  }

  void add_landmarks() {
    const Points& estimate = record_.estimate.landmarks_m;
    const bool known = run_.log.true_landmarks.has_value();
    const Points& at = known ? *run_.log.true_landmarks : estimate;
    std::vector<Index> rows;
    SceneLabels labels;
    const double height = kPillarHeight * side_;
    Spheres balls{.label = "landmark, estimated position",
                  .radius = kBallRadius * side_,
                  .style = {.colour = path_style(record_.method).colour}};
    for (Index i = 0; i < at.rows(); ++i) {
      if (!at.row(i).allFinite() || !is_shown(at.row(i))) continue;
      rows.push_back(i);
      labels.at.push_back(on_floor(at.row(i), height + 2.0 * balls.radius));
      labels.text.push_back(run_.log.landmarks[static_cast<std::size_t>(i)]);
    }
    Rods rods = pillars(at, rows, kPillarRadius * side_, height);
    rods.label = rods.from.empty() || !known ? "" : "landmark, true position";
    rods.style.colour = ThemeColour::kText;
    add(std::move(rods));
    for (Index i = 0; i < estimate.rows(); ++i)
      if (estimate.row(i).allFinite() && is_shown(estimate.row(i)))
        balls.at.push_back(on_floor(estimate.row(i), height + balls.radius));
    if (!balls.at.empty()) add(std::move(balls));
    if (!labels.at.empty()) labels_.push_back(std::move(labels));
  }

  void describe() {
    if (!view_.leaving.empty())
      scene_.notes.push_back(
          {"Outside the image: " + listed(view_.leaving, 4) + ".", ThemeColour::kWarning});
    const std::string method(info(record_.method).label);
    scene_.caption = fmt::format(
        "{} from above: the {} path, {}.{} Pillars stand at the {} positions of the landmarks "
        "(heights not to scale){}.",
        run_.log.name, method,
        has_errors_ ? fmt::format("coloured by its error up to {} m, the 95th percentile",
                                  significant(limits_.high, 2))
                    : "coloured by time",
        run_.log.ground_truth ? " The wide band under it is the true path." : "",
        run_.log.true_landmarks ? "true" : "estimated",
        run_.log.true_landmarks ? "; a ball is where the map has each" : "");
    scene_.alt = fmt::format("The ground of {} with {} and the {} path", run_.log.name,
                             counted(std::ssize(run_.log.landmarks), "landmark"), method);
    if (!record_.errors.empty())
      scene_.alt += fmt::format("; mean error {}", error_text(record_.errors.front().mean_m));
    scene_.alt += ".";
  }

  const DriveSceneSpec& spec_;
  const SlamRun& run_;
  const SlamRecord& record_;
  PathView view_;
  Ground ground_;
  double side_ = 1.0;
  Range limits_;
  bool has_errors_ = false;
  std::vector<SceneLabels> labels_;
  Scene scene_;
};

}  // namespace

bool has_drive_scene(const SlamRun& run, SlamMethod method) {
  const SlamRecord* record = record_of(run, method);
  if (record == nullptr) return false;
  const Points& path = record->estimate.path.positions_m;
  Index shown = 0;
  for (Index i = 0; i < path.rows(); ++i) shown += path.row(i).allFinite() ? 1 : 0;
  if (shown < 2) return false;
  const PathView view = path_view({"drive", "", run, {SlamMethod::kDeadReckoning, method}});
  const auto& [x, y] = view.limits;
  const double farthest =
      std::max({std::abs(x.low), std::abs(x.high), std::abs(y.low), std::abs(y.high)});
  return is_room_side(view.side_m) && farthest <= kLongestSide_m && x.high > x.low &&
         y.high > y.low;
}

Scene drive_scene(const DriveSceneSpec& spec) {
  if (!has_drive_scene(spec.run, spec.method))
    throw InvalidInput("drive_scene: no path that can be shown");
  return DriveScene(spec).make();
}

}  // namespace mapproof
