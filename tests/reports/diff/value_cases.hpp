#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/diff/verdict.hpp"

namespace mapproof::test {

/// A study in which one thing was changed, and what must be said of it.
struct ValueCase {
  std::string name;
  std::string id;  ///< Of the item that is looked at.
  Verdict verdict = Verdict::kIdentical;
  std::vector<std::string> cause;  ///< Parts of it.
  bool passes = false;
  /// Makes the changed study in a folder that is a copy of the baseline.
  std::function<void(const std::filesystem::path& folder)> change;
  bool alone = true;  ///< All other items must be identical.
};

/// Writes the study that all cases begin from.
void write_base_study(const std::filesystem::path& folder);

std::vector<ValueCase> record_cases();
std::vector<ValueCase> figure_cases();
std::vector<ValueCase> drawing_cases();
std::vector<ValueCase> file_cases();

}  // namespace mapproof::test
