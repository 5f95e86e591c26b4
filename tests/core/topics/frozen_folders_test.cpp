#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/studies/study_kind.hpp"
#include "core/studies/validate.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

/// Folders of format version 1, as they were written then: docs/stability.md promises that every
/// later version reads them. A failure here breaks that promise; the folders are not made again.
class FrozenFolder : public ::testing::TestWithParam<const char*> {
 protected:
  const std::filesystem::path folder_ = test::data_file(GetParam());
};

TEST_P(FrozenFolder, GivesTheResultsThatStandInIt) {
  EXPECT_EQ(results_csv(read_study_contents(folder_, {}).results.rows),
            read_file(folder_ / "results.csv"));
}

TEST_P(FrozenFolder, IsValidFileByFile) {
  const std::vector<Finding> findings = validate(folder_);
  EXPECT_GE(findings.size(), 3U);
  for (const Finding& finding : findings) EXPECT_EQ(finding.problem, "") << finding.path;
}

INSTANTIATE_TEST_SUITE_P(Version1, FrozenFolder,
                         ::testing::Values("study", "slam_study", "topic_study"),
                         [](const auto& folder) { return std::string(folder.param); });

}  // namespace
}  // namespace mapproof
