#pragma once

#include <cstddef>
#include <string>
#include <utility>

namespace mapproof {

/// Two texts that differ, each printable and cut to `most` characters so that the excerpts differ
/// too. Long texts begin, after "… ", shortly before their first difference.
std::pair<std::string, std::string> excerpts(const std::string& a, const std::string& b,
                                             std::size_t most);

}  // namespace mapproof
