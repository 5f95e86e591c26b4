#pragma once

#include <string>
#include <vector>

#include "core/model/fit.hpp"
#include "render/plot/figure.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

inline constexpr const char* kFitSection = "fit";
inline constexpr const char* kFitTitle = "Do the data fit the map?";  ///< Of that section.

/// The figure of all tests of a fit; its verdict stands under the title.
Figure fit_figure(const Fit& fit, const std::string& id, std::vector<std::string> record_ids);

/// Whether the data fit the map, and on how many tests that rests, for the first screen; its link
/// leads to the section kFitSection.
Highlights::Item fit_number(const Fit& fit);

/// The section at the head of a report of a map: the verdict in words, its causes, what is open or
/// missing, the figures, and the least effects that would have been seen.
/// @param figures  That show the fit, the one of its tests first.
/// @param id       Of the section, and a prefix of its table's.
/// @param verdict  In words, with what the fit does not show; empty: verdict_text() of the fit.
Section fit_section(const Fit& fit, const std::vector<FigureBlock>& figures,
                    const std::string& id = kFitSection, const std::string& title = kFitTitle,
                    const std::string& verdict = {});

}  // namespace mapproof
