#pragma once

#include <string>
#include <vector>

#include "core/model/study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The opening of a study's report: the best method of each sensor compared with the paper's value,
/// how the maps ended, and a figure of each kind.
Opening study_opening(const Study& study, const StudyFigures& figures);

/// Those of the ids that are among the figures and scenes, each once, the first `most`.
std::vector<std::string> present_ids(const std::vector<std::string>& ids,
                                     const StudyFigures& figures, std::size_t most);

}  // namespace mapproof
