#pragma once

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

}  // namespace mapproof
