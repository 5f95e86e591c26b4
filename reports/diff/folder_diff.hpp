#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"

namespace mapproof {

/// Compares two studies with their figures, two folders of images, or two files (images, figures as
/// JSON, map.json, slam.json).
/// @throws IoError if one of them does not exist or cannot be listed; InvalidInput if there is
/// nothing to compare, or if they are of different kinds.
/// @note Compares several images at a time, by oneTBB; the result does not depend on it.
DiffResult folder_diff(const std::filesystem::path& baseline, const std::filesystem::path& current,
                       const DiffSettings& settings = {});

/// Whether a folder holds records, figures, images, tables or reports.
/// @throws IoError if it cannot be listed.
bool holds_items(const std::filesystem::path& folder);

/// Gives the records another judgement, made by other rules on the same values, and so to what
/// follows from them; the whole is judged again. Nothing where no records were compared.
void judge_records_as(DiffResult& result, const Judgement& judgement);

/// Changes every text of the result that can name a file: a side may be in a temporary folder.
void rename_files(DiffResult& result,
                  const std::function<std::string(const std::string& text)>& renamed);

/// The result for a current folder without a baseline: all items are new, the baseline is missing.
/// It never passes, whatever is allowed.
/// @throws IoError as folder_diff.
DiffResult no_baseline(const std::filesystem::path& baseline, const std::filesystem::path& current,
                       const DiffSettings& settings);

}  // namespace mapproof
