#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// One file of the baseline to be replaced, or removed.
struct ApprovalStep {
  std::filesystem::path from;  ///< Of the current; empty: the baseline's file goes.
  std::filesystem::path file;  ///< Below the baseline.
};

/// What is to be taken as the new baseline.
struct ApprovalOrder {
  std::vector<std::string> ids;  ///< Of items.
  bool all = false;              ///< Every item of either side.
  std::string key;               ///< Pictures become further baselines ID@KEY; [A-Za-z0-9._-]*.
  bool force = false;            ///< `all` may remove more than half of the baseline's files.
};

struct ApprovalPlan {
  std::vector<ApprovalStep> steps;
  std::vector<std::string> refused = {};  ///< Items that cannot be taken, and why.
};

/// The files of two folders that belong to the items, those that are the same on both sides left
/// out: of a figure
/// its records, ID.figure.json, ID.scene.json, SVG, PNG and PDF; of a table its formats; of
/// "records" all of the study with its timings. Records come before what is drawn of them. Items
/// are taken whole or not at all: of all together those that cannot be are refused, else it throws.
/// A file of the baseline goes only where the current has nothing of its name, no folder either.
/// @throws InvalidInput for sides that are not comparable (see require_comparable()), an id that is
///         on neither side, a key that cannot be part of a name, a current file that cannot be read,
///         a figure whose records are of another experiment than the baseline's (these go as a
///         whole), or if `all` would remove more than half of the baseline without `force`.
/// @throws IoError if a folder cannot be listed.
ApprovalPlan approval_plan(const std::filesystem::path& baseline,
                           const std::filesystem::path& current, const ApprovalOrder& order);

/// Why an item cannot be approved by itself.
struct ApprovalRefusal {
  std::string why;
  bool goes_with_records = false;  ///< It can be, together with all records.
};

/// Those of the items that cannot be approved by themselves; none where the current is no folder.
/// @throws IoError if a folder cannot be listed.
/// @note Reads the items' files of the current, as approval_plan does.
std::map<std::string, ApprovalRefusal> approval_refusals(const std::filesystem::path& baseline,
                                                         const std::filesystem::path& current,
                                                         const std::vector<std::string>& ids);

/// Takes a plan's files in one step: after a kill at any moment the baseline is wholly the old one or
/// wholly the new one (see FolderReplacement). It should be locked if it is there.
/// @throws IoError: then it is the old one.
void apply(const ApprovalPlan& plan, const std::filesystem::path& baseline);

/// Takes a single file as the new baseline of another one, at once.
/// @throws InvalidInput if they are the same file, of two formats, or the current is empty or cannot
///         be read; IoError.
void approve_file(const std::filesystem::path& baseline, const std::filesystem::path& current);

/// The ids in a file of approvals (docs/schemas/approvals.schema.json).
/// @throws IoError with file and JSON pointer.
std::vector<std::string> parse_approvals(std::string_view text, const std::string& source);

}  // namespace mapproof
