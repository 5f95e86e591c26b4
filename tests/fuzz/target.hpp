#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof::fuzz {

/// A reader that is given any bytes. Of what it throws, IoError and InvalidInput are answers;
/// anything else, a signal, more memory than stated and a property that fails are findings.
struct Target {
  std::string name;  ///< Of its corpus too: tests/fuzz/corpus/NAME.
  std::function<void(std::string_view bytes)> run;
  /// Files and folders below tests/data to start with, besides the corpus.
  std::vector<std::string> seeds = {};
  /// The most memory at once: this many bytes, and so many for each byte of the input.
  std::size_t memory = std::size_t{32} << 20;
  std::size_t memory_per_byte = 64;
};

/// Makes a target known to the program that its source is linked into.
struct Added {
  explicit Added(Target target);
};

/// All, in the order of their names.
const std::vector<Target>& targets();

/// Runs a target on an input. @throws what is a finding and was thrown; ends the process with a
/// message at any other finding.
void run(const Target& target, std::string_view bytes);

}  // namespace mapproof::fuzz
