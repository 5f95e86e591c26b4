#pragma once

#include <string>

namespace mapproof {

/// What stands in a command for a folder that is not to be named: "…/plaza".
inline constexpr const char* kUnshownFolder = "…/";

/// A word as a POSIX shell takes it: in quotes where it needs them; "~/" and kUnshownFolder stay in
/// front of them.
std::string shell_word(const std::string& word);

}  // namespace mapproof
