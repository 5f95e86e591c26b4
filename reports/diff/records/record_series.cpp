#include "reports/diff/records/record_series.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/statistics/paired_runs.hpp"
#include "reports/diff/records/number_diff.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostPairs = 20;
constexpr std::size_t kMostValues = 1000;

std::set<std::string> subjects_of(const RecordSet& set) {
  std::set<std::string> subjects;
  for (const auto& [key, values] : set.values) subjects.insert(key.subject);
  return subjects;
}

/// Subjects of `some` that are not in `others`, by family.
std::map<std::string, std::vector<std::string>> lone_subjects(const RecordSet& some,
                                                              const RecordSet& others) {
  const std::set<std::string> there = subjects_of(others);
  std::map<std::string, std::vector<std::string>> lone;
  for (const std::string& subject : subjects_of(some)) {
    if (there.contains(subject)) continue;
    const auto family = some.families.find(subject);
    if (family != some.families.end()) lone[family->second.name].push_back(subject);
  }
  return lone;
}

/// A mean of values that come one by one.
class Mean {
 public:
  void add(double value) {
    sum_ += value;
    ++count_;
  }
  bool empty() const { return count_ == 0; }
  /// NaN without a value.
  double value() const { return empty() ? kNaN : sum_ / static_cast<double>(count_); }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

double mean_of(const ValuesByRun& values) {
  Mean mean;
  for (const auto& [run, value] : values)
    if (std::isfinite(value)) mean.add(value);
  return mean.value();
}

/// Leaves the largest of all pairs; of equal ones those that came first.
void keep_largest(std::vector<PairedValue>& pairs) {
  const auto size = [](const PairedValue& pair) {
    const double difference = std::abs(pair.current - pair.baseline);
    return std::isnan(difference) ? kInfinity : difference;
  };
  std::ranges::stable_sort(pairs, std::ranges::greater(), size);
  if (pairs.size() > kMostPairs) pairs.resize(kMostPairs);
}

void add_to_largest(const PairedValue& pair, std::vector<PairedValue>& pairs) {
  constexpr std::size_t kHeld = 1000;  // Of which the largest are found at once.
  if (pairs.size() == kHeld) keep_largest(pairs);
  pairs.push_back(pair);
}

void compare_pair(const PairedValue& pair, const Name& run, const Tolerance& tolerance,
                  Comparison& out, const auto& differ) {
  const double a = pair.baseline, b = pair.current;
  if (std::isnan(a) && std::isnan(b)) return;
  if (std::isnan(a) || std::isnan(b)) {
    ++(std::isnan(a) ? out.gained : out.lost);
    add_to_largest(pair, out.largest);
    return;
  }
  ++out.pairs;
  if (std::isinf(a) ||
      std::isinf(b)) {  // A gap without a certificate: no difference, but better or worse.
    if (a == b) {
      ++out.equal;
      return;
    }
  } else {
    differ(run, a, b);
    if (a == b) {
      ++out.equal;
      return;
    }
    if (tolerance.holds(a, b)) {
      ++out.within;
      return;
    }
  }
  ++out.beyond;
  ++(b > a ? out.worse : out.better);
  add_to_largest(pair, out.largest);
}

/// The value of a run; NaN if the side has the run but not the value, empty if it has neither.
std::optional<double> value_of(const RecordSet& set, const double* value, const Name& run) {
  if (value != nullptr) return *value;
  return run.empty() || set.runs.contains(run) ? std::optional(kNaN) : std::nullopt;
}

/// Both sides of a comparison.
struct RecordPair {
  const RecordSet& baseline;
  const RecordSet& current;
  bool same_seeds = false;  ///< See have_same_seeds().
};

/// Calls `pair(run, value, other value)` for each run of either side, in ascending order; null: the
/// side has no value.
template <typename Pair>
void for_each_run(const ValuesByRun& a, const ValuesByRun& b, const Pair& pair) {
  auto one = a.begin(), other = b.begin();
  while (one != a.end() || other != b.end()) {
    const bool has_one = one != a.end() && (other == b.end() || !(other->first < one->first));
    const bool has_other = other != b.end() && (one == a.end() || !(one->first < other->first));
    pair(has_one ? one->first : other->first, has_one ? &one->second : nullptr,
         has_other ? &other->second : nullptr);
    if (has_one) ++one;
    if (has_other) ++other;
  }
}

bool has_negative(const ValuesByRun& values) {
  return std::ranges::any_of(values, [](const auto& value) { return value.second < 0.0; });
}

/// Compares one quantity of one subject over all runs.
/// @param changes  Of the runs, to be tested in pairs; empty if they are not pairs.
Comparison compare(const RecordPair& sides, const ValuesByRun& before, const ValuesByRun& after,
                   const Quantity& quantity, const Tolerance& tolerance,
                   std::vector<RunChange>& changes) {
  const auto& [a, b, same_seeds] = sides;
  Comparison out;
  Mean firsts, seconds;
  const bool in_points = changes_in_points(quantity) || has_negative(before) || has_negative(after);
  const bool are_pairs = same_seeds && a.repeats;
  if (are_pairs) changes.reserve(std::min(before.size(), after.size()));
  const auto differ = [&](const Name& run, double first, double second) {
    if (are_pairs)
      changes.push_back(
          {run, a.runs.find(run).value_or(run), value_change(in_points, first, second)});
  };
  for_each_run(before, after, [&](const Name& run, const double* one, const double* other) {
    const std::optional<double> first = value_of(a, one, run), second = value_of(b, other, run);
    if (!first || !second) return;
    compare_pair({run, *first, *second}, run, tolerance, out, differ);
    if (!std::isfinite(*first) || !std::isfinite(*second)) return;
    firsts.add(*first);
    seconds.add(*second);
    if (out.values.size() < kMostValues) out.values.push_back({*first, *second});
  });
  out.baseline_mean = same_seeds && !firsts.empty() ? firsts.value() : mean_of(before);
  out.current_mean = same_seeds && !seconds.empty() ? seconds.value() : mean_of(after);
  keep_largest(out.largest);
  return out;
}

/// Whether all errors that differ, of any quantity and subject, became worse, or all became better.
bool point_one_way(const std::vector<Comparison>& all) {
  bool worse = false, better = false;
  for (const Comparison& c : all) {
    if (c.quantity.of_solver) continue;
    worse = worse || c.worse + c.lost > 0;
    better = better || c.better + c.gained > 0;
  }
  return !worse || !better;
}

SubjectLabel label_of(const RecordSet& set, const std::string& subject) {
  const auto label = set.labels.find(subject);
  return label == set.labels.end() ? SubjectLabel{subject} : label->second;
}

/// Of both sides: parts that differ have an arrow between them.
SubjectLabel joint_label(const SubjectLabel& before, const SubjectLabel& after) {
  if (before.size() != after.size()) return {label_text(before) + " \u2192 " + label_text(after)};
  SubjectLabel joint = before;
  for (std::size_t i = 0; i < joint.size(); ++i)
    if (after[i] != joint[i]) joint[i] += " \u2192 " + after[i];
  return joint;
}

/// The quantities of the dictionary, and those that either side declares. Quantities that the sides
/// declare in different units are left out; those that they declare with different directions have
/// none.
std::vector<Quantity> compared_quantities(const RecordSet& a, const RecordSet& b) {
  std::vector<Quantity> all = b.quantities.all();
  for (const Quantity& before : a.quantities.declared()) {
    const auto after = std::ranges::find(all, before.id, &Quantity::id);
    if (after == all.end())
      all.push_back(before);
    else if (after->unit != before.unit)
      all.erase(after);
    else if (after->better != before.better)
      after->better = Better::kNeither;
  }
  return all;
}

/// @param one_way  The result of point_one_way() for all.
Outcome outcome_of(const Comparison& c, bool same_seeds, bool one_way,
                   const RecordOptions& options) {
  const Quantity& quantity = c.quantity;
  if (c.beyond + c.lost + c.gained == 0)
    return c.within > 0 ? Outcome::kWithinTolerance : Outcome::kEqual;
  if (quantity.better == Better::kNeither || !same_seeds) return Outcome::kChanged;
  const bool up_is_worse = quantity.better == Better::kLower;
  if (c.test && c.lost + c.gained == 0) {
    const double effect = c.test->change.ranks.effect;
    const bool decides = c.test->p < options.significance &&
                         std::abs(effect) >= options.least_effect &&
                         (c.test->change.has_p() || !quantity.of_solver);
    if (!decides) return Outcome::kChanged;
    return (effect > 0.0) == up_is_worse ? Outcome::kWorse : Outcome::kBetter;
  }
  const int worse = c.worse + c.lost, better = c.better + c.gained;
  if (quantity.of_solver || (worse > 0 && better > 0)) return Outcome::kChanged;
  // A lost or gained score decides without other scores.
  if (!one_way && c.lost + c.gained == 0) return Outcome::kChanged;
  return worse > 0 ? Outcome::kWorse : Outcome::kBetter;
}

/// Tests those that differ beyond tolerance in enough units.
/// @param units  Of each.
void test_all(std::vector<Comparison>& all, const std::vector<PairedUnits>& units) {
  const auto is_tested = [&](std::size_t i) {
    return all[i].beyond > 0 && std::cmp_greater_equal(units[i].changes.size(), kLeastUnits);
  };
  std::vector<std::span<const double>> tested;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_tested(i)) tested.push_back(units[i].changes);
  const auto [changes, p] = test_pairs(tested);
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_tested(i)) continue;
    all[i].test = PairedTest{units[i].unit, changes[next], p[next]};
    ++next;
  }
}

void set_greatest_means(std::vector<Comparison>& all) {
  std::map<std::string, double> greatest;  // By quantity.
  for (const Comparison& one : all)
    for (const double mean : {one.baseline_mean, one.current_mean})
      if (std::isfinite(mean))
        greatest[one.quantity.id] = std::max(greatest[one.quantity.id], std::abs(mean));
  for (Comparison& one : all) one.greatest_mean = greatest[one.quantity.id];
}

/// Series that do not differ have values, too.
void set_least_values(const RecordSet& a, const RecordSet& b, std::vector<Comparison>& all) {
  std::map<std::string, double> least;  // By quantity.
  for (const RecordSet* side : {&a, &b})
    for (const auto& [key, values] : side->values) {
      double& lowest = least.try_emplace(key.quantity, kInfinity).first->second;
      for (const auto& [run, value] : values)
        if (std::isfinite(value)) lowest = std::min(lowest, value);
    }
  for (Comparison& one : all) one.least_value = least[one.quantity.id];
}

}  // namespace

bool have_same_seeds(const RecordSet& a, const RecordSet& b, const Tolerances& tolerances) {
  if (a.seed != b.seed) return false;
  return std::ranges::all_of(a.worlds, [&](const auto& world) {
    const auto other = b.worlds.find(world.first);
    return other == b.worlds.end() || same_positions(world.second, other->second, tolerances);
  });
}

std::string moved_ground_truth(const RecordSet& a, const RecordSet& b,
                               const Tolerances& tolerances) {
  for (const auto& [run, world] : a.worlds) {
    const auto other = b.worlds.find(run);
    if (other == b.worlds.end() || world.points.rows() != other->second.points.rows()) continue;
    const auto diff = points_diff("", world, other->second, tolerances);
    if (diff && !diff->moves.empty())
      return fmt::format("the true position of {} in {}",
                         move_text(diff->moves.front(), diff->quantity), run);
  }
  return "";
}

std::map<std::string, std::string> matched_subjects(const RecordSet& a, const RecordSet& b) {
  std::map<std::string, std::string> matched;
  for (const std::string& subject : subjects_of(a)) matched[subject] = subject;
  const auto after = lone_subjects(b, a);
  for (const auto& [family, before] : lone_subjects(a, b)) {
    const auto other = after.find(family);
    if (other != after.end() && before.size() == 1 && other->second.size() == 1)
      matched[before[0]] = other->second[0];
  }
  return matched;
}

std::vector<Comparison> compare_series(const RecordSet& a, const RecordSet& b, bool same_seeds,
                                       const RecordOptions& options, long& values) {
  const std::set<std::string> there = subjects_of(b);
  static const ValuesByRun kNone;
  const std::vector<Quantity> quantities = compared_quantities(a, b);
  const bool draws_groups = a.draws_groups || b.draws_groups;
  std::vector<Comparison> all;
  std::vector<PairedUnits> units;
  values = 0;
  for (const auto& [subject, other] : matched_subjects(a, b)) {
    if (!there.contains(other)) continue;
    for (const Quantity& quantity : quantities) {
      const auto before = a.values.find({subject, quantity.id});
      const auto after = b.values.find({other, quantity.id});
      if (before == a.values.end() && after == b.values.end()) continue;
      std::vector<RunChange> changes;
      Comparison c = compare({a, b, same_seeds}, before == a.values.end() ? kNone : before->second,
                             after == b.values.end() ? kNone : after->second, quantity,
                             tolerance_of(quantity, options.tolerances), changes);
      values += c.pairs + c.lost + c.gained;
      c.subject = subject;
      c.current_subject = other;
      c.label = joint_label(label_of(a, subject), label_of(b, other));
      c.quantity = quantity;
      if (quantity.better == Better::kHigher) std::swap(c.worse, c.better);
      if (quantity.better == Better::kNeither || !same_seeds) c.worse = c.better = 0;
      if (c.within + c.beyond + c.lost + c.gained == 0) continue;
      units.push_back(c.beyond > 0 ? paired_units(std::move(changes), draws_groups)
                                   : PairedUnits{});
      all.push_back(std::move(c));
    }
  }
  set_greatest_means(all);
  set_least_values(a, b, all);
  test_all(all, units);
  const bool one_way = point_one_way(all);
  for (Comparison& one : all) one.outcome = outcome_of(one, same_seeds, one_way, options);
  return all;
}

}  // namespace mapproof
