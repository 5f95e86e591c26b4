#pragma once

#include <string>

namespace mapproof {

/// A field of comma-separated values [rfc4180]: in quotes if it holds a quote, a line's end, a
/// separator or comment sign of any kind that readers take, or spaces at an end.
std::string csv_field(const std::string& text);

/// Shortest text that reads back as the same double; empty if it is not finite.
std::string csv_number(double value);

}  // namespace mapproof
