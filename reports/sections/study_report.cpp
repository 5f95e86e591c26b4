#include "reports/sections/study_report.hpp"

#include <iterator>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/proofs.hpp"

namespace mapproof {
namespace {

std::string subtitle(const Study& study) {
  const Experiment& experiment = study.experiment;
  return fmt::format("Experiment {}, seed {}: {}, {}, room of {:g} m", experiment.name,
                     experiment.seed, counted(std::ssize(study.runs), "simulated run"),
                     counted(experiment.world.landmarks, "landmark"), experiment.world.side_m);
}

}  // namespace

Report study_report(const StudyReportInput& input) {
  const Experiment& experiment = input.study.experiment;
  Report report;
  report.title = experiment.title.empty() ? experiment.name : experiment.title;
  report.subtitle = subtitle(input.study);
  report.sections.push_back(summary_section(input.study));
  for (const SensorStudy& sensor : experiment.sensors)
    report.sections.push_back(accuracy_section(input.study, sensor));
  for (const FigureGroup& group : input.figures.groups)
    report.sections.push_back(figures_section(group));
  if (auto variations = variations_section(input.study))
    report.sections.push_back(*std::move(variations));
  report.sections.push_back(statuses_section(input.study));
  if (auto proofs = proofs_section(input.study)) report.sections.push_back(*std::move(proofs));
  report.sections.push_back(
      provenance_section(input.study, input.sessions, input.timings, input.command));
  report.opening = study_opening(input.study, input.figures);
  report.footer = fmt::format("Made by mapproof {} ({}).", input.study.provenance.version,
                              input.study.provenance.commit);
  return report;
}

}  // namespace mapproof
