#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
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

/// The group of each run, by Name::id(): 4 bytes per run, and 4 per name of the process where runs
/// have groups other than themselves.
class GroupsByRun {
 public:
  GroupsByRun() = default;
  /// Of all rows.
  explicit GroupsByRun(const std::vector<Result>& rows) {
    for (const Result& row : rows) set(row.run, row.group);
  }

  void set(const Name& run, const Name& group);

  /// None if the run is not there. @note O(1).
  std::optional<Name> find(const Name& run) const {
    if (!contains(run)) return std::nullopt;
    return is_alone_[run.id()] ? run : groups_[run.id()];
  }
  bool contains(const Name& run) const { return run.id() < known_.size() && known_[run.id()]; }

  std::size_t size() const { return runs_.size(); }
  /// In ascending order.
  std::vector<Name> runs() const;

 private:
  std::vector<bool> known_;     ///< By number of the run.
  std::vector<bool> is_alone_;  ///< Likewise: it is the group of itself.
  std::vector<Name> groups_;    ///< Likewise, of those that are not alone.
  std::vector<Name> runs_;      ///< In the order in which they came.
};

/// Runs by their groups, so that means over groups take no copy of names and values: a bit per run,
/// and 4 bytes where groups do not ascend as the runs do.
class RunsByGroup {
 public:
  /// Of the runs of the values, at most 2^32 - 1. A run without a group is one of its own.
  RunsByGroup(const ValuesByRun& values, const GroupsByRun& groups);

  std::size_t groups() const { return groups_; }

  /// The mean of the values of each group's runs, in ascending order of the groups.
  /// @param value_of  The value of the run of an index.
  template <typename ValueOf>
  std::vector<double> means(const ValueOf& value_of) const {
    std::vector<double> means;
    means.reserve(groups_);
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < begins_.size(); ++i) {
      if (begins_[i] && count > 0) {
        means.push_back(sum / count);
        sum = 0.0;
        count = 0;
      }
      sum += value_of(order_.empty() ? i : order_[i]);
      ++count;
    }
    if (count > 0) means.push_back(sum / count);
    return means;
  }

 private:
  std::vector<std::uint32_t> order_;  ///< Indices of runs by group; empty: as they are.
  std::vector<bool> begins_;          ///< Per run in that order: it is the first of its group.
  std::size_t groups_ = 0;
};

}  // namespace mapproof
