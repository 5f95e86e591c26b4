#include "reports/sections/slam/slam_summary.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "render/figures/curves/log_log.hpp"
#include "render/figures/curves/refinement_starts.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/figures/words.hpp"
#include "reports/sections/slam/slam_text.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

std::string metres_of(double value) { return significant(value, 2) + " m"; }

/// ".58 m for spectral, 4-D (rigid)"; empty if the method has no error.
std::string error_words_of(const SlamRun& run, SlamMethod method) {
  const TrajectoryError* error = error_of(run, method);
  if (error == nullptr || !std::isfinite(error->mean_m)) return "";
  return fmt::format("{} for {} ({})", metres_of(error->mean_m), info(method).label,
                     alignment_words(error->alignment));
}

/// The mean errors that a reader wants first.
std::string error_sentence_of(const SlamRun& run) {
  std::vector<std::string> parts;
  for (const SlamMethod method : {SlamMethod::kRefined, SlamMethod::kSpectral,
                                  SlamMethod::kSpectralKnown, SlamMethod::kDeadReckoning})
    if (std::string text = error_words_of(run, method); !text.empty())
      parts.push_back(std::move(text));
  return parts.empty() ? "" : listed(parts, 6);
}

/// The scale error of the ranges, where the refinement determined it.
std::string scale_words(const SlamRun& run) {
  const SlamRecord* refined = record_of(run, SlamMethod::kRefined);
  if (refined == nullptr || refined->estimate.range_scale == 1.0) return "";
  const double percent = 100.0 * (refined->estimate.range_scale - 1.0);
  return fmt::format(
      " Its ranges are {} % too {}, as the refinement estimates from odometry and ranges alone.",
      significant(std::abs(percent), 2), percent > 0.0 ? "long" : "short");
}

std::string start_words(const SlamRun& run) {
  std::vector<std::string> parts;
  for (const auto& [method, where] :
       {std::pair{SlamMethod::kRefined, "the spectral answer"},
        std::pair{SlamMethod::kRefinedFromOdometry, "dead reckoning"},
        std::pair{SlamMethod::kRefinedFromRandom, "random landmarks"}})
    if (const StartCount count = starts_at_optimum(run.starts, method); count.of > 0)
      parts.push_back(fmt::format("{} of {} from {}", count.reached, count.of, where));
  if (parts.empty()) return "";
  return " Starts of the refinement that end within 1 % of the least cost: " + listed(parts, 3) +
         ".";
}

void add_run(const SlamRun& run, BulletList& findings, Highlights& highlights) {
  const std::string errors = error_sentence_of(run);
  std::string text = errors.empty()
                         ? fmt::format(": {} mapped, no error claimed, there being no true path.",
                                       counted(std::ssize(run.log.landmarks), "landmark"))
                         : ": mean position error " + errors + ".";
  findings.items.push_back(
      {{strong(title_of(run)), phrase(text + scale_words(run) + start_words(run))}});
  for (const SlamMethod method : {SlamMethod::kRefined, SlamMethod::kSpectral}) {
    const TrajectoryError* error = error_of(run, method);
    if (error == nullptr || run.simulated) continue;
    highlights.items.push_back(
        {fmt::format("{}, {}", title_of(run), info(method).label), metres_of(error->mean_m),
         fmt::format("mean position error, {}", alignment_words(error->alignment))});
  }
}

/// The errors of landmarks and positions with the most measurements.
std::string end_words(const ConvergenceCurve& curve) {
  const ConvergencePoint& last = curve.points.back();
  if (last.landmarks_m.values == 0) return "";
  std::string text = fmt::format(" After {} steps the mean error of landmarks is {}", last.steps,
                                 metres_of(last.landmarks_m.mean));
  if (last.positions_m.values > 0)
    text += fmt::format(
        ", single positions of the robot, which have no more measurements than at the start, {}",
        metres_of(last.positions_m.mean));
  return text + ".";
}

void add_convergence(const SlamStudy& study, BulletList& findings, Highlights& highlights) {
  if (study.convergence.empty()) return;
  const ConvergenceCurve& curve = study.convergence.front();
  const double slope = convergence_slope(curve);
  if (!std::isfinite(slope)) return;
  const std::string text = slope_words(slope);
  highlights.items.push_back(
      {"Convergence of \u0108, slope", text, "theory: \u22121/2 in the logarithms"});
  findings.items.push_back(
      {{strong("Convergence"),
        phrase(fmt::format(": the error of the observation model changes as the number of "
                           "measurements to the power {} ({}); theory predicts \u22121/2.{}{}",
                           text, curve.title, variant_words(study), end_words(curve)))}});
}

void add_remarks_on_paper(BulletList& findings) {
  findings.items.push_back(
      {{strong("The paper\u2019s numbers"),
        phrase(
            ": its text prints no errors; it refers to its technical report for them. So there is "
            "nothing to compare ours with. Fig. 2A is a photograph of the robot: left out.")}});
}

}  // namespace

Section slam_summary_section(const SlamStudy& study) {
  Section section{"slam-summary", "Range-only SLAM: summary", {}};
  for (const std::string& missing : study.missing)
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Data missing", Paragraph{{{missing, Emphasis::kData}}}});
  BulletList findings;
  Highlights highlights;
  for (const SlamRun& run : study.runs)
    if (!run.simulated) add_run(run, findings, highlights);
  add_convergence(study, findings, highlights);
  for (const SlamRun& run : study.runs)
    if (run.simulated) add_run(run, findings, highlights);
  if (is_of_paper(study)) add_remarks_on_paper(findings);
  section.blocks.emplace_back(plain(
      "Path of a robot and positions of landmarks from ranges, and odometry where there is any. "
      "Squared ranges factor into landmarks and positions; least squares refines both."));
  if (!highlights.items.empty()) section.blocks.emplace_back(std::move(highlights));
  section.blocks.emplace_back(std::move(findings));
  return section;
}

}  // namespace mapproof
