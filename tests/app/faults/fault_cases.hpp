#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof::test {

/// A command whose calls are made to fail, or at whose calls it is killed
/// (tests/support/faults.cpp).
struct FaultCase {
  std::string name;
  /// Writes the input of the command into an empty folder.
  std::function<void(const std::filesystem::path& folder)> prepare;
  /// The arguments; all outputs go below the folder, too.
  std::function<std::vector<std::string>(const std::string& folder)> command;
  int exit_code = 0;  ///< Without faults.
  /// Whether a file, below the folder, holds seconds or dates: its bytes do not repeat.
  std::function<bool(std::string_view file)> varies = [](std::string_view) { return false; };
  /// What else has to hold after a run, with a fault or without.
  std::function<void(const std::filesystem::path& folder)> check =
      [](const std::filesystem::path&) {};
  /// How many calls of a kind a sweep tries; of a short command all.
  long samples = std::numeric_limits<long>::max();
};

inline std::ostream& operator<<(std::ostream& out, const FaultCase& one) { return out << one.name; }

/// run, merge, reproduce, report, render, diff, approve, check, nightly, map, slam.
const std::vector<FaultCase>& fault_cases();

/// Those whose next run goes on from what a kill left, or removes it: run, report, approve,
/// nightly.
std::vector<FaultCase> kill_cases();

/// The kinds of calls that are made to fail.
inline const std::vector<std::string> kFaultKinds = {"alloc", "open", "write", "fsync", "rename",
                                                     "close", "mmap", "fork",  "exec",  "thread"};

/// Makes one call of a kind fail per run: each of them in turn, or `at_most` of them at equal
/// distances. Each run must end with exit code 2 or 3 and one line that
/// reports it (3 and "out of memory", of "alloc" and "mmap"; 3 and what to do, of "thread"), or as
/// without the fault. All files that it leaves are those of before or whole, and the next run writes the same bytes as without
/// the fault.
/// @param cores  As taskset has them: on one core there is one thread.
void expect_faults_reported(const FaultCase& tried, const std::string& kind, long at_most,
                            const std::string& cores = "0,1");

/// The same of kills: all files that are left are those of before or whole, leftovers apart, which
/// the next run removes.
void expect_kills_survived(const FaultCase& tried, const std::string& kind, long at_most);

/// Kills at so many random moments, drawn from `seed`.
void expect_random_kills_survived(const FaultCase& tried, int times, unsigned seed);

}  // namespace mapproof::test
