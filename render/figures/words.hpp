#pragma once

#include <string>

#include "core/base/words.hpp"

namespace mapproof {

/// `value` with so many significant digits, never in scientific notation below 1e6.
std::string significant(double value, int digits = 3);

/// A number for a data attribute: six significant digits, "." for the point.
std::string data_number(double value);

}  // namespace mapproof
