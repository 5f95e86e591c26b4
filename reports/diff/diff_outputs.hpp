#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/item_images.hpp"

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
/// @param links  Images, named as attachments: [[ATTACHMENT|path]] on a line of its own, as Jenkins
///               and GitLab read it. The first of an item is the one that GitLab shows.
std::string diff_junit(const DiffResult& result, const ImageLinks& links = {});

/// A summary for a comment on a change: counts and a table of the differing items, at most 50 rows.
/// @param links  Images, shown for the first ten items that do not pass; the prefix is a URL, or a
///               path that is relative to the page.
std::string diff_markdown(const DiffResult& result, const ImageLinks& links = {});

/// Lines that GitHub Actions turns into annotations of a change: an error for each item that does
/// not pass, ten lines at most, as GitHub shows no more of one step.
/// @param folder  The baseline in the repository: errors stand at its files.
std::string github_lines(const DiffResult& result, const std::string& folder);

/// Lines that CTest and CDash read from a test's output: the number of items of each verdict, and
/// the images of the first ten items that do not pass.
/// @param keeps_baseline  The baseline's files stay after the program's end.
std::string ctest_lines(const DiffResult& result, bool keeps_baseline);

}  // namespace mapproof
