#include "core/records/studies/topic_store.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/not_finite.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/records/studies/topic_json.hpp"
#include "core/studies/validate.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/schemas/schema_problem.hpp"

namespace mapproof {
namespace {

TopicStudy small_topic_study() {
  TopicStudy study;
  study.experiment.name = "gaps";
  study.experiment.title = "Gaps";
  study.experiment.topic = "missing";
  study.experiment.seed = 7;
  study.experiment.layouts = 2;
  study.experiment.options = {{"dimensions", {10.0}}, {"shares", {0.1, 0.5}}};
  study.design = {
      .setups = {{.id = "random",
                  .title = "At random",
                  .factors = {{"share", "share missing", "", {0.1, 0.5}}}}},
      .methods = {{.id = "ppca", .label = "PPCA"}, {.id = "fill", .label = "Mean fill"}},
      .quantities = {known_quantity("mpe_m"),
                     study_quantity("found", "found", "%", Better::kHigher)}};
  study.provenance = test::made_up_provenance();
  return study;
}

TopicPart made_up_part(const RunId& run) {
  TopicPart part;
  part.id = slug(run);
  part.run = run;
  part.outcomes = {{.at = condition("random", {{"share", 0.1}}),
                    .method = "ppca",
                    .values = {{"mpe_m", 0.05}, {"found", 100.0}},
                    .statuses = {status_with_message(StatusCode::kNotConverged, "after 9 steps")}},
                   {.at = condition("random", {{"share", 0.5}}),
                    .method = "fill",
                    .values = {{"mpe_m", kNaN}},
                    .statuses = {}}};
  TopicMap map{.id = "ppca",
               .at = condition("random", {{"share", 0.5}}),
               .method = "ppca",
               .map = test::made_up_result({1, 1}).maps[0],
               .pairs = {},
               .uncertainty = {}};
  map.pairs = {{.first = 0, .second = 1, .distance_m = 2.0, .precision = 4.0, .scans = 9}};
  map.uncertainty = MapUncertainty{
      .covariances = {}, .squared_radius = 6.5, .replicates = 9, .maps = 8, .block_steps = 3};
  map.uncertainty->covariances.assign(map.map.names.size(), Eigen::Matrix2d::Identity());
  map.uncertainty->covariances.back().setConstant(kNaN);
  part.maps = {map};
  part.seconds = {{.part = part.id, .method = "ppca", .seconds = 1.0},
                  {.part = part.id, .method = "ppca", .seconds = 0.5}};
  return part;
}

TopicInput known_options(std::string_view topic) {
  static const std::vector<TopicOption> options = {
      {.name = "dimensions", .usual = {10.0}, .minimum = 1.0, .maximum = 50.0, .integer = true},
      {.name = "shares", .usual = {0.1, 0.3}, .minimum = 0.0, .maximum = 0.9, .list = true}};
  return {.options = topic == "missing" ? &options : nullptr};
}

TopicExperiment parsed(const std::string& more, const std::string& profile = "") {
  const std::string text =
      R"({"schema": {"name": "mapproof.topic_experiment", "version": 1}, "name": "gaps", )"
      R"("topic": "missing")" +
      more + "}";
  return parse_topic_experiment(text, "gaps.json", known_options, profile);
}

std::string refusal(const std::string& more) {
  return test::error_of([&] { parsed(more); });
}

TEST(TopicStudy, IsReadBackAsItWasWritten) {
  const test::TemporaryFolder folder;
  const TopicStudy written = small_topic_study();
  {
    StudyWriter store = StudyWriter(folder.path(), study_start(written));
    store.write(part_of(made_up_part({2, 1}), ""));
    store.write(part_of(made_up_part({1, 1}), ""));
    EXPECT_TRUE(holds_part(folder.path(), small_topic_study().design, "layout-1-pose-1", ""));
    EXPECT_FALSE(holds_part(folder.path(), small_topic_study().design, "layout-1-pose-1",
                            "of another data set"));
  }
  const TopicStudy study = read_topic_study(folder.path());
  EXPECT_EQ(topic_study_json(study), topic_study_json(written));
  ASSERT_EQ(study.parts.size(), 2U);
  EXPECT_EQ(study.parts[0].id, "layout-1-pose-1");
  EXPECT_EQ(topic_part_json(study.parts[1], ""), topic_part_json(made_up_part({2, 1}), ""));
  EXPECT_TRUE(std::isnan(study.parts[0].outcomes[1].values.at("mpe_m")));
  const auto& uncertainty = study.parts[0].maps[0].uncertainty;
  ASSERT_TRUE(uncertainty);
  EXPECT_FALSE(uncertainty->covariances.back().allFinite());
  EXPECT_EQ(uncertainty->squared_radius, 6.5);
  ASSERT_EQ(study.parts[0].seconds.size(), 1U);
  EXPECT_EQ(study.parts[0].seconds[0].seconds, 0.5) << "the later of two";
  EXPECT_EQ(study_schema(folder.path()), "mapproof.topic_study");
}

TEST(TopicStudy, IsValidAndKeepsToItsSchemas) {
  const test::TemporaryFolder folder;
  {
    StudyWriter store = StudyWriter(folder.path(), study_start(small_topic_study()));
    store.write(part_of(made_up_part({1, 1}), ""));
  }
  for (const Finding& finding : validate(folder.path(), {})) EXPECT_EQ(finding.problem, "");
  const auto json_of = [&](const char* file) {
    return nlohmann::json::parse(read_file(folder / file));
  };
  EXPECT_EQ(test::schema_problem("topic_study", json_of("study.json")), "");
  EXPECT_EQ(test::schema_problem("topic_part", json_of("parts/layout-1-pose-1.json")), "");
}

TEST(TopicStudy, MakesADamagedPartAgainAndNamesItToReaders) {
  const test::TemporaryFolder folder;
  StudyWriter store = StudyWriter(folder.path(), study_start(small_topic_study()));
  TopicPart part = made_up_part({1, 1});
  part.outcomes[0].method = "other";
  store.write(part_of(part, ""));
  EXPECT_FALSE(holds_part(folder.path(), small_topic_study().design, "layout-1-pose-1", ""));
  EXPECT_EQ(test::error_of([&] { read_topic_study(folder.path()); }),
            (folder / "parts/layout-1-pose-1.json").string() +
                ": /outcomes/0/method: the study has no such method");
}

TEST(TopicStudy, RefusesAFolderOfAnotherExperiment) {
  const test::TemporaryFolder folder;
  { StudyWriter(folder.path(), study_start(small_topic_study())); }
  TopicStudy other = small_topic_study();
  other.experiment.options["dimensions"] = {9.0};
  EXPECT_EQ(test::error_of([&] { StudyWriter(folder.path(), study_start(other)); }),
            folder.path().string() +
                ": holds another experiment (/options/dimensions/0 is 10 there and 9 here); choose "
                "another folder or remove it");
}

TEST(TopicExperiment, TakesTheUsualValuesOfOptionsThatAreLeftOut) {
  const TopicExperiment experiment = parsed(R"(, "options": {"shares": [0.2, 0.7]})");
  EXPECT_EQ(experiment.options.at("dimensions"), std::vector{10.0});
  EXPECT_EQ(experiment.options.at("shares"), (std::vector{0.2, 0.7}));
  EXPECT_EQ(experiment.world.landmarks, 50);
}

TEST(TopicExperiment, TakesAProfile) {
  const TopicExperiment experiment =
      parsed(R"(, "profiles": {"quick": {"layouts": 3, "options": {"dimensions": 4}}})", "quick");
  EXPECT_EQ(experiment.layouts, 3);
  EXPECT_EQ(experiment.options.at("dimensions"), std::vector{4.0});
}

TEST(TopicExperiment, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(refusal(R"(, "options": {"dimensions": 0})"),
            "gaps.json: /options/dimensions: expected an integer from 1 to 50, got 0");
  EXPECT_EQ(refusal(R"(, "options": {"dimensions": 2.5})"),
            "gaps.json: /options/dimensions: expected an integer from 1 to 50, got 2.5");
  EXPECT_EQ(refusal(R"(, "options": {"share": [0.5]})"),
            "gaps.json: /options: unknown key \"share\": did you mean \"shares\"?");
  EXPECT_EQ(refusal(R"(, "anchors": 51)"), "gaps.json: /anchors: 51 anchors of 50 landmarks");
  EXPECT_EQ(refusal(R"(, "world": {"landmarks": 5000}, "steps": 100000)"),
            "gaps.json: /steps: 5000 landmarks at 100000 steps are more than 2e+08 entries");
  EXPECT_EQ(test::error_of([] {
              parse_topic_experiment(
                  R"({"schema": {"name": "mapproof.topic_experiment", "version": 1},)"
                  R"("name": "a", "topic": "mising"})",
                  "a.json", known_options);
            }),
            "a.json: /topic: no topic \"mising\"");
}

}  // namespace
}  // namespace mapproof
