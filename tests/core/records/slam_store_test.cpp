#include "core/records/studies/slam_store.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/experiments/slam_experiment_json.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/studies/validate.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/core/records/slam_samples.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

StudyWriter filled(const fs::path& folder, const Provenance& provenance) {
  StudyWriter store = StudyWriter(folder, study_start(test::small_slam_experiment(), provenance));
  const std::vector<SlamTiming> timings = {
      {.run = "drive", .method = SlamMethod::kRefined, .seconds = 1.0},
      {.run = "drive", .method = SlamMethod::kRefined, .seconds = 0.5}};
  store.write(part_of(test::made_up_slam_run("drive"), timings));
  store.write(part_of(test::made_up_convergence("white")));
  store.write(part_of(test::made_up_histories()));
  store.write(part_of(test::made_up_space_run()));
  const std::vector<FactorizationCost> costs = {{.landmarks = 4, .steps = 20, .seconds = 0.001}};
  store.write(part_of(costs));
  return store;
}

TEST(SlamStudy, IsReadBackAsItWasWritten) {
  const test::TemporaryFolder folder;
  { filled(folder.path(), test::made_up_provenance()); }
  const SlamStudy study = read_slam_study(folder.path());
  EXPECT_EQ(study.experiment.name, "small");
  ASSERT_EQ(study.runs.size(), 1U);
  EXPECT_EQ(slam_run_json(study.runs[0]), slam_run_json(test::made_up_slam_run("drive")));
  EXPECT_EQ(study.runs[0].records[0].error_m[1], 0.2);
  EXPECT_TRUE(std::isnan(study.runs[0].records[0].error_m[2]));
  EXPECT_EQ(study.runs[0].records[0].estimate.landmark_cov_m2[2](0, 1), 0.5);
  EXPECT_FALSE(study.runs[0].log.true_landmarks->row(1).allFinite());
  ASSERT_EQ(study.convergence.size(), 1U);
  EXPECT_EQ(convergence_json(study.convergence[0]),
            convergence_json(test::made_up_convergence("white")));
  ASSERT_TRUE(study.histories);
  EXPECT_EQ(range_histories_json(*study.histories),
            range_histories_json(test::made_up_histories()));
  ASSERT_TRUE(study.space);
  EXPECT_EQ(space_run_json(*study.space), space_run_json(test::made_up_space_run()));
  EXPECT_TRUE(study.space->records[1].estimate.empty());
  EXPECT_EQ(study_schema(folder.path()), "mapproof.slam_study");
}

TEST(SlamStudy, TakesTheLaterOfTwoTimings) {
  const test::TemporaryFolder folder;
  { filled(folder.path(), test::made_up_provenance()); }
  const SlamTimings timings = read_slam_timings(folder.path());
  ASSERT_EQ(timings.methods.size(), 1U);
  EXPECT_EQ(timings.methods[0].seconds, 0.5);
  ASSERT_EQ(timings.factorization.size(), 1U);
  EXPECT_EQ(timings.factorization[0].steps, 20);
}

TEST(SlamStudy, OfDataThatAreMissingHasTheirSourceAndNoRun) {
  const test::TemporaryFolder folder;
  {
    StudyWriter(folder.path(),
                study_start(test::small_slam_experiment(), test::made_up_provenance()));
  }
  const SlamStudy study = read_slam_study(folder.path());
  EXPECT_TRUE(study.runs.empty());
  ASSERT_EQ(study.experiment.data.size(), 1U);
  EXPECT_EQ(study.experiment.data[0].title, "A drive");
  EXPECT_EQ(study.experiment.data[0].source, "Ask for it.");
}

TEST(SlamStudy, KnowsWhatItHoldsAndWhatIsDamagedOrOfAnotherLog) {
  const test::TemporaryFolder folder;
  const StudyWriter store = filled(folder.path(), test::made_up_provenance());
  const SlamRun run = test::made_up_slam_run("drive");
  EXPECT_TRUE(holds_run(folder.path(), "drive", run.log));
  EXPECT_TRUE(holds_convergence(folder.path(), "white"));
  EXPECT_TRUE(holds_histories(folder.path()));
  EXPECT_TRUE(holds_space(folder.path()));
  EXPECT_FALSE(holds_run(folder.path(), "simulation"));
  EXPECT_FALSE(holds_convergence(folder.path(), "correlated"));
  RangeLog other = run.log;
  other.ranges[0].range_m += 1e-9;
  EXPECT_FALSE(holds_run(folder.path(), "drive", other));
  fs::resize_file(folder / "runs/drive.json", 1000);
  EXPECT_FALSE(holds_run(folder.path(), "drive", run.log));
}

TEST(SlamStudy, WritesEachPathAsTumAndCsv) {
  const test::TemporaryFolder folder;
  { filled(folder.path(), test::made_up_provenance()); }
  for (const char* file : {"groundtruth.tum", "groundtruth.csv", "refined.tum", "refined.csv"})
    EXPECT_TRUE(fs::exists(folder / "paths/drive" / file)) << file;
  EXPECT_FALSE(fs::exists(folder / "paths/drive/ekf.csv"));
  EXPECT_TRUE(
      read_file(folder / "paths/drive/refined.csv").starts_with("time_s,x_m,y_m,heading_rad"));
}

TEST(SlamStudy, OfAnotherExperimentOrAnotherKindIsRefusedAndKept) {
  const test::TemporaryFolder folder;
  { filled(folder.path(), test::made_up_provenance()); }
  SlamExperiment other = test::small_slam_experiment();
  other.seed = 8;
  EXPECT_THROW(StudyWriter(folder.path(), study_start(other, test::made_up_provenance())), IoError);
  EXPECT_THROW(
      StudyWriter(folder.path(), study_start(test::small_experiment(), test::made_up_provenance())),
      IoError);
  EXPECT_TRUE(fs::exists(folder / "runs/drive.json"));
  const test::TemporaryFolder mapping;
  {
    StudyWriter(mapping.path(), study_start(test::small_experiment(), test::made_up_provenance()));
  }
  EXPECT_THROW(StudyWriter(mapping.path(), study_start(other, test::made_up_provenance())),
               IoError);
  EXPECT_EQ(study_schema(mapping.path()), "mapproof.study");
}

TEST(SlamStudy, OfAnotherSolverIsMadeAgain) {
  const test::TemporaryFolder folder;
  { filled(folder.path(), test::made_up_provenance()); }
  Provenance newer = test::made_up_provenance();
  newer.solver_digest = "another";
  const StudyWriter store =
      StudyWriter(folder.path(), study_start(test::small_slam_experiment(), newer));
  EXPECT_EQ(store.redone(), "another solver");
  EXPECT_FALSE(fs::exists(folder / "runs/drive.json"));
  EXPECT_FALSE(fs::exists(folder / "histories.json"));
}

TEST(SlamStudy, IsValidAndEachDamagedFileOfItIsNamed) {
  const test::TemporaryFolder folder;
  { filled(folder.path(), test::made_up_provenance()); }
  for (const Finding& finding : validate(folder.path())) EXPECT_EQ(finding.problem, "");
  for (const char* file :
       {"runs/drive.json", "convergence/white.json", "histories.json", "space.json"}) {
    const std::string whole = read_file(folder / file);
    write_file(folder / file, whole.substr(0, whole.size() / 2));
    int named = 0;
    for (const Finding& finding : validate(folder.path()))
      named += finding.problem.find(file) != std::string::npos;
    EXPECT_EQ(named, 1) << file;
    write_file(folder / file, whole);
  }
}

TEST(SlamRun, OfAnOlderVersionHasNoUpgrade) {
  std::string text = slam_run_json(test::made_up_slam_run("drive"));
  const std::size_t start = text.find("\"upgrade\""), end = text.find("\"published\"");
  text.erase(start, end - start);
  EXPECT_FALSE(parse_slam_run(text, "old.json").upgrade);
}

TEST(SpaceRun, WithNumbersThatDoNotFitIsRefused) {
  const auto refused = [](auto change) {
    SpaceRun run = test::made_up_space_run();
    change(run);
    EXPECT_THROW(parse_space_run(space_run_json(run), "space.json"), IoError);
  };
  refused([](SpaceRun& run) { run.landmarks_m(0, 0) = NAN; });
  refused([](SpaceRun& run) { run.records[0].estimate.landmarks_m.conservativeResize(4, 3); });
  refused([](SpaceRun& run) { run.records[0].estimate.positions_m.conservativeResize(1, 3); });
  refused([](SpaceRun& run) { run.known = {5}; });
}

TEST(SlamExperiment, IsReadBackAsItWasWritten) {
  const std::string text = slam_experiment_json(test::small_slam_experiment());
  EXPECT_EQ(slam_experiment_json(parse_slam_experiment(text, "e.json")), text);
}

TEST(SlamExperiment, ProfilesReplaceWhatTheyName) {
  const std::string text = R"({"schema": {"name": "mapproof.slam_experiment", "version": 1},
    "name": "x", "methods": ["ekf"], "seed": 1, "profiles": {"quick": {"seed": 2}}})";
  EXPECT_EQ(parse_slam_experiment(text, "e.json").seed, 1U);
  EXPECT_EQ(parse_slam_experiment(text, "e.json", "quick").seed, 2U);
  EXPECT_THROW(parse_slam_experiment(text, "e.json", "slow"), IoError);
}

}  // namespace
}  // namespace mapproof
