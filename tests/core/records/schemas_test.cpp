#include <gtest/gtest.h>

#include <map>

#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/experiments/slam_experiment_json.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/studies/slam_store.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/studies/validate.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/core/records/slam_samples.hpp"
#include "tests/support/schemas/file_schemas.hpp"
#include "tests/support/schemas/schema_problem.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::schema_problem;

/// "mapproof.run" -> "run".
std::string kind_of(const json& value) {
  return value.at("schema").at("name").get<std::string>().substr(std::string("mapproof.").size());
}

TEST(Schemas, AreThoseOfTheCode) {
  for (const auto& [name, text] : test::file_schemas())
    EXPECT_EQ(read_file(fs::path(MAPPROOF_SOURCE_DIR) / "docs/schemas" / name), text)
        << "cmake --build build --target write_schemas";
}

/// The keys below a node of a schema that say nothing of themselves, by their pointers.
void gather_silent_keys(const json& node, const std::string& at, std::vector<std::string>& silent) {
  if (node.is_array())
    for (std::size_t i = 0; i < node.size(); ++i)
      gather_silent_keys(node[i], at + "/" + std::to_string(i), silent);
  if (!node.is_object()) return;
  for (const auto& [key, value] : node.items()) {
    // Conditions on keys that are described elsewhere.
    if (key == "anyOf" || key == "oneOf" || key == "allOf" || key == "not") continue;
    if (key == "properties")
      for (const auto& [name, child] : value.items())
        if (child.is_object() && !child.contains("description")) silent.push_back(at + "/" + name);
    gather_silent_keys(value, at + "/" + key, silent);
  }
}

TEST(Schemas, DescribeEveryKeyOfAnExperiment) {
  for (const char* name : {"experiment", "slam_experiment", "topic_experiment"}) {
    std::vector<std::string> silent;
    gather_silent_keys(json::parse(test::file_schemas().at(std::string(name) + ".schema.json")),
                       name, silent);
    EXPECT_TRUE(silent.empty()) << silent.front();
  }
}

TEST(Schemas, HoldForEveryFileOfAStudy) {
  const test::TemporaryFolder folder;
  {
    StudyWriter store = StudyWriter(
        folder.path(), study_start(test::small_experiment(), test::made_up_provenance()));
    RunResult result = test::made_up_result({1, 1});
    result.maps.push_back(result.maps[0]);
    result.maps[1].ground_truth_m.reset();
    store.write(part_of(result));
    store.write_session(test::made_up_session());
  }
  for (const char* file : {"study.json", "runs/layout-1-pose-1.json", "maps/layout-1-pose-1.json",
                           "details/layout-1-pose-1.json"}) {
    const json value = json::parse(read_file(folder / file));
    EXPECT_EQ(schema_problem(kind_of(value), value), "") << file;
  }
  std::istringstream lines(read_file(folder / "timings.jsonl"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(schema_problem("timing", json::parse(line)), "") << line;
  EXPECT_EQ(count, 4);
}

TEST(Schemas, HoldForMapsAndObservations) {
  const json map = json::parse(read_file(test::data_file("maps/map.json")));
  EXPECT_EQ(schema_problem("map", map), "");
  const auto history =
      read_observations(test::data_file("observations/wide_named.csv"), Sensor::kVisibility);
  EXPECT_EQ(schema_problem("observations", json::parse(observations_json(history.history))), "");
  const DetectionSource seen = read_detections(test::data_file("mrclam"));
  EXPECT_EQ(schema_problem("detections", json::parse(detections_json(seen.log))), "");
}

TEST(Schemas, HoldForEveryExperimentInTheTemplatesAndTheirProfiles) {
  int count = 0;
  for (const fs::path& folder :
       {fs::path(MAPPROOF_SOURCE_DIR) / "experiments", test::data_file("experiments")})
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string text = read_file(entry.path());
      const json value = json::parse(text);
      EXPECT_EQ(schema_problem(kind_of(value), value), "") << entry.path();
      if (kind_of(value) != "experiment") continue;
      for (const std::string& profile :
           profile_names(text, entry.path().string(), "mapproof.experiment")) {
        const Experiment experiment = parse_experiment(text, entry.path().string(), profile);
        EXPECT_EQ(schema_problem("experiment", json::parse(experiment_json(experiment))), "")
            << entry.path() << " " << profile;
      }
      ++count;
    }
  EXPECT_GE(count, 2);
}

TEST(Schemas, HoldForTheRangeOnlyExperimentAndItsProfiles) {
  const fs::path path = fs::path(MAPPROOF_SOURCE_DIR) / "experiments/boots2013.json";
  const std::string text = read_file(path);
  for (const std::string& profile :
       profile_names(text, path.string(), "mapproof.slam_experiment")) {
    const std::string whole =
        slam_experiment_json(parse_slam_experiment(text, path.string(), profile));
    EXPECT_EQ(schema_problem("slam_experiment", json::parse(whole)), "") << profile;
  }
}

TEST(Schemas, HoldForEveryFileOfARangeOnlyStudy) {
  const SlamExperiment experiment = test::small_slam_experiment();
  for (const std::string& text :
       {slam_run_json(test::made_up_slam_run("drive")),
        convergence_json(test::made_up_convergence("white")),
        range_histories_json(test::made_up_histories()), slam_experiment_json(experiment),
        space_run_json(test::made_up_space_run()),
        slam_study_json(experiment, test::made_up_provenance())}) {
    const json value = json::parse(text);
    EXPECT_EQ(schema_problem(kind_of(value), value), "") << kind_of(value);
  }
  const SlamTiming timing{.run = "drive", .method = SlamMethod::kRefined, .seconds = 0.5};
  EXPECT_EQ(schema_problem("timing", json::parse(timing_line(timing))), "");
  const FactorizationCost cost{.landmarks = 4, .steps = 20, .seconds = 0.001};
  EXPECT_EQ(schema_problem("timing", json::parse(timing_line(cost))), "");
}

struct Damage {
  std::string kind;
  std::string pointer;
  json value;  ///< null: the key is removed.
};

std::ostream& operator<<(std::ostream& out, const Damage& damage) {
  return out << damage.kind << damage.pointer << " = " << damage.value;
}

class Damaged : public ::testing::TestWithParam<Damage> {
 protected:
  /// A sound file of the kind.
  json sound(const std::string& kind) const {
    if (kind == "experiment") return read("experiments/small.json");
    if (kind == "map") return read("maps/map.json");
    if (kind == "slam_experiment")
      return json::parse(slam_experiment_json(test::small_slam_experiment()));
    if (kind == "slam_run") return json::parse(slam_run_json(test::made_up_slam_run("drive")));
    if (kind == "slam_convergence")
      return json::parse(convergence_json(test::made_up_convergence("white")));
    if (kind == "range_histories")
      return json::parse(range_histories_json(test::made_up_histories()));
    if (kind == "space_run") return json::parse(space_run_json(test::made_up_space_run()));
    if (kind == "observations") return read("observations/observations.json");
    StudyWriter(folder_.path(), study_start(test::small_experiment(), test::made_up_provenance()))
        .write(part_of(test::made_up_result({1, 1})));
    if (kind == "study") return json::parse(read_file(folder_ / "study.json"));
    const char* subfolder = kind == "run" ? "runs" : kind == "maps" ? "maps" : "details";
    return json::parse(read_file(folder_ / subfolder / "layout-1-pose-1.json"));
  }

  const test::TemporaryFolder folder_;

 private:
  static json read(const std::string& file) {
    return json::parse(read_file(test::data_file(file)));
  }
};

TEST_P(Damaged, FileIsRefusedByTheSchemaAndByTheReader) {
  const Damage& damage = GetParam();
  json value = sound(damage.kind);
  ASSERT_EQ(schema_problem(damage.kind, value), "");
  const json::json_pointer location(damage.pointer);
  if (damage.value.is_null())
    value[location.parent_pointer()].erase(location.back());
  else
    value[location] = damage.value;
  EXPECT_NE(schema_problem(damage.kind, value), "");
  const fs::path path = folder_.file("damaged.json", value.dump());
  EXPECT_NE(validate(path).at(0).problem, "") << value.dump(1);
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, Damaged,
    ::testing::Values(
        Damage{"experiment", "/schema/version", 2}, Damage{"experiment", "/schema", nullptr},
        Damage{"experiment", "/name", "a b"}, Damage{"experiment", "/layouts", 1e9},
        Damage{"experiment", "/seed", -1}, Damage{"experiment", "/colour", "red"},
        Damage{"experiment", "/sensors/sonar", json::object()},
        Damage{"experiment", "/sensors/range/methods/isomapp", json::object()},
        Damage{"experiment", "/sensors/range/methods/isomap", json::object()},
        Damage{"experiment", "/sensors/range/checkpoints/0", 2},
        Damage{"experiment", "/sensors/visibility/noise", 0.6},
        Damage{"experiment", "/sensors/visibility/published/values/0/K", nullptr},
        Damage{"experiment", "/profiles/tiny", 3}, Damage{"study", "/experiment/poses", 0},
        Damage{"study", "/provenance/commit", nullptr},
        Damage{"study", "/provenance/libraries/0/version", 3}, Damage{"run", "/run/layout", 0},
        Damage{"run", "/world/landmarks_m/0", {1}}, Damage{"run", "/records/0/sensor", "sonar"},
        Damage{"run", "/records/0/K", 4}, Damage{"run", "/records/1/K", "six"},
        Damage{"run", "/records/1/statuses/0/code", "tired"},
        Damage{"run", "/records/1/certificate/solver", "magic"},
        Damage{"run", "/records/1/certificate/relative_gap", -1},
        Damage{"run", "/records/0/score/moe_percent", 101}, Damage{"run", "/anchors", {1, 1}},
        Damage{"run", "/occlusion/hidden", -1}, Damage{"run", "/variations/0/K", nullptr},
        Damage{"run", "/variations/1/level", "high"},
        Damage{"experiment", "/variations/0/quantity", "weather"},
        Damage{"experiment", "/variations/0/id", "Noise"},
        Damage{"experiment", "/variations/0/levels", json::array()},
        Damage{"experiment", "/variations/0/sensor", "sonar"},
        Damage{"experiment", "/figures/0/kind", "pie"},
        Damage{"experiment", "/figures/0/id", nullptr},
        Damage{"experiment", "/solver/smacof_relative_fall", 2},
        Damage{"experiment", "/anchor_placement", "moon"},
        Damage{"details", "/sensors/0/scan/views/0", "lost"},
        Damage{"details", "/sensors/0/scan/step", 0}, Damage{"details", "/path/positions_m/0", {1}},
        Damage{"details", "/sensors/0/distances/0", "far"},
        Damage{"details", "/sensors/0/spectra/0/method", "magic"}, Damage{"maps", "/names/0", ""},
        Damage{"maps", "/maps/0/estimate", nullptr}, Damage{"maps", "/maps/0/frame", "lies"},
        Damage{"map", "/names", {"a", "a"}}, Damage{"map", "/ground_truth_m", nullptr},
        Damage{"map", "/step", -1}, Damage{"map", "/estimate/0", {1, 2, 3}},
        Damage{"slam_experiment", "/colour", "red"}, Damage{"slam_experiment", "/methods", nullptr},
        Damage{"slam_experiment", "/methods/0", "magic"},
        Damage{"slam_experiment", "/world/landmarks", 3},
        Damage{"slam_experiment", "/convergence/noises/0/correlation", 1},
        Damage{"slam_experiment", "/data/0/id", "A b"},
        Damage{"slam_experiment", "/histories/methods/0", "magic"},
        Damage{"slam_run", "/log/ground_truth/x_m", nullptr}, Damage{"slam_run", "/log/start", {1}},
        Damage{"slam_run", "/log/ranges/landmark/0", -1},
        Damage{"slam_run", "/records/0/method", "magic"},
        Damage{"slam_run", "/records/0/errors/0/alignment", "some"},
        Damage{"slam_run", "/records/0/errors/0/path_mean_m", -1},
        Damage{"slam_run", "/records/0/landmark_cov_m2/0", {1, 2}},
        Damage{"slam_run", "/records/0/statuses/0/code", "tired"},
        Damage{"slam_run", "/windows/chosen_s", "long"}, Damage{"slam_run", "/starts/0/number", 0},
        Damage{"slam_experiment", "/space/known", 4},
        Damage{"slam_run", "/upgrade/before/points/0", {1, 2}},
        Damage{"slam_run", "/upgrade/after/quadric/0", {1, 2, 3}},
        Damage{"space_run", "/records/0/alignment", "some"},
        Damage{"space_run", "/records/0/landmarks_m/0", {1, 2}},
        Damage{"space_run", "/landmarks_m", nullptr},
        Damage{"slam_convergence", "/points/0/steps", 0},
        Damage{"slam_convergence", "/points/0/sine/mean", "x"},
        Damage{"range_histories", "/maps/0/K", nullptr},
        Damage{"range_histories", "/maps/1/squared", 1}, Damage{"observations", "/sensor", "sonar"},
        Damage{"observations", "/landmarks", json::array()},
        Damage{"observations", "/values/0/0", "1"},
        Damage{"observations", "/values/0", json::array()}));

}  // namespace
}  // namespace mapproof
