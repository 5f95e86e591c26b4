#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "reports/diff/diff_result.hpp"

namespace mapproof {

/// The output formats of a comparison (docs/diff.md). All are deterministic.

/// The items that are listed.
enum class DiffWords {
  kAll,       ///< Those that are not identical.
  kFailures,  ///< Those that do not pass; the output is empty if the whole passes.
};

/// One line per item, "worse  fig-7  cause", and one for the whole.
std::string diff_text(const DiffResult& result, DiffWords words = DiffWords::kAll);

/// docs/schemas/diff.schema.json.
nlohmann::ordered_json diff_json(const DiffResult& result);

/// JUnit XML with one test case per item. An item that does not pass is a failure, or an error if
/// it is unreadable.
std::string diff_junit(const DiffResult& result);

/// A summary for a comment on a change: counts and a table of the differing items, at most 50 rows.
std::string diff_markdown(const DiffResult& result);

/// Lines that CTest and CDash read from a test's output: the number of items of each verdict, and
/// the images of the first ten items that do not pass.
std::string ctest_lines(const DiffResult& result);

}  // namespace mapproof
