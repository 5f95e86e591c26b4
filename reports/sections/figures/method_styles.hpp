#pragma once

#include <cstddef>
#include <string>

#include "core/model/method.hpp"

namespace mapproof {

/// The style of a method's line, the same in all figures (see series_style). Methods on a neighbour
/// graph, and those without one, differ in colour among themselves.
std::size_t series_of_method(Method method);

/// label(), cut to what stands above a small panel: "SMACOF kNN, K = 7".
std::string short_label(const MethodSetting& setting);

}  // namespace mapproof
