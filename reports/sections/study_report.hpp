#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/model/study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

struct StudyReportInput {
  const Study& study;
  std::span<const Session> sessions;
  std::span<const Timing> timings;
  const StudyFigures& figures;
  std::string command;  ///< The one that makes this study and report again, ready to be typed.
};

/// What is still to be run, a sentence; empty: nothing.
std::string mapping_incomplete(const Study& study);

/// The whole report of a study: summary, accuracy, figures, variations, warnings, provenance.
Report study_report(const StudyReportInput& input);

/// Its parts, each a pure function of the records.
Section summary_section(const Study& study);
Section accuracy_section(const Study& study, const SensorStudy& sensor);
Section figures_section(const FigureGroup& group);
/// Empty if the experiment has none.
std::optional<Section> variations_section(const Study& study);
Section statuses_section(const Study& study);

}  // namespace mapproof
