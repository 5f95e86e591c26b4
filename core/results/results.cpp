#include "core/results/results.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"

namespace mapproof {
namespace {

auto location_of(const Result& result) {
  return std::tie(result.at, result.method, result.quantity, result.run, result.subject);
}

auto location_of(const RunOutcome& outcome) {
  return std::tie(outcome.at, outcome.method, outcome.run);
}

/// The rank of each name in the order of the names that rows have, by its number.
template <typename Key>
class Ranks {
 public:
  Ranks(const std::vector<Result>& rows, const Key& key) {
    using Value = std::decay_t<decltype(key(rows.front()))>;
    std::uint32_t last = 0;
    for (const Result& row : rows) last = std::max(last, key(row).id());
    ranks_.resize(last + std::size_t{1}, kNone);
    std::vector<Value> values;
    for (const Result& row : rows)
      if (const Value value = key(row); std::exchange(ranks_[value.id()], 0) == kNone)
        values.push_back(value);
    std::ranges::sort(values, [](const Value& a, const Value& b) { return a < b; });
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0 && values[i - 1] < values[i]) ++count_;
      ranks_[values[i].id()] = count_;
    }
    ++count_;
  }

  std::uint32_t count() const { return count_; }
  std::uint32_t operator[](std::uint32_t id) const { return ranks_[id]; }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> ranks_;
  std::uint32_t count_ = 0;
};

/// Sorts the indices stably by one member of their rows: by counting, whatever their number.
template <typename Key>
void sort_by(const std::vector<Result>& rows, const Key& key, std::vector<std::uint32_t>& order) {
  const Ranks<Key> ranks(rows, key);
  if (ranks.count() == 1) return;
  std::vector<std::uint32_t> starts(ranks.count() + std::size_t{1}, 0);
  for (const Result& row : rows) ++starts[ranks[key(row).id()] + std::size_t{1}];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint32_t> sorted(rows.size());  // Not before the ranks, which take as much.
  for (const std::uint32_t i : order) sorted[starts[ranks[key(rows[i]).id()]]++] = i;
  order = std::move(sorted);
}

}  // namespace

std::size_t Interning<std::vector<Level>>::hash(View levels) {
  std::size_t all = levels.size();
  const auto add = [&all](std::size_t one) {
    all = (std::rotl(all, 5) ^ one) * 0x9E3779B97F4A7C15U;
  };
  for (const Level& level : levels) {
    add(std::hash<std::string>()(level.factor));
    if (const auto* text = std::get_if<std::string>(&level.value))
      add(std::hash<std::string>()(*text));
    else
      add(static_cast<std::size_t>(std::bit_cast<std::uint64_t>(std::get<double>(level.value))));
  }
  return all ^ (all >> 32);  // Tables take the last bits.
}

bool Interning<std::vector<Level>>::same(View a, View b) {
  return std::ranges::equal(a, b, [](const Level& one, const Level& other) {
    const auto* number = std::get_if<double>(&one.value);
    const auto* other_number = std::get_if<double>(&other.value);
    if (number == nullptr || other_number == nullptr) return one == other;
    return one.factor == other.factor &&
           std::bit_cast<std::uint64_t>(*number) == std::bit_cast<std::uint64_t>(*other_number);
  });
}

std::string level_text(const Level& level) {
  const auto* text = std::get_if<std::string>(&level.value);
  return text != nullptr ? *text : csv_number(std::get<double>(level.value));
}

Condition condition(Name setup, std::vector<Level> levels) {
  std::ranges::sort(levels, {}, &Level::factor);
  return {.setup = setup, .levels = std::move(levels)};
}

bool comes_before(const Result& a, const Result& b) { return location_of(a) < location_of(b); }

std::vector<std::uint32_t> order_of(const std::vector<Result>& rows) {
  if (rows.size() > ~std::uint32_t{0}) throw InvalidInput("more than 4294967295 rows of results");
  std::vector<std::uint32_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0U);
  if (std::ranges::is_sorted(rows, comes_before)) return order;
  // The least important member first.
  sort_by(
      rows, [](const Result& row) { return row.subject; }, order);
  sort_by(
      rows, [](const Result& row) { return row.run; }, order);
  sort_by(
      rows, [](const Result& row) { return row.quantity; }, order);
  sort_by(
      rows, [](const Result& row) { return row.method; }, order);
  sort_by(
      rows, [](const Result& row) { return row.at.levels; }, order);
  sort_by(
      rows, [](const Result& row) { return row.at.setup; }, order);
  return order;
}

void put_in_order(std::vector<std::uint32_t> order,
                  const std::function<void(std::size_t, std::size_t)>& swap) {
  // Index i gets element order[i], along each cycle of the permutation.
  for (std::uint32_t start = 0; start < order.size(); ++start)
    for (std::uint32_t to = start; order[to] != to;) {
      const std::uint32_t from = std::exchange(order[to], to);
      if (from == start) break;
      swap(to, from);
      to = from;
    }
}

void sort_results(Results& results) {
  put_in_order(order_of(results.rows),
               [&](std::size_t a, std::size_t b) { std::swap(results.rows[a], results.rows[b]); });
  std::ranges::stable_sort(results.outcomes, [](const RunOutcome& a, const RunOutcome& b) {
    return location_of(a) < location_of(b);
  });
}

std::string series_name(const Condition& at, const std::string& method,
                        const std::string& subject) {
  std::string name = at.setup.get() + "/" + method;
  for (const Level& level : at.levels) {
    name += "/" + (level.factor == kStepsFactor ? "" : level.factor + "-") + level_text(level);
  }
  return subject.empty() ? name : name + "/" + subject;
}

Name run_in_name(const Condition& at, const Name& run) { return run == at.setup ? Name() : run; }

std::string record_name(const Condition& at, const std::string& method, const std::string& run) {
  const std::string& first = run_in_name(at, run);
  return (first.empty() ? "" : first + "/") + series_name(at, method);
}

}  // namespace mapproof
