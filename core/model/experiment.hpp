#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/method.hpp"
#include "core/model/score.hpp"
#include "core/model/sensor.hpp"
#include "core/model/status.hpp"
#include "core/model/walk_options.hpp"
#include "core/model/world_options.hpp"

namespace mapproof {

/// What a variation changes from one level to the next, everything else being as in the study.
enum class Factor {
  kNoise,             ///< SensorOptions::noise.
  kDropoutShare,      ///< SensorOptions::dropout_share.
  kAnchors,           ///< Experiment::anchors.
  kSmacofFall,        ///< SolverOptions::smacof_relative_fall.
  kSmacofKnnFall,     ///< SolverOptions::smacof_knn_relative_fall.
  kOnlySeenTogether,  ///< SolverOptions::only_seen_together: 0 or 1.
  kSide,              ///< WorldOptions::side_m.
  kLandmarks,         ///< WorldOptions::landmarks.
  kDiameter,          ///< WorldOptions::landmark_diameter_m.
  kReach,             ///< How far a landmark may be and still be observed, m.
  kSteps,             ///< The only checkpoint.
};

/// Everything about a factor that its readers ask.
struct FactorInfo {
  Factor factor;
  std::string_view name;  ///< In files: "dropout_share".
  bool integer;
  double minimum;  ///< Inclusive.
  double maximum;  ///< Inclusive.
  bool of_world;   ///< Another level makes another world or walk: no variation, only a sweep.
};

const FactorInfo& info(Factor factor);

/// The names of these factors, in their order.
std::vector<std::string_view> factor_names();

struct Experiment;

/// Sets the factor, of the sensor if it is one of a sensor, to that level. A reach of visibility is
/// the visual angle of a landmark that far away.
/// @throws InvalidInput if the experiment does not have the sensor.
void set_level(Experiment& experiment, Sensor sensor, Factor factor, double level);

/// A side study: some methods over the levels of one factor, at one step of every run.
struct Variation {
  std::string id;  ///< [a-z][a-z0-9-]*, unique in the experiment.
  Sensor sensor = Sensor::kVisibility;
  Factor factor = Factor::kNoise;
  std::vector<double> levels;  ///< Ascending.
  int step = 0;
  /// Placement of the anchors; empty: as in the experiment.
  std::optional<AnchorPlacement> placement;
  std::vector<MethodSetting> settings;
};

/// How one map of a variation came out.
struct VariationRecord {
  std::string variation;  ///< Its id.
  double level = 0.0;
  MethodSetting setting;
  std::vector<Status> statuses;
  std::optional<Score> score;  ///< Empty if no map came out.
};

/// A number that a paper printed, compared with ours.
struct PublishedValue {
  MethodSetting setting;
  double mpe_m = 0.0;
  double moe_percent = 0.0;
  std::string note = {};  ///< Why ours cannot match it, a sentence or two; empty: nothing known.
};

/// What was published on one sensor's part of an experiment; nothing if `source` is empty.
struct Published {
  std::string source = {};  ///< "Yairi 2007, Table 1".
  std::string table = {};  ///< Id of the table that compares ours with it: "table-1"; may be empty.
  std::vector<PublishedValue> values = {};
  std::vector<std::string> notes = {};  ///< On all of the values, a sentence or two each.
  /// Methods from least to greatest MPE, as the source has them and ours is expected to.
  std::vector<std::vector<Method>> orderings = {};
};

/// One sensor and its errors.
struct SensorOptions {
  Sensor sensor = Sensor::kVisibility;
  double visual_angle_rad =
      0.087266462599716474;  ///< Visibility: seen if it looks wider than this.
  bool occlusion = true;     ///< Visibility: hidden if another landmark cuts the ray to the centre.
  double noise = 0.0;  ///< Standard deviation, rad or m; visibility: share of flipped entries.
  double dropout_share = 0.0;  ///< Share of entries lost at random.
  double reach_m = 0.0;  ///< Bearing, range: landmarks further away are not measured; 0: no limit.
};

/// A method and the parameter values it is tried with.
struct MethodGrid {
  Method method = Method::kLpca;
  std::vector<double> parameters;  ///< Empty exactly if the method has no parameter.
};

/// What the paper leaves open about its solvers.
struct SolverOptions {
  /// Equal-weight SMACOF stops once a step lowers the stress by less than this share of it.
  double smacof_relative_fall = 1e-7;
  /// The same of kNN-weighted SMACOF, which is stopped early: convergence makes worse maps.
  double smacof_knn_relative_fall = 1e-2;
  /// Visibility: pairs never seen together are not neighbours.
  bool only_seen_together = false;
};

/// How the affine map to the anchors is fitted.
enum class AffineFit {
  kLeastDistances,  ///< Least sum of distances, as the paper says.
  kLeastSquares,    ///< Least sum of squared distances.
};

/// The name used in files: "least_distances".
std::string_view name(AffineFit fit);

/// "least distances": for readers.
std::string_view label(AffineFit fit);

/// One sensor's part of an experiment.
struct SensorStudy {
  SensorOptions sensor;
  std::vector<int> checkpoints;     ///< Steps at which maps are built, ascending.
  std::vector<MethodGrid> methods;  ///< Those of others behind ours.
  Published published;
};

/// The settings of some grids, in the order of their methods and parameters.
std::vector<MethodSetting> settings_of(const std::vector<MethodGrid>& grids);

/// The grids that hold just those settings, which stand method by method.
std::vector<MethodGrid> grids_of(const std::vector<MethodSetting>& settings);

/// The settings of one sensor's study, in the order of its methods and their parameters.
std::vector<MethodSetting> settings_of(const SensorStudy& study);

/// What a paper's figure shows.
enum class FigureKind {
  kIdea,         ///< Observation histories become a map.
  kMeasurement,  ///< One scan of the sensor.
  kErrorCurve,   ///< MPE over the steps, one curve per method.
  kMap,          ///< The map of one run.
};

/// The name used in files: "idea", "measurement", "error_curve", "map".
std::string_view name(FigureKind kind);

/// A figure of the paper that is drawn again, under an id of its own.
struct PaperFigure {
  std::string id;  ///< [a-z][a-z0-9-]*, unique in the experiment: "fig-4".
  FigureKind kind = FigureKind::kMap;
  Sensor sensor = Sensor::kVisibility;
  std::vector<Method> methods;  ///< kErrorCurve: all that it shows; kMap: the one; else none.
  std::optional<PublishedValue> example;  ///< kMap: the map that the paper shows.
};

/// What a method of somebody else gets for each map (docs/external-methods.md).
enum class ExternalInput {
  kDistances,  ///< M x M distances of the observation vectors; infinite: no common step.
  kFeatures,   ///< M x C observation vectors; 0 where nothing was observed.
  kHistory,    ///< M x N observations as they came; NaN: nothing observed.
};

/// "distances", "features", "history".
std::string_view name(ExternalInput input);

/// A mapping method that is a command.
struct ExternalMethod {
  std::string name;
  std::string label;
  std::string source;
  ExternalInput input = ExternalInput::kDistances;
  std::vector<std::string> command;
  std::vector<std::string> files;  ///< What it is made of, below its folder.
  double timeout_s = 60.0;         ///< For each map.
  std::string symbol;              ///< Of its parameter; empty: it has none.
  std::vector<double> values;      ///< Of the parameter.
  /// Where the command is started: the folder of the file that names it. Not in files. Empty: it
  /// must not be started, since nobody but a study's records named it.
  std::optional<std::filesystem::path> folder = {};
};

/// As records have it.
Method method_of(const ExternalMethod& method);

/// A simulated study: `layouts` worlds, each walked from `poses` initial poses. A run is one pair.
struct Experiment {
  std::string name;  ///< Letters, digits, '-' and '_'.
  std::string title;
  std::uint64_t seed = 0;
  int layouts = 1;
  int poses = 1;
  WorldOptions world;
  WalkOptions walk;
  int anchors = 4;
  AnchorPlacement anchor_placement = AnchorPlacement::kWalls;
  AffineFit affine_fit = AffineFit::kLeastDistances;
  SolverOptions solver;
  std::vector<SensorStudy> sensors;
  std::vector<Variation> variations;
  std::vector<PaperFigure> figures;
  std::vector<ExternalMethod> external_methods;  ///< Every sensor has their grids.
};

/// Adds methods of others to the experiment, and to the methods of every sensor.
void add_external_methods(Experiment& experiment, const std::vector<ExternalMethod>& methods);

/// The description of a method of others in the experiment; null if it is none of these.
const ExternalMethod* find_external(const Experiment& experiment, Method method);

/// The study of that sensor; null if the experiment has none.
const SensorStudy* find_sensor(const Experiment& experiment, Sensor sensor);

}  // namespace mapproof
