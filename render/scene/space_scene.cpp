#include "render/scene/space_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/status_text.hpp"
#include "render/scene/cloud_box.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

const Point3 kToSpaceCamera{0.55, -1.0, 0.62};
constexpr double kSeen = 0.035;  // A rod this long is seen, of the box.

void require_usable(const SpaceRun& run) {
  if (!has_space_scene(run)) throw InvalidInput("space_scene: nothing that can be shown");
  for (const SpaceRecord& record : run.records)
    if (record.estimate.landmarks_m.rows() != run.landmarks_m.rows() ||
        (!record.estimate.empty() && record.estimate.positions_m.rows() != run.positions_m.rows()))
      throw InvalidInput("space_scene: an estimate is not of the run's landmarks and positions");
}

/// What went wrong, after a space; nothing if that is not known.
std::string words_of(const SpaceEstimate& estimate) {
  return estimate.statuses.empty() ? "" : " " + status_text(estimate.statuses.front());
}

std::vector<Point3> as_points(const SpacePoints& rows) {
  std::vector<Point3> points;
  for (const auto& row : rows.rowwise()) points.emplace_back(row.transpose());
  return points;
}

/// The ground truth, about which the box is.
std::vector<Point3> true_positions(const SpaceRun& run) {
  std::vector<Point3> positions = as_points(run.landmarks_m);
  for (const Point3& p : as_points(run.positions_m)) positions.push_back(p);
  return positions;
}

/// What errors are lengthened by: the least of 1, 2, 5, 10, ... with which the mean is seen.
double round_factor(double mean_m, double size) {
  double factor = 1.0;
  for (int i = 0; mean_m > 0.0 && factor * mean_m < kSeen * size && i < 12; ++i)
    factor *= i % 3 == 1 ? 2.5 : 2.0;
  return factor;
}

class SpaceScene {
 public:
  explicit SpaceScene(const SpaceSceneSpec& spec)
      : spec_(spec), run_(spec.run), box_(true_positions(spec.run)) {
    scene_.id = spec.id;
    scene_.title = spec.title;
    scene_.record_ids = spec.record_ids;
    scene_.lights = usual_lights();
    scene_.columns = 1;
    double least = 0.0;
    for (const SpaceRecord& record : run_.records)
      if (record.landmarks_error_m) least = std::max(least, *record.landmarks_error_m);
    factor_ = round_factor(least, box_.size());
  }

  Scene make() {
    add_ground_truth();
    const std::size_t shared = scene_.parts.size();
    for (const SpaceRecord& record : run_.records) add_view(record, shared);
    describe();
    require_valid(scene_);
    return std::move(scene_);
  }

 private:
  void add_ground_truth() {
    scene_.parts.emplace_back(box_.floor());
    scene_.parts.emplace_back(box_.edges());
    Rods stalks{.radius = 0.0018 * box_.size(),
                .style = {.colour = ThemeColour::kMuted, .share = 0.6}};
    for (const Point3& p : as_points(run_.landmarks_m)) {
      stalks.from.emplace_back(p.x(), p.y(), box_.low.z());
      stalks.to.push_back(p);
    }
    scene_.parts.emplace_back(std::move(stalks));
    scene_.parts.emplace_back(path());
    scene_.parts.emplace_back(Spheres{.label = "true landmark",
                                      .at = as_points(run_.landmarks_m),
                                      .radius = 0.01 * box_.size(),
                                      .style = {.colour = ThemeColour::kSeries1}});
  }

  /// All of a long flight would be a tangle.
  Eigen::Index shown_steps() const { return std::min(run_.positions_m.rows(), kShownSteps); }

  Tube path() const {
    Tube tube{
        .label = fmt::format("true path, the last {} steps from dark to bright", shown_steps()),
        .points = as_points(run_.positions_m.bottomRows(shown_steps())),
        .radius = 0.0026 * box_.size()};
    for (std::size_t i = 0; i < tube.points.size(); ++i)
      tube.tones.values.push_back(static_cast<double>(i));
    tube.tones.limits = {0.0, static_cast<double>(tube.points.size() - 1)};
    return tube;
  }

  void add_view(const SpaceRecord& record, std::size_t shared) {
    const bool is_first = !has_estimate_ && !record.estimate.empty();
    has_estimate_ = has_estimate_ || is_first;
    Shot view{
        .title = record.knows_landmarks
                     ? fmt::format("{} known",
                                   counted(static_cast<long long>(run_.known.size()), "landmark"))
                     : "No landmark known",
        .camera = box_.camera(kToSpaceCamera),
        .rules = box_.rules({"x [m]", "y [m]", "z [m]"})};
    for (std::size_t i = 0; i < shared; ++i) view.parts.push_back(i);
    const auto add = [&](Part part) {
      view.parts.push_back(scene_.parts.size());
      scene_.parts.push_back(std::move(part));
    };
    if (record.estimate.empty()) {
      scene_.notes.push_back(
          {view.title + ": no map came out." + words_of(record.estimate), ThemeColour::kWarning});
    } else {
      add_estimated_path(record.estimate, view.title, is_first, add);
      Rods rods = errors_of(record.estimate);
      Spheres ends{.label = is_first ? "estimated landmark" : "",
                   .at = rods.to,
                   .radius = 0.007 * box_.size(),
                   .style = {.colour = ThemeColour::kSeries2}};
      rods.label = is_first ? rods_label() : "";
      if (!rods.from.empty()) {
        add(std::move(rods));
        add(std::move(ends));
      }
    }
    scene_.views.push_back(std::move(view));
  }

  /// The estimated path, as far as it keeps near the box; a note counts the rest.
  void add_estimated_path(const SpaceEstimate& estimate, const std::string& title, bool is_first,
                          const std::function<void(Part)>& add) {
    const Point3 middle = 0.5 * (box_.low + box_.high);
    Tube tube{.label = is_first ? "estimated path" : "",
              .radius = 0.0016 * box_.size(),
              .style = {.colour = ThemeColour::kText, .share = 0.75}};
    Eigen::Index far = 0;
    const std::vector<Point3> all = as_points(estimate.positions_m);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_near = (all[i] - middle).norm() < box_.size();
      far += is_near ? 0 : 1;
      if (is_near && std::ssize(all) - static_cast<Eigen::Index>(i) <= shown_steps())
        tube.points.push_back(all[i]);
    }
    if (far > 0)
      scene_.notes.push_back(
          {fmt::format("{}: {} far outside.", title,
                       far == 1 ? "1 estimated position is"
                                : fmt::format("{} estimated positions are", far)),
           ThemeColour::kWarning});
    if (tube.points.size() > 1) add(std::move(tube));
  }

  std::string rods_label() const {
    if (factor_ == 1.0) return "ground truth to estimated position";
    return fmt::format("ground truth to estimated position, {:g} \u00D7 as long", factor_);
  }

  /// To the estimates, which then stand where lengthened errors put them.
  Rods errors_of(const SpaceEstimate& estimate) const {
    Rods rods{.radius = 0.0035 * box_.size(), .style = {.colour = ThemeColour::kSeries2}};
    for (Eigen::Index n = 0; n < run_.landmarks_m.rows(); ++n) {
      const Point3 ground_truth = run_.landmarks_m.row(n).transpose();
      const Point3 error = estimate.landmarks_m.row(n).transpose() - ground_truth;
      if (!error.allFinite() || factor_ * error.norm() > box_.size()) continue;
      rods.from.push_back(ground_truth);
      rods.to.push_back(ground_truth + factor_ * error);
    }
    return rods;
  }

  void describe() {
    scene_.caption = fmt::format(
        "{} in space and a flight of {}, of which the last {} are drawn, from ranges alone ({}): "
        "rank 5 instead of 4. Paths as "
        "estimated; errors of landmarks {}.",
        counted(run_.landmarks_m.rows(), "landmark"), counted(run_.positions_m.rows(), "step"),
        shown_steps(), run_.noise,
        factor_ == 1.0 ? "drawn as long as they are"
                       : fmt::format("drawn {:g} times as long as they are", factor_));
    scene_.alt =
        fmt::format("{} at heights from {} to {} m", counted(run_.landmarks_m.rows(), "landmark"),
                    significant(run_.landmarks_m.col(2).minCoeff()),
                    significant(run_.landmarks_m.col(2).maxCoeff()));
    for (std::size_t i = 0; i < run_.records.size(); ++i) {
      const SpaceRecord& record = run_.records[i];
      scene_.alt += "; " + scene_.views[i].title + ": ";
      if (!record.landmarks_error_m || !record.positions_error_m)
        scene_.alt += "no map";
      else
        scene_.alt += fmt::format(
            "mean error {} m of landmarks, {} m of positions ({})",
            significant(*record.landmarks_error_m), significant(*record.positions_error_m),
            record.alignment == Alignment::kNone ? "not aligned"
                                                 : "after the best motion or mirror");
    }
    scene_.alt += ".";
  }

  const SpaceSceneSpec& spec_;
  const SpaceRun& run_;
  CloudBox box_;
  double factor_ = 1.0;
  bool has_estimate_ = false;  ///< Shown so far; the first stands in the legend.
  Scene scene_;
};

}  // namespace

bool has_space_scene(const SpaceRun& run) {
  constexpr double kFarthest_m = 1e8, kLeastSize = 1e-6;  // The size as a share of the distance.
  if (run.records.empty() || run.landmarks_m.rows() < 1 || run.positions_m.rows() < 2) return false;
  if (!run.landmarks_m.allFinite() || !run.positions_m.allFinite()) return false;
  const double farthest =
      std::max(run.landmarks_m.cwiseAbs().maxCoeff(), run.positions_m.cwiseAbs().maxCoeff());
  const CloudBox box(true_positions(run));
  return farthest <= kFarthest_m && box.size() > kLeastSize * std::max(farthest, 1.0);
}

Scene space_scene(const SpaceSceneSpec& spec) {
  require_usable(spec.run);
  return SpaceScene(spec).make();
}

}  // namespace mapproof
