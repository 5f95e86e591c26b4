#pragma once

#include <string>
#include <vector>

#include "reports/diff/records/record_diff.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Adds what became of the records: scores with their tests, positions, settings, statuses, runs
/// on one side alone, versions, files that cannot be read.
/// @param suffix  Ends the tables' ids.
void add_record_tables(std::vector<Block>& blocks, const RecordDiff& diff,
                       const std::string& suffix);

/// Adds files that are compared value by value, where there are some.
void add_others_table(std::vector<Block>& blocks, const std::vector<OtherDiff>& others,
                      const std::string& suffix);

}  // namespace mapproof
