#pragma once

#include <filesystem>
#include <string>

#include "core/model/range_log.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {

/// A short made-up log: 13 poses once round a corner, 24 ranges to three landmarks, all of it true.
RangeLog sample_log();

/// The same as the text of each table.
std::string ranges_csv_of(const RangeLog& log);
std::string odometry_csv_of(const RangeLog& log);
std::string start_csv_of(const RangeLog& log);
std::string ground_truth_csv_of(const RangeLog& log);
std::string landmarks_csv_of(const RangeLog& log);
std::string pyfg_of(const RangeLog& log);
std::string td_text_of(const RangeLog& log);
std::string dr_text_of(const RangeLog& log);

/// Writes the tables into the folder "set" there, and gives its path.
std::filesystem::path csv_folder(const TemporaryFolder& folder, const RangeLog& log);

/// Writes DR, DRp, GT, TD and TL by matio. DRp is the true path, as the odometry has no error.
void write_mat(const RangeLog& log, const std::filesystem::path& path, bool is_compressed);

bool remarks_hold(const RangeLog& log, std::string_view words);

/// Expects the same ranges, and motions within the tolerance.
void expect_same(const RangeLog& log, const RangeLog& expected, double tolerance);

}  // namespace mapproof::test
