#pragma once

#include <string>
#include <string_view>

namespace mapproof::test {

/// The bytes as a gzip file.
std::string gzipped(std::string_view bytes);

/// The bytes as an xz file.
std::string xzipped(std::string_view bytes);

}  // namespace mapproof::test
