#include "reports/diff/records/record_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/words.hpp"
#include "core/results/great_errors.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostRecordNames = 3;
constexpr std::size_t kLongestName = 200;  // Of labels, whose levels come last.

constexpr double kSignificant = 0.05;

/// The absolute effect of a significant test, else 0.
double reported_effect(const Comparison& c) {
  return c.test && c.test->p < kSignificant ? std::abs(c.test->change.ranks.effect) : 0.0;
}

std::string names_text(const std::vector<std::string>& names) {
  std::vector<std::string> shown;
  for (const std::string& name : names) shown.push_back(printable(name, kLongestName));
  return listed(shown, kMostRecordNames);
}

/// "seed 2007 → 2008, poses 5 → 10": the first changes.
std::string changes_text(const std::vector<SettingChange>& changes) {
  std::vector<std::string> parts;
  for (const SettingChange& change : changes) {
    const auto shown = [](const std::string& value) {
      return value.empty() ? std::string("none") : printable(value, 40);
    };
    parts.push_back(fmt::format("{} {} \u2192 {}", printable(change.pointer.substr(1)),
                                shown(change.baseline), shown(change.current)));
  }
  return parts.empty() ? "" : listed(parts, kMostRecordNames);
}

/// Whether a value of the experiment only describes it: no record depends on it.
bool describes_only(const SettingChange& change) {
  constexpr std::array<std::string_view, 10> kDescriptions = {
      "title", "label",  "note",    "notes",     "source",
      "table", "figure", "figures", "published", "orderings"};
  std::string_view rest = change.pointer;
  while (!rest.empty()) {
    rest.remove_prefix(1);  // "/"
    const std::string_view key = rest.substr(0, rest.find('/'));
    if (std::ranges::find(kDescriptions, key) != kDescriptions.end()) return true;
    rest.remove_prefix(key.size());
  }
  return false;
}

/// Adds the records that only one side has.
void judge_presence(const RecordDiff& diff, Judgement& whole, std::vector<std::string>& causes) {
  const auto add = [&](const std::vector<std::string>& names, Verdict verdict, const char* noun) {
    if (names.empty()) return;
    whole.verdict = heavier(whole.verdict, verdict);
    causes.push_back(fmt::format("{}{}{}: {}", verdict == Verdict::kMissing ? "missing " : "new ",
                                 noun, names.size() == 1 ? "" : "s", names_text(names)));
  };
  add(diff.missing_runs, Verdict::kMissing, "run");
  add(labels_of(diff, diff.missing_subjects), Verdict::kMissing, "record");
  add(diff.new_runs, Verdict::kNew, "run");
  add(labels_of(diff, diff.new_subjects), Verdict::kNew, "record");
}

/// "; it is probably better, but there are too few runs to be sure", where this quantity alone
/// points one way: by a p that is not significant among all, or without a test in all of three or
/// more runs.
std::string tendency_words(const Comparison& c) {
  constexpr int kFewest = 3;
  if (c.quantity.better == Better::kNeither || c.quantity.of_solver) return "";
  bool worse = c.worse > 0;
  if (c.test) {
    if (c.test->change.p >= kSignificant || c.test->p < kSignificant) return "";
    worse = (c.test->change.ranks.effect > 0.0) == (c.quantity.better == Better::kLower);
  } else if ((c.worse > 0) == (c.better > 0) || c.worse + c.better < kFewest) {
    return "";
  }
  return fmt::format("; it is probably {}, but there are too few runs to be sure",
                     worse ? "worse" : "better");
}

/// Why a test has no p, or decides nothing; else empty.
std::string test_words(const Comparison& c) {
  if (c.test && !has_p(c)) return fmt::format("; {}", kNoPWords);
  if (!c.test || c.outcome != Outcome::kChanged) return "";
  return c.test->p < kSignificant
             ? fmt::format(", with a small effect of {:.2f}", c.test->change.ranks.effect)
             : ", neither better nor worse over the runs";
}

void judge_comparisons(const RecordDiff& diff, Judgement& whole, std::vector<std::string>& causes) {
  std::vector<const Comparison*> all;
  for (const Comparison& comparison : diff.comparisons) {
    all.push_back(&comparison);
    whole.verdict = heavier(whole.verdict, verdict_of(comparison.outcome));
  }
  const Comparison* first = most_telling(all);
  if (first == nullptr || verdict_of(first->outcome) <= Verdict::kWithinTolerance) return;
  const auto beyond = std::ranges::count_if(
      all, [](const Comparison* c) { return verdict_of(c->outcome) > Verdict::kWithinTolerance; });
  causes.push_back(fmt::format("{} of {}{}{}{}{}", comparison_text(*first),
                               label_text(first->label), test_words(*first), tendency_words(*first),
                               beyond > 1
                                   ? fmt::format("; {} {}, too", counted(beyond - 1, "other score"),
                                                 beyond == 2 ? "differs" : "differ")
                                   : "",
                               directions_text(all, *first)));
}

std::string unit_words(const Quantity& quantity) {
  return quantity.unit.empty() ? "without a unit" : "in " + printable(quantity.unit, 40);
}

/// Quantities with different units are not compared, whatever their numbers are.
void judge_quantities(const RecordDiff& diff, Judgement& whole, std::vector<std::string>& causes) {
  for (const auto& [before, after] : diff.redeclared) {
    whole.verdict = heavier(whole.verdict, Verdict::kChanged);
    const std::string label = printable(after.label, 100);
    causes.push_back(
        before.unit != after.unit
            ? fmt::format("{} is {} in the baseline and {} in the current: not compared", label,
                          unit_words(before), unit_words(after))
            : fmt::format("of {} {} is better in the baseline and {} in the current", label,
                          name(before.better), name(after.better)));
  }
}

/// Subjects whose change a quantity already judges.
std::set<std::string> judged_subjects(const RecordDiff& diff) {
  std::set<std::string> subjects;
  for (const Comparison& comparison : diff.comparisons)
    if (verdict_of(comparison.outcome) > Verdict::kWithinTolerance)
      subjects.insert({comparison.subject, comparison.current_subject});
  return subjects;
}

void judge_points(const RecordDiff& diff, Judgement& whole, std::vector<std::string>& causes) {
  const std::set<std::string> judged = judged_subjects(diff);
  const PointsDiff* first = nullptr;
  const PointsDiff* renamed = nullptr;
  const PointMove* given = nullptr;
  long records = 0, others = 0;
  for (const PointsDiff& points : diff.points) {
    const bool beyond = points.beyond + points.lost + points.gained > 0 ||
                        points.ground_truth_differs || !points.renamed.empty();
    if (renamed == nullptr && !points.renamed.empty()) renamed = &points;
    if (given == nullptr && points.moved_ground_truth) given = &*points.moved_ground_truth;
    if (!beyond)
      whole.verdict = heavier(whole.verdict, Verdict::kWithinTolerance);
    else if (!judged.contains(subject_of(points.record).subject))
      whole.verdict = heavier(whole.verdict, Verdict::kChanged);
    if (points.ground_truth_differs) ++others;
    if (!beyond || points.moves.empty()) continue;
    ++records;
    if (first == nullptr || points.moves[0].moved > first->moves[0].moved) first = &points;
  }
  if (first != nullptr)
    causes.push_back(fmt::format(
        "{} in record {}{}", moves_text(*first), first->record,
        records > 1 ? fmt::format(", points moved in {} in all", counted(records, "record")) : ""));
  if (renamed != nullptr)
    causes.push_back(
        fmt::format("renamed in record {}: {}", renamed->record, names_text(renamed->renamed)));
  if (others > 0 && diff.same_seeds)
    causes.push_back(given == nullptr
                         ? fmt::format("{} of different landmarks", counted(others, "map"))
                         : fmt::format("the true position of {}", move_text(*given, "landmark_m")));
}

void judge_rest(const RecordDiff& diff, Judgement& whole, std::vector<std::string>& causes) {
  const std::set<std::string> judged = judged_subjects(diff);
  for (const StatusChange& change : diff.statuses)
    if (!judged.contains(subject_of(change.record).subject))
      whole.verdict = heavier(whole.verdict, Verdict::kChanged);
  const auto follows = [&diff](const StatusChange& change) {
    return std::ranges::any_of(diff.others, [&](const OtherDiff& other) {
      return other.presence != Presence::kBoth &&
             other.file.ends_with("/" + subject_of(change.record).run + ".json");
    });
  };
  // What is not in a file that one side lacks follows from that.
  if (!diff.statuses.empty() && !follows(diff.statuses[0])) {
    const StatusChange& first = diff.statuses[0];
    causes.push_back(fmt::format("warnings of {}: {} \u2192 {}", first.record,
                                 first.baseline.empty() ? "none" : first.baseline,
                                 first.current.empty() ? "none" : first.current));
  }
  if (!diff.anchors.empty()) {
    whole.verdict = heavier(whole.verdict, Verdict::kChanged);
    causes.push_back("different anchors in " + names_text(diff.anchors));
  }
}

void judge_others(const RecordDiff& diff, Judgement& whole, std::vector<std::string>& causes) {
  std::size_t lone_files = 0;
  for (const OtherDiff& other : diff.others) {
    const bool lone = other.presence != Presence::kBoth;
    const bool beyond = lone || other.beyond > 0 || other.shape;
    if (lone)
      whole.verdict = heavier(
          whole.verdict, other.presence == Presence::kBaseline ? Verdict::kMissing : Verdict::kNew);
    else if (!beyond)
      whole.verdict = heavier(whole.verdict, Verdict::kWithinTolerance);
    else if (whole.verdict <= Verdict::kWithinTolerance)  // Otherwise scores judge it.
      whole.verdict = Verdict::kChanged;
    if (lone && lone_files++ < kMostRecordNames)
      causes.insert(causes.begin(), other_text(other));
    else if (beyond && causes.empty())
      causes.push_back(other_text(other));
  }
}

/// Counts of the differences within tolerance.
std::string within_text(const RecordDiff& diff) {
  long values = 0, points = 0, numbers = 0;
  for (const Comparison& c : diff.comparisons) values += c.within + c.beyond;
  for (const PointsDiff& p : diff.points) points += p.within;
  for (const OtherDiff& o : diff.others) numbers += o.within;
  return fmt::format("{}, {} and {} differ within tolerance", counted(values, "value"),
                     counted(points, "position"), counted(numbers, "other number"));
}

std::string sentence(const std::vector<std::string>& causes) {
  std::string text;
  for (const std::string& cause : causes) text += (text.empty() ? "" : "; ") + cause;
  return text;
}

}  // namespace

Verdict verdict_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kEqual:
      return Verdict::kIdentical;
    case Outcome::kWithinTolerance:
      return Verdict::kWithinTolerance;
    case Outcome::kBetter:
      return Verdict::kBetter;
    case Outcome::kWorse:
      return Verdict::kWorse;
    case Outcome::kChanged:
      return Verdict::kChanged;
  }
  return Verdict::kChanged;
}

const Comparison* most_telling(const std::vector<const Comparison*>& comparisons) {
  const Comparison* first = nullptr;
  for (const Comparison* comparison : comparisons)
    if (first == nullptr || shows_more(*comparison, *first)) first = comparison;
  return first;
}

std::string directions_text(const std::vector<const Comparison*>& all, const Comparison& first) {
  if (first.outcome != Outcome::kChanged || first.test) return "";
  int worse = 0, better = 0, both = 0;
  for (const Comparison* c : all) {
    if (c->quantity.of_solver) continue;
    const bool is_worse = c->worse + c->lost > 0, is_better = c->better + c->gained > 0;
    both += is_worse && is_better;
    worse += is_worse && !is_better;
    better += is_better && !is_worse;
  }
  std::string text;
  for (const auto& [count, word] :
       {std::pair(worse, "worse"), {better, "better"}, {both, "both ways"}})
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, word);
  return (worse > 0) + (better > 0) + (both > 0) > 1 ? " (errors: " + text + ")" : "";
}

std::string other_text(const OtherDiff& other) {
  if (other.presence == Presence::kBaseline) return printable(other.file) + " is missing";
  if (other.presence == Presence::kCurrent) return printable(other.file) + " is new";
  const std::string file = other.file.empty() ? "the file" : printable(other.file);
  const std::string what = other.beyond == 0
                               ? std::string("its keys, words or lengths differ")
                               : fmt::format("{} {}", counted(other.beyond, "number"),
                                             other.beyond == 1 ? "differs" : "differ");
  return fmt::format("{}: {}, the first at {} {} \u2192 {}", file, what, printable(other.first),
                     printable(other.baseline), printable(other.current));
}

std::vector<std::string> labels_of(const RecordDiff& diff,
                                   const std::vector<std::string>& subjects) {
  std::vector<std::string> labels;
  for (const std::string& subject : subjects) {
    const auto label = diff.labels.find(subject);
    labels.push_back(label == diff.labels.end() ? subject : label_text(label->second));
  }
  return labels;
}

std::string settings_text(const RecordDiff& diff) {
  std::string text = changes_text(diff.settings);
  if (diff.same_seeds) return text;
  const std::string why = diff.moved_ground_truth.empty() ? "different seeds or true positions"
                                                          : diff.moved_ground_truth;
  return text + (text.empty() ? "" : ": ") + why;
}

std::string comparison_text(const Comparison& comparison, const std::string& run) {
  const Quantity& quantity = comparison.quantity;
  const ScaledUnit unit = shown_unit(comparison);
  const auto changed = [&](double baseline, double current) {
    return change_text(
        unit.factor * baseline, unit.factor * current, unit.unit,
        unit.unit == quantity.unit && has_great_errors(quantity, comparison.least_value));
  };
  const auto own = std::ranges::find(comparison.largest, run, &PairedValue::run);
  const bool has_own = own != comparison.largest.end();
  const bool is_alone = !has_own && run.empty() && comparison.pairs > 1 && comparison.beyond == 1 &&
                        comparison.largest.size() == 1 && comparison.lost + comparison.gained == 0;
  std::string p;
  if (has_p(comparison)) p = ", " + p_words(comparison.test->p);
  if (is_alone) {
    const PairedValue& only = comparison.largest.front();
    return fmt::format("{} {} in run {} alone of {}{}", quantity.label,
                       changed(only.baseline, only.current), only.run,
                       comparison.pairs, p);
  }
  std::string text = fmt::format(
      "{} {}", quantity.label,
      has_own ? changed(own->baseline, own->current)
              : changed(comparison.baseline_mean, comparison.current_mean));
  if (!has_own && comparison.pairs > 1)
    text += fmt::format(" over {}", counted(comparison.pairs, "run"));
  text += p;
  if (comparison.lost > 0) text += fmt::format(", lost in {}", counted(comparison.lost, "run"));
  if (comparison.gained > 0)
    text += fmt::format(", gained in {}", counted(comparison.gained, "run"));
  return text;
}

std::string moves_text(const PointsDiff& points) {
  return points.transform.empty() ? move_text(points.moves.front(), points.quantity)
                                  : points.transform;
}

std::string move_text(const PointMove& move, const std::string& quantity) {
  const std::string who = (quantity == "path_m" ? "position " : "landmark ") + printable(move.name);
  if (!std::isfinite(move.moved))
    return who + (std::isfinite(move.current.x) ? " gained a position" : " lost its position");
  if (quantity == "landmark_shape")
    return fmt::format("{} moved {:.3g} of the map's spread", who, move.moved);
  if (move.moved > kGreatestError_m) return fmt::format("{} moved {}", who, kGreatErrorText);
  return move.moved < 0.9995 ? fmt::format("{} moved {:.3g} mm", who, 1000.0 * move.moved)
                             : fmt::format("{} moved {:.3g} m", who, move.moved);
}

Judgement judge(const RecordDiff& diff) {
  Judgement whole;
  std::vector<std::string> causes;
  const std::string settings = settings_text(diff);
  judge_quantities(diff, whole, causes);
  judge_presence(diff, whole, causes);
  judge_comparisons(diff, whole, causes);
  judge_points(diff, whole, causes);
  judge_rest(diff, whole, causes);
  judge_others(diff, whole, causes);
  if (!diff.problems.empty()) {
    // Records that are lost with an unreadable file are not listed besides that file.
    const auto more = std::ssize(diff.problems) - 1;
    whole.verdict = Verdict::kUnreadable;
    causes = {diff.problems[0].what +
              (more > 0 ? fmt::format(", and {}", counted(more, "file")) + " more" : "")};
  }
  if (!settings.empty()) {
    std::string text = settings;
    if (whole.verdict <= Verdict::kWithinTolerance) {
      const bool describes = std::ranges::all_of(diff.settings, describes_only);
      whole.verdict = describes ? Verdict::kStyle : Verdict::kChanged;
      if (!describes)
        text = changes_text(diff.settings) +
               ", but the records did not change: they are not of this experiment";
    }
    causes.insert(causes.begin() + std::ssize(diff.redeclared), text);
  }
  if (whole.verdict == Verdict::kWithinTolerance) causes.push_back(within_text(diff));
  whole.cause = sentence(causes);
  return whole;
}

std::string_view name(Presence presence) {
  switch (presence) {
    case Presence::kBoth:
      return "both";
    case Presence::kBaseline:
      return "baseline";
    case Presence::kCurrent:
      return "current";
  }
  return "";
}

ScaledUnit shown_unit(const Comparison& comparison) {
  return scaled_unit(comparison.quantity, comparison.greatest_mean);
}

bool has_p(const Comparison& comparison) {
  return comparison.test && comparison.test->change.has_p();
}

bool shows_more(const Comparison& a, const Comparison& b) {
  const Verdict first = verdict_of(a.outcome), second = verdict_of(b.outcome);
  if (first != second) return first > second;
  const std::size_t rank = dictionary_rank(a.quantity), other = dictionary_rank(b.quantity);
  if (rank != other) return rank < other;
  if (reported_effect(a) != reported_effect(b)) return reported_effect(a) > reported_effect(b);
  const double p = a.test ? a.test->p : 1.0, q = b.test ? b.test->p : 1.0;
  if (p != q) return p < q;
  if (first == Verdict::kChanged && !a.test && !b.test && a.quantity.better == Better::kLower &&
      a.baseline_mean != b.baseline_mean)
    return a.baseline_mean < b.baseline_mean || std::isnan(b.baseline_mean);
  const auto change = [](const Comparison& c) {
    const double ratio =
        std::abs(c.current_mean - c.baseline_mean) / std::max(std::abs(c.baseline_mean), 1e-300);
    return std::isnan(ratio) ? 0.0 : ratio;
  };
  return change(a) > change(b);
}

std::string_view name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kEqual:
      return "equal";
    case Outcome::kWithinTolerance:
      return "within-tolerance";
    case Outcome::kBetter:
      return "better";
    case Outcome::kWorse:
      return "worse";
    case Outcome::kChanged:
      return "changed";
  }
  return "";
}

RecordName subject_of(const std::string& id) {
  RecordName name{.run = "", .subject = id.substr(0, id.find(" of "))};
  constexpr std::string_view kPath = "/path";
  if (name.subject.ends_with(kPath)) name.subject.resize(name.subject.size() - kPath.size());
  const std::size_t slash = name.subject.find('/');
  if (name.subject.starts_with("layout-") && slash != std::string::npos) {
    name.run = name.subject.substr(0, slash);
    name.subject.erase(0, slash + 1);
  }
  return name;
}

}  // namespace mapproof
