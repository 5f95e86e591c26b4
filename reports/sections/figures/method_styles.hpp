#pragma once

#include <cstddef>
#include <string>

#include "core/model/experiment.hpp"

namespace mapproof {

/// The style of a method's line, the same in all figures (see series_style). Methods on a neighbour
/// graph, and those without one, differ in colour among themselves. Those of others come behind
/// mapproof's, in the order of the experiment.
std::size_t series_of_method(const Experiment& experiment, Method method);

/// label(), cut to what stands above a small panel: "SMACOF kNN, K = 7".
std::string short_label(const MethodSetting& setting);

}  // namespace mapproof
