#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/slam/slam_study.hpp"
#include "core/model/study.hpp"
#include "core/results/results.hpp"
#include "core/results/study_labels.hpp"
#include "core/results/values_by_run.hpp"

namespace mapproof {

/// Points with names: the landmarks of a map, the positions of a path.
struct AlignedPoints {
  std::string quantity = "landmark_m";  ///< Quantity::id.
  Frame frame = Frame::kGroundTruth;
  bool is_free =
      false;  ///< In metres, in a frame defined up to a rotation, a translation and a reflection.
  std::vector<std::string> names;      ///< One per row; empty: rows are counted from 1.
  Points points;                       ///< n x 2; NaN rows: no position.
  std::optional<Points> ground_truth;  ///< n x 2; NaN rows: not known.
};

/// A file of the records that cannot be read.
struct RecordProblem {
  std::string file;  ///< Below the folder.
  std::string what;
};

/// What a folder of records holds, of any kind of study.
struct StudyContents {
  std::string kind;  ///< "mapproof.study", "mapproof.slam_study", "mapproof.topic_study",
                     ///< "mapproof.results_study", "mapproof.map", "mapproof.slam_run": the schema
                     ///< of its first file.
  Provenance provenance;
  StudyLabels labels;  ///< Of what a study declares; mapproof's own methods are known.
  Results results;
  /// Its author chose its groups: they are the units of every test, however few.
  bool draws_groups = false;
  std::vector<Result> seconds;  ///< Of its parts: they vary from run to run.
  GroupsByRun runs;             ///< Of one that cannot be read the group is not known: empty.
  std::map<std::string, AlignedPoints> worlds;  ///< By run: the true positions.
  std::map<std::string, std::string> anchors;   ///< By run: their rows, as text.
  std::map<std::string, AlignedPoints> points;  ///< Maps and paths, by record_name().
  std::vector<RecordProblem> problems;
};

/// What is asked of a study's folder.
struct ContentsAsked {
  bool seconds = false;
  /// Whether maps are read of that file; empty: of none. Paths come with their records.
  std::function<bool(const std::filesystem::path&)> maps = {};
  /// A file that cannot be read is a problem and the rest goes on; else it is thrown.
  bool keeps_on = false;
};

/// A map's landmarks; positions on a path.
AlignedPoints placed(const MapRecord& map);
AlignedPoints placed_path(const Points& positions_m);

/// Adds a log: its path and what each method made of it.
void add_log(StudyContents& contents, const SlamRun& run);

/// Runs `read`; where reading keeps on, trouble with the file is noted.
void try_file(StudyContents& contents, const std::filesystem::path& folder,
              const std::filesystem::path& file, const ContentsAsked& asked,
              const std::function<void()>& read);

/// One map, and one log's result, as a study of its own.
StudyContents contents_of(const MapRecord& map);
StudyContents contents_of(const SlamRun& run);

}  // namespace mapproof
