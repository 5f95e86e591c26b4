#pragma once

#include <string>
#include <vector>

#include "reports/model/report.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_figures.hpp"

namespace mapproof {

struct ResultsReportInput {
  const ResultsView& view;
  const std::vector<MethodComparison>& comparisons;  ///< compare_methods() of it.
  const StudyFigures& figures;                       ///< results_figures() of both.
  std::string command;                               ///< That writes the report again.
};

/// The report of a study that is a table of results: what was asked and what came out, then one
/// section per block with its figures, tables and comparisons, and where the numbers come from.
Report results_report(const ResultsReportInput& input);

/// Its sections alone, to stand in a report with others: ids begin with the study's name, titles
/// with its title.
std::vector<Section> results_sections(const ResultsReportInput& input);

}  // namespace mapproof
