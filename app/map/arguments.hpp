#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/map/reference.hpp"
#include "app/table_options.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/embed/embedder.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/input_summary.hpp"
#include "core/records/observations/observations.hpp"

namespace mapproof {

/// The options of `mapproof map`: those of the command line, and what complete() adds to them.
/// option_table holds which of them go together.
struct MapJob {
  std::string path;                         ///< Of the observations.
  std::shared_ptr<ByteSource> source = {};  ///< Opened by complete(); none: the path is a folder.
  std::string sensor;       ///< A sensor's name, kRangeBearing, or empty: as in the file.
  TableOptions table = {};  ///< How the files are to be read.
  /// Columns of --columns; marked by complete() where anchors, ground truth or another sensor's
  /// file has them. And those of the files of other sensors, where the observations have them.
  ColumnNames columns = {}, with_columns = {};
  std::vector<std::string> with;         ///< Files of other sensors,
  std::vector<std::string> with_sensor;  ///< and what each holds.
  std::string anchors;
  std::string ground_truth;
  int jobs = 1;              ///< Threads.
  bool force = false;        ///< Replace another map in the folder.
  int steps = 0;             ///< The first so many observations; 0: all.
  bool drop_unseen = false;  ///< Map the others where a landmark was never observed.
  std::string fit = "least-distances";

  std::string method;  ///< Empty: chosen if that is quick, else isomap; pairs of range and bearing.
  std::optional<double> parameter;  ///< One of these four.
  std::optional<double> neighbours;
  std::optional<double> variance;
  std::optional<double> degree;
  std::optional<int> references;      ///< Of Landmark ISOMAP; empty: its own number.
  std::optional<double> stress_fall;  ///< SMACOF's stop rule; empty: the method's own.
  EmbedderOptions embedder;

  std::string missing = "pairwise-complete";  ///< One of missing_strategies().
  std::optional<int> dimensions;              ///< Of PPCA or PCA.
  int submaps = 0;  ///< Most landmarks of a sub-map, 6 or more; 0: one map.
  std::optional<double>
      overlap;                 ///< Share in common with neighbours, in [0, 0.8]; empty: the usual.
  int ellipse_replicates = 0;  ///< Resamples for each landmark's ellipse; 0: none.
  bool check_ids = false;
  bool repair_ids = false;
  bool find_moved = false;
  std::vector<std::string> uncertain_ids;

  bool incremental = false;
  std::string every = "1s";
  std::string out;
  std::optional<std::string> templates;

  MethodSetting setting;  ///< Without a parameter: the usual one of these data.
  std::optional<NamedPointsFile> known_anchors;
  std::optional<NamedPointsFile> known_ground_truth;
  /// Called with what was understood of each file.
  std::function<void(const std::string& path, const InputSummary&)> understood = {};

  bool is_range_bearing() const { return sensor == kRangeBearing; }
  bool chooses_method() const;
  /// Whether the method may be chosen although none is named: nothing that is asked for prevents
  /// it.
  bool may_choose_method() const;
  bool judges_ids() const { return check_ids || repair_ids || find_moved; }
  bool is_rigid() const { return fit == "rigid"; }
  AffineFit affine_fit() const;
  /// @throws InvalidInput for a scan window that is none.
  TableFormat table_format() const;
};

/// "pairwise-complete", "ppca", "pca", "covisible", "auto": strategies for missing data.
std::vector<std::string> missing_strategies();

/// Adds all options of `map` to its command; they fill in the job.
void add_map_options(CLI::App& app, MapJob& job);

}  // namespace mapproof
