#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mapproof::test {

/// A command whose allocations are made to fail.
struct MemoryCase {
  std::string name;
  /// Writes the input of the command into an empty folder.
  std::function<void(const std::filesystem::path& folder)> prepare;
  /// The arguments; all outputs go below the folder, too.
  std::function<std::vector<std::string>(const std::string& folder)> command;
  int exit_code = 0;  ///< Without faults.
};

const std::vector<MemoryCase>& memory_cases();

/// Makes one allocation of at least 64 KiB fail per run, on one core and on two: each of them in
/// turn, or `at_most` of them at equal distances. Each run must end with exit code 3 and one line
/// that reports it, or as without the fault. All files that it leaves are whole, and the next run
/// writes the same bytes as without the fault.
void expect_memory_faults_reported(const MemoryCase& tried, long at_most);

}  // namespace mapproof::test
