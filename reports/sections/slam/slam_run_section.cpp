#include "reports/sections/slam/slam_run_section.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "render/figures/curves/log_log.hpp"
#include "reports/sections/slam/slam_figures.hpp"
#include "reports/sections/slam/slam_tables.hpp"
#include "reports/sections/slam/slam_text.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

using RunList = std::vector<const SlamRun*>;

RunList runs_of(const SlamStudy& study, bool simulated) {
  RunList runs;
  for (const SlamRun& run : study.runs)
    if (run.simulated == simulated) runs.push_back(&run);
  return runs;
}

/// What the reader of the log did or noticed.
void add_remarks(const SlamRun& run, Section& section) {
  if (run.log.remarks.empty()) return;
  section.blocks.emplace_back(plain("When the log was read:"));
  BulletList remarks;
  for (const std::string& remark : run.log.remarks)
    remarks.items.push_back({{{remark, Emphasis::kData}}});
  section.blocks.emplace_back(std::move(remarks));
}

/// The first figure in full width, the others side by side.
Section section_of(const FigureGroup* figures, std::string id, std::string title) {
  if (figures == nullptr) return {std::move(id), std::move(title), {}};
  Section section{figures->id, figures->title, {plain(figures->words)}};
  section.blocks.emplace_back(figure_block(figures->figures.front()));
  Gallery others = gallery_of(*figures, 1);
  if (!others.figures.empty()) section.blocks.emplace_back(std::move(others));
  return section;
}

/// Eq. 5 and what the paper's text reads off it.
Paragraph bound_words(const ConvergenceCurve& curve) {
  std::vector<double> steps, sines;
  for (const ConvergencePoint& point : curve.points) {
    steps.push_back(point.steps);
    sines.push_back(point.sine.values > 0 ? point.sine.mean : kNaN);
  }
  return plain(fmt::format(
      "Eq. 5 bounds the sine of the largest canonical angle between the learned subspace and the "
      "true one by N c \u221A(2 log T / T) / \u03B3. The text of the paper concludes a sample "
      "complexity of \u00D5(\u03B6\u00B2) for an error \u03B6, which would ask for fewer "
      "measurements the smaller the error: a misprint. Solved for T, the bound gives "
      "\u00D5(1/\u03B6\u00B2). "
      "The measured sine changes as the number of measurements to the power {}.",
      slope_words(log_log_slope(steps, sines))));
}

}  // namespace

std::optional<Section> slam_accuracy_section(const SlamStudy& study) {
  const RunList runs = runs_of(study, false);
  if (runs.empty()) return std::nullopt;
  Section section{"slam-accuracy", "Range-only SLAM: methods", {}};
  section.blocks.emplace_back(slam_drive_table(runs));
  Table errors = is_of_paper(study)
                     ? slam_error_table("table-plaza", "Methods on the Plaza data sets", runs)
                     : slam_error_table("slam-errors", "Methods", runs);
  if (is_of_paper(study))
    errors.notes.emplace_back(
        "Published: the paper\u2019s text prints no errors of these methods, so no column holds "
        "any.");
  section.blocks.emplace_back(std::move(errors));
  if (auto alignments = slam_alignment_table(runs))
    section.blocks.emplace_back(*std::move(alignments));
  return section;
}

Section slam_run_section(const SlamRun& run, const FigureGroup* figures) {
  Section section = section_of(figures, slam_run_group(run), "Range-only SLAM: " + title_of(run));
  if (run.windows)
    section.blocks.emplace_back(plain(fmt::format(
        "Ranges come one at a time: windows of {:.3g} s bring them to common times. Of the lengths "
        "that "
        "give ranges at the most times it is the one that best predicts ranges held out, without "
        "the ground truth.",
        run.windows->chosen_s)));
  if (auto landmarks = slam_landmark_table(run)) section.blocks.emplace_back(*std::move(landmarks));
  add_remarks(run, section);
  return section;
}

std::optional<Section> slam_simulation_section(const SlamStudy& study, const FigureGroup* figures) {
  const RunList runs = runs_of(study, true);
  if (runs.empty() && study.convergence.empty()) return std::nullopt;
  Section section = section_of(figures, kSlamSimulation, "Range-only SLAM: simulation");
  if (!study.convergence.empty() && is_of_paper(study)) {
    section.blocks.emplace_back(plain(
        "The paper gives neither the noise nor the size of the area of its Fig. 1: those used "
        "here are choices of the experiment, listed under provenance."));
    section.blocks.emplace_back(bound_words(study.convergence.front()));
  }
  if (!runs.empty())
    section.blocks.emplace_back(
        slam_error_table("slam-errors-simulation", "Methods on the simulated example", runs));
  if (!study.convergence.empty())
    section.blocks.emplace_back(slam_convergence_table(study.convergence));
  for (const SlamRun* run : runs) add_remarks(*run, section);
  return section;
}

}  // namespace mapproof
