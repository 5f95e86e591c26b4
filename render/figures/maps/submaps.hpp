#pragma once

#include <string>
#include <vector>

#include "core/model/submaps.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Sub-maps as they were joined: the hull of each in a colour of its own, the joined landmarks, and
/// a line from each to every position that a sub-map gives it: the residuals of the joins.
///
/// @param names  Of all M landmarks. @throws InvalidInput if there are not as many as positions.
Figure submaps_figure(const JoinedSubmaps& joined, const std::vector<std::string>& names,
                      const std::string& id);

}  // namespace mapproof
