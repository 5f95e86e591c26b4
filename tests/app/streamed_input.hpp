#pragma once

#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace mapproof::test {

/// Runs `COMMAND PIPE --incremental --json ...` while the bytes are written into the pipe, then
/// closed.
Outcome followed(const std::string& command, const TemporaryFolder& folder,
                 const std::string& bytes, const std::vector<std::string>& more);

}  // namespace mapproof::test
