#pragma once

#include <span>
#include <string_view>

namespace mapproof {

/// An option that has another name now.
struct RetiredOption {
  std::string_view name;  ///< "--kind".
  std::string_view now;   ///< "--sensor".
};

std::span<const RetiredOption> retired_options();

/// @param words  Of the command line, behind the program's name.
/// @throws InvalidInput with the new name of the first retired option among them.
void refuse_retired_options(std::span<char* const> words);

}  // namespace mapproof
