#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/study.hpp"

namespace mapproof {

/// What a number is of: all but the run.
struct SeriesKey {
  std::string subject;   ///< "bearing/isomap-K9/2000", "spectral-known".
  std::string quantity;  ///< QuantityFacts::name.

  auto operator<=>(const SeriesKey&) const = default;
};

/// A subject without its parameter, so that another value of it can be recognised.
struct SubjectFamily {
  std::string name;       ///< "bearing/isomap/2000".
  std::string parameter;  ///< "K = 9"; empty: none.
};

/// Points with names: the landmarks of a map, the positions of a path.
struct PlacedPoints {
  std::string quantity = "landmark_m";  ///< QuantityFacts::name.
  Frame frame = Frame::kTruth;
  std::vector<std::string> names;  ///< One a row; empty: rows are counted from 1.
  Points points;                   ///< n x 2; NaN rows: no place.
  std::optional<Points> truth;     ///< n x 2; NaN rows: not known.
};

/// A file of the records that cannot be read.
struct RecordProblem {
  std::string file;  ///< Below the folder.
  std::string what;
};

/// The records of one side of a comparison, whatever kind they are of.
struct RecordSet {
  std::string kind;  ///< "mapproof.study", "mapproof.slam_study", "mapproof.trial_study",
                     ///< "mapproof.map", "mapproof.slam_run".
  std::string seed;  ///< Of the experiment; empty: none.
  /// The experiment, value by value: JSON pointer and text.
  std::map<std::string, std::string> settings;
  Provenance provenance;
  bool repeats = false;                           ///< Runs differ by their seed alone.
  std::map<std::string, std::string> runs;        ///< Id of each, and the layout it belongs to.
  std::map<std::string, PlacedPoints> worlds;     ///< By run: the true places.
  std::map<std::string, std::string> anchors;     ///< By run: their rows, as text.
  std::map<std::string, SubjectFamily> families;  ///< By subject, where it has a parameter.
  /// What figures call subjects that have another name: of one map its id.
  std::map<std::string, std::string> called;
  /// Numbers by run; NaN: no map came out, or there is nothing to judge.
  std::map<SeriesKey, std::map<std::string, double>> values;
  std::map<std::string, std::string> statuses;  ///< Of a record: its codes, in order.
  std::map<std::string, PlacedPoints> points;   ///< By record: "layout-1-pose-2/bearing/lpca/2000".
  /// All files but study.json that are not the same on the other side, below the folder: what no
  /// other member holds is compared value by value.
  std::map<std::string, std::filesystem::path> others;
  std::vector<RecordProblem> problems;
};

/// Whether there are records that read_records() reads: the folder of a study of any kind or of
/// a map, a map.json or a slam.json.
bool holds_records(const std::filesystem::path& path);

/// Reads the records of a folder or a file. A file of a study that cannot be read is a problem and
/// the rest goes on.
/// @param beside  The other side: maps and details whose files are equal there, byte by byte, are
///                left out.
/// @throws IoError if there are no records, or what says of which kind they are cannot be read.
RecordSet read_records(const std::filesystem::path& path, const std::filesystem::path& beside);

}  // namespace mapproof
