#pragma once

#include <map>
#include <string>

namespace mapproof::test {

/// The schemas of core's files that the code makes, by the names of their own files.
std::map<std::string, std::string> file_schemas();

}  // namespace mapproof::test
