#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/results/results.hpp"

namespace mapproof {

/// One number per run, in ascending order of the runs' names: 16 bytes each.
class ValuesByRun {
 public:
  using value_type = std::pair<Name, double>;

  /// Of the run; 0 if it was not there. @note O(1) at the end, else O(n).
  double& operator[](const Name& run) {
    auto at = values_.end();
    if (!values_.empty() && !(values_.back().first < run)) at = values_.begin() + index_of(run);
    if (at == values_.end() || at->first != run) at = values_.insert(at, {run, 0.0});
    return at->second;
  }

  /// Null if the run is not there.
  const double* find(const Name& run) const {
    const auto at = values_.begin() + index_of(run);
    return at == values_.end() || at->first != run ? nullptr : &at->second;
  }
  bool contains(const Name& run) const { return find(run) != nullptr; }

  /// Adds the values of runs that are not there yet.
  void merge(const ValuesByRun& others);

  /// Leaves the values of those runs alone, which are in ascending order.
  void keep(const std::vector<Name>& runs);

  void reserve(std::size_t runs) { values_.reserve(runs); }
  bool empty() const { return values_.empty(); }
  std::size_t size() const { return values_.size(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

 private:
  std::ptrdiff_t index_of(const Name& run) const {
    return std::ranges::lower_bound(values_, run, {}, &value_type::first) - values_.begin();
  }

  std::vector<value_type> values_;
};

/// The group of each run, by Name::id(): 4 bytes per name of the process, and 4 per run.
class GroupsByRun {
 public:
  GroupsByRun() = default;
  /// Of all rows.
  explicit GroupsByRun(const std::vector<Result>& rows) {
    for (const Result& row : rows) set(row.run, row.group);
  }

  void set(const Name& run, const Name& group);

  /// Null if the run is not there. @note O(1).
  const Name* find(const Name& run) const { return contains(run) ? &groups_[run.id()] : nullptr; }
  bool contains(const Name& run) const { return run.id() < known_.size() && known_[run.id()]; }

  std::size_t size() const { return runs_.size(); }
  /// In ascending order.
  std::vector<Name> runs() const;

 private:
  std::vector<Name> groups_;  ///< By number of the run.
  std::vector<bool> known_;   ///< Likewise.
  std::vector<Name> runs_;    ///< In the order in which they came.
};

/// The mean of the values of each group's runs. A run without a group is one of its own.
ValuesByRun means_by_group(const ValuesByRun& values, const GroupsByRun& groups);

}  // namespace mapproof
