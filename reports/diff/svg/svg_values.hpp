#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace mapproof {

/// Red, green and blue, 0 to 255, of "#abc", "#aabbcc", "rgb(1, 2, 3)", "rgb(10%, 20%, 30%)" or a
/// name of CSS; empty if it is none of them.
std::optional<std::array<double, 3>> css_colour(std::string_view text);

/// How two values of an attribute differ.
struct ValueDistance {
  bool is_number = false;  ///< Whether they differ in numbers alone.
  bool is_colour = false;
  double distance = 0.0;  ///< The largest difference of two numbers, or of 255 of two channels.
};

/// Compares two values of the attribute or property `name`: colours as colours in any notation,
/// path data command by command whatever is written shorter or relative, transforms as matrices,
/// others number by number. Equal values have distance 0 and are numbers.
ValueDistance value_distance(std::string_view name, std::string_view a, std::string_view b);

}  // namespace mapproof
