#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// "1 run", "25 runs".
std::string counted(long long count, std::string_view noun);

/// "a", "a and b", "a, b and c"; beyond `most` names: "a, b and 5 more".
std::string listed(const std::vector<std::string>& names, std::size_t most);

}  // namespace mapproof
