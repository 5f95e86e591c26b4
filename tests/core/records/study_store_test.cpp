#include "core/records/studies/study_store.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/experiment/run.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::error_of;
using test::made_up_provenance;
using test::made_up_result;
using test::small_experiment;
using test::TemporaryFolder;

/// The runs of the small experiment that the folder holds, whole.
std::vector<RunId> finished(const fs::path& folder) {
  std::vector<RunId> runs = runs_of(small_experiment());
  std::erase_if(runs, [&](const RunId& run) { return !holds_run(folder, run); });
  return runs;
}

StudyWriter open_store(const fs::path& folder) {
  return StudyWriter(folder, study_start(small_experiment(), made_up_provenance()));
}

TEST(StudyWriter, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  {
    StudyWriter store = open_store(folder / "study");
    store.write(part_of(made_up_result({.layout = 2, .pose = 1})));
    store.write(part_of(made_up_result({.layout = 1, .pose = 2})));
    store.write_session(test::made_up_session());
  }
  const Study study = read_study(folder / "study");
  EXPECT_EQ(experiment_json(study.experiment), experiment_json(small_experiment()));
  EXPECT_EQ(study.provenance.libraries, made_up_provenance().libraries);
  ASSERT_EQ(study.runs.size(), 2U);
  EXPECT_EQ(study.runs[0].id, (RunId{.layout = 1, .pose = 2}));
  const mapproof::Run expected = made_up_result({.layout = 2, .pose = 1}).run;
  const mapproof::Run& run = study.runs[1];
  EXPECT_EQ(run.world.landmarks_m, expected.world.landmarks_m);
  EXPECT_EQ(run.anchors, expected.anchors);
  ASSERT_EQ(run.records.size(), 2U);
  EXPECT_EQ(run.records[0].score->mpe_m, expected.records[0].score->mpe_m);
  EXPECT_EQ(run.records[1].setting, expected.records[1].setting);
  EXPECT_EQ(run.records[1].statuses, expected.records[1].statuses);
  EXPECT_EQ(run.records[1].stress, expected.records[1].stress);
  EXPECT_EQ(run.records[1].certificate, expected.records[1].certificate);
  EXPECT_FALSE(run.records[1].score.has_value());
}

TEST(StudyWriter, GivesBackVariationsAndDetails) {
  const TemporaryFolder folder;
  const RunId id{.layout = 1, .pose = 2};
  const RunResult written = made_up_result(id);
  open_store(folder.path()).write(part_of(written));
  const mapproof::Run run = read_study(folder.path()).runs.at(0);
  ASSERT_EQ(run.variations.size(), 2U);
  EXPECT_EQ(run.variations[0].level, 0.125);
  EXPECT_EQ(run.variations[0].score->mpe_m, written.run.variations[0].score->mpe_m);
  EXPECT_EQ(run.variations[1].setting, written.run.variations[1].setting);
  EXPECT_EQ(run.occlusion->hidden, 20);

  const RunDetails details = read_details(folder.path(), id).value();
  EXPECT_EQ(details.path.positions_m, written.details.path.positions_m);
  EXPECT_EQ(details.path.headings_rad, written.details.path.headings_rad);
  ASSERT_EQ(details.sensors.size(), 1U);
  const SensorDetails& sensor = details.sensors[0];
  EXPECT_EQ(sensor.views, written.details.sensors[0].views);
  EXPECT_EQ(sensor.first_steps, written.details.sensors[0].first_steps);
  EXPECT_TRUE(std::isnan(sensor.values(2)));
  EXPECT_TRUE(std::isnan(sensor.distances(2)));
  EXPECT_EQ(sensor.distances(5), 0.9);
  EXPECT_EQ(sensor.spectra[1].first, written.details.sensors[0].spectra[1].first);
  EXPECT_EQ(sensor.spectra[1].second, written.details.sensors[0].spectra[1].second);
  EXPECT_FALSE(read_details(folder.path(), {.layout = 2, .pose = 2}));
}

TEST(StudyWriter, KeepsTheMapsOfARunWithTheirHoles) {
  const TemporaryFolder folder;
  const RunId id{.layout = 1, .pose = 1};
  RunResult result = made_up_result(id);
  result.maps.push_back(result.maps[0]);
  result.maps[1].id += "-other";
  result.maps[1].anchors = {2};
  result.maps[1].ground_truth_m.reset();
  result.maps[1].frame = Frame::kSimilarity;
  open_store(folder.path()).write(part_of(result));
  const std::vector<MapRecord> maps = read_maps(folder.path(), id);
  ASSERT_EQ(maps.size(), 2U);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    EXPECT_EQ(maps[i].id, result.maps[i].id);
    EXPECT_EQ(maps[i].names, result.maps[i].names);
    EXPECT_EQ(maps[i].anchors, result.maps[i].anchors);
    EXPECT_EQ(maps[i].frame, result.maps[i].frame);
    EXPECT_EQ(maps[i].ground_truth_m, result.maps[i].ground_truth_m);
    EXPECT_EQ(maps[i].estimate.topRows(2), result.maps[i].estimate.topRows(2));
    EXPECT_TRUE(maps[i].estimate.row(2).array().isNaN().all());
  }
}

TEST(StudyWriter, WritesTheSameBytesInWhateverOrderRunsEnd) {
  const TemporaryFolder folder;
  std::vector<RunId> ids = {{1, 1}, {1, 2}, {2, 1}, {2, 2}};
  StudyWriter forwards = open_store(folder / "forwards");
  for (const RunId& id : ids) forwards.write(part_of(made_up_result(id)));
  StudyWriter at_once = open_store(folder / "at-once");
  std::vector<std::thread> threads;
  for (auto id = ids.rbegin(); id != ids.rend(); ++id)
    threads.emplace_back([&at_once, id] { at_once.write(part_of(made_up_result(*id))); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(contents(folder / "forwards"), contents(folder / "at-once"));
  EXPECT_EQ(read_timings(folder / "at-once").size(), 8U);
}

/// If this fails, studies made before the change can no longer be compared with those made after:
/// raise the version of the schema, keep reading the old one, and only then renew tests/data/study.
TEST(StudyWriter, StillWritesTheStudyThatTheTestDataHold) {
  const TemporaryFolder folder;
  StudyWriter store = open_store(folder.path());
  for (const RunId& id : {RunId{1, 1}, {1, 2}, {2, 1}, {2, 2}})
    store.write(part_of(made_up_result(id)));
  const TemporaryFolder frozen;
  std::filesystem::copy(test::data_file("study"), frozen / "study",
                        std::filesystem::copy_options::recursive);
  std::filesystem::remove(frozen / "study/results.csv");  // Of the runner, not of the writer.
  EXPECT_EQ(contents(folder.path()), contents(frozen / "study"));
}

TEST(StudyWriter, ResumesWithTheRunsThatAreWhole) {
  const TemporaryFolder folder;
  {
    StudyWriter store = open_store(folder.path());
    store.write(part_of(made_up_result({1, 1})));
    store.write(part_of(made_up_result({1, 2})));
    store.write(part_of(made_up_result({2, 1})));
  }
  const std::string whole = contents(folder.path());
  const std::string run = read_file(folder / "runs/layout-1-pose-1.json");
  write_file(folder / "runs/layout-1-pose-1.json", run.substr(0, run.size() / 2));
  fs::remove(folder / "maps/layout-1-pose-2.json");
  folder.file("runs/layout-9-pose-9.json", "{}");
  StudyWriter store = open_store(folder.path());
  EXPECT_EQ(store.redone(), "");
  EXPECT_EQ(finished(folder.path()), (std::vector<RunId>{{2, 1}}));
  fs::remove(folder / "runs/layout-9-pose-9.json");
  store.write(part_of(made_up_result({1, 1})));
  store.write(part_of(made_up_result({1, 2})));
  EXPECT_EQ(contents(folder.path()), whole);
}

TEST(StudyWriter, RedoesTheRunsOfAnotherSolver) {
  const TemporaryFolder folder;
  open_store(folder.path()).write(part_of(made_up_result({1, 1})));
  StudyWriter store =
      StudyWriter(folder.path(), study_start(small_experiment(), made_up_provenance("another")));
  EXPECT_EQ(store.redone(), "another solver");
  EXPECT_TRUE(finished(folder.path()).empty());
  EXPECT_TRUE(read_timings(folder.path()).empty());
  EXPECT_EQ(read_study(folder.path()).provenance.solver_digest, "another");
}

TEST(StudyWriter, NamesTheDifferenceToTheExperimentInTheFolder) {
  const TemporaryFolder folder;
  open_store(folder / "study");
  Experiment other = small_experiment();
  other.seed = 8;
  const std::string path = (folder / "study").string();
  EXPECT_EQ(error_of([&] { StudyWriter(path, study_start(other, made_up_provenance())); }),
            path +
                ": holds another experiment (/seed is 7 there and 8 here); choose another folder "
                "or remove it");
  other = small_experiment();
  other.sensors[0].methods.pop_back();
  EXPECT_NE(error_of([&] {
              StudyWriter(path, study_start(other, made_up_provenance()));
            }).find("/sensors/visibility/methods/isomap is {\"K\":[4,5]} there and missing here"),
            std::string::npos);
}

TEST(StudyWriter, LeavesAFolderWithOtherFilesAlone) {
  const TemporaryFolder folder;
  folder.file("thesis.tex", "years of work");
  EXPECT_EQ(error_of([&] { open_store(folder.path()); }),
            folder.path().string() + ": is not empty and holds no study; choose another folder");
  EXPECT_EQ(contents(folder.path()), "== thesis.tex\nyears of work");
}

TEST(StudyWriter, RefusesAFileInPlaceOfTheFolder) {
  const TemporaryFolder folder;
  const fs::path file = folder.file("file", "");
  EXPECT_NE(error_of([&] { open_store(file); }).find("file: "), std::string::npos);
  EXPECT_NE(error_of([&] { open_store(file / "below"); }).find("cannot be made"),
            std::string::npos);
}

TEST(StudyWriter, RemovesWhatAKilledProcessLeft) {
  const TemporaryFolder folder;
  open_store(folder / "study").write(part_of(made_up_result({1, 1})));
  const std::string before = contents(folder.path());
  folder.file("study/study.json.part-999999999-0123456789abcdef", "half");
  folder.file("study/runs/layout-1-pose-2.json.part-999999999-0123456789abcdef", "half");
  folder.file("study/figures/map.svg.part-999999999-0123456789abcdef", "half");
  folder.file("new/study.json.part-999999999-0123456789abcdef", "half");
  open_store(folder / "study");
  EXPECT_EQ(contents(folder / "study"), contents(folder / "study"));
  open_store(folder / "new");
  fs::remove_all(folder / "new");
  EXPECT_EQ(contents(folder.path()), before);
}

TEST(StudyWriter, RemovesNoFileOfTheUserWithTheNameOfALeftover) {
  const TemporaryFolder folder;
  open_store(folder / "study");
  const std::vector<std::string> mine = {
      "study/movie.part-99999",  "study/notes.part-4000000-abc",
      "study/big.tar.part-123",  "study/runs/a.part-999999999-0123456789ABCDEF",
      "study/sub/x.part-123456", "study/sub/study.json.part-999999999-0123456789abcdef"};
  for (const std::string& file : mine) folder.file(file, "mine");
  open_store(folder / "study");
  for (const std::string& file : mine) EXPECT_EQ(read_file(folder / file), "mine") << file;
}

TEST(StudyReader, TellsAStudyFromOtherFolders) {
  const TemporaryFolder folder;
  EXPECT_FALSE(is_study(folder.path()));
  EXPECT_FALSE(is_study(folder / "missing"));
  EXPECT_EQ(error_of([&] { read_study(folder.path()); }),
            folder.path().string() + ": holds no study: study.json is missing");
  EXPECT_EQ(error_of([&] { read_study(folder / "missing"); }),
            (folder / "missing").string() + ": does not exist");
  open_store(folder.path());
  EXPECT_TRUE(is_study(folder.path()));
  EXPECT_TRUE(read_study(folder.path()).runs.empty());
}

TEST(StudyReader, NamesADamagedFile) {
  const TemporaryFolder folder;
  open_store(folder.path()).write(part_of(made_up_result({1, 1})));
  const fs::path path = folder / "runs/layout-1-pose-1.json";
  const std::string run = read_file(path);
  write_file(path, run.substr(0, run.size() / 2));
  EXPECT_NE(error_of([&] { read_study(folder.path()); }).find("the file is truncated"),
            std::string::npos);
  write_file(path, "");
  EXPECT_EQ(error_of([&] { read_study(folder.path()); }), path.string() + ": is empty");
}

TEST(StudyReader, NoticesAFileUnderAnotherRunsName) {
  const TemporaryFolder folder;
  open_store(folder.path()).write(part_of(made_up_result({1, 1})));
  fs::rename(folder / "runs/layout-1-pose-1.json", folder / "runs/layout-2-pose-2.json");
  fs::rename(folder / "maps/layout-1-pose-1.json", folder / "maps/layout-2-pose-2.json");
  EXPECT_NE(error_of([&] { read_study(folder.path()); }).find("states that it is layout-1-pose-1"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              read_maps(folder.path(), {2, 2});
            }).find("layout-1-pose-1"),
            std::string::npos);
  EXPECT_TRUE(finished(folder.path()).empty());
}

TEST(Timings, AreSortedAndTheLaterOfTwoCounts) {
  const TemporaryFolder folder;
  StudyWriter store = open_store(folder.path());
  store.write(part_of(made_up_result({2, 1})));
  RunResult again = made_up_result({1, 1});
  store.write(part_of(again));
  again.timings[0].seconds = 9.0;
  store.write(part_of(again));
  const std::vector<Timing> timings = read_timings(folder.path());
  ASSERT_EQ(timings.size(), 4U);
  EXPECT_EQ(timings[0].run, (RunId{1, 1}));
  EXPECT_EQ(timings[0].sensor, Sensor::kVisibility);
  EXPECT_EQ(timings[1].seconds, 9.0);
  EXPECT_EQ(timings[3].run, (RunId{2, 1}));
}

TEST(Timings, LoseOnlyALineThatAKillTore) {
  const TemporaryFolder folder;
  {
    StudyWriter store = open_store(folder.path());
    store.write_session(test::made_up_session());
    store.write(part_of(made_up_result({1, 1})));
  }
  const std::string text = read_file(folder / "timings.jsonl");
  write_file(folder / "timings.jsonl", text.substr(0, text.size() - 20));
  EXPECT_EQ(read_timings(folder.path()).size(), 1U);
  EXPECT_EQ(read_sessions(folder.path()).size(), 1U);
  open_store(folder.path()).write_session(test::made_up_session());
  EXPECT_EQ(read_timings(folder.path()).size(), 1U);
  ASSERT_EQ(read_sessions(folder.path()).size(), 2U);
  EXPECT_EQ(read_sessions(folder.path())[1].command, test::made_up_session().command);
}

TEST(Timings, NameTheLineThatIsDamaged) {
  const TemporaryFolder folder;
  open_store(folder.path());
  folder.file("timings.jsonl", "{\"kind\": \"nap\"}\n");
  EXPECT_EQ(error_of([&] { read_timings(folder.path()); }),
            (folder / "timings.jsonl").string() +
                ": line 1: /kind: the kind \"nap\" is unknown: did you mean \"map\"?");
}

}  // namespace
}  // namespace mapproof
