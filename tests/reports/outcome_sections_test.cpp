#include <limits>

#include <gtest/gtest.h>

#include "reports/model/format.hpp"
#include "reports/sections/certificates.hpp"
#include "reports/sections/provenance.hpp"
#include "reports/sections/study_report.hpp"
#include "tests/reports/section_text.hpp"
#include "tests/reports/synthetic_study.hpp"

namespace mapproof {
namespace {

using test::contains_text;
using test::synthetic_study;
using test::table_named;

TEST(StatusesSection, CountsMapsOfEachKindAndListsFailuresFirst) {
  const Section section = statuses_section(synthetic_study(5, 2));
  const auto& list = std::get<StatusList>(section.blocks.back());
  EXPECT_EQ(list.items[0].code, "failed");
  EXPECT_EQ(list.items[0].count, 4);
  EXPECT_EQ(list.items[0].of, 120);  // At three parameters.
  EXPECT_EQ(list.items[0].locations[0].record_id, "layout-1-pose-1/visibility/isomap-K4/500");
  for (const StatusList::Item& item : list.items) {
    EXPECT_EQ(item.locations.size(), static_cast<std::size_t>(item.count));
    EXPECT_FALSE(item.meaning.empty());
  }
}

TEST(StatusesSection, CountsAMapOnceThatCarriesOneStatusTwice) {
  Study study = synthetic_study(1, 1);
  study.runs[0].records.resize(1);
  study.runs[0].records[0].statuses = {status_with_message(StatusCode::kBridged, "a"),
                                       status_with_message(StatusCode::kBridged, "b")};
  const Section section = statuses_section(study);
  EXPECT_EQ(std::get<StatusList>(section.blocks.back()).items[0].count, 1);
}

TEST(ProvenanceSection, HoldsTheCommandTheSeedAndTheVersions) {
  const Study study = synthetic_study();
  const auto timings = test::synthetic_timings(study);
  const auto sessions = test::synthetic_sessions();
  const Section section = provenance_section(study, sessions, timings, "mapproof run x");
  std::string facts;
  for (const Block& block : section.blocks)
    if (const auto* pairs = std::get_if<KeyValues>(&block))
      for (const auto& item : pairs->items) facts += item.key + "=" + item.value.text + "\n";
  for (const char* fact : {"Command=mapproof run x\n", "Seed=2007\n", "Built with=Eigen 3.4.0\n",
                           "Commit=0123456789ab\n", "mapproof=0.1.0\n"})
    EXPECT_NE(facts.find(fact), std::string::npos) << fact << facts;
  const Table& durations = table_named(section, "durations");
  EXPECT_EQ(std::get<NumberCell>(durations.rows[0].cells[2]).value, 40);
  EXPECT_NEAR(std::get<NumberCell>(durations.rows[0].cells[3]).value, 1.0, 1e-9);
}

TEST(StudyReport, KeepsItsOwnRulesForAnyNumberOfRuns) {
  for (const int layouts : {0, 1, 5}) {
    const Study study = synthetic_study(layouts, 1);
    const StudyFigures figures = test::synthetic_figures(study);
    EXPECT_NO_THROW(check(study_report({study, {}, {}, figures, ""}))) << layouts;
  }
}

TEST(ProvenanceSection, SaysWhichMethodTakesMostOfTheTime) {
  const Study study = synthetic_study();
  std::vector<Timing> timings = test::synthetic_timings(study);
  for (Timing& timing : timings)
    timing.seconds = timing.setting.method == Method::kSmacof ? 3.0 : 1e-6;
  const Section section = provenance_section(study, {}, timings, "");
  EXPECT_TRUE(contains_text(section, "SMACOF, equal weights takes the largest share of the time: 100 %"))
      << test::words(section);
  for (Timing& timing : timings) timing.seconds = 1e-6;
  EXPECT_FALSE(contains_text(provenance_section(study, {}, timings, ""), "largest share"));
}

TEST(CertificatesSection, IsLeftOutWithoutASemidefiniteProgram) {
  EXPECT_FALSE(certificates_section(synthetic_study()));
}

TEST(CertificatesSection, CountsWhatIsCertifiedAndNamesTheWorstRecord) {
  Study study = synthetic_study(2, 1);
  const auto certified = [](double gap) {
    return Certificate{SdpSolver::kInteriorPoint, 10.0, 10.0 * (1.0 + gap), gap, 1e-9};
  };
  auto& records = study.runs[1].records;
  const MethodSetting sde{Method::kSde, 6.0};
  for (std::size_t i = 0; i < 4; ++i) {
    records[i].setting = sde;
    records[i].sensor = Sensor::kVisibility;
  }
  records[0].certificate = certified(1e-9);
  records[1].certificate = certified(3e-4);
  records[2].certificate =
      Certificate{SdpSolver::kLowRank, 10.0, std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::infinity(), 0.0};
  // At the bound, but by distances that are not kept.
  records[3].certificate = certified(1e-9);
  records[3].certificate->constraint_residual = 0.78;
  const auto section = certificates_section(study);
  ASSERT_TRUE(section);
  EXPECT_TRUE(contains_text(*section,
                   "4 programs solved, 3 by interior point (ours) and 1 by low rank "
                   "(ours)"))
      << test::words(*section);
  EXPECT_TRUE(contains_text(*section, "within 10⁻⁶: 1 of them")) << test::words(*section);
  const Table& table = table_named(*section, "certificates");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(page_cell(table.rows[0].cells[5], table.columns[5]), "0.000300");
  EXPECT_EQ(table.rows[0].source, record_id({2, 1}, Sensor::kVisibility, sde, records[1].step));
  EXPECT_EQ(std::get<TextCell>(table.rows[1].cells[5]).text, "no bound");
}

TEST(CertificateSection, SaysWhetherTheMapIsCertifiedAndWhenNoPointsHaveTheDistances) {
  const Certificate certified{SdpSolver::kInteriorPoint, 10.0, 10.0, 0.0, 0.0};
  EXPECT_TRUE(contains_text(certificate_section(certified), "No other map"));
  Certificate bad = certified;
  bad.constraint_residual = 0.1;
  EXPECT_TRUE(contains_text(certificate_section(bad), "not certified"));
  bad.dual = -5e16;
  bool said = false;
  for (const Block& block : certificate_section(bad).blocks)
    if (const auto* facts = std::get_if<KeyValues>(&block))
      for (const auto& item : facts->items) said |= item.value.text.starts_with("below 0");
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace mapproof
