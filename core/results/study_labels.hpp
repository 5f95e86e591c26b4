#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mapproof {

/// A factor's label and the unit of its levels; empty if there is none.
struct LabelWithUnit {
  std::string label;
  std::string unit = {};

  bool operator==(const LabelWithUnit&) const = default;
};

/// What a study itself calls its setups, methods and factors, by their ids.
struct StudyLabels {
  std::map<std::string, std::string> setups = {};
  /// Of every method that is not one of mapproof's own, its id where the study has no other word
  /// for it.
  std::map<std::string, std::string> methods = {};
  /// The ids of `methods` in the order of the study, which their styles in figures depend on; ids
  /// that are not here come last, as they sort.
  std::vector<std::string> order = {};
  std::map<std::string, LabelWithUnit> factors = {};

  /// Adds a method, or another label of one that is there; its place in the order is the last.
  void add_method(const std::string& id, const std::string& label) {
    methods[id] = label;
    std::erase(order, id);
    order.push_back(id);
  }

  /// The ids of all methods in the order of the study.
  std::vector<std::string> ordered() const {
    std::vector<std::string> ids = order;
    std::erase_if(ids, [&](const std::string& id) { return !methods.contains(id); });
    for (const auto& [id, label] : methods)
      if (std::ranges::find(order, id) == order.end()) ids.push_back(id);
    return ids;
  }

  /// Adds what a later study called them: its labels and its order come first.
  void add(const StudyLabels& later) {
    for (const auto& [id, label] : later.setups) setups[id] = label;
    for (const auto& [id, label] : later.methods) methods[id] = label;
    for (const auto& [id, label] : later.factors) factors[id] = label;
    std::vector<std::string> all = later.ordered();
    for (const std::string& id : order)
      if (!later.methods.contains(id)) all.push_back(id);
    order = std::move(all);
  }

  bool operator==(const StudyLabels& other) const {
    return setups == other.setups && methods == other.methods && factors == other.factors &&
           ordered() == other.ordered();
  }
};

}  // namespace mapproof
