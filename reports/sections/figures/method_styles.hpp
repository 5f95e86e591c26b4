#pragma once

#include <cstddef>
#include <string>

#include "core/model/experiment.hpp"

namespace mapproof {

/// The style of a method's line, the same in all figures (see series_style). Methods of others have
/// first the colours that no method of mapproof has in the experiment, in its order.
std::size_t series_of_method(const Experiment& experiment, Method method);

/// label(), cut to what stands above a small panel: "SMACOF kNN, K = 7".
std::string short_label(const MethodSetting& setting);

}  // namespace mapproof
