#pragma once

#include "reports/model/report.hpp"
#include "reports/sections/results/results_report.hpp"

namespace mapproof {

/// The first screen of a report of results: the question, what came out, what is wrong, the best
/// values, and the figures that a reader wants to open.
Opening results_opening(const ResultsReportInput& input);

}  // namespace mapproof
