#pragma once

#include <vector>

#include "reports/diff/diff_result.hpp"

namespace mapproof {

/// The causes that three or more items have in common, by Judgement::shared_cause, in the order of
/// their first items.
std::vector<SharedCause> shared_causes(const std::vector<DiffItem>& items);

/// The shared cause of an item; null if it has its own.
const SharedCause* shared_cause_of(const DiffResult& result, const DiffItem& item);

}  // namespace mapproof
