#include "reports/diff/figures/figure_match.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace mapproof {
namespace {

/// The names of all points, if all have one and they are unique.
std::optional<std::map<std::string_view, std::size_t>> names_of(const LayerView& layer) {
  std::map<std::string_view, std::size_t> names;
  const bool by_mark = layer.has_mark_a_point();
  if (!by_mark && layer.texts.size() != layer.points()) return std::nullopt;
  for (std::size_t i = 0; i < layer.points(); ++i) {
    const std::string_view name = by_mark ? layer.marks[i].id : layer.texts[i];
    if (name.empty() || !names.emplace(name, i).second) return std::nullopt;
  }
  return names;
}

std::vector<Match> match_in_order(const LayerView& a, const LayerView& b) {
  const std::size_t n = a.points(), m = b.points(), least = std::min(n, m);
  std::size_t head = 0, tail = 0;
  if (n == m) {
    head = n;
  } else {
    while (head < least && have_equal_coordinates(a, head, b, head)) ++head;
    while (tail < least - head && have_equal_coordinates(a, n - 1 - tail, b, m - 1 - tail)) ++tail;
    head = least - tail;
  }
  std::vector<Match> matches;
  for (std::size_t i = 0; i < head; ++i) matches.push_back({i, i});
  for (std::size_t i = head; i < n - tail; ++i) matches.push_back({i, std::nullopt});
  for (std::size_t j = head; j < m - tail; ++j) matches.push_back({std::nullopt, j});
  for (std::size_t k = tail; k-- > 0;) matches.push_back({n - 1 - k, m - 1 - k});
  return matches;
}

}  // namespace

bool have_equal_coordinates(const LayerView& a, std::size_t i, const LayerView& b, std::size_t j) {
  for (std::size_t c = 0; c < a.coordinates.size(); ++c) {
    const double first = a.coordinates[c].values[i], second = b.coordinates[c].values[j];
    if (first != second && !(std::isnan(first) && std::isnan(second))) return false;
  }
  return true;
}

std::vector<Match> match_layers(const std::vector<Layer>& a, const std::vector<Layer>& b) {
  std::vector<LayerView> first, second;
  for (const Layer& layer : a) first.push_back(view_of(layer));
  for (const Layer& layer : b) second.push_back(view_of(layer));
  std::vector<std::optional<std::size_t>> partner(a.size());
  std::vector<bool> taken(b.size(), false);
  const auto pass = [&](const std::function<bool(std::size_t, std::size_t)>& fits) {
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size() && !partner[i]; ++j)
        if (!taken[j] && first[i].kind == second[j].kind && fits(i, j)) {
          partner[i] = j;
          taken[j] = true;
        }
  };
  const auto whole_mark = [](const LayerView& view) {
    return view.is_whole ? view.marks[0].id : std::string();
  };
  pass([&](std::size_t i, std::size_t j) { return a[i] == b[j]; });
  pass([&](std::size_t i, std::size_t j) {
    return first[i].label == second[j].label && whole_mark(first[i]) == whole_mark(second[j]);
  });
  pass([&](std::size_t i, std::size_t j) {
    return !whole_mark(first[i]).empty() && whole_mark(first[i]) == whole_mark(second[j]);
  });
  pass([&](std::size_t i, std::size_t j) { return first[i].label == second[j].label; });
  pass([&](std::size_t, std::size_t) { return true; });

  std::vector<Match> matches;
  for (std::size_t i = 0; i < a.size(); ++i) matches.push_back({i, partner[i]});
  for (std::size_t j = 0; j < b.size(); ++j)
    if (!taken[j]) matches.push_back({std::nullopt, j});
  return matches;
}

std::vector<Match> match_points(const LayerView& a, const LayerView& b) {
  const auto first = names_of(a), second = names_of(b);
  if (!first || !second) return match_in_order(a, b);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < a.points(); ++i) {
    const std::string_view name = a.has_mark_a_point() ? a.marks[i].id : a.texts[i];
    const auto found = second->find(name);
    matches.push_back({i, found == second->end() ? std::nullopt : std::optional(found->second)});
  }
  for (std::size_t j = 0; j < b.points(); ++j) {
    const std::string_view name = b.has_mark_a_point() ? b.marks[j].id : b.texts[j];
    if (!first->contains(name)) matches.push_back({std::nullopt, j});
  }
  return matches;
}

}  // namespace mapproof
