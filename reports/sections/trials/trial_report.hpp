#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/trial_study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

struct TrialReportInput {
  const TrialStudy& study;
  std::span<const Session> sessions;
  const StudyFigures& figures;  ///< trial_figures() of it.
  std::string command;          ///< The one that makes this study and report again.
};

/// The whole report of a study of trials: what was asked and what came out, then a section a setup
/// with its figures and tables, the maps, and the provenance.
Report trial_report(const TrialReportInput& input);

/// Its sections alone, to stand in a report with others: ids begin with the study's name, titles
/// with its title.
std::vector<Section> trial_sections(const TrialReportInput& input);

}  // namespace mapproof
