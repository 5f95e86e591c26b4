#include "reports/sections/results/crossed_names.hpp"

#include <algorithm>
#include <set>

namespace mapproof {
namespace {

using Parts = std::pair<std::string, std::string>;

std::optional<Parts> parts_of(const std::string& label) {
  const std::size_t comma = label.find(", ");
  if (comma == std::string::npos || comma == 0 || comma + 2 == label.size()) return std::nullopt;
  return Parts{label.substr(0, comma), label.substr(comma + 2)};
}

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// Whether one of them occurs twice.
bool any_repeats(const std::vector<std::string>& names) {
  return std::set<std::string>(names.begin(), names.end()).size() < names.size();
}

}  // namespace

std::optional<CrossedNames> crossed_names(const std::vector<std::string>& labels,
                                          const std::vector<std::string>& of_study) {
  std::vector<Parts> shown;
  std::vector<std::string> firsts, seconds;
  for (const std::string& label : labels) {
    const auto parts = parts_of(label);
    if (!parts) return std::nullopt;
    shown.push_back(*parts);
    firsts.push_back(parts->first);
    seconds.push_back(parts->second);
  }
  if (!any_repeats(firsts) || !any_repeats(seconds)) return std::nullopt;
  CrossedNames crossed;
  for (const std::string& label : of_study) {
    const auto parts = parts_of(label);
    if (!parts) continue;
    if (index_of(crossed.firsts, parts->first) == crossed.firsts.size())
      crossed.firsts.push_back(parts->first);
    if (index_of(crossed.seconds, parts->second) == crossed.seconds.size())
      crossed.seconds.push_back(parts->second);
  }
  std::set<std::size_t> first_parts, second_parts;
  for (const auto& [first, second] : shown) {
    crossed.names.emplace_back(index_of(crossed.firsts, first), index_of(crossed.seconds, second));
    first_parts.insert(crossed.names.back().first);
    second_parts.insert(crossed.names.back().second);
  }
  if (first_parts.size() + second_parts.size() > labels.size()) return std::nullopt;
  return crossed;
}

}  // namespace mapproof
