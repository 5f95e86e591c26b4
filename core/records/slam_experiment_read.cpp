#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/base/spelling.hpp"
#include "core/json/text_input.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "core/records/slam_values.hpp"

namespace mapproof {
namespace {

constexpr double kLargest_m = 1e6;
constexpr double kMostEntriesOfAWorld = 1e8;  ///< Landmarks times steps.

std::vector<int> read_sizes(const JsonCursor& array, int least, int most) {
  return read_ascending<int>(array,
                             [&](const JsonCursor& item) { return item.integer32(least, most); });
}

RangeNoiseModel read_noise(const JsonCursor& object) {
  object.allow_only({"id", "title", "noise_m", "share", "correlation", "plain_svd"});
  RangeNoiseModel noise;
  noise.id = read_id(object.at("id"));
  noise.title = noise.id;
  if (const auto title = object.find("title")) noise.title = title->text(200);
  read_if_there(object, "noise_m", 0.0, kLargest_m, noise.noise_m);
  read_if_there(object, "share", 0.0, 1.0, noise.share);
  read_if_there(object, "correlation", 0.0, 0.999, noise.correlation);
  if (const auto plain = object.find("plain_svd")) noise.plain_svd = plain->boolean();
  return noise;
}

SlamWorldOptions read_slam_world(const JsonCursor& object) {
  object.allow_only({"landmarks", "known", "half_width_m", "step_m", "turn_sigma_rad"});
  SlamWorldOptions world;
  read_if_there(object, "landmarks", 4, kMostLandmarks, world.landmarks);
  read_if_there(object, "known", 4, world.landmarks, world.known);
  read_if_there(object, "half_width_m", 1e-3, kLargest_m, world.half_width_m);
  read_if_there(object, "step_m", 1e-6, world.half_width_m, world.step_m);
  read_if_there(object, "turn_sigma_rad", 0.0, 100.0, world.turn_sigma_rad);
  return world;
}

SlamExample read_example(const JsonCursor& object) {
  object.allow_only({"figure", "steps", "noise"});
  SlamExample example;
  example.figure = read_id(object.at("figure"));
  read_if_there(object, "steps", 8, 100'000, example.steps);
  example.noise = read_noise(object.at("noise"));
  return example;
}

ConvergenceOptions read_convergence(const JsonCursor& object) {
  object.allow_only({"pairs", "most_condition", "steps", "noises"});
  ConvergenceOptions convergence;
  read_if_there(object, "pairs", 2, 100'000, convergence.pairs);
  read_if_there(object, "most_condition", 10.0, 1e6, convergence.most_condition);
  convergence.steps = read_sizes(object.at("steps"), 8, kMostSteps);
  std::set<std::string> ids;
  for (const JsonCursor& item : object.at("noises").elements(1, 20)) {
    convergence.noises.push_back(read_noise(item));
    if (!ids.insert(convergence.noises.back().id).second) item.at("id").fail("is there twice");
  }
  return convergence;
}

SlamDataSet read_data_set(const JsonCursor& object) {
  object.allow_only({"id", "title", "figure", "files", "source", "published"});
  SlamDataSet set;
  set.id = read_id(object.at("id"));
  set.title = object.at("title").text(200);
  set.figure = read_id(object.at("figure"));
  for (const JsonCursor& file : object.at("files").elements(1, 20)) {
    const std::string name = file.text(1000);
    if (name.empty() || name.front() == '/' || name.find("..") != std::string::npos)
      file.fail("expected a path below the folder of the data, got " + in_quotes(name));
    set.files.push_back(name);
  }
  set.source = object.at("source").text(1000);
  if (const auto published = object.find("published"))
    set.published = read_published_drive(*published);
  return set;
}

std::vector<SlamDataSet> read_data(const JsonCursor& array, const std::string& example_id) {
  std::vector<SlamDataSet> sets;
  std::set<std::string> ids{example_id};
  for (const JsonCursor& item : array.elements(0, 100)) {
    sets.push_back(read_data_set(item));
    if (!ids.insert(sets.back().id).second) item.at("id").fail("is there twice");
  }
  return sets;
}

template <typename Kind, typename Read>
std::vector<Kind> read_kinds(const JsonCursor& array, Read read_one) {
  std::vector<Kind> kinds;
  for (const JsonCursor& item : array.elements(1, 100)) {
    kinds.push_back(read_one(item));
    if (std::ranges::count(kinds, kinds.back()) > 1) item.fail("is there twice");
  }
  std::ranges::sort(kinds);
  return kinds;
}

RangeHistoryOptions read_histories(const JsonCursor& object) {
  object.allow_only({"landmarks", "steps", "noise", "neighbours", "methods"});
  RangeHistoryOptions histories;
  read_if_there(object, "landmarks", 4, 1000, histories.landmarks);
  read_if_there(object, "steps", 8, 100'000, histories.steps);
  histories.noise = read_noise(object.at("noise"));
  read_if_there(object, "neighbours", 1, histories.landmarks - 1, histories.neighbours);
  histories.neighbours = std::min(histories.neighbours, histories.landmarks - 1);
  histories.methods = read_kinds<Method>(
      object.at("methods"), [](const JsonCursor& item) { return read_method(item.text(), item); });
  return histories;
}

SpaceFlightOptions read_space(const JsonCursor& object) {
  object.allow_only({"landmarks", "known", "steps", "half_width_m", "height_m", "step_m",
                     "turn_sigma_rad", "noise"});
  SpaceFlightOptions space;
  read_if_there(object, "landmarks", 5, kMostLandmarks, space.landmarks);
  space.known = std::min(space.known, space.landmarks);
  read_if_there(object, "known", 5, space.landmarks, space.known);
  read_if_there(object, "steps", 13, 100'000, space.steps);
  read_if_there(object, "half_width_m", 1e-3, kLargest_m, space.half_width_m);
  space.height_m = std::min(space.height_m, 2.0 * space.half_width_m);
  read_if_there(object, "height_m", 1e-3, 2.0 * space.half_width_m, space.height_m);
  space.step_m = std::min(space.step_m, 0.5 * space.height_m);
  read_if_there(object, "step_m", 1e-6, 0.5 * space.height_m, space.step_m);
  read_if_there(object, "turn_sigma_rad", 0.0, 100.0, space.turn_sigma_rad);
  space.noise = read_noise(object.at("noise"));
  return space;
}

/// Sizes that no single number shows.
void check_sizes(const SlamExperiment& experiment, const JsonCursor& document) {
  const auto check = [](double landmarks, double steps, const JsonCursor& place) {
    if (landmarks * steps > kMostEntriesOfAWorld)
      place.fail(fmt::format("{} landmarks at {} steps are more than {:g} ranges", landmarks, steps,
                             kMostEntriesOfAWorld));
  };
  if (experiment.convergence)
    check(experiment.world.landmarks, experiment.convergence->steps.back(),
          document.at("convergence").at("steps"));
  if (experiment.space)
    check(experiment.space->landmarks, experiment.space->steps, document.at("space"));
  const FactorizationGrid& grid = experiment.factorization;
  if (!grid.landmarks.empty() && !grid.steps.empty())
    check(grid.landmarks.back(), grid.steps.back(), document.at("factorization"));
}

}  // namespace

SlamExperiment read_slam_experiment(const JsonCursor& document) {
  expect_schema(document, "mapproof.slam_experiment");
  document.allow_only({"schema", "name", "title", "seed", "world", "example", "convergence", "data",
                       "methods", "random_starts", "histories", "space", "factorization"});
  SlamExperiment experiment;
  experiment.name = read_study_name(document.at("name"));
  experiment.title = experiment.name;
  if (const auto title = document.find("title")) experiment.title = title->text(200);
  if (const auto seed = document.find("seed")) experiment.seed = seed->unsigned_integer();
  if (const auto world = document.find("world")) experiment.world = read_slam_world(*world);
  if (const auto example = document.find("example")) experiment.example = read_example(*example);
  if (const auto convergence = document.find("convergence"))
    experiment.convergence = read_convergence(*convergence);
  if (const auto data = document.find("data"))
    experiment.data =
        read_data(*data, experiment.example ? experiment.example->noise.id : std::string());
  experiment.methods = read_kinds<SlamMethod>(document.at("methods"), read_slam_method);
  read_if_there(document, "random_starts", 1, 1000, experiment.random_starts);
  if (const auto histories = document.find("histories"))
    experiment.histories = read_histories(*histories);
  if (const auto space = document.find("space")) experiment.space = read_space(*space);
  if (const auto grid = document.find("factorization")) {
    grid->allow_only({"landmarks", "steps"});
    experiment.factorization = {.landmarks = read_sizes(grid->at("landmarks"), 4, kMostLandmarks),
                                .steps = read_sizes(grid->at("steps"), 8, kMostSteps)};
  }
  check_sizes(experiment, document);
  return experiment;
}

}  // namespace mapproof
