#include "core/records/experiments/experiment_json.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/studies/run_json.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using nlohmann::json;
using test::error_of;

const std::filesystem::path kTemplate =
    std::filesystem::path(MAPPROOF_SOURCE_DIR) / "experiments/yairi2007.json";

/// The error for small.json with one value replaced, or removed if it is null.
std::string experiment_error(const std::string& pointer, const json& value) {
  json experiment = json::parse(read_file(test::data_file("experiments/small.json")));
  const json::json_pointer location(pointer);
  if (value.is_null())
    experiment[location.parent_pointer()].erase(location.back());
  else
    experiment[location] = value;
  return error_of([&] { parse_experiment(experiment.dump(), "e.json"); });
}

TEST(ExperimentJson, ComesBackTheSameFromItsOwnText) {
  for (const char* profile : {"", "tiny", "noisy"}) {
    const Experiment experiment = parse_experiment(
        read_file(test::data_file("experiments/small.json")), "small.json", profile);
    const std::string text = experiment_json(experiment);
    EXPECT_EQ(experiment_json(parse_experiment(text, "again")), text);
  }
}

TEST(ExperimentJson, GivesMethodsOfOthersToEverySensor) {
  json file = json::parse(read_file(test::data_file("experiments/small.json")));
  file["external_methods"] = json::parse(
      R"([{"name": "tsne", "label": "t-SNE", "source": "2008", "input": "distances",
           "command": ["python3", "tsne.py"], "files": ["tsne.py"], "timeout_s": 5,
           "parameter": {"symbol": "perplexity", "values": [2, 4.5]}},
          {"name": "other", "label": "Other", "input": "history", "command": ["./other"]}])");
  const Experiment experiment = parse_experiment(file.dump(), "e.json");
  ASSERT_EQ(experiment.external_methods.size(), 2U);
  EXPECT_FALSE(experiment.external_methods[0].folder);
  for (const SensorStudy& sensor : experiment.sensors) {
    const std::vector<MethodSetting> settings = settings_of(sensor);
    ASSERT_GE(settings.size(), 4U);
    EXPECT_EQ(slug(settings[settings.size() - 3]), "tsne-perplexity2");
    EXPECT_EQ(label(settings[settings.size() - 2]), "t-SNE, perplexity = 4.5");
    EXPECT_EQ(slug(settings.back()), "other");
    EXPECT_EQ(find_external(experiment, settings.back().method), &experiment.external_methods[1]);
    EXPECT_EQ(find_external(experiment, settings.front().method), nullptr);
  }
  const std::string text = experiment_json(experiment);
  EXPECT_EQ(experiment_json(parse_experiment(text, "again")), text);
  file["external_methods"][1]["name"] = "isomap";
  EXPECT_EQ(error_of([&] { parse_experiment(file.dump(), "e.json"); }),
            "e.json: /external_methods/1/name: \"isomap\" is a method of mapproof");
  file["external_methods"][1]["name"] = "isomap-";
  file["external_methods"][1]["parameter"] = {{"symbol", "K"}, {"values", {4}}};
  EXPECT_NO_THROW(parse_experiment(file.dump(), "e.json"));
}

TEST(RunJson, DescribesMethodsOfOthers) {
  const Method tsne =
      external_method({.name = "tsne", .label = "t-SNE", .source = "2008", .symbol = "perplexity"});
  mapproof::Run run{
      .id = {1, 1}, .world = {}, .anchors = {}, .occlusion = {}, .records = {}, .variations = {}};
  run.records.push_back({.sensor = Sensor::kBearing,
                         .setting = {tsne, 2.5},
                         .step = 10,
                         .statuses = {status_of<StatusReason::kMethodRefused>({"no licence"}),
                                      status_of<StatusReason::kMethodTimeout>(0.5)},
                         .score = {},
                         .certificate = {}});
  const std::string text = run_json(run);
  const mapproof::Run again = parse_run(text, "run.json");
  EXPECT_EQ(again.records[0].setting, run.records[0].setting);
  EXPECT_EQ(again.records[0].statuses, run.records[0].statuses);
  const auto error_without = [&](const char* key) {
    json file = json::parse(text);
    file["records"][0].erase(key);
    return error_of([&] { parse_run(file.dump(), "run.json"); });
  };
  EXPECT_EQ(error_without("external"),
            "run.json: /records/0/method: unknown method \"tsne\": did you mean \"sde\"?");
  EXPECT_EQ(error_without("parameter"),
            "run.json: /records/0/external: has the symbol of a parameter, which is missing");
  json ours = json::parse(text);
  ours["records"][0]["method"] = "lpca";
  EXPECT_EQ(error_of([&] { parse_run(ours.dump(), "run.json"); }),
            "run.json: /records/0: unknown key \"external\"");
}

TEST(ExperimentJson, TakesDefaultsForWhatIsLeftOut) {
  const Experiment experiment = test::small_experiment();
  EXPECT_EQ(experiment.title, "small");
  EXPECT_EQ(experiment.walk.step_m, WalkOptions{}.step_m);
  EXPECT_EQ(experiment.world.gap_m, WorldOptions{}.gap_m);
  EXPECT_EQ(experiment.affine_fit, AffineFit::kLeastDistances);
  EXPECT_TRUE(experiment.sensors[0].sensor.occlusion);
}

TEST(ExperimentJson, PutsMethodsInTheOrderOfTheTablesAndSensorsInTheirs) {
  const Experiment experiment = test::small_experiment();
  ASSERT_EQ(experiment.sensors.size(), 2U);
  EXPECT_EQ(experiment.sensors[0].sensor.sensor, Sensor::kVisibility);
  EXPECT_EQ(experiment.sensors[1].sensor.sensor, Sensor::kRange);
  EXPECT_EQ(experiment.sensors[0].methods[0].method, Method::kLpca);
  EXPECT_EQ(experiment.sensors[0].methods[1].method, Method::kIsomap);
  EXPECT_EQ(experiment.sensors[0].methods[1].parameters, (std::vector{4.0, 5.0}));
}

TEST(ExperimentJson, AppliesAProfileAsAMergePatch) {
  const std::string text = read_file(test::data_file("experiments/small.json"));
  EXPECT_EQ(profile_names(text, "e.json", "mapproof.experiment"),
            (std::vector<std::string>{"noisy", "tiny"}));
  const Experiment tiny = parse_experiment(text, "e.json", "tiny");
  EXPECT_EQ(tiny.layouts, 1);
  EXPECT_EQ(tiny.sensors.size(), 1U);
  EXPECT_EQ(parse_experiment(text, "e.json", "noisy").sensors[0].sensor.noise, 0.1);
  EXPECT_EQ(error_of([&] { parse_experiment(text, "e.json", "big"); }),
            "e.json: /profiles: no profile \"big\": it has \"noisy\", \"tiny\"");
}

TEST(ExperimentJson, NamesTheProfileInItsErrors) {
  json experiment = json::parse(read_file(test::data_file("experiments/small.json")));
  experiment["profiles"]["tiny"]["poses"] = 0;
  EXPECT_EQ(error_of([&] { parse_experiment(experiment.dump(), "e.json", "tiny"); }),
            "e.json with profile tiny: /poses: expected an integer from 1 to 10000, got 0");
}

TEST(ExperimentJson, QuotesTheProfilesThatItHasAndListsFive) {
  json experiment = json::parse(read_file(test::data_file("experiments/small.json")));
  experiment["profiles"] = {{"a\x1b[2J\n", json::object()}};
  for (const char* name : {"b", "c", "d", "e", "f", "g"})
    experiment["profiles"][name] = json::object();
  EXPECT_EQ(error_of([&] { parse_experiment(experiment.dump(), "e.json", "none"); }),
            "e.json: /profiles: no profile \"none\": it has \"a\\u{001B}[2J\\u{000A}\", \"b\", "
            "\"c\", \"d\", \"e\" and 2 more");
}

/// What was published for that method in the study of a sensor.
const PublishedValue& published_for(const SensorStudy& study, Method method) {
  for (const PublishedValue& value : study.published.values)
    if (value.setting.method == method) return value;
  throw std::runtime_error("nothing published");
}

const MethodGrid& grid_of(const SensorStudy& study, Method method) {
  return *std::ranges::find(study.methods, method, &MethodGrid::method);
}

TEST(ExperimentJson, HoldsThePapersTablesInItsTemplate) {
  const std::string text = read_file(kTemplate);
  const Experiment full = parse_experiment(text, "yairi2007.json", "full");
  EXPECT_EQ(experiment_json(full), experiment_json(parse_experiment(text, "yairi2007.json")));
  EXPECT_EQ(full.layouts * full.poses, 25);
  ASSERT_EQ(full.sensors.size(), 2U);
  EXPECT_EQ(full.sensors[0].published.table, "table-1");
  EXPECT_EQ(published_for(full.sensors[0], Method::kIsomap).mpe_m, 0.177);
  EXPECT_EQ(published_for(full.sensors[1], Method::kSmacofKnn).moe_percent, 1.0);
  EXPECT_NE(published_for(full.sensors[1], Method::kKpcaGaussian).note, "");
  EXPECT_EQ(grid_of(full.sensors[1], Method::kIsomap).parameters.back(), 14.0);
  const Experiment quick = parse_experiment(text, "yairi2007.json", "quick");
  EXPECT_EQ(quick.layouts * quick.poses, 5);
  EXPECT_EQ(quick.sensors[1].checkpoints, (std::vector{500, 1000, 2000}));
  EXPECT_EQ(grid_of(quick.sensors[1], Method::kIsomap).parameters, std::vector{9.0});
  for (const SensorStudy& study : full.sensors)
    EXPECT_EQ(std::ssize(study.methods),
              std::ranges::count_if(all_methods(), [](const MethodInfo& method) {
                return !method.approximates;
              }));
  for (const char* id : {"fig-1", "fig-2", "fig-3", "fig-4", "fig-5", "fig-6", "fig-8", "fig-9"})
    EXPECT_EQ(std::ranges::count(full.figures, id, &PaperFigure::id), 1) << id;
  EXPECT_TRUE(quick.variations.empty());
}

TEST(ExperimentJson, KeepsWhatIsSaidAboutPublishedValues) {
  json experiment = json::parse(read_file(test::data_file("experiments/small.json")));
  json& published = experiment["sensors"]["visibility"]["published"];
  published["table"] = "table-7";
  published["values"][0]["note"] = "\u03C3\u00B2 differs.";
  published["notes"] = {"One.", "Two."};
  published["orderings"] = json::parse(R"([["isomap", "lpca"], ["smacof", "lpca"]])");
  const Experiment read = parse_experiment(experiment.dump(), "e.json");
  const Published& kept = read.sensors[0].published;
  EXPECT_EQ(kept.table, "table-7");
  EXPECT_EQ(kept.values[0].note, "\u03C3\u00B2 differs.");
  EXPECT_EQ(kept.notes.size(), 2U);
  EXPECT_EQ(kept.orderings[1], (std::vector{Method::kSmacof, Method::kLpca}));
  const std::string text = experiment_json(read);
  EXPECT_EQ(experiment_json(parse_experiment(text, "again")), text);
}

TEST(ExperimentJson, RefusesTableIdsThatOthersCouldTake) {
  EXPECT_EQ(experiment_error("/sensors/visibility/published/table", "accuracy-bearing"),
            "e.json: /sensors/visibility/published/table: expected \"table-\" and small letters, "
            "digits or '-', got \"accuracy-bearing\"");
  json experiment = json::parse(read_file(test::data_file("experiments/small.json")));
  experiment["sensors"]["visibility"]["published"]["table"] = "table-1";
  experiment["sensors"]["range"]["published"] = {
      {"source", "s"}, {"table", "table-1-half"}, {"values", json::array()}};
  EXPECT_EQ(error_of([&] { parse_experiment(experiment.dump(), "e.json"); }),
            "e.json: /sensors/range/published/table: \"table-1-half\" begins as the table of "
            "visibility does, \"table-1\"");
  experiment["sensors"]["range"]["published"]["table"] = "table-12";
  EXPECT_NO_THROW(parse_experiment(experiment.dump(), "e.json"));
}

TEST(ExperimentJson, RefusesOrderingsThatOrderNothing) {
  const std::string location = "/sensors/visibility/published/orderings";
  EXPECT_EQ(experiment_error(location, json::array({json::array({"lpca"})})),
            "e.json: " + location + "/0: expected at least 2 elements, got 1");
  EXPECT_EQ(experiment_error(location, json::array({json::array({"lpca", "isomap", "lpca"})})),
            "e.json: " + location + "/0/2: is there twice: at " + location + "/0/0 before");
  EXPECT_EQ(experiment_error(location, json::array({json::array({"lpca", "smakof"})})),
            "e.json: " + location + "/0/1: unknown method \"smakof\": did you mean \"smacof\"?");
}

TEST(ExperimentJson, RefusesACountOfABillion) {
  EXPECT_EQ(experiment_error("/layouts", 1'000'000'000),
            "e.json: /layouts: expected an integer from 1 to 10000, got 1000000000");
  EXPECT_EQ(experiment_error("/world/landmarks", 1e9),
            "e.json: /world/landmarks: expected an integer from 4 to 5000, got 1000000000");
  EXPECT_EQ(experiment_error("/sensors/range/checkpoints/0", 1'000'000'000),
            "e.json: /sensors/range/checkpoints/0: expected an integer from 3 to 1000000, got "
            "1000000000");
}

TEST(ExperimentJson, RefusesWalksThatWouldNotEnd) {
  EXPECT_EQ(experiment_error("/walk", {{"step_m", 1000}, {"substep_m", 0.0001}}),
            "e.json: /walk: step_m = 1000 in substeps of substep_m = 0.0001 are 10000000 a step; "
            "at most 10000");
  json sensors = json::parse(read_file(test::data_file("experiments/small.json")))["sensors"];
  for (auto& sensor : sensors) sensor["checkpoints"] = {1'000'000};
  json experiment = json::parse(read_file(test::data_file("experiments/small.json")));
  experiment["sensors"] = sensors;
  experiment["walk"] = {{"step_m", 20}, {"substep_m", 0.01}};
  EXPECT_EQ(error_of([&] { parse_experiment(experiment.dump(), "e.json"); }),
            "e.json: /walk: 2000 substeps a step x 1000000 steps are more than 1000000000");
}

TEST(ExperimentJson, RefusesAWalkWithoutRoomEvenByDefault) {
  json experiment = json::parse(read_file(test::data_file("experiments/small.json")));
  for (const char* key : {"walk", "variations"}) experiment.erase(key);
  experiment["world"] = {{"side_m", 0.11},
                         {"landmarks", 5},
                         {"landmark_diameter_m", 0.001},
                         {"gap_m", 0.0},
                         {"wall_margin_m", 0.0}};
  EXPECT_EQ(error_of([&] { parse_experiment(experiment.dump(), "e.json"); }),
            "e.json: /: wall_margin_m = 0.06 leaves the robot no room within walls of 0.11 m");
}

TEST(ExperimentJson, AsksWhichMethodWasMeant) {
  EXPECT_EQ(experiment_error("/sensors/range/methods/isomapp", {{"K", {4}}}),
            "e.json: /sensors/range/methods: unknown key \"isomapp\": did you mean \"isomap\"?");
}

TEST(ExperimentJson, RefusesKThatIsNotBelowTheNumberOfLandmarks) {
  EXPECT_EQ(experiment_error("/sensors/visibility/methods/isomap/K", {5, 12}),
            "e.json: /sensors/visibility/methods/isomap/K/1: K must be below the number of "
            "landmarks, 12, got 12");
}

TEST(ExperimentJson, RefusesKThatIsNoInteger) {
  EXPECT_EQ(experiment_error("/sensors/visibility/methods/isomap/K", {4.5}),
            "e.json: /sensors/visibility/methods/isomap/K/0: expected an integer from 1 to 1000, "
            "got 4.5");
}

TEST(ExperimentJson, RefusesAParameterForAMethodWithoutOne) {
  EXPECT_EQ(experiment_error("/sensors/visibility/methods/lpca/K", {4}),
            "e.json: /sensors/visibility/methods/lpca: unknown key \"K\"");
}

TEST(ExperimentJson, RefusesCheckpointsThatDoNotAscend) {
  EXPECT_EQ(experiment_error("/sensors/range/checkpoints", {200, 100}),
            "e.json: /sensors/range/checkpoints/1: expected values in ascending order, got 100 "
            "after 200");
  EXPECT_EQ(experiment_error("/sensors/range/checkpoints", json::array()),
            "e.json: /sensors/range/checkpoints: expected at least 1 elements, got 0");
}

TEST(ExperimentJson, RefusesLandmarksThatDoNotFitTheRoom) {
  EXPECT_EQ(experiment_error("/world/landmarks", 5000),
            "e.json: /world: 5000 landmarks of 0.048 m, 0.01 m apart, do not fit into a room of "
            "1.5 m: at most 292 do");
  EXPECT_EQ(experiment_error("/world/side_m", 0.2),
            "e.json: /world: a room of 0.2 m has no space for a landmark of 0.048 m that keeps "
            "0.1 m from the walls");
}

TEST(ExperimentJson, RefusesWhatOneSensorHasNoUseFor) {
  EXPECT_EQ(experiment_error("/sensors/range/occlusion", true),
            "e.json: /sensors/range: unknown key \"occlusion\"");
  EXPECT_EQ(experiment_error("/sensors/visibility/noise", 0.75),
            "e.json: /sensors/visibility/noise: expected a number from 0 to 0.5, got 0.75");
}

TEST(ExperimentJson, ReadsVariationsAndThePapersFigures) {
  const Experiment experiment = test::small_experiment();
  EXPECT_EQ(experiment.solver.smacof_knn_relative_fall, 1e-3);
  ASSERT_EQ(experiment.variations.size(), 2U);
  EXPECT_EQ(experiment.variations[0].step, 100);
  EXPECT_EQ(experiment.variations[0].settings,
            (std::vector<MethodSetting>{{Method::kLpca, {}}, {Method::kIsomap, 4.0}}));
  EXPECT_EQ(experiment.variations[1].placement, AnchorPlacement::kRandom);
  ASSERT_EQ(experiment.figures.size(), 3U);
  EXPECT_EQ(experiment.figures[1].methods, std::vector{Method::kIsomap});
  EXPECT_EQ(experiment.figures[2].example->setting.parameter, 5.0);
}

TEST(ExperimentJson, RefusesVariationsThatTheExperimentCannotMake) {
  EXPECT_EQ(experiment_error("/variations/0/sensor", "bearing"),
            "e.json: /variations/0/sensor: the experiment has no sensor bearing");
  EXPECT_EQ(experiment_error("/variations/0/levels", {0.1, 0.6}),
            "e.json: /variations/0/levels/1: expected a number from 0 to 0.5, got 0.6");
  EXPECT_EQ(experiment_error("/variations/1/levels", {3, 12}),
            "e.json: /variations/1/levels/1: expected an integer from 3 to 11, got 12");
  EXPECT_EQ(experiment_error("/variations/1/id", "noise"),
            "e.json: /variations/1/id: is there twice");
  EXPECT_EQ(experiment_error("/variations/0/methods/isomap/K", {12}),
            "e.json: /variations/0/methods/isomap/K/0: K must be below the number of landmarks, "
            "12, got 12");
  EXPECT_EQ(
      experiment_error("/figures/0/id", "../fig"),
      "e.json: /figures/0/id: expected \"fig-\", then lower-case letters, digits and '-', got "
      "\"../fig\"");
  EXPECT_EQ(
      experiment_error("/figures/0/id", "map-visibility-lpca"),
      "e.json: /figures/0/id: expected \"fig-\", then lower-case letters, digits and '-', got "
      "\"map-visibility-lpca\"");
  EXPECT_EQ(experiment_error("/figures/1/methods", {"isomap", "isomap"}),
            "e.json: /figures/1/methods/1: is there twice: at /figures/1/methods/0 before");
  EXPECT_EQ(experiment_error("/figures/0",
                             {{"id", "fig-2"}, {"kind", "measurement"}, {"sensor", "range"}}),
            "e.json: /figures/0/sensor: a scan of ranges has no figure; expected visibility or "
            "bearing");
}

TEST(ExperimentJson, RefusesWhatHasNoNameOrNoSensors) {
  EXPECT_EQ(experiment_error("/name", nullptr), "e.json: /: lacks the key \"name\"");
  EXPECT_EQ(experiment_error("/name", "../x"),
            "e.json: /name: expected letters, digits, '-' and '_', got \"../x\"");
  EXPECT_EQ(experiment_error("/sensors", json::object()),
            "e.json: /sensors: expected at least 1 of visibility, bearing, range, got 0");
  EXPECT_EQ(experiment_error("/sensors/range/methods", json::object()),
            "e.json: /sensors/range/methods: expected at least 1 of lpca, smacof, smacof-knn, "
            "kpca-gaussian, kpca-polynomial, isomap, lle, lem, hlle, sde, landmark-isomap, "
            "landmark-mvu, got 0");
}

}  // namespace
}  // namespace mapproof
