#include "reports/diff/records/record_diff.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/results/great_errors.hpp"
#include "core/statistics/paired_change.hpp"
#include "reports/diff/records/difference_summary.hpp"
#include "reports/diff/records/number_diff.hpp"
#include "reports/diff/records/numbers_in_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

/// One quantity of one subject in that many layouts, at 1 + layout / 10.
RecordSet set_of(int layouts) {
  RecordSet set;
  set.kind = "mapproof.study";
  set.seed = "7";
  set.repeats = true;
  for (int layout = 1; layout <= layouts; ++layout) {
    const std::string run = "layout-" + std::to_string(layout) + "-pose-1";
    set.runs.set(run, "layout-" + std::to_string(layout));
    set.values[{"bearing/lpca/100", "mpe_m"}][run] = 1.0 + 0.1 * layout;
  }
  return set;
}

ValuesByRun& values(RecordSet& set) { return set.values[{"bearing/lpca/100", "mpe_m"}]; }

/// Calls change_one(run, value) for each, which may change the value.
template <typename ChangeOne>
void change(ValuesByRun& values, const ChangeOne& change_one) {
  for (const auto& [run, value] : ValuesByRun(values)) change_one(run, values[run]);
}

Outcome outcome_of(const RecordDiff& diff, const std::string& quantity) {
  for (const Comparison& comparison : diff.comparisons)
    if (comparison.quantity.id == quantity) return comparison.outcome;
  return Outcome::kEqual;
}

/// A table that another program wrote: so many runs in each of so many groups.
RecordSet table_of(int groups, int runs, const Quantity& quantity) {
  RecordSet set;
  set.kind = "mapproof.results_study";
  set.repeats = set.draws_groups = true;
  set.quantities.declare(quantity);
  for (int group = 1; group <= groups; ++group)
    for (int i = 1; i <= runs; ++i) {
      const std::string run = std::to_string(group) + "-" + std::to_string(i);
      set.runs.set(run, "room-" + std::to_string(group));
      set.values[{"s/ekf", quantity.id}][run] = 1.0 + 0.1 * group + 0.01 * i;
    }
  return set;
}

TEST(RecordDiff, GivesNoPWithFewerThanThreePairsButADirectionIfAllAgree) {
  for (const int layouts : {1, 2, 3, 5}) {
    const RecordSet before = set_of(layouts);
    RecordSet after = before;
    change(values(after), [&](const Name&, double& value) { value += 0.01; });
    const RecordDiff diff = record_diff(before, after);
    ASSERT_EQ(diff.comparisons.size(), 1U);
    EXPECT_EQ(diff.comparisons[0].test.has_value(), layouts > 2);
    EXPECT_EQ(diff.judgement.verdict, Verdict::kWorse) << layouts;
    EXPECT_EQ(diff.judgement.cause.find("p ") != std::string::npos, layouts > 2)
        << diff.judgement.cause;
    EXPECT_EQ(diff.judgement.cause.find("too few"), std::string::npos) << diff.judgement.cause;
  }
  RecordSet before = set_of(5), after = before;
  double sign = 1.0;
  change(values(after), [&](const Name&, double& value) { value += 0.01 * (sign = -sign); });
  EXPECT_EQ(record_diff(before, after).judgement.verdict, Verdict::kChanged);
}

TEST(RecordDiff, SaysThatRunsAreTooFewOnlyWhereNoTestDecides) {
  // Two groups of three runs are too few for a test.
  const Quantity ate = study_quantity("ate_m", "ATE", "m", Better::kLower);
  const auto cause = [&](int groups, double other) {
    RecordSet before = table_of(groups, 3, ate);
    before.values[{"s/mcl", "ate_m"}] = before.values[{"s/ekf", "ate_m"}];
    RecordSet after = before;
    change(after.values[{"s/ekf", "ate_m"}], [&](const Name&, double& value) { value += 0.1; });
    change(after.values[{"s/mcl", "ate_m"}], [&](const Name&, double& value) { value += other; });
    return record_diff(before, after).judgement.cause;
  };
  constexpr const char* kTooFew = "too few runs to be sure";
  EXPECT_NE(cause(2, -0.1).find(kTooFew), std::string::npos) << cause(2, -0.1);
  EXPECT_EQ(cause(3, -0.1).find(kTooFew), std::string::npos) << cause(3, -0.1);
}

TEST(RecordDiff, HasNoDirectionWithFewPairsWhereErrorsHaveBothDirections) {
  RecordSet before = set_of(1);
  const auto with = [](RecordSet set, const char* quantity, double value) {
    set.values[{"bearing/lpca/100", quantity}]["layout-1-pose-1"] = value;
    return set;
  };
  before = with(with(with(before, "moe_percent", 4.0), "mpe_all_fitted_m", 0.5), "stress", 0.1);
  const RecordSet worse = with(with(before, "mpe_m", 2.0), "moe_percent", 5.0);
  EXPECT_EQ(record_diff(before, worse).judgement.verdict, Verdict::kWorse);
  const RecordDiff both = record_diff(before, with(worse, "mpe_all_fitted_m", 0.4));
  EXPECT_EQ(both.judgement.verdict, Verdict::kChanged);
  EXPECT_NE(both.judgement.cause.find("errors: 2 worse, 1 better"), std::string::npos)
      << both.judgement.cause;
  // That of another method counts too; a score that is lost counts whatever the others do.
  RecordSet other = before, others_better = worse;
  other.values[{"bearing/isomap/100", "mpe_m"}]["layout-1-pose-1"] = 1.0;
  others_better.values[{"bearing/isomap/100", "mpe_m"}]["layout-1-pose-1"] = 0.5;
  EXPECT_EQ(record_diff(other, others_better).judgement.verdict, Verdict::kChanged);
  others_better.values[{"bearing/lpca/100", "moe_percent"}]["layout-1-pose-1"] = std::nan("");
  EXPECT_EQ(record_diff(other, others_better).judgement.verdict, Verdict::kWorse);
}

TEST(RecordDiff, NeverTakesTheSolversStressForAnErrorOfTheMap) {
  for (const int layouts : {1, 2, 8}) {
    RecordSet before = set_of(layouts);
    before.values[{"bearing/lpca/100", "stress"}] = values(before);
    RecordSet after = before;
    // Too few for a test, or equal changes, of which it has no p.
    change(after.values[{"bearing/lpca/100", "stress"}],
           [&](const Name&, double& value) { value *= 1.01; });
    EXPECT_EQ(record_diff(before, after).judgement.verdict, Verdict::kChanged) << layouts;
    // Nor does it contradict errors with one direction.
    change(values(after), [&](const Name&, double& value) { value -= 0.01; });
    const RecordDiff diff = record_diff(before, after);
    EXPECT_EQ(diff.judgement.verdict, Verdict::kChanged);
    EXPECT_EQ(outcome_of(diff, "mpe_m"), Outcome::kBetter) << layouts;
  }
}

TEST(RecordDiff, CountsLayoutsNotPosesWhereThereAreEnough) {
  RecordSet before = set_of(8);
  for (int layout = 1; layout <= 8; ++layout) {
    const std::string run = "layout-" + std::to_string(layout) + "-pose-2";
    before.runs.set(run, "layout-" + std::to_string(layout));
    values(before)[run] = 2.0;
  }
  RecordSet after = before;
  change(values(after), [&](const Name&, double& value) { value += 0.1 * value * value; });
  const RecordDiff diff = record_diff(before, after);
  ASSERT_TRUE(diff.comparisons[0].test);
  EXPECT_EQ(diff.comparisons[0].test->unit, "layout");
  EXPECT_EQ(diff.comparisons[0].test->change.units, 8);
  std::vector<double> changes;
  for (int layout = 1; layout <= 8; ++layout)
    changes.push_back(0.5 * (std::log1p(0.1 * (1.0 + 0.1 * layout)) + std::log1p(0.2)));
  EXPECT_NEAR(diff.comparisons[0].test->p, paired_change(changes).p, 1e-12);
}

TEST(RecordDiff, HasTheValuesOfAllPairsAlsoOfRunsThatDoNotDiffer) {
  const RecordSet before = set_of(40);
  RecordSet after = before;
  change(values(after), [](const Name&, double& value) { value += value > 2.0 ? 0.5 : 0.0; });
  const RecordDiff diff = record_diff(before, after);
  ASSERT_EQ(diff.comparisons.size(), 1U);
  const Comparison& one = diff.comparisons[0];
  EXPECT_GT(one.equal, 0);
  EXPECT_EQ(one.values.size(), 40U);
  EXPECT_EQ(std::ranges::count_if(one.values, [](Point pair) { return pair.x != pair.y; }),
            one.beyond);
}

TEST(RecordDiff, CorrectsForTheNumberOfQuantitiesThatDiffer) {
  RecordSet before = set_of(8);
  for (const char* subject : {"a", "b", "c", "d", "e", "f", "g"})
    before.values[{subject, "mpe_m"}] = values(before);
  RecordSet after = before;
  for (auto& [key, runs] : after.values)
    change(runs, [&](const Name&, double& value) { value *= 1.0 + 0.1 * value; });
  const RecordDiff eight = record_diff(before, after);
  EXPECT_EQ(eight.judgement.verdict, Verdict::kWorse);
  EXPECT_TRUE(eight.judgement.cause.ends_with("; 7 other scores differ, too"))
      << eight.judgement.cause;
  for (const char* subject : {"a", "b", "c", "d"})
    after.values[{subject, "mpe_m"}] = before.values[{subject, "mpe_m"}];
  const RecordDiff four = record_diff(before, after);
  const PairedTest test = *four.comparisons[0].test;
  EXPECT_DOUBLE_EQ(test.p, 4.0 * test.change.p);
  EXPECT_DOUBLE_EQ(eight.comparisons[0].test->p, 8.0 * test.change.p);
}

TEST(RecordDiff, PairsNoRunsOfDifferentSeedsOrTruePositions) {
  const RecordSet before = set_of(8);
  RecordSet after = before;
  change(values(after), [&](const Name&, double& value) { value *= 2.0; });
  after.seed = "8";
  RecordDiff diff = record_diff(before, after);
  EXPECT_FALSE(diff.same_seeds);
  EXPECT_FALSE(diff.comparisons[0].test);
  EXPECT_EQ(diff.judgement.verdict, Verdict::kChanged);

  RecordSet here = before, there = after;
  there.seed = "7";
  here.worlds["layout-1-pose-1"].points = Points::Zero(3, 2);
  there.worlds["layout-1-pose-1"].points = Points::Ones(3, 2);
  EXPECT_FALSE(record_diff(here, there).same_seeds);
}

TEST(RecordDiff, TakesALostScoreForWorseAndAGainedOneForBetter) {
  RecordSet before = set_of(8), after = before;
  values(after)["layout-1-pose-1"] = std::nan("");
  EXPECT_EQ(record_diff(before, after).judgement.verdict, Verdict::kWorse);
  EXPECT_EQ(record_diff(after, before).judgement.verdict, Verdict::kBetter);
  EXPECT_EQ(record_diff(after, after).judgement.verdict, Verdict::kIdentical);
}

TEST(RecordDiff, ReportsAMapAndAFileOnOnlyOneSide) {
  RecordSet before = set_of(3);
  const std::string record = "layout-2-pose-1/bearing/lpca/100";
  before.points[record] = {.names = {"a"}, .points = Points::Zero(1, 2), .ground_truth = {}};
  RecordSet after = before;
  after.points.clear();
  for (const auto& [one, other] : {std::pair{before, after}, {after, before}}) {
    const RecordDiff diff = record_diff(one, other);
    EXPECT_EQ(diff.judgement.verdict, Verdict::kChanged);
    EXPECT_NE(diff.judgement.cause.find(record), std::string::npos) << diff.judgement.cause;
  }
  after = set_of(3);
  RecordSet detailed = after;
  detailed.others["details/layout-1-pose-1.json"] = "details/layout-1-pose-1.json";
  const RecordDiff diff = record_diff(detailed, after);
  EXPECT_EQ(diff.judgement.verdict, Verdict::kMissing);
  EXPECT_EQ(diff.judgement.cause, "details/layout-1-pose-1.json is missing");
  EXPECT_EQ(record_diff(after, detailed).judgement.verdict, Verdict::kNew);
  after.runs = {};  // The missing run then reports it.
  for (const char* run : {"layout-2-pose-1", "layout-3-pose-1"})
    after.runs.set(run, *detailed.runs.find(run));
  EXPECT_TRUE(record_diff(detailed, after).others.empty());
}

TEST(RecordDiff, NeverJudgesVersionsNorIterations) {
  RecordSet before = set_of(8);
  for (const Name& run : before.runs.runs())
    before.values[{"bearing/lpca/100", "iterations"}][run] = 10.0;
  RecordSet after = before;
  after.provenance.version = "9.9";
  EXPECT_EQ(record_diff(before, after).judgement.verdict, Verdict::kIdentical);
  EXPECT_EQ(record_diff(before, after).provenance.size(), 1U);
  change(after.values[{"bearing/lpca/100", "iterations"}],
         [&](const Name&, double& value) { value = 900.0; });
  EXPECT_EQ(record_diff(before, after).judgement.verdict, Verdict::kWithinTolerance);
}

TEST(RecordDiff, RefusesRecordsOfTwoKinds) {
  RecordSet before, after;
  before.kind = "mapproof.study";
  after.kind = "mapproof.map";
  EXPECT_THROW(record_diff(before, after), InvalidInput);
}

AlignedPoints shape_of(const Points& points) {
  AlignedPoints placed;
  placed.quantity = "landmark_shape";
  placed.frame = Frame::kSimilarity;
  placed.points = points;
  return placed;
}

TEST(PointsDiff, AlignsShapesByTranslationRotationScaleAndReflection) {
  Points points(5, 2);
  points << 0, 0, 1, 0, 2, 1, 0.5, 3, -1, 1;
  Points moved(5, 2);
  for (Eigen::Index i = 0; i < 5; ++i)  // Reflected, rotated by 90 degrees, twice as large.
    moved.row(i) << 2.0 * points(i, 1) + 4.0, 2.0 * points(i, 0) - 7.0;
  const auto same = points_diff("m", shape_of(points), shape_of(moved), {});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->beyond, 0);
  moved(3, 0) += 0.2;
  const auto other = points_diff("m", shape_of(points), shape_of(moved), {});
  ASSERT_TRUE(other);
  EXPECT_GT(other->beyond, 0);
  EXPECT_EQ(other->moves[0].name, "4");
}

TEST(PointsDiff, AlignsMetricMapsWithoutAFrameWithoutScale) {
  Points points(4, 2), turned(4, 2);
  points << 0, 0, 1, 0, 2, 1, 0.5, 3;
  for (Eigen::Index i = 0; i < 4; ++i) turned.row(i) << points(i, 1) + 4.0, points(i, 0) - 7.0;
  const auto beyond = [&](const Points& other, bool is_free) {
    AlignedPoints a, b;
    a.points = points, b.points = other;
    a.is_free = b.is_free = is_free;
    return points_diff("m", a, b, {}).value().beyond;
  };
  EXPECT_EQ(beyond(turned, true), 0);
  EXPECT_GT(beyond(turned, false), 0);
  EXPECT_GT(beyond(1.1 * turned, true), 0);
}

TEST(PointsDiff, ReportsALostAndAGainedPosition) {
  AlignedPoints before, after;
  before.points.resize(4, 2);
  before.points << 0, 1, 2, 3, 4, 5, 6, 7;
  after.points = before.points;
  before.points.row(1).setConstant(std::nan(""));
  after.points.row(2).setConstant(std::nan(""));
  const auto diff = points_diff("m", before, after, {});
  ASSERT_TRUE(diff);
  EXPECT_EQ(diff->lost, 1);
  EXPECT_EQ(diff->gained, 1);
  EXPECT_EQ(diff->points, 2);
  EXPECT_FALSE(points_diff("m", before, before, {}));
}

TEST(Quantities, TextsDistinguishUnequalNumbers) {
  EXPECT_EQ(change_text(0.138, 0.152, "m"), "0.138 \u2192 0.152 m");
  EXPECT_EQ(change_text(0.12, 0.153, "m"), "0.120 \u2192 0.153 m");
  EXPECT_EQ(change_text(3.0, 12.0, ""), "3 \u2192 12");
  EXPECT_EQ(change_text(1.0, 1.0 + 1e-9, ""), "1.000000000 \u2192 1.000000001");
  EXPECT_EQ(change_text(std::nan(""), 2.0, "%"), "none \u2192 2.00 %");
}

TEST(Quantities, TextsHaveNoNumbersThatNobodyReads) {
  const auto [before, after] =
      readable_numbers("0 to 0.17021583813709998", "0 to 0.19574815564336318");
  EXPECT_EQ(before, "0 to 0.170");
  EXPECT_EQ(after, "0 to 0.196");
  EXPECT_EQ(readable_numbers("-0.033210000001", "0.1").first, "\u22120.0332");
  EXPECT_NE(readable_numbers("0.086094250001", "0.086094250002").first,
            readable_numbers("0.086094250001", "0.086094250002").second);
  EXPECT_EQ(readable_numbers("K = 7: 0.125 m", "K = 7: 0.166 m, worse").second,
            "K = 7: 0.166 m, worse");
}

TEST(Quantities, TextsSayThatAMapDiverged) {
  EXPECT_EQ(change_text(0.138, 8.93e13, "m", true), "0.138 m \u2192 over 1\u00A0km");
  EXPECT_EQ(change_text(8.93e13, 0.138, "m", true), "over 1\u00A0km \u2192 0.138 m");
  EXPECT_EQ(change_text(8.93e13, 1.2e3, "m", true),
            "over 1\u00A0km before and after (1.34×10⁻¹¹ times as great)");
  EXPECT_EQ(change_text(8.93e13, 1.2e3, "m"), "8.93\u00D710\u00B9\u00B3 \u2192 1200 m");
  EXPECT_EQ(change_text(0.138, 900.0, "m", true), "0.138 \u2192 900 m");
}

TEST(Quantities, OfOthersHaveGreatErrorsWhereSomeAreSmall) {
  EXPECT_TRUE(has_great_errors(known_quantity("mpe_m"), 1e6));
  const Quantity theirs{.id = "drift_m", .label = "drift", .unit = "m", .better = Better::kLower};
  EXPECT_TRUE(has_great_errors(theirs, 12.0));
  EXPECT_FALSE(has_great_errors(theirs, 2e4));  // Distances of that size.
  EXPECT_FALSE(has_great_errors(known_quantity("moe_percent"), 1.0));
}

TEST(RecordDiff, TestsGroupsThatAreDrawnHoweverFew) {
  const Quantity ate = study_quantity("ate_m", "ATE", "m", Better::kLower);
  for (const int groups : {2, 3, 7}) {
    const RecordSet before = table_of(groups, 6, ate);
    RecordSet after = before;
    // Worse in all runs of the first group, a little better in the others.
    change(after.values[{"s/ekf", "ate_m"}], [&](const std::string& run, double& value) {
      value += run.starts_with("1-") ? 0.5 : -0.001;
    });
    const RecordDiff diff = record_diff(before, after);
    ASSERT_EQ(diff.comparisons.size(), 1U);
    const auto& test = diff.comparisons[0].test;
    ASSERT_EQ(test.has_value(), groups > 2) << "two groups are too few for a test";
    EXPECT_EQ(diff.judgement.verdict, Verdict::kChanged);
    EXPECT_EQ(diff.judgement.cause.find("layout"), std::string::npos) << diff.judgement.cause;
    EXPECT_EQ(diff.judgement.cause.find("seed"), std::string::npos) << diff.judgement.cause;
    if (!test) continue;
    EXPECT_EQ(test->unit, "group");
    EXPECT_EQ(test->change.units, groups);
  }
}

TEST(RecordDiff, AnotherUnitIsAChangeOfMeaningAndNamesBoth) {
  const RecordSet before = table_of(3, 2, study_quantity("ate_m", "ATE", "m", Better::kLower));
  RecordSet after = table_of(3, 2, study_quantity("ate_m", "ATE", "cm", Better::kLower));
  change(after.values[{"s/ekf", "ate_m"}], [&](const Name&, double& value) { value *= 200.0; });
  const RecordDiff diff = record_diff(before, after);
  EXPECT_EQ(diff.judgement.verdict, Verdict::kChanged);
  EXPECT_NE(diff.judgement.cause.find(
                "ATE is in m in the baseline and in cm in the current: not compared"),
            std::string::npos)
      << diff.judgement.cause;
  EXPECT_TRUE(diff.comparisons.empty());
}

TEST(RecordDiff, AnotherDirectionIsAChangeOfMeaning) {
  const RecordSet before = table_of(3, 2, study_quantity("gain", "gain", "", Better::kLower));
  const RecordSet after = table_of(3, 2, study_quantity("gain", "gain", "", Better::kHigher));
  const RecordDiff diff = record_diff(before, after);
  EXPECT_EQ(diff.judgement.verdict, Verdict::kChanged);
  EXPECT_EQ(diff.judgement.cause,
            "of gain lower is better in the baseline and higher in the current");
}

TEST(RecordDiff, NamesSubjectsByTheirLabelsAndByTheirIdsWithoutOne) {
  RecordSet before = set_of(3);
  before.labels["bearing/lpca/100"] = {"bearing", "local PCA", "100 steps"};
  RecordSet after = before;
  change(values(after), [](const Name&, double& value) { value += 0.5; });
  const auto cause = [&] { return record_diff(before, after).judgement.cause; };
  EXPECT_NE(cause().find(" of bearing, local PCA, 100 steps"), std::string::npos) << cause();
  after.values.clear();
  EXPECT_NE(cause().find("missing record: bearing, local PCA, 100 steps"), std::string::npos)
      << cause();
  before.labels.clear();
  EXPECT_NE(cause().find("missing record: bearing/lpca/100"), std::string::npos) << cause();
}

TEST(RecordDiff, ShowsAllValuesOfAQuantityInTheUnitThatKeepsThemShort) {
  RecordSet before = table_of(3, 2, study_quantity("scan_s", "time per scan", "s", Better::kLower));
  for (const char* subject : {"s/ekf", "s/slow"})
    for (const char* run : {"1-1", "1-2", "2-1", "2-2", "3-1", "3-2"})
      before.values[{subject, "scan_s"}][run] = subject[2] == 'e' ? 4e-4 : 0.02;
  RecordSet after = before;
  for (auto& [key, values] : after.values)
    change(values, [](const Name&, double& value) { value *= 2.0; });
  const RecordDiff diff = record_diff(before, after);
  ASSERT_EQ(diff.comparisons.size(), 2U);
  for (const Comparison& comparison : diff.comparisons)
    EXPECT_EQ(shown_unit(comparison).unit, "ms") << comparison.subject;
  EXPECT_TRUE(comparison_text(diff.comparisons[0])
                  .starts_with("time per scan 0.400 \u2192 0.800 ms over 6 runs"))
      << comparison_text(diff.comparisons[0]);
}

TEST(RecordDiff, ShowsNoEndOfALineThatBothFilesHave) {
  const test::TemporaryFolder folder;
  folder.file("a.csv", "name,x_m\r\nL1,1\r\n");
  folder.file("b.csv", "name,y_m\r\nL1,1\r\n");
  const OtherDiff diff = number_diff("a.csv", folder / "a.csv", folder / "b.csv", {});
  EXPECT_EQ(diff.first, "line 1");
  EXPECT_EQ(diff.baseline, "name,x_m");
  EXPECT_EQ(diff.current, "name,y_m");
}

TEST(RecordDiff, SaysHowManyScoresOfAQuantityDiffer) {
  QuantityDifferences differences{.quantity = known_quantity("mpe_m"), .records = 1, .better = 1};
  differences.low = differences.median = differences.high = NAN;
  EXPECT_EQ(differences_text(differences), "MPE: 1 record differs, 0 worse, 1 better");
  differences.records = 2;
  EXPECT_EQ(differences_text(differences), "MPE: 2 records differ, 0 worse, 1 better");
}

TEST(RecordDiff, OneMoreStepOfAMapIsASettingAndNoOtherRecord) {
  const test::TemporaryFolder folder;
  const auto map_of = [&](const std::string& name, int steps, double mpe_m) {
    MapRecord map{.id = "map",
                  .origin = FromPairs{},
                  .step = steps,
                  .names = {"a", "b", "c"},
                  .estimate = Points::Random(3, 2),
                  .score = Score{mpe_m, 1.0, mpe_m, 1.0}};
    folder.file(name, map_json(map));
    return folder / name;
  };
  const auto before = map_of("a/map.json", 1000, 0.1), after = map_of("b/map.json", 1001, 0.2);
  const RecordSets sets = read_records(before, after);
  const RecordDiff diff = record_diff(sets.baseline, sets.current);
  EXPECT_TRUE(diff.missing_subjects.empty() && diff.new_subjects.empty());
  ASSERT_EQ(diff.settings.size(), 1U);
  EXPECT_EQ(diff.settings[0].pointer, "/steps");
  EXPECT_EQ(diff.judgement.verdict, Verdict::kWorse) << diff.judgement.cause;
}

}  // namespace
}  // namespace mapproof
