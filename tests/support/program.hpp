#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {

/// How a start of the program ended.
struct Outcome {
  int exit_code = -1;  ///< -1: ended by a signal.
  std::string out;
  std::string error;
};

/// Limits put on the program before it starts.
struct Limits {
  std::size_t file_bytes =
      0;  ///< Largest file it may write; 0: no limit. Stands in for a full disk.
  std::size_t address_bytes = 0;  ///< Address space; 0: no limit. As batch systems set it.
};

/// Runs mapproof with these arguments, without a shell, and waits for it.
Outcome mapproof(const std::vector<std::string>& arguments, const Limits& limits = {});

/// The same for any program, found by its name: its name or path, then its arguments. 127: none.
Outcome run_program(const std::vector<std::string>& command, const Limits& limits = {});

/// The path of mapproof.
std::string program();

/// Starts mapproof and lets it run, its output thrown away; to be killed and waited for.
pid_t start_mapproof(const std::vector<std::string>& arguments);

/// Every file below a folder: its relative path and its bytes, sorted.
using Contents = std::vector<std::pair<std::string, std::string>>;
Contents contents(const std::filesystem::path& folder);

/// Expects the same files with the same bytes; says which differ, rather than printing them.
void expect_same(const Contents& first, const Contents& second);

}  // namespace mapproof::test
