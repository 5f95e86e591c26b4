#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/model/report.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

struct ResultsReportInput {
  const ResultsView& view;
  const std::vector<MethodComparison>& comparisons;  ///< compare_methods() of it.
  const StudyFigures& figures;                       ///< results_figures() of both, and maps.
  std::vector<Block> provenance;                     ///< Where the numbers come from.
  /// What came out, a sentence each, by whoever knows what the study asked; the report says them in
  /// place of what the comparisons came to.
  std::vector<std::string> conclusions = {};
  std::string compared_with = {};  ///< What the results are judged against; empty: each other.
  Highlights::Item headline = {};  ///< The first number of the first screen; no value: none.
  /// Ids of the figures that show this number: the first that is there is the first screen's.
  std::vector<std::string> headline_figures = {};
  std::string incomplete = {};     ///< What is still missing, a sentence; empty: nothing.
  std::vector<std::string> warnings = {};  ///< What is wrong with data or maps, a clause each.
  std::vector<std::string> remarks =
      {};                        ///< On the study's files beside the table, a sentence each.
  std::vector<Table> cost = {};  ///< What it took.
  /// Associated poses of each method over all runs, where the results are errors of paths.
  std::map<std::string, long long> poses = {};
  std::string footer = {};  ///< What made the records; empty: the page says what made it.
  std::string date = {};    ///< When the records were made, YYYY-MM-DD; empty: not known.
};

/// The provenance of results that another program made.
/// @param command  That writes the report again.
std::vector<Block> given_provenance(const ResultsView& view, const std::string& command);

/// The report of a study that is a table of results: what was asked and what came out, then one
/// section per block with its figures, tables and comparisons, the maps and paths, what it took,
/// and where the numbers come from.
Report results_report(const ResultsReportInput& input);

/// Its sections alone, for a report with others: ids begin with the study's name.
std::vector<Section> results_sections(const ResultsReportInput& input);

}  // namespace mapproof
