#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/model/sensor.hpp"
#include "core/model/study.hpp"
#include "core/results/results.hpp"

namespace mapproof {

/// A factor that a sweep can take, as files and tables of results name it.
struct SweptFactor {
  std::string_view name;   ///< With its unit: "bearing_noise_deg".
  std::string_view label;  ///< "noise of bearings".
  std::string_view unit;   ///< "°".
  Factor factor;
  double scale = 1.0;                     ///< From this unit to the factor's own.
  std::optional<Sensor> sensor = {};      ///< The only one that has it; empty: all do.
  double maximum = info(factor).maximum;  ///< In this unit, inclusive.

  double minimum() const { return info(factor).minimum / scale; }
};

/// All of them, in the order in which they are set: the reach of visibility goes by the diameter.
std::span<const SweptFactor> swept_factors();

/// The factor of that name; null if there is none.
const SweptFactor* swept_factor_named(std::string_view name);

/// A factor and the levels that a sweep gives it.
struct SweptLevels {
  std::string factor;          ///< SweptFactor::name.
  std::vector<double> levels;  ///< Ascending.
};

/// One factor or two, every combination of whose levels is tried.
using Sweep = std::vector<SweptLevels>;

/// What conditions of a setup differ in.
struct SetupFactor {
  std::string id;              ///< [a-z][a-z0-9_]*, with its unit: "missing_percent".
  std::string label;           ///< For readers, without the unit: "share missing".
  std::string unit;            ///< "%"; empty: a count or a ratio.
  std::vector<double> levels;  ///< Ascending, one or more.
};

/// Numbers of observations as a factor.
SetupFactor steps_factor(std::vector<double> steps);

/// Conditions with figures and tables of their own: every combination of the factors' levels.
struct TopicSetup {
  std::string id;                         ///< [a-z][a-z0-9-]*: "sensor-range".
  std::string title;                      ///< "Distant landmarks not observed".
  std::vector<SetupFactor> factors = {};  ///< None: there is one condition.
};

/// The conditions of a setup, the first factor's levels outermost.
std::vector<Condition> conditions_of(const TopicSetup& setup);

/// The levels of a setup's only factor; of a setup without factors 0 alone.
/// @throws InvalidInput if it has several factors.
std::vector<double> levels_of(const TopicSetup& setup);

/// The condition at a level of the only factor; without factors whatever the level.
/// @throws InvalidInput as levels_of().
Condition condition_at(const TopicSetup& setup, double level);

/// One of what is compared with each other: a method, a criterion, a sensor.
struct StudiedMethod {
  std::string id;     ///< [a-z][A-Za-z0-9.+-]*; a method's is slug(): "isomap-K6", "ppca-isomap".
  std::string label;  ///< "ISOMAP, K = 6".
};

/// An option of a topic, as an experiment file may give it.
struct TopicOption {
  std::string_view name;      ///< "shares_missing".
  std::vector<double> usual;  ///< One number, or the ascending ones of a list.
  double minimum = 0.0;       ///< Inclusive.
  double maximum = 0.0;       ///< Inclusive.
  bool integer = false;
  bool list = false;
};

/// What the study of a topic compares, in the order of its tables.
struct TopicDesign {
  std::vector<TopicSetup> setups;
  std::vector<StudiedMethod> methods;
  std::vector<Quantity> quantities;  ///< By which outcomes are judged: study_quantity().
};

/// What one method came to under one condition of a setup. Not every combination has to be tried.
struct TopicOutcome {
  Condition at;  ///< The setup and a level of each of its factors.
  std::string method;
  /// By quantity of the design. One that does not apply is not there; NaN: nothing came out.
  std::map<std::string, double> values;
  std::vector<Status> statuses;
};

/// A pair of landmarks whose distance was measured.
struct MeasuredPair {
  Eigen::Index first = 0;  ///< Rows of the map, first < second.
  Eigen::Index second = 0;
  double distance_m = 0.0;
  double precision = 1.0;  ///< Weight, 1 / variance, 1/m^2.
  int scans = 0;           ///< That showed both.
};

/// A map that is shown.
struct TopicMap {
  std::string id;      ///< [a-z][A-Za-z0-9.+-]*, unique in its part: "bearing-isomap-K8".
  Condition at;        ///< The setup and a level of each of its factors.
  std::string method;  ///< That made it.
  MapRecord map;
  std::vector<MeasuredPair> pairs;        ///< Drawn thin under the map; may be empty.
  std::optional<MapUncertainty> uncertainty;  ///< The ellipses of its landmarks.
};

/// Seconds that one method took on one part.
struct MethodSeconds {
  std::string part;
  std::string method;
  double seconds = 0.0;
};

/// What was tried in one simulated run, or on one data set.
struct TopicPart {
  std::string id;            ///< slug(run), or the data set's: "dataset2".
  std::optional<RunId> run;  ///< Of a simulated one; means and intervals go over those alone.
  std::vector<TopicOutcome> outcomes;
  std::vector<TopicMap> maps;          ///< Of few parts: the first run's.
  std::vector<MethodSeconds> seconds;  ///< Vary from run to run; kept in timings.jsonl.
};

/// Adds to what a method took on a part: one entry a method.
void add_seconds(TopicPart& part, std::string_view method, double seconds);

/// A data set that is not a part of the program.
struct DataSet {
  std::string id;      ///< [a-z0-9-]+, unique: "dataset2"; the id of its part.
  std::string title;   ///< "MRCLAM dataset 2".
  std::string digest;  ///< SHA-256 of its files.
};

/// A question put to simulated worlds or to data.
struct TopicExperiment {
  std::string name;  ///< Letters, digits, '-' and '_'.
  std::string title;
  std::string topic;  ///< Name of a Topic (core/topics/topic.hpp).
  std::uint64_t seed = 0;
  int layouts = 1;  ///< A run is one layout with one initial pose; not of a topic of data.
  int poses = 1;
  int steps = 2000;
  WorldOptions world;
  WalkOptions walk;
  int anchors = 4;
  std::map<std::string, std::vector<double>> options;  ///< Every one of the topic's.
  std::vector<SensorStudy> sensors = {};  ///< Of a topic that sweeps; `steps` is the checkpoint.
  std::vector<Sweep> sweeps = {};         ///< Likewise.
  std::vector<DataSet> data = {};         ///< Of a topic of data: what was there.
};

/// An experiment's option. @throws InvalidInput if the experiment does not have it.
double number_option(const TopicExperiment& experiment, const std::string& name);
std::vector<double> list_option(const TopicExperiment& experiment, const std::string& name);

/// Whether the sensor has all factors of the sweep.
bool has_factors(Sensor sensor, const Sweep& sweep);

/// One sensor's experiment at a level of each factor of a sweep: everything else is as in the
/// experiment of the sweep.
/// @param levels  As many as the sweep has factors.
Experiment at_levels(const TopicExperiment& experiment, const SensorStudy& sensor,
                     const Sweep& sweep, const std::vector<double>& levels);

/// the study of a topic as its folder holds it.
struct TopicStudy {
  TopicExperiment experiment;
  Provenance provenance;
  TopicDesign design;
  std::vector<TopicPart> parts;  ///< Runs in ascending order, or data sets by name.
};

}  // namespace mapproof
