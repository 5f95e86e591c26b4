#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/model/study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// As many figures an opening names: a page shows a few of them small.
inline constexpr std::size_t kMostCandidates = 18;

/// The opening of a study's report: published errors inside our intervals, published orderings,
/// the best method of each sensor, how the maps ended, and a figure of each kind.
Opening study_opening(const Study& study, const StudyFigures& figures);

/// In what a study of Yairi's paper is smaller than the paper's, each a sentence; empty if in
/// nothing, and for other studies.
std::string smaller_than_paper(const Experiment& experiment);

/// The first ids of all lists, then the second ones, and so on.
std::vector<std::string> in_turns(const std::vector<std::vector<std::string>>& lists);

/// Those of the ids that are among the figures and scenes, each once, the first `most`.
std::vector<std::string> present_ids(const std::vector<std::string>& ids,
                                     const StudyFigures& figures, std::size_t most);

/// Makes one of the ids that are there the opening's figure, the others its small figures.
/// @param evidence  Of figures that show the opening's first number: the first that is there is the
///                  opening's, whatever it found. Else it is the first of `ids` that found
///                  something.
void choose_figures(const std::vector<std::string>& ids, const StudyFigures& figures,
                    Opening& opening, const std::vector<std::string>& evidence = {});

/// The day that it is, YYYY-MM-DD in UTC.
std::string today_utc();

/// The day of the last session, YYYY-MM-DD in UTC; empty without sessions.
std::string date_of(std::span<const Session> sessions);

}  // namespace mapproof
