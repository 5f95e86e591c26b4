#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// A text as a literal of Python on one line; matplotlib takes no "$" in it for mathematics.
std::string python_text(std::string_view text);
/// Numbers as they read back; NaN and infinities by their names in the script: nan, inf.
std::string python_number(double value);
/// "[1, 2, ...]" in lines of at most 96 characters, those after the first indented by four.
std::string python_list(const std::vector<double>& values);
std::string python_list(const std::vector<std::string>& texts);

}  // namespace mapproof
