#pragma once

#include <map>
#include <string>

namespace mapproof::test {

/// The schemas of comparisons, their settings and approvals, and of nightly runs, that the code
/// makes, by the names of their files.
std::map<std::string, std::string> comparison_schemas();

}  // namespace mapproof::test
