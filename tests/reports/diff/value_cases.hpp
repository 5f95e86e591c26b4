#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "reports/diff/verdict/verdict.hpp"

namespace mapproof::test {

/// A study with one change, and the expected verdict.
struct ValueCase {
  std::string name;
  std::string id;  ///< Of the item that is checked.
  Verdict verdict = Verdict::kIdentical;
  std::vector<std::string> cause;  ///< Parts of it.
  bool passes = false;
  /// Makes the changed study in a folder that is a copy of the baseline.
  std::function<void(const std::filesystem::path& folder)> change;
  bool alone = true;  ///< All other items must be identical.
};

/// Writes the study that all cases begin from.
void write_base_study(const std::filesystem::path& folder);

struct SmallStudy;
/// Writes the records in a copy of that study again, and draws the figures that changed.
void write_changed(const SmallStudy& study, const std::filesystem::path& folder);

/// Tables, a report's page and a PDF, to stand beside it.
void write_base_documents(const std::filesystem::path& folder);
/// A range-only study with something in every field.
void write_base_slam_study(const std::filesystem::path& folder);

std::vector<ValueCase> record_cases();
std::vector<ValueCase> field_cases();     ///< Single values of the records' files.
std::vector<ValueCase> slam_cases();      ///< Of the range-only study.
std::vector<ValueCase> document_cases();  ///< With the documents beside the study.
std::vector<ValueCase> figure_cases();
std::vector<ValueCase> drawing_cases();
std::vector<ValueCase> file_cases();

}  // namespace mapproof::test
