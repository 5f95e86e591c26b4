#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/statistics/paired_change.hpp"
#include "render/base/geometry.hpp"
#include "render/figures/unit_scale.hpp"
#include "reports/diff/records/record_set.hpp"
#include "reports/diff/verdict/tolerances.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// The rules by which records are judged.
struct RecordOptions {
  Tolerances tolerances;
  double significance = 0.05;  ///< Of all paired tests of one comparison together.
  double least_effect = 0.3;   ///< The least rank-biserial correlation that counts.
};

/// The outcome for one quantity of one subject.
enum class Outcome { kEqual, kWithinTolerance, kBetter, kWorse, kChanged };

/// "equal", "within-tolerance", "better", "worse", "changed".
std::string_view name(Outcome outcome);

/// The sides that have a file.
enum class Presence { kBoth, kBaseline, kCurrent };

/// "both", "baseline", "current".
std::string_view name(Presence presence);

/// The value of one run on both sides; NaN: none.
struct PairedValue {
  std::string run;
  double baseline = 0.0;
  double current = 0.0;
};

/// The test over pairs of equal runs, as nightly runs test them (core/statistics/paired_runs.hpp).
struct PairedTest {
  std::string unit;     ///< "layout", "group", "run".
  PairedChange change;  ///< A difference, or the logarithm of a ratio.
  double p = 1.0;       ///< Corrected for all tests of the comparison.
};

/// One quantity of one subject over all runs.
struct Comparison {
  std::string subject;
  std::string current_subject;  ///< The same, unless its parameter changed.
  SubjectLabel label = {};      ///< Of both: "bearing", "ISOMAP, K = 8 → ISOMAP, K = 9".
  Quantity quantity;            ///< From the dictionary, or as the study declares it.
  int pairs = 0;                ///< Runs that have it on both sides; of them …
  int equal = 0;
  int within = 0;
  int beyond = 0;
  int worse = 0;  ///< Of them, by the quantity's direction, if the seeds are equal.
  int better = 0;
  int lost = 0;                ///< Runs with a value only in the baseline; not in `pairs`.
  int gained = 0;              ///< Runs with a value only in the current.
  double baseline_mean = 0.0;  ///< Over the pairs, or without pairs over all; NaN: none.
  double current_mean = 0.0;
  double greatest_mean = 0.0;  ///< Of its quantity over all comparisons, of either side.
  double least_value = 0.0;    ///< Of its quantity in all runs, of either side.
  std::vector<PairedValue>
      largest;                     ///< Beyond tolerance, the largest difference first; at most 20.
  std::vector<Point> values = {};  ///< Of the pairs of finite values, baseline and current, in the
                                   ///< order of the runs; at most the first 1000.
  std::optional<PairedTest> test;  ///< With three or more units of equal seeds.
  Outcome outcome = Outcome::kEqual;
};

/// The unit in which texts, tables and figures show the values of its quantity, as reports do.
ScaledUnit shown_unit(const Comparison& comparison);

/// Whether a test gave a p: equal changes have none by Student's t.
bool has_p(const Comparison& comparison);

/// Whether the first is to be shown before the second: by the weight of the outcome, then by the
/// order of the dictionary, then by the largest significant effect, then by the best method where
/// there is no direction and no test, else by the largest change.
bool shows_more(const Comparison& a, const Comparison& b);

/// One landmark or one position of a path that moved beyond tolerance.
struct PointMove {
  std::string name;
  Point baseline, current;  ///< x to the right, y up; NaN: no position.
  double moved = 0.0;       ///< Infinite if it has a position on only one side.
  std::optional<double> baseline_error, current_error;  ///< Where the ground truth is known.
};

/// The points of one record.
struct PointsDiff {
  std::string record;
  SubjectLabel label = {};  ///< Of the record, its run last; empty: not known.
  std::string quantity;    ///< "landmark_m", "landmark_shape" or "path_m".
  int points = 0;        ///< On both sides.
  int within = 0;
  int beyond = 0;
  int lost = 0;
  int gained = 0;
  bool ground_truth_differs = false;  ///< The landmarks differ: nothing was compared.
  std::vector<PointMove> moves;       ///< The farthest first; at most 20.
  std::string
      transform;  ///< What moved all of them together, see transform_text(); empty: nothing.
  std::vector<std::string> renamed;  ///< "L7 → X7": other names at the same positions.
  std::optional<PointMove>
      moved_ground_truth;  ///< Of the true positions that differ, the farthest.
  std::optional<double> baseline_error, current_error;  ///< Means, where the ground truth is known.
};

/// One value of the experiment; empty: missing.
struct SettingChange {
  std::string pointer;
  std::string baseline, current;
};

/// A quantity that the two sides declare with different units or directions.
struct QuantityChange {
  Quantity baseline, current;
};

/// The warnings of one record.
struct StatusChange {
  std::string record;
  std::string baseline, current;  ///< Codes, in order.
};

/// A file of the records, compared value by value.
struct OtherDiff {
  std::string file;
  Presence presence = Presence::kBoth;
  long numbers = 0;
  long within = 0;
  long beyond = 0;
  std::string first = {};  ///< JSON pointer or line of the first value beyond tolerance.
  std::string baseline = {}, current = {};  ///< Its values.
  bool shape = false;                       ///< Keys, words or lengths differ as well.
};

/// The differences of two sets of records.
struct RecordDiff {
  bool same_seeds = false;  ///< Runs can be compared pair by pair.
  std::string
      moved_ground_truth;  ///< Which true position differs where the seeds are equal; else empty.
  std::vector<SettingChange> settings;
  std::vector<SettingChange> provenance;  ///< Versions: reported, never judged.
  std::vector<std::string> missing_runs, new_runs;
  std::vector<std::string> missing_subjects, new_subjects;
  std::map<std::string, SubjectLabel> labels;  ///< Of the missing and the new subjects.
  std::vector<Comparison> comparisons;     ///< Those that are not equal in all runs.
  std::vector<Quantity> declared;          ///< Quantities that either side declares.
  std::vector<QuantityChange> redeclared;  ///< Those with different units are not compared.
  long values = 0;                         ///< Numbers compared in all.
  std::vector<PointsDiff> points;          ///< Records with a point that is not equal.
  std::vector<StatusChange> statuses;
  std::vector<std::string> anchors;  ///< Runs whose anchors differ.
  std::vector<OtherDiff> others;
  std::vector<RecordProblem> problems;
  /// Names in figures of subjects with a different name: their families, the id of a map.
  std::map<std::string, std::set<std::string>> called;
  Judgement judgement;
};

/// The verdict on the whole, and its cause in one sentence.
Judgement judge(const RecordDiff& diff);

/// The most significant of the comparisons: the heaviest outcome, MPE before others, the least p.
/// Null if there is none.
const Comparison* most_telling(const std::vector<const Comparison*>& comparisons);

/// " (errors: 1 worse, 3 better)" if they have both directions, and `first`, the most significant
/// of them, has no test; else empty.
std::string directions_text(const std::vector<const Comparison*>& all, const Comparison& first);

/// "space.json is missing"; "maps/layout-1-pose-2.json: 2 numbers differ, the first at …".
std::string other_text(const OtherDiff& other);

/// The verdict that follows from an outcome.
Verdict verdict_of(Outcome outcome);

/// Missing or new subjects as readers call them; the id of one without a label.
std::vector<std::string> labels_of(const RecordDiff& diff,
                                   const std::vector<std::string>& subjects);

/// "seed 0 → 5", "K = 6 → K = 7 of bearing/isomap/2000": the differences of the experiments; empty
/// if there are none.
std::string settings_text(const RecordDiff& diff);

/// "MPE 0.138 → 0.152 m, p = 0.003": of one run where `run` names one that differs, else the means.
std::string comparison_text(const Comparison& comparison, const std::string& run = "");

/// What moved the points of a record: all of them together, or the one that moved farthest.
std::string moves_text(const PointsDiff& points);

/// "landmark L17 moved 41 mm".
std::string move_text(const PointMove& move, const std::string& quantity);

/// The run and the subject of a record id.
struct RecordName {
  std::string run;      ///< "layout-1-pose-2"; empty: all runs.
  std::string subject;  ///< "bearing/lpca/2000".
};

/// @param id  "layout-1-pose-2/bearing/lpca/2000", "bearing/lpca/2000 of 5 runs",
///            "plaza-1/spectral/path".
RecordName subject_of(const std::string& id);

}  // namespace mapproof
