#include "core/base/text/spelling.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mapproof {
namespace {

constexpr std::size_t kCompared = 64;

/// Levenshtein distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// Whether two neighbouring letters have changed places.
bool is_swapped(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  const auto [first, other] = std::ranges::mismatch(a, b);
  const auto at = static_cast<std::size_t>(first - a.begin());
  return at + 1 < a.size() && a[at] == b[at + 1] && a[at + 1] == b[at] &&
         a.substr(at + 2) == b.substr(at + 2);
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates) {
  if (candidates.empty()) return {};
  const std::string_view start = word.substr(0, kCompared);
  return *std::ranges::min_element(
      candidates, {}, [&](std::string_view candidate) { return edit_distance(start, candidate); });
}

std::string_view likely_word(std::string_view word, std::span<const std::string_view> candidates) {
  const auto goes_on = [&](std::string_view candidate) {
    return !word.empty() && candidate.size() > word.size() && candidate.starts_with(word);
  };
  for (const std::string_view candidate : candidates)
    if (goes_on(candidate) && (candidate[word.size()] == '_' || candidate[word.size()] == '-'))
      return candidate;
  for (const std::string_view candidate : candidates)
    if (is_swapped(word, candidate)) return candidate;
  const std::string_view nearest = nearest_word(word, candidates);
  if (word.size() > kCompared || nearest.empty()) return {};
  const std::size_t allowed = std::max<std::size_t>(1, std::min(word.size(), nearest.size()) / 3);
  if (edit_distance(word, nearest) <= allowed) return nearest;
  constexpr std::size_t kFewest = 3;  // Letters that begin one word and hardly another.
  const auto longer = std::ranges::find_if(candidates, goes_on);
  return word.size() >= kFewest && longer != candidates.end() ? *longer : std::string_view();
}

}  // namespace mapproof
