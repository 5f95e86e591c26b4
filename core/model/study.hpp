#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/certificate.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/model/score.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// Which layout and which initial pose, both counted from 1.
struct RunId {
  int layout = 1;
  int pose = 1;

  auto operator<=>(const RunId&) const = default;
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
  long within_reach = 0;  ///< Looks at a landmark near enough to be seen.
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

/// What made a study: enough to make it again, nothing that varies between two makings.
struct Provenance {
  std::string version;  ///< Of mapproof.
  std::string commit;   ///< Of its source; "unknown" outside a checkout.
  std::string solver_digest;  ///< Of the sources that compute: records of another one are redone.
  std::vector<std::pair<std::string, std::string>> libraries;  ///< Name and version.
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

}  // namespace mapproof
