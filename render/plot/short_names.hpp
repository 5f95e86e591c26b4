#pragma once

#include <string>

#include "render/theme/theme.hpp"

namespace mapproof {

/// A label with the short names of methods: "SMACOF kNN, K = 7".
std::string short_name(const std::string& label);

/// The label as it stands in a figure of the theme: in one of a column's width the long names of
/// methods are short, "SMACOF, kNN weights, K = 7" is "SMACOF kNN, K = 7".
std::string label_in(const Theme& theme, const std::string& label);

}  // namespace mapproof
