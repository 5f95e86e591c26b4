#pragma once

#include <string>
#include <vector>

namespace mapproof {

/// `value` with so many significant digits, never in scientific notation below 1e6.
std::string significant(double value, int digits = 3);

/// "a", "a and b", "a, b and c"; beyond `most` names: "a, b and 5 more".
std::string listed(const std::vector<std::string>& names, std::size_t most);

/// "1 landmark", "2 landmarks".
std::string counted(std::size_t count, const std::string& noun);

/// A number for a data attribute: six significant digits, "." for the point.
std::string data_number(double value);

}  // namespace mapproof
