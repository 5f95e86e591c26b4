#pragma once

#include <filesystem>

#include "reports/diff/approvals/approval_files.hpp"

namespace mapproof {

/// One side of an approval.
struct ApprovalSide {
  std::filesystem::path root;
  ApprovalFiles files = {};  ///< Of approval_files(root).
};

/// Requires that the current can replace the baseline: neither lies in the other, the current holds
/// something, and both hold the same kind of records, or both figures and images without records.
/// A baseline that holds nothing yet can be replaced by any current.
/// @throws InvalidInput with the reason; IoError if records cannot be read.
void require_comparable(const ApprovalSide& baseline, const ApprovalSide& current);

/// The same for two single files, which must have one format. @throws InvalidInput.
void require_comparable_files(const std::filesystem::path& baseline,
                              const std::filesystem::path& current);

}  // namespace mapproof
