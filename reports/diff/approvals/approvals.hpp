#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// One file of the baseline that is replaced or removed.
struct ApprovalStep {
  std::filesystem::path from;  ///< File of the current; empty: the baseline's file is removed.
  std::filesystem::path file;  ///< Relative to the baseline.
};

/// What is to become the new baseline.
struct ApprovalRequest {
  std::vector<std::string> ids;  ///< The ids of items.
  bool all = false;              ///< Every item of either side.
  std::string key;               ///< Images become further baselines ID@KEY; [A-Za-z0-9._-]*.
  bool force = false;            ///< `all` may remove more than half of the baseline's files.
};

struct ApprovalPlan {
  std::vector<ApprovalStep> steps;
  std::vector<std::string> refused = {};  ///< With `all`: items that cannot be approved, and why.
  /// Relative to the baseline: files that apply() makes from the approved records.
  std::vector<std::filesystem::path> made = {};
};

/// The steps that make the items of the baseline those of the current, without the files that are
/// equal. An item has these files: a figure its records, ID.figure.json, ID.scene.json, SVG, PNG
/// and PDF; a table its formats; "records" the whole study with its timings. Records come before
/// the figures made from them. An item is approved whole or not at all. A file of the baseline is
/// removed only where the current has no file and no folder of that name.
/// @throws InvalidInput for sides that are not comparable (see require_comparable()), an id that is
///         on neither side, a key that cannot be part of a name, or if `all` would remove more than
///         half of the baseline without `force`. Without `all` also for a current file that cannot
///         be read, and for a figure whose records are of another experiment than the baseline's:
///         such records are approved only as a whole.
/// @throws IoError if the current does not exist, a folder cannot be listed, or the file with the
///         schema of its records cannot be read.
/// @note Reads each file of the items once or twice.
ApprovalPlan approval_plan(const std::filesystem::path& baseline,
                           const std::filesystem::path& current, const ApprovalRequest& request);

/// Why an item cannot be approved by itself.
struct ApprovalRefusal {
  std::string why;
  bool goes_with_records = false;  ///< It can be approved together with all records.
};

/// Which items are asked about.
struct ApprovalQuestion {
  std::vector<std::string> ids;
  std::set<std::filesystem::path> decoded;  ///< Files that need no reading: they can be read.
};

/// The items that cannot be approved by themselves; none if the current is not a folder.
/// @throws IoError if a folder cannot be listed.
/// @note Reads the items' files of the current, as approval_plan() does.
std::map<std::string, ApprovalRefusal> approval_refusals(const std::filesystem::path& baseline,
                                                         const std::filesystem::path& current,
                                                         const ApprovalQuestion& question);

/// Applies a plan in one step: after a kill at any moment the baseline is wholly the old one or
/// wholly the new one (see FolderReplacement). The caller holds its lock, if it exists. Where
/// records of a study are taken without its results.csv, that table is made again from the records.
/// @throws IoError, and leaves the old baseline; after the last step only for what was left of the
///         old one.
void apply(ApprovalPlan& plan, const std::filesystem::path& baseline);

/// Replaces a single baseline file by another file, in one step.
/// @throws InvalidInput if they are the same file or of two formats, or if the current is empty or
///         cannot be read; IoError if the baseline cannot be written.
void approve_file(const std::filesystem::path& baseline, const std::filesystem::path& current);

/// The ids in a file of approvals (docs/schemas/approvals.schema.json).
/// @throws IoError with file and JSON pointer.
std::vector<std::string> parse_approvals(std::string_view text, const std::string& source);

}  // namespace mapproof
