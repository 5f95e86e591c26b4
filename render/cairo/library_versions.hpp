#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mapproof {

/// Name and version of the libraries that draw, as linked at run time.
std::vector<std::pair<std::string, std::string>> render_library_versions();

}  // namespace mapproof
