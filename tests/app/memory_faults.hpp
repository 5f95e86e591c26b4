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
  long first = 1, stride = 1;  ///< Which allocations are a fair sample.
};

const std::vector<MemoryCase>& memory_cases();

/// Lets allocations of at least 64 KiB fail, the `first`, and then every `stride`-th, each in a run
/// of its own, on one thread and on two. Each run must end with exit code 3 and one line that says
/// so, or as if nothing had happened; all files it leaves are whole; the next run's bytes are as
/// ever.
void expect_memory_faults_told(const MemoryCase& tried, long first, long stride);

}  // namespace mapproof::test
