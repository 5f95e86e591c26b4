#include <algorithm>
#include <iostream>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reports/diff/folder_diff.hpp"
#include "tests/reports/diff/value_cases.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

/// Expected and actual verdicts: rows and columns by Verdict.
using Confusion = std::map<Verdict, std::map<Verdict, int>>;

void print(const std::string& name, const Confusion& confusion) {
  std::string text = fmt::format("{}\n{:>18}", name, "must be \\ said");
  for (const Verdict said : kVerdicts) text += fmt::format(" {:>10.10}", mapproof::name(said));
  for (const auto& [must, row] : confusion) {
    text += fmt::format("\n{:>18}", mapproof::name(must));
    for (const Verdict said : kVerdicts)
      text += fmt::format(" {:>10}", row.contains(said) ? row.at(said) : 0);
  }
  std::cout << text << "\n";
}

class Mutations : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_base_study(*folder_ / "base");
    write_base_documents(*folder_ / "base");
    write_base_slam_study(*folder_ / "slam");
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static void run(const std::string& name, const std::vector<ValueCase>& cases,
                  const std::string& base = "base") {
    Confusion confusion;
    for (const ValueCase& one : cases) run(one, *folder_ / base, confusion);
    print(name + fmt::format(": {} pairs", cases.size()), confusion);
  }

  static void run(const ValueCase& one, const fs::path& base, Confusion& confusion) {
    SCOPED_TRACE(one.name);
    const fs::path changed = *folder_ / "changed";
    fs::remove_all(changed);
    fs::copy(base, changed, fs::copy_options::recursive);
    one.change(changed);
    const DiffResult result = folder_diff(base, changed);
    const auto item = std::ranges::find(result.items, one.id, &DiffItem::id);
    ASSERT_NE(item, result.items.end());
    ++confusion[one.verdict][item->judgement.verdict];
    EXPECT_EQ(name(item->judgement.verdict), name(one.verdict)) << item->judgement.cause;
    EXPECT_EQ(item->passes, one.passes) << item->judgement.cause;
    for (const std::string& part : one.cause)
      EXPECT_NE(item->judgement.cause.find(part), std::string::npos)
          << "\"" << part << "\" is not in: " << item->judgement.cause;
    if (!one.alone) return;
    for (const DiffItem& other : result.items) {
      if (other.id == one.id) continue;
      EXPECT_EQ(name(other.judgement.verdict), name(Verdict::kIdentical))
          << other.id << ": " << other.judgement.cause;
    }
  }

  static TemporaryFolder* folder_;
};

TemporaryFolder* Mutations::folder_ = nullptr;

TEST_F(Mutations, OfRecordsAreAllReportedWithTheirCause) { run("records", record_cases()); }

TEST_F(Mutations, OfAnyFieldOfTheRecordsAreReported) { run("fields", field_cases()); }

TEST_F(Mutations, OfRangeOnlyStudiesAreReportedWithTheirCause) {
  run("range-only", slam_cases(), "slam");
}

TEST_F(Mutations, OfTablesPagesAndPdfsAreReported) { run("documents", document_cases()); }

TEST_F(Mutations, OfFiguresAreAllReportedWithTheirCause) { run("figures", figure_cases()); }

TEST_F(Mutations, OfDrawingsAreDistinguishedFromThoseOfValues) { run("drawings", drawing_cases()); }

TEST_F(Mutations, OfFilesAreReportedAndStopNothingElse) { run("files", file_cases()); }

TEST_F(Mutations, ThatAreNoneAreIdentical) {
  const DiffResult result = folder_diff(*folder_ / "base", *folder_ / "base");
  EXPECT_TRUE(result.passes);
  for (const DiffItem& item : result.items)
    EXPECT_EQ(item.judgement.verdict, Verdict::kIdentical) << item.id;
}

}  // namespace
}  // namespace mapproof::test
