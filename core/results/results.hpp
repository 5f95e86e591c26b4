#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/interned.hpp"
#include "core/results/quantity.hpp"

namespace mapproof {

/// One factor of a condition and the level it stands at.
struct Level {
  std::string factor;                       ///< "steps", "anchor-count", "missing_percent".
  std::variant<double, std::string> value;  ///< A number that is not NaN, or a text.

  auto operator<=>(const Level&) const = default;
};

/// "2000", "white": a number in as few digits as read back as the same.
std::string level_text(const Level& level);

/// The factor whose levels are numbers of observations.
inline constexpr std::string_view kStepsFactor = "steps";

template <>
struct Interning<std::vector<Level>> {
  using View = const std::vector<Level>&;
  static std::size_t hash(View levels);
  /// By the bits of numbers.
  static bool same(View a, View b);
};

using Levels = Interned<std::vector<Level>>;

/// Under what a result came out.
struct Condition {
  Name setup = {};     ///< "bearing", "plaza-1", "sensor-range".
  Levels levels = {};  ///< Any number of factors, in ascending order of their names.

  auto operator<=>(const Condition&) const = default;
};

/// A condition with its levels in order.
Condition condition(Name setup, std::vector<Level> levels = {});

/// One number: of a method under a condition, in one run. 40 bytes: a study may have 10^7.
struct Result {
  Condition at = {};
  Name method = {};    ///< With its parameter: "isomap-K6".
  Name quantity = {};  ///< Quantity::id.
  Name run = {};       ///< "layout-1-pose-2", "plaza-1"; empty: of several runs together.
  /// What runs that depend on each other share, "layout-1": intervals and paired tests draw it.
  Name group = {};
  Name subject = {};   ///< A landmark, beacon or robot; empty: of all.
  double value = 0.0;  ///< NaN: lost, no number came out.
};
static_assert(sizeof(Result) <= 40);

/// How one method ended in one run.
struct RunOutcome {
  Condition at = {};
  Name method = {};
  Name run = {};
  std::vector<std::string> codes = {};  ///< Of its statuses, in order; empty: it went well.
};

/// A method without its parameter, so that another value of it can be recognised.
struct MethodFamily {
  std::string name;       ///< "isomap".
  std::string parameter;  ///< "K = 9".
};

/// All that a study found, one row per number.
struct Results {
  Quantities quantities = {};             ///< The dictionary and what the study declares.
  std::vector<Result> rows = {};          ///< In ascending order of all but the value.
  std::vector<RunOutcome> outcomes = {};  ///< In ascending order.
  std::map<std::string, MethodFamily> families = {};  ///< By method, where it has a parameter.
  /// The runs are drawn alike and differ by their seeds alone: tests over them mean something.
  bool are_repeats = false;
};

/// Puts rows and outcomes in order.
void sort_results(Results& results);

/// The indices of rows in ascending order, of equal ones the first first.
/// @note O(n) time, of n rows that have few different names or many; 8 bytes per row and per name.
/// @throws InvalidInput beyond 2^32 - 1 rows.
std::vector<std::uint32_t> order_of(const std::vector<Result>& rows);

/// Swaps elements until each index has the element that was at the index that `order` gives it.
void put_in_order(std::vector<std::uint32_t> order,
                  const std::function<void(std::size_t, std::size_t)>& swap);

/// Whether `a` comes before `b` in a table of results.
bool comes_before(const Result& a, const Result& b);

/// What a number is of, but for run and quantity: "bearing/isomap-K9/2000",
/// "bearing/isomap-K9/anchor-count-5/2000", "plaza-1/ekf": setup, method, levels, subject.
std::string series_name(const Condition& at, const std::string& method,
                        const std::string& subject = "");

/// The run that a record's name begins with. A log is a setup of its own, and its records are
/// named by that: empty.
Name run_in_name(const Condition& at, const Name& run);

/// "layout-1-pose-2/bearing/isomap-K9/2000".
std::string record_name(const Condition& at, const std::string& method, const std::string& run);

}  // namespace mapproof
