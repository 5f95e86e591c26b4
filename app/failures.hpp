#pragma once

#include <functional>
#include <string>

namespace mapproof {

/// Does the work and gives its exit code. What it throws becomes one line on standard error that
/// begins with "mapproof: ", and the exit code is that of the failure.
/// @param of  What stands before the words: whose work it is.
int exit_code_of(const std::function<int()>& work, const std::string& of = "");

}  // namespace mapproof
