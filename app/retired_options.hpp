#pragma once

#include <span>

namespace mapproof {

/// @param words  Of the command line, behind the program's name.
/// @throws InvalidInput with the new name of the first retired option among them (see
///         core/base/retired_names.hpp).
void refuse_retired_options(std::span<char* const> words);

}  // namespace mapproof
