#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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

/// Under what a result came out.
struct Condition {
  std::string setup = {};          ///< "bearing", "plaza-1", "sensor-range".
  std::vector<Level> levels = {};  ///< Any number of factors, in ascending order of their names.

  auto operator<=>(const Condition&) const = default;
};

/// A condition with its levels in order.
Condition condition(std::string setup, std::vector<Level> levels = {});

/// One number: of a method under a condition, in one run.
struct Result {
  Condition at = {};
  std::string method = {};    ///< With its parameter: "isomap-K6".
  std::string quantity = {};  ///< Quantity::id.
  std::string run = {};       ///< "layout-1-pose-2", "plaza-1"; empty: of several runs together.
  /// What runs that depend on each other share, "layout-1": intervals and paired tests draw it.
  std::string group = {};
  std::string subject = {};  ///< A landmark, beacon or robot; empty: of all.
  double value = 0.0;        ///< NaN: lost, no number came out.
};

/// How one method ended in one run.
struct RunOutcome {
  Condition at = {};
  std::string method = {};
  std::string run = {};
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

/// Whether `a` comes before `b` in a table of results.
bool comes_before(const Result& a, const Result& b);

/// What a number is of, but for run and quantity: "bearing/isomap-K9/2000",
/// "bearing/isomap-K9/anchor-count-5/2000", "plaza-1/ekf": setup, method, levels, subject.
std::string series_name(const Condition& at, const std::string& method,
                        const std::string& subject = "");

/// The run that a record's name begins with. A log is a setup of its own, and its records are
/// named by that: empty.
std::string run_in_name(const Condition& at, const std::string& run);

/// "layout-1-pose-2/bearing/isomap-K9/2000".
std::string record_name(const Condition& at, const std::string& method, const std::string& run);

}  // namespace mapproof
