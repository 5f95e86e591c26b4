#pragma once

#include <string>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/item_files.hpp"
#include "reports/diff/records/record_tie.hpp"

namespace mapproof {

/// Compares one figure or image: its value, then its images; then finds the cause.
/// @param baseline, current  Null if that side does not have the item.
DiffItem item_diff(const std::string& id, const ItemFiles* baseline, const ItemFiles* current,
                   const RecordContext& context, const DiffSettings& settings);

}  // namespace mapproof
