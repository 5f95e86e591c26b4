#include "core/results/results_study.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// @return The first label whose id no row has; empty if there is none.
std::string complete(std::vector<Label>& labels, const std::set<std::string>& in_rows) {
  for (const Label& label : labels)
    if (!in_rows.contains(label.id)) return label.id;
  std::set<std::string> known;
  for (const Label& label : labels) known.insert(label.id);
  for (const std::string& id : in_rows)
    if (!known.contains(id)) labels.push_back({id, id});
  return "";
}

void complete_quantities(ResultsStudy& study, const std::set<std::string>& in_rows) {
  std::erase_if(study.quantities, [&](const std::string& id) { return !in_rows.contains(id); });
  for (const Quantity& quantity : study.results.quantities.all())
    if (in_rows.contains(quantity.id) &&
        std::ranges::find(study.quantities, quantity.id) == study.quantities.end())
      study.quantities.push_back(quantity.id);
}

/// Rows of one condition that stand together.
struct ConditionRows {
  const Result* first = nullptr;
  long rows = 0;
};

std::vector<ConditionRows> rows_by_condition(const std::vector<Result>& rows) {
  std::vector<ConditionRows> all;
  for (const Result& row : rows) {
    if (all.empty() || all.back().first->at != row.at) all.push_back({.first = &row});
    ++all.back().rows;
  }
  return all;
}

const std::string& setup_of(const ConditionRows& rows) { return rows.first->at.setup; }

/// The remark where some rows of a setup have a factor and others have not; empty else.
/// @param conditions  Of the setup alone.
std::string lacking(std::span<const ConditionRows> conditions, const std::string& factor) {
  long without = 0, all = 0;
  const Result* first = nullptr;
  for (const ConditionRows& one : conditions) {
    const Condition& at = one.first->at;
    all += one.rows;
    if (std::ranges::find(at.levels, factor, &Level::factor) != at.levels.end()) continue;
    without += one.rows;
    if (first == nullptr) first = one.first;
  }
  if (without == 0 || without == all) return "";
  return fmt::format(
      "at.{} is empty in {} of the {} rows of the setup \"{}\", first of {}, {}{}: there the "
      "factor "
      "is not given, and these rows stand in a section of their own",
      printable(factor, 40), without, all, printable(first->at.setup, 40),
      printable(first->method, 40), first->quantity.get(),
      first->run.empty() ? "" : ", run " + printable(first->run, 40));
}

/// Whether a quantity has values other than 0, and all of them lie in 0 to 1.
bool are_shares(const std::vector<Result>& rows, const Name& quantity) {
  bool any = false;
  for (const Result& row : rows) {
    if (row.quantity != quantity || std::isnan(row.value)) continue;
    if (row.value < 0.0 || row.value > 1.0) return false;
    any = any || row.value > 0.0;
  }
  return any;
}

}  // namespace

std::string complete(ResultsStudy& study) {
  std::set<std::string> quantities, setups, methods, factors;
  Result before;
  for (const Result& row : study.results.rows) {
    const bool is_first = &row == &study.results.rows.front();
    if (is_first || row.quantity != before.quantity) quantities.insert(row.quantity);
    if (is_first || row.method != before.method) methods.insert(row.method);
    if (is_first || row.at.setup != before.at.setup) setups.insert(row.at.setup);
    if (row.at.levels != before.at.levels)
      for (const Level& level : row.at.levels) factors.insert(level.factor);
    before = row;
  }
  complete_quantities(study, quantities);
  if (const std::string id = complete(study.setups, setups); !id.empty()) return "setups: " + id;
  if (const std::string id = complete(study.methods, methods); !id.empty()) return "methods: " + id;
  if (const std::string id = complete(study.factors, factors); !id.empty()) return "factors: " + id;
  return "";
}

std::vector<std::string> remarks_of(const ResultsStudy& study) {
  std::vector<std::string> remarks;
  const std::vector<ConditionRows> conditions = rows_by_condition(study.results.rows);
  for (const Label& setup : study.setups) {
    const auto own = std::ranges::equal_range(conditions, setup.id, {}, setup_of);
    for (const Label& factor : study.factors)
      if (std::string remark = lacking(own, factor.id); !remark.empty())
        remarks.push_back(std::move(remark));
  }
  for (const std::string& id : study.quantities) {
    const Quantity& quantity = study.results.quantities.at(id);
    // An error, as a drift, may well be below 1 %.
    if (quantity.unit == "%" && quantity.better != Better::kLower &&
        are_shares(study.results.rows, id))
      remarks.push_back(fmt::format(
          "all values of {} lie between 0 and 1, but its unit is %: are they shares?", id));
  }
  return remarks;
}

std::vector<std::string> label_remarks_of(const ResultsStudy& study) {
  std::vector<std::string> remarks;
  std::vector<Label> quantities;
  for (const std::string& id : study.quantities)
    quantities.push_back({id, study.results.quantities.at(id).label});
  for (const auto& [list, labels] :
       {std::pair<const char*, const std::vector<Label>*>{"quantities", &quantities},
        {"setups", &study.setups},
        {"methods", &study.methods},
        {"factors", &study.factors}}) {
    std::map<std::string, std::string> ids;  // The first of each label.
    for (const Label& label : *labels)
      if (const auto [first, is_new] = ids.emplace(label.label, label.id); !is_new)
        remarks.push_back(fmt::format(
            "{}: {} and {} have the same label \"{}\": figures and tables do not distinguish them",
            list, printable(first->second, 40), printable(label.id, 40),
            printable(label.label, 40)));
  }
  return remarks;
}

std::string label_of(const std::vector<Label>& labels, const std::string& id) {
  const auto found = std::ranges::find(labels, id, &Label::id);
  return found == labels.end() ? id : found->label;
}

}  // namespace mapproof
