#pragma once

#include <map>
#include <string>

namespace mapproof::test {

/// The schemas of figures and scenes that the code makes, by the names of their files.
std::map<std::string, std::string> drawing_schemas();

}  // namespace mapproof::test
