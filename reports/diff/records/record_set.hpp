#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/records/studies/study_contents.hpp"

namespace mapproof {

/// The files that records are kept in, seconds apart: those of a study of either kind, of a map or
/// of one log's result. Paths below `place`, ascending; what cannot be listed is left out.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& place);

/// The folder below `root` whose record_files() include the file; empty if none does.
/// @param file  Below `root`; it need not be there.
std::optional<std::filesystem::path> folder_of_record(const std::filesystem::path& root,
                                                      const std::filesystem::path& file);

/// Whether both files are there and hold the same bytes.
bool same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);

/// What a number is of: all but the run.
struct SeriesKey {
  std::string subject;   ///< series_name(): "bearing/isomap-K9/2000", "plaza-1/ekf".
  std::string quantity;  ///< Quantity::id.

  auto operator<=>(const SeriesKey&) const = default;
};

/// A subject without its parameter, so that another value of it can be recognised.
struct SubjectFamily {
  std::string name;       ///< "bearing/isomap/2000".
  std::string parameter;  ///< "K = 9"; empty: none.
};

/// The records of one side of a comparison, whatever kind they are of.
struct RecordSet {
  std::string kind;  ///< StudyContents::kind.
  std::string seed;  ///< Of the experiment; empty: none.
  /// The experiment, value by value: JSON pointer and text.
  std::map<std::string, std::string> settings;
  Provenance provenance;
  Quantities quantities;
  bool repeats = false;  ///< Results::are_repeats.
  /// Groups are what is independent, however few: whoever wrote the table said so. Else, where
  /// groups are few, paired tests take runs, which are independent within a group that stays.
  bool draws_groups = false;
  std::map<std::string, std::string> runs;        ///< Id of each, and its group.
  std::map<std::string, PlacedPoints> worlds;     ///< By run: the true places.
  std::map<std::string, std::string> anchors;     ///< By run: their rows, as text.
  std::map<std::string, SubjectFamily> families;  ///< By subject, where it has a parameter.
  /// What figures call subjects that have another name: of one map its id.
  std::map<std::string, std::string> called;
  /// Numbers by run_in_name(); NaN: no map came out, or there is nothing to judge.
  std::map<SeriesKey, std::map<std::string, double>> values;
  std::map<std::string, std::string> statuses;  ///< Of a record: its codes, in order.
  std::map<std::string, PlacedPoints> points;   ///< By record_name(): maps and paths.
  /// All files but study.json, results.csv and the parts of trials that are not the same on the
  /// other side, below the folder: what no other member holds is compared value by value.
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
