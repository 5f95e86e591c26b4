#include "reports/diff/svg/svg_tree.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "reports/diff/svg/svg_attributes.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostPairs = std::size_t{1} << 22;

/// Digests of elements with all below them; children come after their parents.
std::vector<std::uint64_t> digests(const SvgTree& tree) {
  const auto mix = [](std::uint64_t seed, std::uint64_t value) {
    return (seed ^ (value + 0x9E3779B97F4A7C15u + (seed << 6) + (seed >> 2))) * 0xFF51AFD7ED558CCDu;
  };
  const std::hash<std::string> hash;
  std::vector<std::uint64_t> of(tree.elements.size());
  for (std::size_t i = tree.elements.size(); i-- > 0;) {
    const SvgElement& element = tree.elements[i];
    std::uint64_t digest = mix(hash(element.name), hash(element.text));
    for (const auto& [name, value] : element.values)
      digest = mix(mix(digest, hash(name)), hash(value));
    for (const int child : element.children) digest = mix(digest, of[child]);
    of[i] = digest;
  }
  return of;
}

/// "line2d_12" without its number.
std::string_view stem(std::string_view id) {
  const std::size_t last = id.find_last_not_of("0123456789");
  return id.substr(0, last == id.npos ? 0 : last + 1);
}

/// How many ids of each stem, the least number and the largest. Numbers too long for one are names.
struct Numbers {
  std::uint32_t count = 0, least = UINT32_MAX, largest = 0;
  bool operator==(const Numbers&) const = default;
  bool are_counted() const { return count > 0 && largest - least + 1 == count; }
};

std::map<std::string_view, Numbers> numbers_of(const SvgTree& tree) {
  std::map<std::string_view, Numbers> found;
  for (const SvgElement& element : tree.elements) {
    const std::string_view of = stem(element.id),
                           digits = std::string_view(element.id).substr(of.size());
    std::uint32_t number = 0;
    if (digits.empty() || digits.size() > 9) continue;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    Numbers& numbers = found[of];
    ++numbers.count;
    numbers.least = std::min(numbers.least, number);
    numbers.largest = std::max(numbers.largest, number);
  }
  return found;
}

/// Stems whose numbers only count, without a gap, to another end: where one of their elements is
/// gone, those after it bear other numbers, and an id says nothing.
std::set<std::string_view> renumbered_stems(const SvgTree& a, const SvgTree& b) {
  std::set<std::string_view> stems;
  const auto others = numbers_of(b);
  for (const auto& [of, numbers] : numbers_of(a))
    if (const auto other = others.find(of); other != others.end() && other->second != numbers &&
                                            other->second.are_counted() && numbers.are_counted() &&
                                            other->second.least == numbers.least)
      stems.insert(of);
  return stems;
}

class Matcher {
 public:
  Matcher(const SvgTree& a, const SvgTree& b)
      : a_(a), b_(b), digest_a_(digests(a)), digest_b_(digests(b)) {
    match_.partner.assign(a.elements.size(), -1);
    match_.back.assign(b.elements.size(), -1);
    match_.is_reordered.assign(a.elements.size(), false);
  }

  SvgMatch run() {
    pair(0, 0);
    pair_by_id();
    // Parents come before their children, and are matched before them.
    for (int i = 0; i < static_cast<int>(a_.elements.size()); ++i)
      if (match_.partner[i] >= 0) match_children(i, match_.partner[i]);
    return std::move(match_);
  }

 private:
  void pair(int i, int j) {
    match_.partner[i] = j;
    match_.back[j] = i;
  }

  /// Elements by their id; -1 where two share one.
  static std::map<std::string_view, int> by_id(const SvgTree& tree) {
    std::map<std::string_view, int> found;
    for (std::size_t i = 1; i < tree.elements.size(); ++i)
      if (const std::string& id = tree.elements[i].id; !id.empty())
        if (const auto [location, is_new] = found.emplace(id, static_cast<int>(i)); !is_new)
          location->second = -1;
    return found;
  }

  void pair_by_id() {
    const auto others = by_id(b_);
    const auto renumbered = renumbered_stems(a_, b_);
    for (const auto& [id, i] : by_id(a_))
      if (const auto other = others.find(id);
          i > 0 && !renumbered.contains(stem(id)) && other != others.end() && other->second > 0 &&
          a_.elements[i].name == b_.elements[other->second].name)
        pair(i, other->second);
  }

  void match_children(int parent_a, int parent_b) {
    const auto &all_a = a_.elements[parent_a].children, &all_b = b_.elements[parent_b].children;
    std::vector<int> free_a, free_b;
    for (const int i : all_a)
      if (match_.partner[i] < 0) free_a.push_back(i);
    for (const int j : all_b)
      if (match_.back[j] < 0) free_b.push_back(j);
    match_runs(free_a, free_b);
    find_reordered(all_a, parent_b);
  }

  /// Equal children at both ends need no search.
  void match_runs(std::vector<int> a, std::vector<int> b) {
    const auto equal = [&](int i, int j) { return digest_a_[i] == digest_b_[j]; };
    while (!a.empty() && !b.empty() && equal(a.back(), b.back())) {
      pair(a.back(), b.back());
      a.pop_back(), b.pop_back();
    }
    std::size_t first = 0;
    while (first < std::min(a.size(), b.size()) && equal(a[first], b[first])) {
      pair(a[first], b[first]);
      ++first;
    }
    a.erase(a.begin(), a.begin() + first);
    b.erase(b.begin(), b.begin() + first);
    if (a.empty() || b.empty()) return;
    if (a.size() * b.size() <= pairs_left_)
      align(a, b);
    else
      for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (a_.elements[a[i]].name == b_.elements[b[i]].name) pair(a[i], b[i]);
  }

  /// What it costs to take one for the other: 0 if equal, more than removing and adding if they
  /// have nothing in common.
  float cost(int i, int j) const {
    if (digest_a_[i] == digest_b_[j]) return 0.0f;
    const SvgElement &a = a_.elements[i], &b = b_.elements[j];
    if (a.name != b.name) return 3.0f;
    float different = a.text == b.text ? 0.0f : 1.0f, all = 1.0f;
    for (const auto& [name, value] : a.values) {
      const auto other = b.values.find(name);
      ++all;
      different += other == b.values.end() || other->second != value;
    }
    different +=
        std::abs(static_cast<float>(a.children.size()) - static_cast<float>(b.children.size())) > 0;
    return 0.1f + 1.5f * different / (all + 1.0f);
  }

  /// The alignment in order that costs least; leaving one out costs 1.
  void align(const std::vector<int>& a, const std::vector<int>& b) {
    const std::size_t n = a.size(), m = b.size();
    pairs_left_ -= n * m;
    std::vector<float> best((n + 1) * (m + 1));
    const auto at = [&](std::size_t i, std::size_t j) -> float& { return best[i * (m + 1) + j]; };
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= m; ++j) {
        if (i == 0 || j == 0) {
          at(i, j) = static_cast<float>(i + j);
          continue;
        }
        at(i, j) = std::min({at(i - 1, j - 1) + cost(a[i - 1], b[j - 1]), at(i - 1, j) + 1.0f,
                             at(i, j - 1) + 1.0f});
      }
    for (std::size_t i = n, j = m; i > 0 && j > 0;) {
      if (at(i, j) == at(i - 1, j) + 1.0f) {
        --i;
      } else if (at(i, j) == at(i, j - 1) + 1.0f) {
        --j;
      } else {
        pair(a[--i], b[--j]);
      }
    }
  }

  /// Of children that stayed below the parent, all but a longest run in the old order.
  void find_reordered(const std::vector<int>& children, int parent_b) {
    std::vector<int> stayed;
    for (const int i : children)
      if (const int j = match_.partner[i]; j >= 0 && b_.elements[j].parent == parent_b)
        stayed.push_back(i);
    if (std::ranges::is_sorted(stayed, {}, [&](int i) { return match_.partner[i]; })) return;
    // Patience sorting: the last of the least runs of each length, and who came before it.
    std::vector<int> tails;
    std::map<int, int> before;
    for (const int i : stayed) {
      const auto location = std::ranges::lower_bound(tails, match_.partner[i], {},
                                                     [&](int k) { return match_.partner[k]; });
      before[i] = location == tails.begin() ? -1 : *(location - 1);
      location == tails.end() ? tails.push_back(i) : void(*location = i);
    }
    for (const int i : stayed) match_.is_reordered[i] = true;
    for (int i = tails.back(); i >= 0; i = before[i]) match_.is_reordered[i] = false;
  }

  const SvgTree &a_, &b_;
  std::vector<std::uint64_t> digest_a_, digest_b_;
  SvgMatch match_;
  std::size_t pairs_left_ = kMostPairs;
};

std::string_view value_of(const SvgElement& element, const std::string& name) {
  const auto found = element.values.find(name);
  return found == element.values.end() ? std::string_view() : std::string_view(found->second);
}

/// A length in pixels; empty for shares of something that is not known.
std::optional<double> pixels(std::string_view length) {
  using Unit = std::pair<std::string_view, double>;
  constexpr std::array kUnits = {Unit{"", 1.0},          Unit{"px", 1.0},  Unit{"pt", 96.0 / 72.0},
                                 Unit{"pc", 16.0},       Unit{"in", 96.0}, Unit{"cm", 96.0 / 2.54},
                                 Unit{"mm", 96.0 / 25.4}};
  double number = 0.0;
  const std::size_t used = read_number(length, number);
  if (used == 0) return std::nullopt;
  for (const auto& [unit, size] : kUnits)
    if (length.substr(used) == unit) return number * size;
  return std::nullopt;
}

/// Width and height of the viewBox; zero: none.
std::array<double, 2> view_box(std::string_view text) {
  std::array<double, 4> box{};
  for (double& number : box) {
    while (text.starts_with(' ') || text.starts_with(',')) text.remove_prefix(1);
    const std::size_t used = read_number(text, number);
    if (used == 0) return {};
    text.remove_prefix(used);
  }
  return {box[2], box[3]};
}

double root_unit(const SvgElement& root) {
  const std::array<double, 2> box = view_box(value_of(root, "viewBox"));
  double unit = 0.0;
  for (const auto& [side, length] : {std::pair("width", box[0]), {"height", box[1]}}) {
    const std::optional<double> size = pixels(value_of(root, side));
    if (!size || *size <= 0.0 || length <= 0.0) continue;
    unit = unit > 0.0 ? std::min(unit, *size / length) : *size / length;
  }
  return unit > 0.0 ? unit : 1.0;
}

/// How much longer the transform makes what it makes longest.
double scale_of(std::string_view transform) {
  const auto matrix = matrix_numbers(transform);
  if (!matrix) return 1.0;
  const std::vector<double>& m = matrix->numbers;
  return std::max(std::hypot(m[0], m[1]), std::hypot(m[2], m[3]));
}

}  // namespace

std::string SvgTree::path(int element) const {
  std::string path;
  for (int i = element; i >= 0; i = elements[i].parent) {
    const SvgElement& one = elements[i];
    std::string step = one.name;
    if (!one.id.empty())
      step += "#" + one.id;
    else if (one.parent >= 0)
      step += fmt::format("[{}]", one.location);
    path.insert(0, path.empty() ? step : step.append("/"));
  }
  return path;
}

SvgMatch match_svgs(const SvgTree& baseline, const SvgTree& current) {
  return Matcher(baseline, current).run();
}

SvgUnits svg_units(const SvgTree& tree) {
  SvgUnits units;
  for (const SvgElement& element : tree.elements) {
    const bool is_root = element.parent < 0;
    const double outer = is_root ? 1.0 : units.inner[static_cast<std::size_t>(element.parent)];
    units.outer.push_back(outer);
    units.inner.push_back(is_root ? root_unit(element)
                                  : outer * scale_of(value_of(element, "transform")));
  }
  return units;
}

}  // namespace mapproof
