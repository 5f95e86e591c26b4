#pragma once

#include <string>
#include <vector>

#include "core/model/paths/space_path.hpp"
#include "core/results/results_study.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The ids of these groups begin with it.
std::string path_error_prefix(const ResultsStudy& study);

/// One group per run with errors of poses: paths coloured by error, errors over time and way,
/// distributions; methods in the order of the study.
std::vector<FigureGroup> path_error_figures(const ResultsStudy& study,
                                            const std::vector<PathErrors>& errors);

}  // namespace mapproof
