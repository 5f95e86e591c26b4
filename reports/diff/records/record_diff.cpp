#include "reports/diff/records/record_diff.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/diff/records/number_diff.hpp"
#include "reports/diff/records/record_comparison.hpp"
#include "reports/diff/records/record_series.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Calls `both` for keys on both sides and lists the others.
template <typename Map, typename Both>
void match(const Map& a, const Map& b, std::vector<std::string>& missing,
           std::vector<std::string>& added, Both both) {
  for (const auto& [key, value] : a) {
    const auto other = b.find(key);
    if (other == b.end())
      missing.push_back(key);
    else
      both(key, value, other->second);
  }
  for (const auto& [key, value] : b)
    if (!a.contains(key)) added.push_back(key);
}

void compare_settings(const RecordSet& a, const RecordSet& b, RecordDiff& diff) {
  std::set<std::string> pointers;
  for (const RecordSet* side : {&a, &b})
    for (const auto& [pointer, value] : side->settings) pointers.insert(pointer);
  for (const std::string& pointer : pointers) {
    const auto before = a.settings.find(pointer), after = b.settings.find(pointer);
    const std::string first = before == a.settings.end() ? "" : before->second;
    const std::string second = after == b.settings.end() ? "" : after->second;
    if (first != second) diff.settings.push_back({pointer, first, second});
  }
}

void compare_provenance(const Provenance& a, const Provenance& b, RecordDiff& diff) {
  const auto add = [&](const std::string& what, const std::string& first,
                       const std::string& second) {
    if (first != second) diff.provenance.push_back({what, first, second});
  };
  add("mapproof", a.version, b.version);
  add("commit", a.commit, b.commit);
  add("solver digest", a.solver_digest, b.solver_digest);
  std::map<std::string, std::pair<std::string, std::string>> libraries;
  for (const auto& [library, version] : a.libraries) libraries[library].first = version;
  for (const auto& [library, version] : b.libraries) libraries[library].second = version;
  for (const auto& [library, versions] : libraries) add(library, versions.first, versions.second);
  std::map<std::string, std::pair<std::string, std::string>> methods;
  for (const MethodFiles& files : a.method_files) methods[files.method].first = files.sha256;
  for (const MethodFiles& files : b.method_files) methods[files.method].second = files.sha256;
  for (const auto& [method, digests] : methods)
    add("files of the method " + method, digests.first, digests.second);
}

void compare_subjects(const RecordSet& a, const RecordSet& b, RecordDiff& diff) {
  std::set<std::string> matched;
  std::set<std::string> there;
  for (const auto& [key, values] : b.values) there.insert(key.subject);
  for (const auto& [subject, other] : matched_subjects(a, b)) {
    if (there.contains(other))
      matched.insert(other);
    else
      diff.missing_subjects.push_back(subject);
  }
  for (const std::string& subject : there)
    if (!matched.contains(subject)) diff.new_subjects.push_back(subject);
  const auto add_labels = [&](const std::vector<std::string>& subjects, const RecordSet& side) {
    for (const std::string& subject : subjects)
      if (const auto label = side.labels.find(subject); label != side.labels.end())
        diff.labels.insert(*label);
  };
  add_labels(diff.missing_subjects, a);
  add_labels(diff.new_subjects, b);
}

/// Whether both sides should have a record. Records that are missing because of runs, subjects or
/// damaged files on only one side are reported there.
bool is_expected(const std::string& record, const RecordSet& a, const RecordSet& b) {
  const RecordName name = subject_of(record);
  const auto has = [&name](const RecordSet& set) {
    const bool damaged = std::ranges::any_of(set.problems, [&name](const RecordProblem& problem) {
      return problem.file.find(name.run + ".json") != std::string::npos;
    });
    return !damaged && set.runs.contains(name.run) &&
           std::ranges::any_of(set.values, [&name](const auto& entry) {
             return entry.first.subject == name.subject && entry.second.contains(name.run);
           });
  };
  return has(a) && has(b);
}

/// Files that are equal on both sides were not read.
void compare_points(const RecordSet& a, const RecordSet& b, const Tolerances& tolerances,
                    RecordDiff& diff) {
  std::vector<std::string> missing, added;
  match(a.points, b.points, missing, added,
        [&](const std::string& record, const AlignedPoints& before, const AlignedPoints& after) {
          if (auto moved = points_diff(record, before, after, tolerances))
            diff.points.push_back(*std::move(moved));
        });
  constexpr const char* kNoMap = "no map is kept";
  for (const std::string& record : missing)
    if (is_expected(record, a, b)) diff.statuses.push_back({record, "", kNoMap});
  for (const std::string& record : added)
    if (is_expected(record, a, b)) diff.statuses.push_back({record, kNoMap, ""});
}

void compare_rest(const RecordSet& a, const RecordSet& b, RecordDiff& diff) {
  std::vector<std::string> missing, added;
  match(a.statuses, b.statuses, missing, added,
        [&](const std::string& record, const std::string& before, const std::string& after) {
          if (before != after) diff.statuses.push_back({record, before, after});
        });
  match(a.anchors, b.anchors, missing, added,
        [&](const std::string& run, const std::string& before, const std::string& after) {
          if (before != after) diff.anchors.push_back(run);
        });
  for (const RecordSet* side : {&a, &b})
    diff.problems.insert(diff.problems.end(), side->problems.begin(), side->problems.end());
}

/// The run to which a file belongs:  "layout-1-pose-2" of "maps/layout-1-pose-2.json", "plaza-1" of
/// "paths/plaza-1/ekf.tum"; empty for others.
std::string run_of(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? *file.begin() : fs::path();
  if (folder == "paths") return std::next(file.begin())->string();
  return folder == "runs" || folder == "maps" || folder == "details" ? file.stem().string() : "";
}

/// Whether a file belongs to a run on only one side; it is then reported as a run.
bool is_reported_apart(const std::string& file, const RecordDiff& diff) {
  const std::string run = run_of(file);
  const auto is_run = [&](const std::vector<std::string>& runs) {
    return std::ranges::find(runs, run) != runs.end();
  };
  return !is_run(diff.missing_runs) && !is_run(diff.new_runs);
}

/// Differences of files that no quantity, position or warning covers.
void compare_others(const RecordSet& a, const RecordSet& b, const Tolerances& tolerances,
                    RecordDiff& diff) {
  std::vector<std::string> missing, added;
  match(a.others, b.others, missing, added,
        [&](const std::string& name, const fs::path& before, const fs::path& after) {
          const bool damaged =
              std::ranges::find(diff.problems, name, &RecordProblem::file) != diff.problems.end();
          if (damaged) return;
          try {
            OtherDiff other = number_diff(name, before, after, tolerances);
            if (other.within + other.beyond > 0 || other.shape)
              diff.others.push_back(std::move(other));
          } catch (const IoError& error) {
            diff.problems.push_back({name, error.what()});
          }
        });
  for (const std::string& name : missing)
    if (is_reported_apart(name, diff))
      diff.others.push_back({.file = name, .presence = Presence::kBaseline});
  for (const std::string& name : added)
    if (is_reported_apart(name, diff))
      diff.others.push_back({.file = name, .presence = Presence::kCurrent});
}

/// "bearing", "ISOMAP, K = 9", "2000 steps", "layout-1-pose-2" of a record; empty: not known.
SubjectLabel record_label(const std::string& record, const RecordSet& set) {
  const RecordName name = subject_of(record);
  const auto found = set.labels.find(name.subject);
  if (found == set.labels.end()) return {};
  SubjectLabel label = found->second;
  if (!name.run.empty()) label.push_back(name.run);
  return label;
}

}  // namespace

RecordDiff record_diff(const RecordSet& a, const RecordSet& b, const RecordOptions& options) {
  if (a.kind != b.kind)
    throw InvalidInput(fmt::format(
        "the baseline is a {}, the current a {}: they cannot be compared", a.kind, b.kind));
  RecordDiff diff;
  diff.same_seeds = have_same_seeds(a, b, options.tolerances);
  if (!diff.same_seeds && a.seed == b.seed)
    diff.moved_ground_truth = moved_ground_truth(a, b, options.tolerances);
  compare_settings(a, b, diff);
  compare_provenance(a.provenance, b.provenance, diff);
  for (const Name& run : a.runs.runs())
    if (!b.runs.contains(run)) diff.missing_runs.push_back(run);
  for (const Name& run : b.runs.runs())
    if (!a.runs.contains(run)) diff.new_runs.push_back(run);
  compare_subjects(a, b, diff);
  for (const RecordSet* side : {&a, &b})
    std::ranges::copy(side->quantities.declared(), std::back_inserter(diff.declared));
  for (const Quantity& before : a.quantities.declared())
    for (const Quantity& after : b.quantities.declared())
      if (before.id == after.id && (before.unit != after.unit || before.better != after.better))
        diff.redeclared.push_back({before, after});
  for (const RecordSet* side : {&a, &b}) {
    for (const auto& [subject, family] : side->families) diff.called[family.name].insert(subject);
    for (const auto& [id, subject] : side->called) diff.called[id].insert(subject);
  }
  diff.comparisons = compare_series(a, b, diff.same_seeds, options, diff.values);
  compare_points(a, b, options.tolerances, diff);
  for (PointsDiff& points : diff.points) points.label = record_label(points.record, b);
  compare_rest(a, b, diff);
  compare_others(a, b, options.tolerances, diff);
  diff.judgement = judge(diff);
  return diff;
}

RecordTie tie(const RecordDiff& diff, const std::string& id) {
  const RecordName name = subject_of(id);
  RecordTie found;
  found.run = name.run;
  const std::string record = name.run.empty() ? name.subject : name.run + "/" + name.subject;
  const auto called = diff.called.find(name.subject);
  const auto is_called = [&](const std::string& subject) {
    return subject == name.subject ||
           (called != diff.called.end() && called->second.contains(subject));
  };
  for (const PointsDiff& points : diff.points)
    if (points.record == record || points.record == record + "/path" || is_called(points.record))
      found.points.push_back(&points);
  for (const Comparison& comparison : diff.comparisons)
    if (is_called(comparison.subject) || is_called(comparison.current_subject) ||
        comparison.subject.starts_with(name.subject + "/"))
      found.comparisons.push_back(&comparison);
  for (const OtherDiff& other : diff.others)
    if ((other.beyond > 0 || other.shape) &&
        (other.file == name.subject + ".json" || other.file == "runs/" + name.subject + ".json"))
      found.others.push_back(&other);
  return found;
}

}  // namespace mapproof
