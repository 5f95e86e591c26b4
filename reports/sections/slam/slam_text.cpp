#include "reports/sections/slam/slam_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/model/slam/method_record.hpp"
#include "render/figures/curves/log_log.hpp"

namespace mapproof {
namespace {

std::string redrawn_words(const ConvergenceOptions& convergence) {
  return fmt::format(
      "worlds whose known landmarks lie nearly on a line or circle (condition number above {:g}) "
      "are drawn again",
      convergence.most_condition);
}

std::vector<const SlamDataSet*> missing_data(const SlamStudy& study) {
  std::vector<const SlamDataSet*> missing;
  for (const SlamDataSet& data : study.experiment.data)
    if (std::ranges::find(study.runs, data.id, &SlamRun::id) == study.runs.end())
      missing.push_back(&data);
  return missing;
}

/// The curve of the paper's own decomposition; null for other studies, and where it was not made.
const ConvergenceCurve* plain_svd_of(const SlamStudy& study) {
  if (!is_of_paper(study)) return nullptr;
  const auto found = std::ranges::find(study.convergence, "plain", &ConvergenceCurve::id);
  return found == study.convergence.end() ? nullptr : &*found;
}

}  // namespace

std::string record_id(const SlamRun& run, const SlamRecord& record) {
  return fmt::format("{}/{}", run.id, info(record.method).name);
}

const TrajectoryError* error_of(const SlamRun& run, SlamMethod method) {
  const SlamRecord* record = record_of(run, method);
  return record == nullptr || record->errors.empty() ? nullptr : &record->errors.front();
}

const SlamRecord* mapped_record(const SlamRun& run) {
  const auto has_map = [](const SlamRecord& record) {
    return record.estimate.landmarks_m.array().isFinite().any();
  };
  if (const SlamRecord* refined = record_of(run, SlamMethod::kRefined);
      refined != nullptr && has_map(*refined))
    return refined;
  const auto found = std::ranges::find_if(run.records, has_map);
  return found == run.records.end() ? nullptr : &*found;
}

bool is_of_paper(const SlamStudy& study) { return study.experiment.name == "boots2013"; }

std::vector<std::pair<std::string, std::string>> simulation_facts(
    const SlamExperiment& experiment) {
  std::vector<std::pair<std::string, std::string>> facts;
  const SlamWorldOptions& world = experiment.world;
  if (experiment.example || experiment.convergence || experiment.histories)
    facts = {
        {"Simulated area", fmt::format("{0:g} m \u00D7 {0:g} m", 2.0 * world.half_width_m)},
        {"Simulated landmarks", fmt::format("{}, {} of them known", world.landmarks, world.known)},
        {"Simulated walk",
         fmt::format("steps of {:g} m, the heading changes by {:g} rad (1 \u03C3) per step",
                     world.step_m, world.heading_change_sigma_rad)}};
  if (const auto& example = experiment.example)
    facts.emplace_back(
        "Example", fmt::format("{}, {}", counted(example->steps, "step"), example->noise.title));
  if (const auto& convergence = experiment.convergence)
    facts.emplace_back(
        "Convergence",
        fmt::format("{} of world and path, up to {}; {}", counted(convergence->pairs, "pair"),
                    counted(convergence->steps.back(), "step"), redrawn_words(*convergence)));
  if (const auto& histories = experiment.histories)
    facts.emplace_back("Mapping methods on ranges",
                       fmt::format("{}, {}, {}, K = {}", counted(histories->landmarks, "landmark"),
                                   counted(histories->steps, "step"), histories->noise.title,
                                   histories->neighbours));
  if (const auto& space = experiment.space)
    facts.emplace_back(
        "Flight in space",
        fmt::format("{0:g} m \u00D7 {0:g} m \u00D7 {1:g} m, {2} landmarks, {3} of them known, {4} "
                    "steps of {5:g} m, {6}",
                    2.0 * space->half_width_m, space->height_m, space->landmarks, space->known,
                    space->steps, space->step_m, space->noise.title));
  return facts;
}

std::vector<std::string> missing_titles(const SlamStudy& study) {
  std::vector<std::string> titles;
  for (const SlamDataSet* data : missing_data(study)) titles.push_back(data->title);
  return titles;
}

std::vector<std::string> missing_logs(const SlamStudy& study) {
  std::vector<std::string> sentences;
  for (const SlamDataSet* data : missing_data(study))
    sentences.push_back(data->title + " is missing. " + data->source);
  return sentences;
}

std::string title_of(const SlamRun& run) { return run.log.name.empty() ? run.id : run.log.name; }

std::string path_figure_id(const SlamRun& run) {
  return run.figure.empty() ? "path-" + run.id : run.figure;
}

std::optional<double> length_m(const RangeLog& log) {
  double length = 0.0;
  if (log.ground_truth) {
    const Points& path = log.ground_truth->positions_m;
    for (Eigen::Index i = 1; i < path.rows(); ++i)
      if (const double step = (path.row(i) - path.row(i - 1)).norm(); std::isfinite(step))
        length += step;
    return length;
  }
  if (log.odometry.empty()) return std::nullopt;
  for (const Motion& motion : log.odometry)
    length += std::hypot(motion.distance_m, motion.sideways_m);
  return length;
}

double convergence_slope(const ConvergenceCurve& curve) {
  std::vector<double> steps, errors;
  for (const ConvergencePoint& point : curve.points) {
    steps.push_back(point.steps);
    errors.push_back(point.observation.values > 0 ? point.observation.mean : kNaN);
  }
  return log_log_slope(steps, errors);
}

std::string slope_basis(const ConvergenceCurve& curve) {
  const auto means = std::ranges::count_if(
      curve.points, [](const ConvergencePoint& point) { return point.observation.values > 0; });
  return fmt::format("a line through {}", counted(means, "mean"));
}

std::string variant_words(const SlamStudy& study) {
  const ConvergenceCurve* plain_svd = plain_svd_of(study);
  if (plain_svd == nullptr) return "";
  std::string text =
      " The exactly known variance of the noise is taken off the factorised matrix, which the "
      "paper does not do";
  const double slope = convergence_slope(*plain_svd);
  if (std::isfinite(slope))
    text +=
        fmt::format("; its plain singular value decomposition gives {} here", slope_words(slope));
  text += ".";
  if (const auto& convergence = study.experiment.convergence)
    text += " Not all worlds count: " + redrawn_words(*convergence) + ".";
  return text;
}

std::string brief_variant_words(const SlamStudy& study) {
  const ConvergenceCurve* plain_svd = plain_svd_of(study);
  if (plain_svd == nullptr) return "";
  const double slope = convergence_slope(*plain_svd);
  if (!std::isfinite(slope)) return "";
  return fmt::format("; as in the paper, with the noise\u2019s variance left in, {}",
                     slope_words(slope));
}

}  // namespace mapproof
