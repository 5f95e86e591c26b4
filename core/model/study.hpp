#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/certificate.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/model/method.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/points.hpp"
#include "core/model/score.hpp"
#include "core/model/sensor.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// Which layout and which initial pose, both counted from 1.
struct RunId {
  int layout = 1;
  int pose = 1;

  auto operator<=>(const RunId&) const = default;
};

/// What keeps a landmark from being seen, if anything does.
enum class View {
  kVisible,
  kHidden,      ///< Within reach, but another landmark cuts the ray to its centre.
  kOutOfReach,  ///< Scans narrower than the visual angle.
};

/// The name used in files: "visible", "hidden", "out_of_reach".
std::string_view name(View view);

/// What one sensor measured at one step of one run, and where everything stood.
struct Measurement {
  Sensor sensor = Sensor::kVisibility;
  RunId run;
  int step = 1;  ///< Counted from 1.
  World world;
  Points path_m;  ///< Positions up to the step, in order; may be empty.
  Eigen::RowVector2d robot_m = Eigen::RowVector2d::Zero();
  double heading_rad = 0.0;
  double reach_m = 0.0;          ///< Visibility: the farthest that a landmark's centre is seen.
  std::vector<View> views;       ///< Visibility: M.
  Eigen::VectorXd bearings_rad;  ///< Bearing: M, relative to the heading; NaN where none came.
};

/// "layout-1-pose-2".
std::string slug(const RunId& run);

/// "layout-1-pose-2/bearing/isomap-K9/2000": which map or record of a study.
std::string record_id(const RunId& run, Sensor sensor, const MethodSetting& setting, int step);

/// How one map came out: the unit that tables and curves are made of.
struct RunRecord {
  Sensor sensor = Sensor::kVisibility;
  MethodSetting setting;
  int step = 0;
  std::vector<Status> statuses;
  std::optional<Score> score;  ///< Empty if no map came out.
  int iterations = 0;
  std::optional<double> stress;
  std::optional<Certificate> certificate;  ///< Of a semidefinite program.
};

/// How often occlusion decided what was seen: eq. 4 of the paper holds where it does not.
struct Occlusion {
  long within_reach = 0;  ///< Detections of landmarks near enough to be seen.
  long hidden = 0;        ///< Of them, those that another landmark hid.
};

/// One run: its world and every record, in order of sensor, method, parameter, step.
struct Run {
  RunId id;
  World world;
  std::vector<Eigen::Index> anchors;
  std::optional<Occlusion> occlusion;  ///< If the experiment has visibility with occlusion.
  std::vector<RunRecord> records;
  std::vector<VariationRecord> variations;  ///< In order of variation, level, setting.
};

/// What a method of others is made of.
struct MethodFiles {
  std::string method;  ///< Its name.
  std::string sha256;  ///< Of its files together.

  bool operator==(const MethodFiles&) const = default;
};

/// What made a study: enough to make it again, nothing that varies between two makings.
struct Provenance {
  std::string version;        ///< Of mapproof.
  std::string commit;         ///< Of its source; "unknown" outside a checkout.
  std::string solver_digest;  ///< Of the sources that compute: records of another one are redone.
  std::vector<std::pair<std::string, std::string>> libraries;  ///< Name and version.
  /// Of methods of others that name their files: records of other files are redone.
  std::vector<MethodFiles> method_files = {};
};

/// Everything a figure or a report needs, maps apart (they are read one at a time).
struct Study {
  Experiment experiment;
  Provenance provenance;
  std::vector<Run> runs;  ///< In ascending order of id.
};

/// Seconds that one piece of a study took; kept apart since it varies from run to run.
struct Timing {
  RunId run;
  Sensor sensor = Sensor::kVisibility;
  MethodSetting setting;
  int step = 0;
  double seconds = 0.0;
};

/// One start of the program on a study, kept with the timings.
struct Session {
  std::string command;      ///< As typed, arguments quoted.
  std::string started_utc;  ///< ISO 8601.
  std::string host;
  int jobs = 1;
  double seconds = 0.0;
  std::optional<double> peak_memory_mib;  ///< Of the process, at its end.
};

/// What figures show of one sensor in one run beyond its maps.
struct SensorDetails {
  Sensor sensor = Sensor::kVisibility;
  int scan_step = 1;            ///< The step of the scan, counted from 1.
  double reach_m = 0.0;         ///< See Measurement.
  std::vector<View> views;      ///< Of the scan; see Measurement.
  Eigen::VectorXd values;       ///< Of the scan: M; NaN: missing.
  Eigen::MatrixXd first_steps;  ///< M x at most 60: how the observation history begins.
  int step = 0;                 ///< The last checkpoint, which the rest is of.
  /// Distances of the observation vectors, M (M - 1) / 2: those of landmark 0 to all after it, then
  /// of landmark 1, and so on; NaN where a pair has no step in common or one was never seen.
  Eigen::VectorXd distances;
  std::optional<ObservationManifold> manifold;  ///< Of these distances; empty: too few are known.
  /// The leading eigenvalues of each setting that has some.
  std::vector<std::pair<MethodSetting, Eigen::VectorXd>> spectra;
};

/// What figures show of one run beyond its records and maps.
struct RunDetails {
  RunId id;
  Path path;
  std::vector<SensorDetails> sensors;
};

/// The scan of one sensor as a figure shows it.
/// @param world  Of the same run.
Measurement measurement(const RunDetails& run, const SensorDetails& sensor, const World& world);

}  // namespace mapproof
