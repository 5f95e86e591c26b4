#pragma once

#include <filesystem>

#include "reports/diff/approval_files.hpp"

namespace mapproof {

/// One side of an approval.
struct ApprovalSide {
  std::filesystem::path root;
  ApprovalFiles files = {};  ///< None of a single file.
};

/// Whether files of the current can take the place of the baseline's at all: the two are apart, the
/// current holds something, and both hold the same kind of records, or both figures and pictures
/// without records. A baseline that holds nothing yet goes with every current.
/// @throws InvalidInput with the reason; IoError if records cannot be opened.
void require_comparable(const ApprovalSide& baseline, const ApprovalSide& current);

/// The same of two single files, which have to be of one format.
void require_comparable_files(const std::filesystem::path& baseline,
                              const std::filesystem::path& current);

}  // namespace mapproof
