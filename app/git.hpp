#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/child_process.hpp"

namespace mapproof {

/// What git said.
struct GitAnswer : ProgramAnswer {
  /// The first line of its output, without its end.
  std::string line() const { return output.substr(0, output.find('\n')); }
  /// Whether git is not installed.
  bool is_missing() const;
};

/// Calls git in the current folder, without a shell. @param input  Its standard input.
/// @throws ProcessError, std::bad_alloc.
GitAnswer git(const std::vector<std::string>& words, std::string_view input = {});

}  // namespace mapproof
