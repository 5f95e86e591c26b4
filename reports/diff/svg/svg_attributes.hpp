#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// Numbers and the words that say what they are: of path data a capital letter a command.
struct NumbersAndWords {
  std::string words;
  std::vector<double> numbers;
};

/// Reads a finite number as SVG writes it at the start of `text`. @return Its length, 0 if none.
std::size_t read_number(std::string_view text, double& number);

/// Path data with every command written out and absolute. Empty if it breaks SVG's grammar.
std::optional<NumbersAndWords> path_numbers(std::string_view data);

/// The six numbers of the matrix that a list of transforms comes to. Empty if it is none.
std::optional<NumbersAndWords> matrix_numbers(std::string_view transforms);

/// How two transforms differ.
struct TransformDistance {
  double shift = 0.0;   ///< User units, by which the origin is placed elsewhere.
  double linear = 0.0;  ///< The largest difference of the four numbers that turn and scale.
};

/// Empty if one is not a list of transforms; no text is the identity.
std::optional<TransformDistance> transform_distance(std::string_view a, std::string_view b);

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
