#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/records/studies/study_contents.hpp"

namespace mapproof {

/// The files that hold records, without the timings: those of a study of any kind, of a map or of
/// one log's result. Paths below `location`, ascending.
/// @throws IoError if a folder cannot be listed.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& location);

/// The folder below `root` whose record_files() include the file; empty if none does.
/// @param file  Below `root`; it need not exist.
std::optional<std::filesystem::path> folder_of_record(const std::filesystem::path& root,
                                                      const std::filesystem::path& file);

/// Whether both files exist and have equal bytes.
bool same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);

/// The key of a number, without its run.
struct SeriesKey {
  std::string subject;   ///< series_name(): "bearing/isomap-K9/2000", "plaza-1/ekf".
  std::string quantity;  ///< Quantity::id.

  auto operator<=>(const SeriesKey&) const = default;
};

/// A subject without its parameter, by which a changed parameter is recognised.
struct SubjectFamily {
  std::string name;       ///< "bearing/isomap/2000".
  std::string parameter;  ///< "K = 9"; empty: none.
};

/// What readers call a subject, part by part: "bearing", "ISOMAP, K = 9", "2000 steps".
using SubjectLabel = std::vector<std::string>;

/// "bearing, ISOMAP, K = 9, 2000 steps".
std::string label_text(const SubjectLabel& label);

/// The records of one side of a comparison, of any kind.
struct RecordSet {
  std::string kind;  ///< StudyContents::kind.
  std::string seed;  ///< Of the experiment; empty: none.
  /// The experiment, value by value: JSON pointer and text.
  std::map<std::string, std::string> settings;
  Provenance provenance;
  Quantities quantities;
  bool repeats = false;  ///< Results::are_repeats.
  /// Groups are the independent units, however few, as declared in the table. Otherwise, with few
  /// groups, paired tests take runs, which are independent for a fixed set of groups.
  bool draws_groups = false;
  GroupsByRun runs;
  std::map<std::string, AlignedPoints> worlds;    ///< By run: the true positions.
  std::map<std::string, std::string> anchors;     ///< By run: their rows, as text.
  std::map<std::string, SubjectFamily> families;  ///< By subject, where it has a parameter.
  /// Names in figures of subjects with a different name: the id of a single map.
  std::map<std::string, std::string> called;
  std::map<std::string, SubjectLabel> labels;  ///< By subject.
  /// Numbers by run_in_name(); NaN: there is no map, or no ground truth to score it.
  std::map<SeriesKey, ValuesByRun> values;
  std::map<std::string, std::string> statuses;  ///< Of a record: its codes, in order.
  std::map<std::string, AlignedPoints> points;  ///< By record_name(): maps and paths.
  /// All files below the folder that differ from the other side, except study.json, results.csv and
  /// the parts of experiments. Values that no other member holds are compared one by one.
  std::map<std::string, std::filesystem::path> others;
  std::vector<RecordProblem> problems;
};

/// Whether read_records() can read records here: the folder of a study of any kind or of a map, a
/// map.json or a slam.json.
bool holds_records(const std::filesystem::path& path);

/// Of both sides of a comparison.
struct RecordSets {
  RecordSet baseline, current;
};

/// Reads the records of two folders or files. A file of a study that cannot be read is listed as a
/// problem; the others are read. Maps and details with equal bytes on both sides are left out.
/// @throws IoError if a side has no records, if a folder cannot be listed, or if the file that
/// states their kind cannot be read.
RecordSets read_records(const std::filesystem::path& baseline,
                        const std::filesystem::path& current);

}  // namespace mapproof
