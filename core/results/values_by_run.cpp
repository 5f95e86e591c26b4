#include "core/results/values_by_run.hpp"

#include <iterator>
#include <numeric>

namespace mapproof {

void ValuesByRun::merge(const ValuesByRun& others) {
  std::vector<value_type> all;
  all.reserve(values_.size() + others.size());
  std::ranges::set_union(values_, others.values_, std::back_inserter(all), {}, &value_type::first,
                         &value_type::first);
  values_ = std::move(all);
}

void ValuesByRun::keep(const std::vector<Name>& runs) {
  auto kept = runs.begin();
  std::erase_if(values_, [&](const value_type& value) {
    while (kept != runs.end() && *kept < value.first) ++kept;
    return kept == runs.end() || *kept != value.first;
  });
}

void GroupsByRun::set(const Name& run, const Name& group) {
  if (run.id() >= known_.size()) {
    known_.resize(run.id() + std::size_t{1});
    is_alone_.resize(known_.size());
  }
  if (!known_[run.id()]) runs_.push_back(run);
  known_[run.id()] = true;
  is_alone_[run.id()] = group == run;
  if (group == run) return;
  if (run.id() >= groups_.size()) groups_.resize(known_.size());
  groups_[run.id()] = group;
}

std::vector<Name> GroupsByRun::runs() const {
  std::vector<Name> sorted = runs_;
  std::ranges::sort(sorted, [](const Name& a, const Name& b) { return a < b; });
  return sorted;
}

RunsByGroup::RunsByGroup(const ValuesByRun& values, const GroupsByRun& groups)
    : begins_(values.size()) {
  const auto runs = values.begin();
  const auto group_of = [&](std::size_t index) {
    const Name& run = runs[static_cast<std::ptrdiff_t>(index)].first;
    return groups.find(run).value_or(run);
  };
  bool ascends = true;
  for (std::size_t i = 1; ascends && i < values.size(); ++i)
    ascends = !(group_of(i) < group_of(i - 1));
  if (!ascends) {
    order_.resize(values.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::ranges::stable_sort(
        order_, [&](std::uint32_t a, std::uint32_t b) { return group_of(a) < group_of(b); });
  }
  const auto run_at = [&](std::size_t i) { return order_.empty() ? i : order_[i]; };
  for (std::size_t i = 0; i < values.size(); ++i) {
    begins_[i] = i == 0 || group_of(run_at(i)) != group_of(run_at(i - 1));
    groups_ += begins_[i];
  }
}

}  // namespace mapproof
