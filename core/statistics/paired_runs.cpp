#include "core/statistics/paired_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/statistics/signed_rank.hpp"

namespace mapproof {
namespace {

/// The p that ranks have to be able to give, of all tests together: a tenth of the level of a
/// nightly run.
constexpr double kFinestP = 1e-4;

/// How many different names there are.
std::size_t count_of(std::vector<std::uint32_t> ids) {
  std::ranges::sort(ids);
  return ids.size() - std::ranges::unique(ids).size();
}

}  // namespace

bool changes_in_points(const Quantity& quantity) { return quantity.unit == "%"; }

double value_change(bool in_points, double before, double after) {
  return in_points ? after - before
                   : std::log(std::max(after, kLeastError) / std::max(before, kLeastError));
}

PairedUnits paired_units(std::vector<RunChange> changes, bool draws_groups) {
  std::vector<std::uint32_t> ids;
  ids.reserve(changes.size());
  const auto count = [&](Name RunChange::*name) {
    ids.clear();
    for (const RunChange& one : changes) ids.push_back((one.*name).id());
    return count_of(ids);
  };
  const std::size_t runs = count(&RunChange::run), groups = count(&RunChange::group);
  std::vector<std::uint32_t>().swap(ids);
  const bool by_group =
      groups < runs && (draws_groups || std::cmp_greater_equal(groups, kLeastGroups));
  Name RunChange::*const of = by_group ? &RunChange::group : &RunChange::run;
  if (by_group) std::ranges::stable_sort(changes, {}, of);
  PairedUnits units{.unit = !by_group ? "run" : draws_groups ? "group" : "layout"};
  units.changes.reserve(by_group ? groups : runs);
  for (auto first = changes.begin(); first != changes.end();) {
    const Name unit = (*first).*of;
    double sum = 0.0;
    int values = 0;
    for (; first != changes.end() && (*first).*of == unit; ++first, ++values) sum += first->value;
    units.changes.push_back(sum / values);
  }
  return units;
}

PairedTests test_pairs(std::span<const std::span<const double>> units,
                       std::span<const double> others) {
  const std::size_t tests = units.size() + others.size();
  const PairedChangeOptions options{
      .finest_p = kFinestP / static_cast<double>(std::max<std::size_t>(tests, 1))};
  PairedTests all;
  for (const std::span<const double> changes : units) {
    all.changes.push_back(paired_change(changes, options));
    all.p.push_back(all.changes.back().p);
  }
  all.p.insert(all.p.end(), others.begin(), others.end());
  all.p = holm(all.p);
  return all;
}

}  // namespace mapproof
