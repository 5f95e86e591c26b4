#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "reports/diff/diff_result.hpp"

namespace mapproof {

/// The forms in which a comparison is handed out (docs/diff.md). All are deterministic.

/// Of which items it is told.
enum class DiffWords {
  kAll,       ///< Of those that are not identical.
  kFailures,  ///< Of those that do not pass; nothing at all if the whole passes.
};

/// One line per item, "worse  fig-7  cause", and one on the whole.
std::string diff_text(const DiffResult& result, DiffWords words = DiffWords::kAll);

/// docs/schemas/diff.schema.json.
nlohmann::ordered_json diff_json(const DiffResult& result);

/// JUnit XML: a test case an item; what does not pass is a failure, or an error if unreadable.
std::string diff_junit(const DiffResult& result);

/// A summary for a comment on a change: counts and a table of what differs, at most 50 rows.
std::string diff_markdown(const DiffResult& result);

/// Lines that CTest and CDash take from a test's output: how many items of each verdict, and the
/// pictures of the first ten that do not pass.
std::string ctest_lines(const DiffResult& result);

}  // namespace mapproof
