#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Calls `work` and returns its exit code. An exception becomes one line on standard error,
/// "mapproof: ", `of` and the message, and the exit code of its type.
/// @param of  A prefix that names the work.
int exit_code_of(const std::function<int()>& work, const std::string& of = "");

/// Reports why the program fails, in the line "mapproof: WHAT" on standard error.
/// @return The code; kInternal if memory ran out.
ExitCode report_failure(const std::string& what, ExitCode code);

/// Reports in such a line that no map was made of an input, and why.
/// @param input     As typed.
/// @param statuses  Of all methods that were to make the map.
/// @return kNo, as report_failure().
ExitCode report_no_map(const std::string& input, const std::vector<Status>& statuses);

}  // namespace mapproof
