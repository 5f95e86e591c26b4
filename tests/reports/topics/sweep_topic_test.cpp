#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/experiment/run.hpp"
#include "core/records/studies/topic_json.hpp"
#include "core/simulate/sensors.hpp"
#include "core/studies/topic_studies.hpp"
#include "core/topics/topics.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

/// A small experiment whose sweeps are these.
std::string text_with(const std::string& sweeps, const std::string& more = "") {
  return R"({"schema": {"name": "mapproof.topic_experiment", "version": 1}, "name": "s",
             "topic": "sweep", "seed": 5, "steps": 150, "world": {"landmarks": 16},)" +
         more + R"("sensors": {"visibility": {"methods": {"isomap": {"K": [5]}}},
                     "bearing": {"methods": {"lpca": {}, "smacof-knn": {"K": [6]}}}},
             "sweeps": [)" +
         sweeps + "]}";
}

TopicExperiment parsed(const std::string& sweeps, const std::string& more = "") {
  return parse_topic_experiment(text_with(sweeps, more), "s.json", input_of_topics());
}

std::string refusal(const std::string& sweeps, const std::string& more = "") {
  try {
    parsed(sweeps, more);
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TopicStudy study_of(const TopicExperiment& experiment) {
  TopicStudy study;
  study.experiment = experiment;
  study.design = kSweepTopic.design(experiment);
  study.parts = {simulate_part(experiment, {1, 1})};
  return study;
}

/// NaN if there is no such outcome.
double mpe_of(const TopicStudy& study, const Condition& at, const std::string& method) {
  for (const TopicOutcome& outcome : study.parts.front().outcomes)
    if (outcome.at == at && outcome.method == method) return outcome.values.at("mpe_m");
  return std::nan("");
}

TEST(SweepTopic, TriesEveryCombinationOfEverySensorThatHasTheFactors) {
  const TopicStudy study = study_of(
      parsed(R"({"anchors": [3, 6]}, {"bearing_noise_deg": [0, 5], "steps": [50, 100, 150]})"));
  ASSERT_EQ(study.design.setups.size(), 3U);
  EXPECT_EQ(study.design.setups[0].id, "visibility-anchors");
  EXPECT_EQ(study.design.setups[2].id, "bearing-bearing-noise-deg-steps");
  EXPECT_EQ(conditions_of(study.design.setups[2]).size(), 6U);
  EXPECT_EQ(study.parts.front().outcomes.size(), 2U + 2U * 2U + 2U * 6U);
  EXPECT_EQ(study.design.quantities[0].id, "mpe_m");
  EXPECT_EQ(study.design.quantities[1].id, "moe_percent");
  EXPECT_EQ(conclusions_of(study).size(), 3U);
}

TEST(SweepTopic, AtTheExperimentsOwnLevelsIsTheExperiment) {
  const TopicStudy study = study_of(parsed(
      R"({"side_m": [2.5, 3]}, {"landmarks": [16, 20]}, {"steps": [100, 150]}, {"anchors": [4]},
         {"bearing_noise_deg": [0, 5]}, {"landmark_diameter_m": [0.048]})"));
  std::vector<double> same;
  for (const auto& [factor, level] : {std::pair<const char*, double>{"side_m", 2.5},
                                      {"landmarks", 16},
                                      {"steps", 150},
                                      {"anchors", 4},
                                      {"bearing_noise_deg", 0},
                                      {"landmark_diameter_m", 0.048}}) {
    std::string setup = std::string("bearing-") + factor;
    std::ranges::replace(setup, '_', '-');
    same.push_back(mpe_of(study, condition(setup, {{factor, level}}), "smacof-knn-K6"));
  }
  for (const double mpe : same) EXPECT_EQ(mpe, same.front());
  EXPECT_GT(same.front(), 0.0);
}

TEST(SweepTopic, SaysInPlainEnglishWhatCameOut) {
  const TopicExperiment experiment =
      parsed(R"({"side_m": [1.5, 4]}, {"anchors": [3, 6], "bearing_noise_deg": [0, 5]})");
  TopicStudy study;
  study.experiment = experiment;
  study.design = kSweepTopic.design(experiment);
  TopicPart& part = study.parts.emplace_back();
  for (const TopicSetup& setup : study.design.setups) {
    double mpe_m = 0.1;
    for (const Condition& at : conditions_of(setup)) {
      part.outcomes.push_back({.at = at,
                               .method = "lpca",
                               .values = {{"mpe_m", mpe_m}, {"moe_percent", 1.0}},
                               .statuses = {}});
      part.outcomes.push_back({.at = at,
                               .method = "smacof-knn-K6",
                               .values = {{"mpe_m", 0.2}, {"moe_percent", 1.0}},
                               .statuses = {}});
      mpe_m += 0.3;
    }
  }
  const std::vector<std::string> found = conclusions_of(study);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(with_plain_spaces(found[1]),
            "Maps from bearing by side of the room: with the side of the room from 1.5 m to 4 m, "
            "the mean MPE of LPCA grows from 0.100 m to 0.400 m and that of SMACOF (kNN "
            "weights, K = 6) stays at 0.200 m.");
  EXPECT_EQ(with_plain_spaces(found[2]),
            "Maps from bearing by anchors and noise of bearings: with the number of anchors from "
            "3 to 6 and the noise of bearings from 0\u00B0 to 5\u00B0, the mean MPE of LPCA "
            "grows from 0.100 m to 1.00 m and that of SMACOF (kNN weights, K = 6) stays at "
            "0.200 m.");
}

TEST(SweepTopic, SaysThatAMeanGrowsOrFallsOnlyIfItDoesAtEveryLevel) {
  const TopicExperiment experiment = parsed(R"({"landmarks": [16, 20, 24]})");
  TopicStudy study;
  study.experiment = experiment;
  study.design = kSweepTopic.design(experiment);
  const TopicSetup& setup = study.design.setups.back();
  const auto sentence = [&](std::vector<double> means_m) {
    study.parts = {TopicPart{}};
    std::size_t i = 0;
    for (const Condition& at : conditions_of(setup))
      study.parts[0].outcomes.push_back(
          {.at = at, .method = "lpca", .values = {{"mpe_m", means_m[i++]}}, .statuses = {}});
    return with_plain_spaces(conclusions_of(study).at(0));
  };
  const std::string start =
      "Maps from bearing by landmarks: with the number of landmarks from 16 to 24, the mean MPE of "
      "LPCA ";
  EXPECT_EQ(sentence({0.107, 0.097, 0.105}),
            start + "goes from 0.107 m to 0.105 m (between 0.0970 m and 0.107 m).");
  EXPECT_EQ(sentence({0.107, 0.106, 0.105}), start + "falls from 0.107 m to 0.105 m.");
  EXPECT_EQ(sentence({0.105, 0.106, 0.107}), start + "grows from 0.105 m to 0.107 m.");
}

TEST(SweepTopic, SpellsMethodsAsAllStudiesDo) {
  const TopicExperiment experiment = parse_topic_experiment(
      R"({"schema": {"name": "mapproof.topic_experiment", "version": 1}, "name": "s",
          "topic": "sweep", "steps": 150, "world": {"landmarks": 16},
          "sensors": {"bearing": {"methods": {"lpca": {}, "isomap": {"K": [6]},
                                              "kpca-gaussian": {"sigma2": [0.05]}}}},
          "sweeps": [{"anchors": [4]}]})",
      "s.json", input_of_topics());
  const TopicStudy study = study_of(experiment);
  std::vector<std::string> ids;
  for (const StudiedMethod& method : study.design.methods) ids.push_back(method.id);
  std::ranges::sort(ids);
  EXPECT_EQ(ids, (std::vector<std::string>{"isomap-K6", "kpca-gaussian-sigma2-0.05", "lpca"}));
  const std::string text = topic_study_json(study);
  EXPECT_EQ(topic_study_json(parse_topic_study(text, "study.json")), text);
}

TEST(SweepTopic, PairsLayoutsWalksAndNoiseAcrossLevels) {
  const TopicExperiment experiment = parsed(R"({"bearing_noise_deg": [0, 2, 4]})");
  const SensorStudy& bearing = experiment.sensors[1];
  const auto at = [&](const std::string& factor, double level) {
    return at_levels(experiment, bearing, {{factor, {level}}}, {level});
  };
  const auto made = [&](const Experiment& one) { return make_run_world(one, {1, 1}); };
  const RunWorld usual = made(at("bearing_noise_deg", 0.0));
  EXPECT_EQ(made(at("anchors", 8)).path.positions_m, usual.path.positions_m);
  EXPECT_EQ(made(at("steps", 70)).path.positions_m, usual.path.positions_m.topRows(70));
  EXPECT_EQ(made(at("landmarks", 12)).world.landmarks_m, usual.world.landmarks_m.topRows(12));
  const auto observed = [&](const std::string& factor, double level) {
    const Experiment one = at(factor, level);
    return observed_in(one, {1, 1}, made(one), one.sensors[0].sensor).values;
  };
  const Eigen::MatrixXd none = observed("bearing_noise_deg", 0.0);
  const Eigen::MatrixXd little = observed("bearing_noise_deg", 2.0) - none;
  const Eigen::MatrixXd more = observed("bearing_noise_deg", 4.0) - none;
  const auto inside = little.array().abs() < 1.0 && more.array().abs() < 1.0;  // Not wrapped.
  EXPECT_LT(inside.select((2.0 * little - more).array(), 0.0).abs().maxCoeff(), 1e-12);
  EXPECT_GT(more.norm(), 0.0);
}

TEST(SweepTopic, LimitsTheReachOfEverySensor) {
  const TopicExperiment experiment = parsed(R"({"reach_m": [0.5, 1]})");
  for (const SensorStudy& sensor : experiment.sensors) {
    const Experiment one = at_levels(experiment, sensor, experiment.sweeps[0], {0.5});
    const RunWorld made = make_run_world(one, {1, 1});
    const ObservationHistory history = observed_in(one, {1, 1}, made, one.sensors[0].sensor);
    for (Eigen::Index i = 0; i < history.landmarks(); ++i)
      for (Eigen::Index t = 0; t < history.steps(); ++t) {
        const double distance =
            (made.world.landmarks_m.row(i) - made.path.positions_m.row(t)).norm();
        const double value = history.values(i, t);
        const bool is_observed =
            sensor.sensor.sensor == Sensor::kVisibility ? value == 1.0 : !std::isnan(value);
        if (is_observed) {
          EXPECT_LE(distance, 0.5 + 1e-12);
        } else if (sensor.sensor.sensor == Sensor::kBearing) {
          EXPECT_GT(distance, 0.5);
        }
      }
  }
}

TEST(SweepTopic, RefusesWhatCannotBeInOneLine) {
  EXPECT_EQ(refusal(R"({"anchors": [4, 16]})"),
            "s.json: /sweeps/0: anchors = 16: 16 anchors leave none of 16 landmarks to be mapped");
  EXPECT_EQ(refusal(R"({"steps": [50]}, {"landmark_diameter_m": [0.05, 3]})"),
            "s.json: /sweeps/1: landmark_diameter_m = 3: a room of 2.5 m has no space for a "
            "landmark of 3 m that keeps 0.1 m from the walls");
  EXPECT_NE(refusal(R"({"side_m": [0.5, 2], "landmarks": [10, 200]})")
                .find("landmarks = 200, side_m = 0.5: 200 landmarks"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"landmarks": [5, 20], "anchors": [3]})").find("K must be below"),
            std::string::npos);
  EXPECT_EQ(refusal(R"({"range_noise_m": [0, 1]})"),
            "s.json: /sweeps/0: no sensor of the experiment has these factors");
  EXPECT_EQ(refusal(R"({"steps": [50], "anchors": [4], "side_m": [3]})"),
            "s.json: /sweeps/0: expected at most 2 of anchors, bearing_noise_deg, "
            "landmark_diameter_m, landmarks, range_noise_m, reach_m, side_m, steps, "
            "visibility_errors_percent, got 3");
  EXPECT_NE(refusal(R"({"side_m": [1.5, 2], "steps": [50]}, {"steps": [80], "side_m": [3]})")
                .find("varies the same factors as sweeps/0"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"ancors": [4]})").find("anchors"), std::string::npos) << "a near name";
  EXPECT_NE(refusal(R"({"anchors": [4.5]})").find("expected an integer"), std::string::npos);
  EXPECT_NE(refusal(R"({"steps": [100, 50]})").find("ascending"), std::string::npos);
  EXPECT_NE(refusal("").find("/sweeps"), std::string::npos);
}

TEST(SweepTopic, IsTheOnlyOneThatSweeps) {
  const std::string text =
      R"({"schema": {"name": "mapproof.topic_experiment", "version": 1}, "name": "s",
          "topic": "missing", "sweeps": [{"steps": [50]}]})";
  EXPECT_THROW(parse_topic_experiment(text, "s.json", input_of_topics()), IoError);
}

}  // namespace
}  // namespace mapproof
