#pragma once

#include <string>

namespace mapproof {

/// A word as a POSIX shell takes it: in quotes where it needs them; "~/" stays in front of them.
std::string shell_word(const std::string& word);

}  // namespace mapproof
