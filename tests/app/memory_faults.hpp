#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mapproof::test {

/// A command whose allocations are made to fail.
struct MemoryCase {
  std::string name;
  /// Makes what the command reads, below an empty folder.
  std::function<void(const std::filesystem::path& folder)> prepare;
  /// With the folder; its outputs go below it too.
  std::function<std::vector<std::string>(const std::string& folder)> command;
  int exit_code = 0;  ///< Without faults.
};

const std::vector<MemoryCase>& memory_cases();

/// Lets one allocation of at least 64 KiB fail in a run, on one thread and on two: every one of them,
/// or `at_most` that lie evenly among them. Each run must end with exit code 3 and one line that says
/// so, or as if nothing had happened; all files it leaves are whole; the next run's bytes are as
/// ever.
void expect_memory_faults_told(const MemoryCase& tried, long at_most);

}  // namespace mapproof::test
