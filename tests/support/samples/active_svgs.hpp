#pragma once

#include <map>
#include <string>

namespace mapproof::test {

/// SVG files that run or load something, by what each does. Each is well-formed.
std::map<std::string, std::string> active_svgs();

/// SVG files that look like those and are inert, as other programs write them.
std::map<std::string, std::string> inert_svgs();

}  // namespace mapproof::test
