#include "core/results/values_by_run.hpp"

#include <iterator>

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
    groups_.resize(known_.size());
  }
  if (!known_[run.id()]) runs_.push_back(run);
  known_[run.id()] = true;
  groups_[run.id()] = group;
}

std::vector<Name> GroupsByRun::runs() const {
  std::vector<Name> sorted = runs_;
  std::ranges::sort(sorted, [](const Name& a, const Name& b) { return a < b; });
  return sorted;
}

ValuesByRun means_by_group(const ValuesByRun& values, const GroupsByRun& groups) {
  std::vector<ValuesByRun::value_type> of_groups;
  of_groups.reserve(values.size());
  for (const auto& [run, value] : values) {
    const Name* group = groups.find(run);
    of_groups.emplace_back(group == nullptr ? run : *group, value);
  }
  std::ranges::stable_sort(of_groups, {}, &ValuesByRun::value_type::first);
  ValuesByRun means;
  means.reserve(of_groups.size());
  for (auto first = of_groups.begin(); first != of_groups.end();) {
    double sum = 0.0;
    int count = 0;
    auto end = first;
    for (; end != of_groups.end() && end->first == first->first; ++end, ++count) sum += end->second;
    means[first->first] = sum / count;
    first = end;
  }
  return means;
}

}  // namespace mapproof
